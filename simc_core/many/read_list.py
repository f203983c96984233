"""A list of loops from a file: headings understood, units told below or beside them, commas settled for the whole file.

Rows are what `tune_many` takes: the cells by the names of columns.py as text, and `row`, their number in the file.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from simc_core.errors import InvalidParameter
from simc_core.many.cells import Cells, cells_of
from simc_core.many.columns import BY_NAME, COLUMNS
from simc_core.wording import Text, joined, said

MOST_ROWS = 1_000_000
ENOUGH = ("plant", "k", "k_prime")  # one of them a list must have
TIMES = ("theta", "tau1", "tau2", "tau_c", "tau_I", "tau_D", "tau_F")
SECONDS = {"s": "s", "sec": "s", "secs": "s", "second": "s", "seconds": "s"}
MINUTES = {"min": "min", "mins": "min", "minute": "min", "minutes": "min"}
TIME_UNITS = SECONDS | MINUTES
IN_BRACKETS = re.compile(r"[\[(]([^\])]*)[\])]")
NUMBER = re.compile(r"[-+−]?[\d.,' ]*\d[\d.,]*(?:[eE][-+]?\d+)?")
POINT = re.compile(r"\d\.\d")
DECIMAL_COMMA = re.compile(r"[-+−]?(?:0,\d+|\d*,\d{1,2}|\d+,\d{4,})(?:[eE][-+]?\d+)?")
HEADING_ROWS = 10  # among which the headings are looked for


@dataclass(frozen=True, slots=True)
class LoopList:
    """What was read.

    Attributes
    ----------
    rows : list of dict
        For `tune_many`.
    columns : dict of str to str
        Each heading of the file and the name that was understood, "" for none.
    notes : tuple of str
        What was assumed, in words.
    """

    rows: list[dict[str, str | int]]
    columns: dict[str, str]
    notes: tuple[str, ...]


def read_list(source: str | Path | bytes, most: int = MOST_ROWS) -> LoopList:
    """A list of loops, as people keep it.

    Parameters
    ----------
    source : str, Path or bytes
        A path, or the content of a file: CSV with commas, semicolons or tabs, decimal points or commas, a row of units
        below the headings or not; a spreadsheet where python-calamine is installed.
    most : int
        Rows that are taken at most.

    Returns
    -------
    LoopList
        Rows, what was understood of the headings, and what was assumed.

    Raises
    ------
    InvalidParameter
        No headings are understood, or there are too many rows; what is wrong in single cells is told by `tune_many`,
        row by row.

    Examples
    --------
    >>> from simc_core import read_list
    >>> found = read_list(b"Tag;K;Dead time [s];Tau1\\nFC-101;1,5;2;8,25\\n")
    >>> found.rows
    [{'row': 2, 'tag': 'FC-101', 'k': '1.5', 'theta': '2', 'tau1': '8.25', 'time_unit': 's'}]
    """
    if not isinstance(source, bytes):
        source = Path(source).read_bytes()
    cells = cells_of(source)
    head = _head(cells)
    columns = _understood(cells[head])
    names = [columns[i] for i in range(len(cells[head]))]
    units = {name: unit for name, unit in zip(names, _units_beside(cells[head]), strict=True) if name and unit}
    first = head + 1
    if first < len(cells) and _is_units(cells[first], names):
        units |= {name: cell for name, cell in zip(names, cells[first], strict=False) if name and cell}
        first += 1
    body = [(i + 1, row) for i, row in enumerate(cells[first:], first) if any(row)]
    if len(body) > most:
        raise InvalidParameter(
            said("a list may have at most {most} rows here, found {given}: split it", most=most, given=len(body))
        )
    if not body:
        raise InvalidParameter(said("the list must have a row below its headings, found none"))
    notes: list[Text] = []
    if _decimal_commas(body, names):
        body = [(i, _with_points(row, names)) for i, row in body]
        notes.append(said("commas are decimal in this file"))
    time_unit = _time_unit(units)
    if time_unit:
        notes.append(said("times are in {time_unit}", time_unit=time_unit))
    return LoopList(
        [_row(i, row, names, time_unit) for i, row in body],
        dict(zip(_headings(cells[head]), names, strict=True)),
        tuple(notes),
    )


def _head(cells: Cells) -> int:
    """Which row has the headings: the first that names a plant. Raises InvalidParameter."""
    for i, row in enumerate(cells[:HEADING_ROWS]):
        if set(ENOUGH) & set(_understood(row)):
            return i
    seen = next((row for row in cells if any(row)), [])
    headings = ", ".join(_headings(seen))[:200]
    if not headings:
        raise InvalidParameter(
            said(
                "the list must have a column plant, or k, theta and tau1, or k_prime and theta, found the headings none"
            )
        )
    raise InvalidParameter(
        said(
            "the list must have a column plant, or k, theta and tau1, or k_prime and theta, found the headings "
            "{headings}",
            headings=headings,
        )
    )


def _understood(row: Sequence[str]) -> list[str]:
    """The name of each heading, "" where it is none, or one that stood there before."""
    found: list[str] = []
    for heading in row:
        name = _name(heading)
        found.append("" if name in found else name)
    return found


def _name(heading: str) -> str:
    plain = IN_BRACKETS.sub("", heading).strip()
    if plain in BY_NAME:
        return plain
    letters = "".join(c for c in plain.lower().replace("′", "prime").replace("'", "prime") if c.isalnum())
    return _ALIKE.get(letters, "")


_ALIKE = {"".join(c for c in column.name.lower() if c.isalnum()): column.name for column in COLUMNS}
_ALIKE |= {other: column.name for column in COLUMNS for other in column.also}


def _headings(row: Sequence[str]) -> list[str]:
    """Headings as they are, made different from one another."""
    found: list[str] = []
    for i, heading in enumerate(row, 1):
        name = heading or f"column {i}"
        found.append(name if name not in found else f"{name} ({i})")
    return found


def _units_beside(row: Sequence[str]) -> list[str]:
    return [match[1].strip() if (match := IN_BRACKETS.search(heading)) else "" for heading in row]


def _is_units(row: Sequence[str], names: Sequence[str]) -> bool:
    """Whether a row tells units: words where numbers belong, a time unit among them, and no plant."""
    cells = dict(zip(names, row, strict=False))
    numbers = [cell for name, cell in cells.items() if name and not BY_NAME[name].text and cell]
    if not numbers or any(NUMBER.fullmatch(cell) for cell in numbers) or cells.get("plant"):
        return False
    return any(_bare(cells.get(name, "")) in TIME_UNITS for name in TIMES)


def _bare(unit: str) -> str:
    return unit.strip("[]() ").lower()


def _time_unit(units: Mapping[str, str]) -> str:
    """s or min, where the times tell it. Raises InvalidParameter where they differ, or it is another."""
    told = {name: _bare(units[name]) for name in TIMES if units.get(name)}
    known = {TIME_UNITS.get(unit, "") for unit in told.values()}
    if len(known) > 1 or known == {""}:
        each = joined(said("{name} in {unit}", name=name, unit=unit[:20]) for name, unit in told.items())
        raise InvalidParameter(
            said("all times of a list must be in s, or all in min, found {each}: convert them", each=each)
        )
    return next(iter(known), "")


def _decimal_commas(body: Sequence[tuple[int, Sequence[str]]], names: Sequence[str]) -> bool:
    """Whether commas are decimal: some cells leave no other reading, and no number has a point."""
    seen = False
    for _, row in body:
        for name, cell in zip(names, row, strict=False):
            if not name or BY_NAME[name].text:
                continue
            if POINT.search(cell):
                return False
            seen = seen or bool(DECIMAL_COMMA.fullmatch(cell))
    return seen


def _with_points(row: Sequence[str], names: Sequence[str]) -> list[str]:
    return [
        cell.replace(",", ".") if name and not BY_NAME[name].text and cell.count(",") == 1 else cell
        for name, cell in zip(names, row, strict=False)
    ]


def _row(i: int, row: Sequence[str], names: Sequence[str], time_unit: str) -> dict[str, str | int]:
    found: dict[str, str | int] = {"row": i}
    found |= {name: cell for name, cell in zip(names, row, strict=False) if name and cell}
    if time_unit:
        own = str(found.get("time_unit", time_unit))
        # nobody can tell which of two is meant: such a row is refused by what then stands there
        found["time_unit"] = own if own.lower() == time_unit else f"{own} (heading: {time_unit})"
    return found


def template() -> str:
    """A list to begin with: headings, a row of units, and loops of each kind, as CSV.

    Returns
    -------
    str
        Which `read_list` reads.
    """
    units = {"PV": "", "OP": "", "": "", "time": "s"}
    names = ("tag", "plant", "k", "theta", "tau1", "tau2", "k_prime", "kind", "form", "Kc", "tau_I", "tau_D", "box")
    lines = [names, tuple(units.get(BY_NAME[name].unit, BY_NAME[name].unit.replace("time", "s")) for name in names)]
    for example in EXAMPLES:
        lines.append(tuple(example.get(name, "") for name in names))
    return "".join(",".join(line) + "\n" for line in lines)


def meanings() -> str:
    """All columns that are understood, one a line, with their units."""
    width = max(len(column.name) for column in COLUMNS)
    return "\n".join(
        f"{column.name:{width}}  {column.meaning}{f' [{column.unit}]' if column.unit else ''}" for column in COLUMNS
    )


EXAMPLES: tuple[dict[str, str], ...] = (
    {"tag": "FC-101", "k": "1.2", "theta": "1", "tau1": "4", "Kc": "0.4", "tau_I": "4", "box": "honeywell_udc"},
    {"tag": "TC-205", "k": "0.8", "theta": "12", "tau1": "90", "tau2": "15", "kind": "PID", "Kc": "9", "tau_I": "60"},
    {"tag": "LC-310", "k_prime": "0.02", "theta": "3", "Kc": "2", "tau_I": "20"},
    {"tag": "PC-412", "plant": "2 exp(-0.5s)/((3s+1)(1s+1)(0.4s+1))", "Kc": "4", "tau_I": "3"},
    {"tag": "AC-507", "k": "0.5", "theta": "30", "tau1": "10"},
)
