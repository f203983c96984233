"""Cells of a file as text: CSV with whatever separator and coding, or a spreadsheet."""

import csv
import io

from simc_core.errors import InvalidParameter
from simc_core.identification.reading.decode import MOST_BYTES, decoded
from simc_core.identification.reading.workbook import is_workbook, rows_of_workbook
from simc_core.wording import said

MOST_COLUMNS = 200
SEPARATORS = ";\t,|"
FIRST_LINES = 20  # by which the separator is found

Cells = list[list[str]]


def cells_of(content: bytes) -> Cells:
    """All cells of a file, row by row, without blanks round them.

    Raises InvalidParameter: nothing in it, or too much; DataError: no text, or a spreadsheet that cannot be opened.
    """
    if not content.strip():
        raise InvalidParameter(said("the file must hold a list of loops, found nothing in it"))
    if len(content) > MOST_BYTES:
        raise InvalidParameter(
            said(
                "a list may have at most {most_bytes} bytes, found {size}: split it",
                most_bytes=MOST_BYTES,
                size=len(content),
            )
        )
    found = rows_of_workbook(content)[0] if is_workbook(content) else _csv(decoded(content)[0])
    widest = max((len(row) for row in found), default=0)
    if widest > MOST_COLUMNS:
        raise InvalidParameter(
            said(
                "a list may have at most {most_columns} columns, found {widest}",
                most_columns=MOST_COLUMNS,
                widest=widest,
            )
        )
    return found


def _csv(text: str) -> Cells:
    separator = _separator(text)
    lines = io.StringIO(text.replace("\0", ""), newline="")
    try:
        return [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=separator)]
    except csv.Error as error:
        raise InvalidParameter(
            said("the file must be a table of text, found a cell that is none: {error}", error=str(error))
        ) from error


def _separator(text: str) -> str:
    """That which cuts the first lines into the same number of columns, and into most; a line "sep=;" says it."""
    first = text[:65536].splitlines()[:FIRST_LINES]
    if first and first[0].lower().startswith("sep=") and len(first[0]) == 5:
        return first[0][4]

    def cut(separator: str) -> tuple[bool, int]:
        counts = [len(row) for row in csv.reader(first, delimiter=separator) if any(row)]
        return len(set(counts)) == 1 and counts[0] > 1, counts[0] if counts else 0

    try:
        return max(SEPARATORS, key=cut)
    except csv.Error:
        return ","
