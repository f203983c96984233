"""The rows before the numbers: titles, one to three rows of names, a row of units."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from simc_core.errors import DataError
from simc_core.identification.reading.instants import UNITS, is_instant
from simc_core.identification.reading.numerals import is_number
from simc_core.wording import counted, said

MOST_HEADER_ROWS = 3
HEAD = 200  # rows among which the first numbers must come
UNITS_MET = (
    "% pct percent °c degc c k °f degf f bar mbar psi psig kpa mpa pa mmhg m3/h m³/h m3/s l/min l/h l/s kg/h kg/s t/h "
    "gpm rpm rad/s v mv volt volts a ma m mm cm ft in w kw mw hz ph ppm u nm n kg g l m3 pwm counts raw eu"
)
UNIT_SIGNS = frozenset(UNITS_MET.split()) | frozenset(UNITS)
BRACKETED = re.compile(r"(?P<name>.*?)\s*[\[(]\s*(?P<unit>[^\[\]()]{1,16}?)\s*[\])]\s*")
SUFFIXED = re.compile(
    r"(?P<name>.+?)[_ ](?P<unit>ms|us|s|sec|min|h|rpm|pct|percent|degc|deg_c|volts?|pwm)", re.IGNORECASE
)
SAID_UNIT = {"percent": "%", "pct": "%", "degc": "°C", "deg_c": "°C", "degf": "°F"}


@dataclass(frozen=True, slots=True)
class Header:
    """names, units: of each column, "" where not told.   first: index of the first row of numbers.   said: in words."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    first: int
    said: str


def width_of(rows: Sequence[Sequence[str]]) -> int:
    """How many columns the rows of numbers have."""
    return Counter(map(len, rows)).most_common(1)[0][0]


def header_of(head: Sequence[Sequence[str]], last: Sequence[Sequence[str]]) -> Header:
    """What stands above the numbers. head: the first rows; last: some of the last ones, which are numbers.

    Raises DataError where no row of numbers is found.
    """
    width = width_of(last)
    usual = sorted(_readable(row) for row in last)[len(last) // 2]
    first = next((i for i, row in enumerate(head) if _readable(row) >= max(1, 0.5 * usual) and len(row) > 1), None)
    if first is None or usual == 0:
        raise DataError(
            counted(
                "no row of numbers was found in the first {n} line",
                "no row of numbers was found in the first {n} lines",
                len(head),
            ),
            line=1,
        )
    above = [_uncommented(row) for row in head[:first]]
    named = [row for row in above if sum(bool(cell) for cell in row) > 1 or len(row) == width == 1][-MOST_HEADER_ROWS:]
    units = [""] * width
    if named and _are_units(named[-1]):
        units = _fitted([cell.strip("[]() ") for cell in named.pop()], width)
    while len(named) > 1 and len(named[-2]) < max(2, width - 1):  # a title of several cells
        named.pop(-2)
    fitted = [_fitted(row, width) for row in named]
    names = [" ".join(dict.fromkeys(filter(None, cells))) for cells in zip(*fitted, strict=True)] if fitted else []
    found = [_split(name) for name in names] or [("", "")] * width
    units = [own or other for (_, own), other in zip(found, units, strict=True)]
    extra = len(named[-1]) - width if named else 0
    return Header(_apart([name for name, _ in found]), tuple(units), first, _said(first, named, extra))


def _uncommented(row: Sequence[str]) -> list[str]:
    """A row whose first cell begins with the sign of a comment, without that."""
    first = [cell if cell == "%" else cell.lstrip("#%").strip() for cell in row[:1]]
    if len(row) > 1 and row[0] == "#":
        return list(row[1:])
    return [*first, *row[1:]]


def _said(first: int, named: Sequence[Sequence[str]], extra: int) -> str:
    if not named:
        if first == 0:
            return said("No names above the numbers.")
        return counted(
            "{n} line above the numbers left out, no names.", "{n} lines above the numbers left out, no names.", first
        )
    if extra <= 0:
        return counted(
            "Names of the columns in {n} line, numbers from line {first}.",
            "Names of the columns in {n} lines, numbers from line {first}.",
            len(named),
            first=first + 1,
        )
    return counted(
        "Names of the columns in {n} line, numbers from line {first}; {extra}.",
        "Names of the columns in {n} lines, numbers from line {first}; {extra}.",
        len(named),
        first=first + 1,
        extra=counted(
            "{n} more name than columns, the last one left out",
            "{n} more names than columns, the last ones left out",
            extra,
        ),
    )


def _readable(row: Sequence[str]) -> int:
    return sum(is_number(cell) or is_instant(cell) for cell in row)


def _are_units(row: Sequence[str]) -> bool:
    given = [cell.strip() for cell in row if cell.strip()]
    known = sum(cell.strip("[]() ").lower() in UNIT_SIGNS for cell in given)
    return bool(given) and known >= 0.5 * len(given) and all(len(cell) <= 18 for cell in given)


def _fitted(row: Sequence[str], width: int) -> list[str]:
    """As many cells as there are columns; one name too few stands above all but a first, unnamed count."""
    if len(row) == width - 1:
        return ["", *row]
    return [*row[:width], *[""] * (width - len(row))]


def _split(name: str) -> tuple[str, str]:
    """A name and its unit."""
    found = BRACKETED.fullmatch(name)
    if not found and (found := SUFFIXED.fullmatch(name)):
        return name, SAID_UNIT.get(found["unit"].lower(), found["unit"])
    if not found:
        return name, ""
    unit = found["unit"]
    return found["name"] or unit, SAID_UNIT.get(unit.lower(), unit)


def _apart(names: Sequence[str]) -> tuple[str, ...]:
    """Names of which no two are the same; a column without a name is called by its place."""
    found: list[str] = []
    for i, name in enumerate(names, start=1):
        wanted = name[:60] or said("column {i}", i=i)
        found.append(wanted if wanted not in found else f"{wanted} ({i})")
    return tuple(found)
