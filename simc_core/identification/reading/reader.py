"""From a file or a paste to a trend, with every step told and every doubt asked."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TypeVar

from simc_core.controllers.forms import Controller
from simc_core.errors import DataError
from simc_core.identification.reading.columns import read_columns
from simc_core.identification.reading.decode import MOST_BYTES, decoded
from simc_core.identification.reading.delimiter import MOST_COLUMNS, cells_of, delimiter_of, lines_of
from simc_core.identification.reading.header import HEAD, header_of, width_of
from simc_core.identification.reading.meaning import understand
from simc_core.identification.reading.numerals import decimal_sign
from simc_core.identification.reading.questions import Question
from simc_core.identification.reading.table import Table
from simc_core.identification.reading.workbook import is_workbook, rows_of_workbook
from simc_core.identification.trend import Trend
from simc_core.wording import said

DECIMAL = {  # by the sign, and whether it is sure
    (",", True): said("Decimal comma."),
    (".", True): said("Decimal point."),
    (",", False): said("Decimal comma, assumed."),
    (".", False): said("Decimal point, assumed."),
}
SAMPLE = 2000  # rows that tell what a column is
Line = TypeVar("Line")
LAST = 60  # rows of which most are numbers, whatever stands above


def read_trend(
    source: str | bytes | Path,
    *,
    columns: Mapping[str, str | int | None] | None = None,
    time_unit: str | None = None,
    period: float | None = None,
    decimal: str | None = None,
    delimiter: str | None = None,
    day_first: bool | None = None,
    encoding: str | None = None,
    sheet: str | None = None,
    controller: Controller | None = None,
) -> Trend:
    """A trend from a file or a paste, as people have them.

    Parameters
    ----------
    source : path, bytes or text
        CSV and its kin, a paste from a spreadsheet, or a spreadsheet file (which needs python-calamine). At most 20 MB
        and 1e6 rows. A text of one line is the name of a file.
    columns : mapping, optional
        Names, or places from 0, of the columns that are "time", "PV", "OP" and "SP", as far as they are known; None
        for "there is none". The others are found by their names and numbers.
    time_unit : str, optional
        Of a column of plain numbers: s, ms, us, ns, min, h or d.
    period : float, optional
        From one row to the next, where no column is time.
    decimal, delimiter : str, optional
        "," or "."; a tab, ";", "|", "," or "blanks".
    day_first : bool, optional
        Of dates like 03/04/2024.
    encoding, sheet : str, optional
        Of a text file; of a spreadsheet file.
    controller : controller, optional
        That was in the loop, where OP was not written down: it is computed, see `op_of_controller`.

    Returns
    -------
    Trend
        In seconds, or in minutes or hours where the file has them; its notes say what was understood.

    Raises
    ------
    DataError
        No trend, or something that cannot be known; names line and column, or the argument that tells it.

    Examples
    --------
    >>> trend = read_trend("Zeit [min];PV;OP\\n0;20,5;30\\n1;20,5;40\\n2;21,5;40\\n")
    >>> trend.y.tolist(), trend.u.tolist(), trend.units["t"]
    ([20.5, 20.5, 21.5], [30.0, 40.0, 40.0], 'min')
    """
    table = load(source, decimal=decimal, delimiter=delimiter, day_first=day_first, encoding=encoding, sheet=sheet)
    reading = understand(
        table, columns=columns, time_unit=time_unit, period=period, day_first=day_first, controller=controller
    )
    if reading.trend is None:
        raise DataError(reading.refusal)
    return reading.trend


def load(
    source: str | bytes | Path,
    *,
    decimal: str | None = None,
    delimiter: str | None = None,
    day_first: bool | None = None,
    encoding: str | None = None,
    sheet: str | None = None,
) -> Table:
    """The columns of a file; parameters and errors as of `read_trend`."""
    if decimal not in (None, ",", "."):
        raise DataError(said("decimal must be , or . found {found!r}", found=decimal))
    data = _content(source)
    if isinstance(data, bytes) and is_workbook(data):
        rows, sheets, in_words = rows_of_workbook(data, sheet)
        if decimal is None and not _has_decimal_commas(rows):
            decimal = "."
        return _table(rows, iter, [in_words], decimal, day_first, sheets)
    text, encoded = (data, "") if isinstance(data, str) else decoded(data, encoding)
    lines = lines_of(text.removeprefix("\ufeff"))
    sign, separated = delimiter_of(lines, delimiter)
    if _names_delimiter(lines[0]):
        lines[0] = ""
    understood = [each for each in (encoded, separated) if each]
    return _table(lines, partial(cells_of, delimiter=sign), understood, decimal, day_first)


def _content(source: str | bytes | Path) -> str | bytes:
    if isinstance(source, bytes):
        return source
    if isinstance(source, str) and ("\n" in source or "\r" in source):
        if len(source) > MOST_BYTES:
            raise DataError(
                said("a text may have at most {most} characters, found {found}", most=MOST_BYTES, found=len(source))
            )
        return source
    path = Path(source)
    try:
        if path.stat().st_size > MOST_BYTES:
            raise DataError(
                said(
                    "a file may have at most {most} MB, found {size:.1f} MB",
                    most=MOST_BYTES // 1_000_000,
                    size=path.stat().st_size / 1e6,
                )
            )
        return path.read_bytes()
    except (OSError, ValueError):
        raise DataError(
            said("there is no file {name!r}; a text must have more than one line", name=str(source)[:80])
        ) from None


def _names_delimiter(line: str) -> bool:
    return line.lower().startswith("sep=")


def _has_decimal_commas(rows: Sequence[Sequence[str]]) -> bool:
    sign, _ = decimal_sign(cell for row in rows[:HEAD] for cell in row)
    return sign == ","


def _table(
    lines: Sequence[Line],
    cells: Callable[[Sequence[Line]], Iterator[list[str]]],
    understood: list[str],
    decimal: str | None,
    day_first: bool | None,
    sheets: tuple[str, ...] = (),
) -> Table:
    """The columns. cells: from lines to rows of cells; they are made when they are read, and not kept."""
    head = list(cells(lines[:HEAD]))
    last = [row for row in cells(lines[-4 * LAST :]) if any(row)][-LAST:]
    width = width_of(last)
    if width > MOST_COLUMNS:
        raise DataError(said("a trend may have at most {most} columns, found {found}", most=MOST_COLUMNS, found=width))
    header = header_of(head, last)
    understood.append(header.said)
    body = lines[header.first :]
    sample = list(cells(body[:: max(1, len(body) // SAMPLE)][: SAMPLE + 1]))
    questions = []
    sign, sure = (decimal, True) if decimal else decimal_sign(cell for row in sample for cell in row)
    if not sure:
        text = said("Numbers like 1,234 may have a decimal comma or separate thousands: what is the decimal sign?")
        questions.append(Question("decimal", text, (",", "."), sign))
    _refuse_twofold_commas(head, header.first, width, header.names)
    understood.append(DECIMAL[sign, sure])
    found = read_columns(cells(body), sample, header.names, header.units, sign, day_first, header.first + 1)
    return Table(tuple(found), tuple(understood), tuple(questions), sheets)


def _refuse_twofold_commas(head: Sequence[Sequence[str]], first: int, width: int, names: Sequence[str]) -> None:
    """0,0,20,5,30,0 below t,PV,OP: the comma separates columns and decimals."""
    above = len([cell for cell in head[first - 1] if cell]) if 0 < first <= len(head) else 0
    if above > 1 and width == 2 * above and all(name.startswith("column") for name in names[above:]):
        raise DataError(
            said(
                "{names} names stand above {columns} columns: the comma seems to be the decimal sign and the "
                "delimiter. Export with semicolons or tabs",
                names=above,
                columns=width,
            ),
            line=first,
        )
