"""Text to cells: what separates them is what gives the last lines the same number of readable cells."""

import csv
import re
from collections import Counter
from collections.abc import Iterator

from simc_core.errors import DataError
from simc_core.identification.reading.instants import is_instant
from simc_core.identification.reading.numerals import is_value
from simc_core.wording import said

LAST_LINES = 60
MOST_ROWS = 1_000_000
MOST_COLUMNS = 64
LONGEST_LINE = 20_000  # characters
BLANKS = "blanks"
CANDIDATES = ("\t", ";", "|", ",", BLANKS)  # where two fit alike, the first
NAMES = {
    "\t": said("tabs", context="columns separated by"),
    ";": said("semicolons", context="columns separated by"),
    "|": said("bars", context="columns separated by"),
    ",": said("commas", context="columns separated by"),
    BLANKS: said("blanks", context="columns separated by"),
}
FIRST_LINE = re.compile(r"sep=(.)\s*", re.IGNORECASE)  # with which Excel is told the delimiter


def lines_of(text: str) -> list[str]:
    """The lines of a text. Raises DataError where there are none or too many."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    while lines and not lines[-1].strip():
        lines.pop()
    if not lines:
        raise DataError(said("there is nothing to read: the text is empty"))
    if len(lines) > MOST_ROWS:
        raise DataError(
            said(
                "a trend may have at most {most} rows, found {found}: cut out the test",
                most=MOST_ROWS,
                found=len(lines),
            )
        )
    long = next((i for i, line in enumerate(lines) if len(line) > LONGEST_LINE), None)
    if long is not None:
        raise DataError(
            said("a line may have at most {most} characters, found {found}", most=LONGEST_LINE, found=len(lines[long])),
            line=long + 1,
        )
    return lines


def delimiter_of(lines: list[str], given: str | None = None) -> tuple[str, str]:
    """What separates the cells, and in words. Raises DataError where nothing does."""
    told = FIRST_LINE.fullmatch(lines[0])
    if given is not None or told:
        sign = given if given is not None else told[1] if told else ""
        if sign not in CANDIDATES:
            raise DataError(
                said("delimiter must be a tab, ; | , or {blanks}, found {found!r}", blanks=BLANKS, found=sign[:10])
            )
        return sign, said("Columns separated by {signs}, as told.", signs=NAMES[sign])
    last = [line for line in lines[-4 * LAST_LINES :] if line.strip()][-LAST_LINES:]
    scores = {sign: _score(last, sign) for sign in CANDIDATES}
    best = max(scores, key=scores.__getitem__)
    if scores[best] == 0:
        raise DataError(
            said("no columns were found: rows must hold numbers with a tab, semicolon or comma between them")
        )
    return best, said("Columns separated by {signs}.", signs=NAMES[best])


def cells_of(lines: list[str], delimiter: str) -> Iterator[list[str]]:
    """The cells of each line, stripped. Raises DataError where a quote is never closed."""
    if delimiter == BLANKS:
        yield from (line.split() for line in lines)
        return
    reader = csv.reader(lines, delimiter=delimiter, skipinitialspace=True)
    try:
        yield from ([cell.strip() for cell in row] for row in reader)
    except csv.Error as error:
        why = said("the cells cannot be told apart ({error}): is a quote never closed?", error=str(error))
        raise DataError(why, line=max(reader.line_num, 1)) from None


def _score(lines: list[str], delimiter: str) -> float:
    """Share of lines with the usual number of cells, times that of readable cells; 0 where there is one column."""
    try:
        rows = list(cells_of(lines, delimiter))
    except DataError:
        return 0.0
    usual, count = Counter(map(len, rows)).most_common(1)[0]
    if usual < 2 or usual > MOST_COLUMNS:
        return 0.0
    cells = [cell for row in rows for cell in row]
    good = sum(not cell or is_value(cell) or is_instant(cell) for cell in cells)
    empty = sum(not cell for cell in cells)
    if empty > 0.9 * len(cells):
        return 0.0
    return count / len(rows) * (good / len(cells)) ** 2
