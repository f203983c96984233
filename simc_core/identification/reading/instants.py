"""Columns of time: dates of all kinds, clock times, epochs, days of a spreadsheet, plain numbers.

Dates are read by explicit shapes, never by a guess: 01.03.2024 is the first of March where a point separates, and a
question where nothing tells.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simc_core.wording import said

DAY = 86400.0
MONTH_WORDS = (  # English, German, French, Spanish, Italian
    *("jan ene janv gen", "feb fév fev févr", "mar mär mrz mars", "apr abr avr", "may mai mag", "jun juin giu"),
    *("jul juil lug", "aug ago aoû août", "sep set sept", "oct okt ott", "nov", "dec dez dic déc"),
)
MONTHS = {word: number for number, words in enumerate(MONTH_WORDS, start=1) for word in words.split()}
CLOCK = r"(\d{1,2}):(\d{2})(?::(\d{2}(?:[.,:]\d+)?))?\s*([AaPp]\.?[Mm]\.?)?"
ZONE = r"\s*(?:Z|UTC|GMT|[+-]\d{2}:?\d{2})?"
SHAPES = {
    "year first": re.compile(rf"(\d{{4}})([-/.])(\d{{1,2}})\2(\d{{1,2}})(?:[T\s,]+{CLOCK}{ZONE})?"),
    "day and month": re.compile(rf"(\d{{1,2}})([-/.])(\d{{1,2}})\2(\d{{4}}|\d{{2}})(?:[T\s,]+{CLOCK}{ZONE})?"),
    "named month": re.compile(rf"(\d{{1,2}})([-/. ])([^\W\d]{{3,5}}\.?)\2(\d{{4}}|\d{{2}})(?:[T\s,]+{CLOCK}{ZONE})?"),
    "compact": re.compile(r"((?:19|20)\d{2})(\d{2})(\d{2})[T ]?(\d{2})(\d{2})(\d{2}(?:[.,]\d+)?)?Z?"),
    "clock": re.compile(CLOCK),
    "minutes": re.compile(r"(\d{1,3}):(\d{2}[.,]\d+)"),
}
UNIT_SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0, "d": DAY, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
UNIT_WORDS = {
    "s": "s sec secs second seconds seg segundos sek sekunden sekunde с сек secondes",
    "min": "min mins minute minutes minutos minuten мин",
    "h": "h hr hrs hour hours hora horas stunden std ч час heures",
    "d": "d day days tage días jours",
    "ms": "ms msec millis millisecond milliseconds",
    "us": "us µs μs usec micros microseconds",
    "ns": "ns nsec nanos nanoseconds",
}
UNITS = {word: unit for unit, words in UNIT_WORDS.items() for word in words.split()}
EPOCHS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
EPOCH_SECONDS = (5e8, 4.1e9)  # from 1985 to 2099
SHEET_DAYS = (20_000.0, 80_000.0)  # a spreadsheet counts days from 1900: 1954 to 2119


@dataclass(frozen=True, slots=True)
class Shape:
    """How dates of a column are written. name: of SHAPES; day_first: of day and month, None where nothing tells."""

    name: str
    day_first: bool | None = True
    clock: bool = True

    @property
    def words(self) -> str:
        """For what was understood."""
        if self.name == "day and month":
            return said("dates, day before month") if self.day_first else said("dates, month before day")
        if self.name == "clock":
            return said("clock times")
        return said("minutes and seconds") if self.name == "minutes" else said("dates")


def is_instant(cell: str) -> bool:
    """Whether a cell is a date or a time of the day."""
    text = cell.strip()
    return any(shape.fullmatch(text) for name, shape in SHAPES.items() if name != "compact")


def shape_of(cells: Sequence[str]) -> Shape | None:
    """How the dates in these cells are written; None where they are none, or not all alike."""
    given = [cell.strip() for cell in cells if cell.strip()]
    for name, shape in SHAPES.items():
        found = [shape.fullmatch(cell) for cell in given]
        if given and sum(each is not None for each in found) >= 0.9 * len(given):
            groups = [each.groups() for each in found if each]
            if name in ("clock", "minutes", "compact"):
                return Shape(name)
            clock = any(group[4] for group in groups)
            return Shape(name, _day_first(groups) if name == "day and month" else True, clock)
    return None


def _day_first(groups: list[tuple[str, ...]]) -> bool | None:
    """A number above 12 tells; else a point does; else that with which time runs evenly and forwards."""
    first, second = [int(group[0]) for group in groups], [int(group[2]) for group in groups]
    if max(first) > 12:
        return True
    if max(second) > 12:
        return False
    if groups[0][1] == ".":
        return True
    changing = (len(set(first)) > 1) - (len(set(second)) > 1)
    if changing and len(set(first if changing > 0 else second)) > 2:
        return changing > 0  # days pass, months do not
    return None


def to_seconds(cells: Sequence[str], shape: Shape, day_first: bool | None = None) -> NDArray[np.float64]:
    """Seconds since 1970, or since midnight for clock times, nan where a cell is none; shape (len(cells),)."""
    pattern = SHAPES[shape.name]
    rows = [pattern.fullmatch(cell.strip()) for cell in cells]
    found = np.full(len(cells), np.nan)
    at = np.flatnonzero([row is not None for row in rows])
    groups = [row.groups() for row in rows if row is not None]
    if not groups:
        return found
    columns = list(zip(*groups, strict=True))
    if shape.name == "minutes":
        found[at] = 60.0 * _numbers(columns[0]) + _numbers(columns[1])
        return found
    if shape.name == "clock":
        found[at] = _clock(columns)
        return found
    if shape.name == "compact":
        year, month, day = (_numbers(columns[i]) for i in range(3))
        clock = 3600 * _numbers(columns[3]) + 60 * _numbers(columns[4]) + _numbers(columns[5])
    else:
        first, second, third = columns[0], columns[2], columns[3]
        if shape.name == "year first":
            year, month, day = map(_numbers, (first, second, third))
        else:
            year = _numbers(third)
            year = np.where(year < 70, year + 2000, np.where(year < 100, year + 1900, year))
            if shape.name == "named month":
                day = _numbers(first)
                month = np.array(
                    [MONTHS.get(name.lower().rstrip("."), MONTHS.get(name.lower()[:3], 0)) for name in second]
                )
            else:
                ahead = day_first if day_first is not None else shape.day_first is not False
                day, month = (_numbers(each) for each in ((first, second) if ahead else (second, first)))
        clock = _clock(columns[4:8])
    good = (month >= 1) & (month <= 12) & (day >= 1) & (day <= 31)
    found[at[good]] = DAY * _days(year[good], month[good], day[good]) + clock[good]
    return found


def _days(year: NDArray[np.float64], month: NDArray[np.float64], day: NDArray[np.float64]) -> NDArray[np.float64]:
    """Days since 1970-01-01."""
    months = (12 * (year - 1970) + month - 1).astype("int64").astype("datetime64[M]")
    return np.asarray(months.astype("datetime64[D]").astype("int64") + day - 1.0, dtype=np.float64)


def _clock(columns: Sequence[Sequence[str | None]]) -> NDArray[np.float64]:
    hour, minute = _numbers(columns[0]), _numbers(columns[1])
    second = _numbers([text and re.sub("[:,]", ".", text) for text in columns[2]])
    half = np.array([(text or "").lower()[:1] for text in columns[3]])
    hour = np.where(half == "p", hour % 12 + 12, np.where(half == "a", hour % 12, hour))
    return 3600.0 * hour + 60.0 * minute + second


def _numbers(texts: Sequence[str | None]) -> NDArray[np.float64]:
    return np.array([(text or "0").replace(",", ".") for text in texts], dtype=np.float64)


def over_midnight(seconds: NDArray[np.float64]) -> tuple[NDArray[np.float64], int]:
    """Clock times with a day added at every midnight, and how many there were."""
    back = np.diff(seconds, prepend=seconds[:1]) < -0.5 * DAY
    return seconds + DAY * np.cumsum(back), int(back.sum())


def epoch_unit(values: NDArray[np.float64]) -> str:
    """The unit in which these count from 1970; empty where they do not."""
    good = values[np.isfinite(values)]
    if good.size == 0:
        return ""
    middle = float(np.median(good))
    low, high = EPOCH_SECONDS
    return next((unit for unit, size in EPOCHS.items() if low < middle * size < high), "")


def are_sheet_days(values: NDArray[np.float64]) -> bool:
    """Whether these are days as a spreadsheet counts them: within a century, with parts of a day."""
    good = values[np.isfinite(values)]
    if good.size < 3 or not (SHEET_DAYS[0] < good.min() and good.max() < SHEET_DAYS[1]):
        return False
    return bool(np.any(good % 1 > 1e-9) and np.median(np.abs(np.diff(good))) < 1.0)
