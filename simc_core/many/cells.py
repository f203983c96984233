"""Cells of a file as text: CSV with whatever separator and coding, or a spreadsheet where a reader of them is there."""

import csv
import importlib
import importlib.util
import io

from simc_core.errors import InvalidParameter

MOST_BYTES = 200_000_000
MOST_COLUMNS = 200
SEPARATORS = ";\t,|"
SPREADSHEETS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")  # xlsx, ods; xls
CALAMINE, PANDAS = "python_calamine", "pandas"
FIRST_LINES = 20  # by which the separator is found

Cells = list[list[str]]


def cells_of(content: bytes) -> Cells:
    """All cells of a file, row by row, without blanks round them.

    Raises InvalidParameter: nothing in it, too much in it, or a spreadsheet that nothing here can read.
    """
    if not content.strip():
        raise InvalidParameter("the file must hold a list of loops, found nothing in it")
    if len(content) > MOST_BYTES:
        raise InvalidParameter(f"a list may have at most {MOST_BYTES} bytes, found {len(content)}: split it")
    found = _spreadsheet(content) if content.startswith(SPREADSHEETS) else _csv(_decoded(content))
    widest = max((len(row) for row in found), default=0)
    if widest > MOST_COLUMNS:
        raise InvalidParameter(f"a list may have at most {MOST_COLUMNS} columns, found {widest}")
    return found


def _decoded(content: bytes) -> str:
    """UTF-8, UTF-16 with its mark, or what old Windows programs write."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        return content.decode("utf-16", errors="replace")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")


def _csv(text: str) -> Cells:
    separator = _separator(text)
    lines = io.StringIO(text.replace("\0", ""), newline="")
    try:
        return [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=separator)]
    except csv.Error as error:
        raise InvalidParameter(f"the file must be a table of text, found a cell that is none: {error}") from error


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


def _spreadsheet(content: bytes) -> Cells:
    """The first sheet."""
    if importlib.util.find_spec(CALAMINE):
        calamine = importlib.import_module(CALAMINE)
        try:
            rows = calamine.CalamineWorkbook.from_filelike(io.BytesIO(content)).get_sheet_by_index(0).to_python()
        except Exception as error:
            raise InvalidParameter(f"the spreadsheet cannot be read ({error}): save the sheet as CSV") from error
    elif importlib.util.find_spec(PANDAS):
        pandas = importlib.import_module(PANDAS)
        try:
            frame = pandas.read_excel(io.BytesIO(content), header=None, dtype=object)
        except Exception as error:
            raise InvalidParameter(f"the spreadsheet cannot be read ({error}): save the sheet as CSV") from error
        rows = [["" if cell != cell else cell for cell in row] for row in frame.values.tolist()]
    else:
        raise InvalidParameter(
            "a spreadsheet needs the package python-calamine (or pandas with openpyxl), which is not installed: "
            "save the sheet as CSV"
        )
    return [[_text(cell) for cell in row] for row in rows]


def _text(cell: object) -> str:
    """A number with all its digits, without the .0 of a whole one."""
    if isinstance(cell, float):
        return repr(cell).removesuffix(".0")
    return "" if cell is None else str(cell).strip()
