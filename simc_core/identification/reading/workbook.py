"""A spreadsheet file (xlsx, xls, xlsb, ods) to rows of cells, by python-calamine."""

import datetime
import importlib
import io
import zipfile
from collections.abc import Iterable
from types import ModuleType
from typing import Any

from simc_core import checks
from simc_core.errors import DataError
from simc_core.identification.reading.delimiter import MOST_COLUMNS, MOST_ROWS
from simc_core.wording import counted, said

ZIP, OLD = b"PK\x03\x04", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
MOST_UNPACKED = 400_000_000  # bytes of an xlsx once unpacked: 20 MB that become more are no trend


def is_workbook(data: bytes) -> bool:
    """Whether these bytes are a spreadsheet file."""
    return data.startswith((ZIP, OLD))


def rows_of_workbook(data: bytes, sheet: str | None = None) -> tuple[list[list[str]], tuple[str, ...], str]:
    """Rows of the sheet with the most cells, or of `sheet`; the names of all sheets; what was understood.

    Raises
    ------
    DataError
        No spreadsheet, too large, no such sheet, or python-calamine is not installed.
    """
    calamine = _library()
    _require_small(data)
    try:
        book = calamine.CalamineWorkbook.from_filelike(io.BytesIO(data))
        sheets = {name: book.get_sheet_by_name(name) for name in book.sheet_names[:50]}
    except Exception as error:  # whatever a foreign file makes of a parser
        raise DataError(
            said("the spreadsheet cannot be opened: {error}. Save it as CSV", error=str(error)[:80])
        ) from None
    if sheet is not None:
        checks.one_of("sheet", sheet, sheets, DataError)
    name = sheet if sheet is not None else max(sheets, key=lambda each: sheets[each].height * sheets[each].width)
    chosen = sheets[name]
    if chosen.total_height > MOST_ROWS or chosen.width > MOST_COLUMNS:
        raise DataError(
            said(
                "a sheet may have at most {rows} rows and {columns} columns, found {found_rows} and {found_columns}",
                rows=MOST_ROWS,
                columns=MOST_COLUMNS,
                found_rows=chosen.total_height,
                found_columns=chosen.width,
            )
        )
    rows = [[_text(cell) for cell in row] for row in chosen.to_python(skip_empty_area=True)]
    if not rows:
        raise DataError(said("sheet {name} is empty", name=name))
    if len(sheets) == 1:
        return rows, tuple(sheets), said("Spreadsheet, sheet {name}.", name=name)
    found = counted(
        "Spreadsheet, sheet {name}, one of {n} sheet.",
        "Spreadsheet, sheet {name}, one of {n} sheets.",
        len(sheets),
        name=name,
    )
    return rows, tuple(sheets), found


def _library() -> ModuleType:
    try:
        return importlib.import_module("python_calamine")
    except ImportError:
        raise DataError(
            said("spreadsheets need python-calamine: pip install 'simc[data]', or save the file as CSV")
        ) from None


def _require_small(data: bytes) -> None:
    if not data.startswith(ZIP):
        return
    try:
        unpacked = sum(part.file_size for part in zipfile.ZipFile(io.BytesIO(data)).infolist())
    except (zipfile.BadZipFile, ValueError):
        raise DataError(said("the spreadsheet cannot be opened: it is damaged, or no spreadsheet")) from None
    if unpacked > MOST_UNPACKED:
        raise DataError(
            said(
                "a spreadsheet may unpack to {most} MB, found {size:.0f} MB",
                most=MOST_UNPACKED // 1_000_000,
                size=unpacked / 1e6,
            )
        )


def _text(cell: Any) -> str:
    match cell:
        case bool():
            return str(cell)
        case float():
            return repr(cell).removesuffix(".0")
        case datetime.datetime():
            return cell.isoformat(sep=" ")
        case datetime.timedelta():
            return repr(cell.total_seconds())
        case datetime.date() | datetime.time():
            return cell.isoformat()
    return str(cell).strip()


def padded(rows: Iterable[list[str]], width: int) -> list[list[str]]:
    """Rows of one length."""
    return [row + [""] * (width - len(row)) for row in rows]
