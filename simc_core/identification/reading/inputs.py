"""Other columns that were moved while OP was: PV may answer them."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from simc_core.identification.reading.columns import QUALITY, Column
from simc_core.identification.reading.questions import Question
from simc_core.identification.reading.roles import PATTERNS
from simc_core.wording import said

HELD = 0.1  # share of its steps in which a column that is moved by hand or by a plan changes
TOGETHER = 5  # rows within which moves are at once
LARGE = 0.2  # share of its range from which a change is a move
ALIKE = 0.999  # correlation of two columns that are one, in two units
MOST_NAMED = 3


def moved_too(columns: Sequence[Column], candidates: Sequence[int], at: Mapping[str, int | None]) -> list[Question]:
    """A question for each column that is held like OP, and moves."""
    op = at["OP"]
    if op is None:
        return []
    own = _moves(columns[op].values)
    if own.size == 0:
        return []
    found = []
    for i in candidates:
        other = columns[i]
        if i in at.values() or other.kind == QUALITY:
            continue
        moves = _moves(other.values)
        if moves.size == 0 or _counts(other.values):
            continue
        if _is_one(columns[op].values, other.values):
            if any(pattern.search(other.name) for pattern in PATTERNS["OP"]):
                continue  # OP in another unit
            text = said(
                "{column} moves exactly as OP does: if it is another input, PV may answer either.", column=other.name
            )
        elif np.abs(moves[:, None] - own[None, :]).min() <= TOGETHER:
            text = said(
                "{column} was moved at once with OP: PV may answer either, and nothing here tells them apart.",
                column=other.name,
            )
        else:
            text = said("{column} changes too: PV may answer it; leave out what follows its steps.", column=other.name)
        found.append(Question("inputs", text, (), "no answer to it"))
    return found[:MOST_NAMED]


def _moves(values: NDArray[np.float64]) -> NDArray[np.intp]:
    """Rows of the moves of a column that is held; empty for one that changes all the time, or never."""
    good = np.flatnonzero(np.isfinite(values))
    steps = np.diff(values[good])
    if steps.size < 10 or np.mean(steps != 0) > HELD or not np.any(steps):
        return np.empty(0, dtype=np.intp)
    return good[1 + np.flatnonzero(np.abs(steps) > LARGE * np.ptp(values[good]))]


def _is_one(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    both = np.isfinite(a) & np.isfinite(b)
    if np.count_nonzero(both) < 10 or np.ptp(a[both]) == 0 or np.ptp(b[both]) == 0:
        return False
    return bool(abs(np.corrcoef(a[both], b[both])[0, 1]) > ALIKE)


def _counts(values: NDArray[np.float64]) -> bool:
    """Phases, rows or the time that is left: up by one, or down all the time."""
    steps = np.diff(values[np.isfinite(values)])
    steps = steps[steps != 0]
    return bool(steps.size > 2 and (np.mean(steps == 1) > 0.8 or np.mean(steps < 0) > 0.95))
