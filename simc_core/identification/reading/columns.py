"""Every column as numbers: read in pieces, so that a large file costs little beside its numbers."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from simc_core.identification.reading.instants import Shape, shape_of, to_seconds
from simc_core.identification.reading.numerals import BAD_WORDS, GOOD_WORDS, to_floats

PIECE = 20_000  # rows
NUMBERS, INSTANTS, QUALITY, STATES, WORDS = "numbers", "dates", "quality", "states", "words"
QUALITY_WORDS = GOOD_WORDS | BAD_WORDS | {"bad", "uncertain", "questionable", "substituted"}


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """One column of a file.

    values: numbers, seconds of instants, 1 for a good quality; nan where there is none; shape (rows,).
    kind: NUMBERS, INSTANTS, QUALITY, STATES or WORDS.   empty, bad: cells without anything, and without a number.
    shape: how its dates are written.   words: of the cells, for kind WORDS and where they are few.
    """

    name: str
    unit: str
    values: NDArray[np.float64]
    kind: str = NUMBERS
    empty: int = 0
    bad: int = 0
    first_bad: tuple[int, str] | None = None
    shape: Shape | None = None
    words: tuple[str, ...] = ()

    @property
    def finite(self) -> NDArray[np.bool_]:
        """Where there is a number."""
        return np.isfinite(self.values)


@dataclass(slots=True)
class _Growing:
    kind: str
    shape: Shape | None
    codes: dict[str, int]
    pieces: list[NDArray[np.float64]]
    empty: int = 0
    bad: int = 0
    first_bad: tuple[int, str] | None = None


def kind_of(cells: Sequence[str]) -> tuple[str, Shape | None]:
    """What the cells of a column are, by a sample of them."""
    given = [cell for cell in cells if cell and cell.lower() not in BAD_WORDS]
    if not given:
        return NUMBERS, None
    if (shape := shape_of(given)) and (shape.name != "compact" or len(given[0]) >= 14):
        return INSTANTS, shape
    if np.isfinite(to_floats(given, ".")).mean() > 0.5 or np.isfinite(to_floats(given, ",")).mean() > 0.5:
        if any(character.isdigit() for character in given[0]):
            return NUMBERS, None
        return STATES, None
    if {cell.lower() for cell in given} <= QUALITY_WORDS:
        return QUALITY, None
    return WORDS, None


def read_columns(
    rows: Iterator[list[str]],
    sample: Sequence[Sequence[str]],
    names: Sequence[str],
    units: Sequence[str],
    decimal: str,
    day_first: bool | None,
    first_line: int,
) -> list[Column]:
    """All columns. rows: those of numbers; sample: some of them, which tell what each column is."""
    width = len(names)
    kinds = [kind_of([row[i] for row in sample if i < len(row)]) for i in range(width)]
    growing = [_Growing(kind, shape, {}, []) for kind, shape in kinds]
    numbered = ((line, row) for line, row in enumerate(rows, start=first_line) if any(row))
    while piece := list(islice(numbered, PIECE)):
        lines = [line for line, _ in piece]
        for i, column in enumerate(growing):
            _take(column, [row[i] if i < len(row) else "" for _, row in piece], decimal, day_first, lines)
    return [_column(*each) for each in zip(growing, names, units, strict=True)]


def _column(grown: _Growing, name: str, unit: str) -> Column:
    values = np.concatenate(grown.pieces) if grown.pieces else np.empty(0)
    words = tuple(grown.codes)
    return Column(name, unit, values, grown.kind, grown.empty, grown.bad, grown.first_bad, grown.shape, words)


def _take(column: _Growing, cells: list[str], decimal: str, day_first: bool | None, lines: list[int]) -> None:
    empty = np.fromiter((not cell for cell in cells), bool, len(cells))
    if column.kind == INSTANTS and column.shape is not None:
        values = to_seconds(cells, column.shape, day_first)
    elif column.kind == QUALITY:
        values = np.array([float(cell.lower() in GOOD_WORDS) for cell in cells])
    elif column.kind == WORDS:
        values = np.array([column.codes.setdefault(cell, len(column.codes)) for cell in cells], dtype=np.float64)
    else:
        values = to_floats(cells, decimal)
    lost = ~np.isfinite(values) & ~empty
    if lost.any() and column.first_bad is None:
        at = int(np.argmax(lost))
        column.first_bad = (lines[at], cells[at][:40])
    column.empty += int(empty.sum())
    column.bad += int(lost.sum())
    column.pieces.append(values)
