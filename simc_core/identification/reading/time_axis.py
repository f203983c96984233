"""Which columns are time, in what unit, and the instants they give."""

import datetime
import re
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from simc_core import checks
from simc_core.errors import DataError
from simc_core.identification.reading.columns import INSTANTS, NUMBERS, WORDS, Column
from simc_core.identification.reading.instants import (
    EPOCHS,
    UNIT_SECONDS,
    UNITS,
    Shape,
    are_sheet_days,
    epoch_unit,
    over_midnight,
)
from simc_core.identification.reading.questions import Question
from simc_core.wording import Text, counted, joined, said

NAMED = re.compile(
    r"(^|[\W_])(time|timestamp|zeit\w*|tiempo|temps|tempo|tid|t|date|datum|fecha|clock|uhrzeit|elapsed|seconds?|время|ts)"
    r"($|[\W_\d])|time|zeitstempel",
    re.IGNORECASE,
)
COUNTED = re.compile(r"(index|idx|no\.?|nr\.?|n|#|row|sample|count\w*|id|column 1|unnamed.*)", re.IGNORECASE)
IN_UNIT = {
    "s": said("in seconds"),
    "min": said("in minutes"),
    "h": said("in hours"),
    "d": said("in days"),
    "ms": said("in milliseconds"),
    "us": said("in microseconds"),
    "ns": said("in nanoseconds"),
}
SINCE_1970 = {
    "s": said("seconds since 1970"),
    "ms": said("milliseconds since 1970"),
    "us": said("microseconds since 1970"),
    "ns": said("nanoseconds since 1970"),
}
KEPT_UNITS = ("s", "min", "h")  # others become seconds
LAST_DATE = 2e11  # seconds since 1970: in the year 8307
RISING = 0.98  # of the steps of a column that is time


@dataclass(slots=True)
class TimeAxis:
    """columns: index of each column of time, with its instants.   unit: of the instants.

    used: columns that are no signals.   said, questions: of what was understood.
    """

    columns: dict[int, NDArray[np.float64]]
    unit: str
    used: set[int]
    said: list[str] = field(default_factory=list)
    questions: list[Question] = field(default_factory=list)

    def of(self, column: int) -> NDArray[np.float64]:
        """The instants of a signal: those of the last column of time before it, else the first."""
        before = [at for at in self.columns if at < column]
        return self.columns[max(before) if before else min(self.columns)]


def time_axis(
    columns: Sequence[Column],
    time: int | None = None,
    time_unit: str | None = None,
    period: float | None = None,
    day_first: bool | None = None,
) -> TimeAxis:
    """The columns of time. time, time_unit, period, day_first: as told, None where not.

    Raises DataError where no column is time and no period is told.
    """
    if time_unit is not None:
        checks.one_of("time_unit", time_unit, UNIT_SECONDS, DataError)
    if period is not None:
        return _by_period(columns, period, time_unit or "s")
    dates = [i for i, column in enumerate(columns) if column.kind == INSTANTS]
    if time is None and dates:
        return _of_dates(columns, dates, day_first)
    found = [time] if time is not None else _numeric(columns)
    if not found:
        question = Question("period", said("No column is time: how long is it from one row to the next, in seconds?"))
        return TimeAxis({}, "s", set(), [said("No column of time.")], [question])
    if columns[found[0]].kind == INSTANTS:
        return _of_dates(columns, found, day_first)
    return _of_numbers(columns, found, time_unit)


def _by_period(columns: Sequence[Column], period: float, unit: str) -> TimeAxis:
    if not (np.isfinite(period) and 1e-9 <= period <= 1e9):
        raise DataError(said("period must be between 1e-9 and 1e9, found {period:g}", period=float(period)))
    values = period * np.arange(columns[0].values.size, dtype=np.float64)
    factor, unit = _in_kept_unit(unit)
    return TimeAxis(
        {-1: factor * values},
        unit,
        set(),
        [said("Time counted by rows, {period:g} {unit} each, as told.", period=float(period), unit=unit)],
    )


def _of_dates(columns: Sequence[Column], dates: list[int], day_first: bool | None) -> TimeAxis:
    notes: list[str] = []
    questions: list[Question] = []
    axes: dict[int, NDArray[np.float64]] = {}
    used = set(dates)
    skip: set[int] = set()
    for i in dates:
        shape, values = columns[i].shape, columns[i].values
        if shape is None or i in skip:
            continue
        if shape.day_first is None and day_first is None and not questions:
            text = said("Dates may have the day or the month first: which?")
            questions.append(Question("day_first", text, ("day first", "month first"), "day first"))
        other = next((j for j in (i + 1, i - 1) if j in used and _is_clock(columns[j].shape)), None)
        parts: list[str] = [shape.words]
        if not shape.clock and not _is_clock(shape) and other is not None:
            values += columns[other].values
            parts = [said("{dates} and clock times in two columns", dates=shape.words)]
            skip.add(other)
        elif _is_clock(shape):
            values, nights = over_midnight(values)
            parts += [counted("over midnight once", "over midnight {n} times", nights)] if nights else []
        axes[i] = values
        parts += _begin(values, _is_clock(shape))
        notes.append(said("Time from {column}: {what}.", column=columns[i].name, what=joined(parts, ", ")))
    return TimeAxis(axes, "s", used, notes, questions)


def _is_clock(shape: Shape | None) -> bool:
    return shape is not None and shape.name in ("clock", "minutes")


def _begin(values: NDArray[np.float64], clock: bool) -> list[Text]:
    good = values[np.isfinite(values)]
    if clock or good.size == 0 or abs(good[0]) > LAST_DATE:
        return []
    first = datetime.datetime.fromtimestamp(float(good[0]), datetime.UTC)
    return [said("from {instant}", instant=f"{first:%Y-%m-%d %H:%M:%S}")]


def _numeric(columns: Sequence[Column]) -> list[int]:
    """Columns of numbers that are time: by name, by counting from 1970 or 1900, else the first that only rises."""
    numbers = [i for i, column in enumerate(columns) if column.kind == NUMBERS and column.finite.sum() > 2]
    named = [
        i for i in numbers if NAMED.search(columns[i].name) and _mostly_rising(columns[i]) and not _is_left(columns[i])
    ]
    if named:
        first = columns[named[0]].name.rstrip("0123456789() ")
        return [i for i in named if columns[i].name.rstrip("0123456789() ") == first or i == named[0]]
    counting = [
        i
        for i in numbers
        if _rising(columns[i]) and (epoch_unit(columns[i].values) or are_sheet_days(columns[i].values))
    ]
    rising = [i for i in numbers if _rising(columns[i], strictly=True)]
    named_count = [i for i in rising if COUNTED.fullmatch(columns[i].name) and columns[i].name != "column 1"]
    others = [i for i in rising if i not in named_count]
    return (counting or others[:1])[:1]


def _is_left(column: Column) -> bool:
    return re.search(r"left|remain|rest", column.name, re.IGNORECASE) is not None


def _rising(column: Column, strictly: bool = False) -> bool:
    """Whether it only rises, or only falls: some exports have the newest first."""
    steps = np.diff(column.values[column.finite])
    if steps.size < 2:
        return False
    up, down = float(np.mean(steps > 0)), float(np.mean(steps < 0))
    if strictly:
        return max(up, down) >= RISING
    return max(up, down) >= 0.05 and min(up, down) <= 1 - RISING


def _mostly_rising(column: Column) -> bool:
    """What a column that is called time must do at least: others are mended later."""
    steps = np.diff(column.values[column.finite])
    up, down = int(np.sum(steps > 0)), int(np.sum(steps < 0))
    return max(up, down) > 2 * min(up, down)


def _of_numbers(columns: Sequence[Column], found: list[int], time_unit: str | None) -> TimeAxis:
    first, main = found[0], columns[found[0]]
    used = set(found) | _counts(columns, first)
    epoch = epoch_unit(main.values)
    if epoch and time_unit is None:
        factor, unit = EPOCHS[epoch], "s"
        axis = TimeAxis({first: factor * main.values}, unit, used)
        begin = _begin(axis.columns[first], clock=False)
        what = joined([SINCE_1970[epoch], *begin], ", ")
        axis.said.append(said("Time from {column}: {what}.", column=main.name, what=what))
        if first + 1 < len(columns) and _are_parts(main, columns[first + 1]):
            axis.columns[first] = axis.columns[first] + 1e-6 * columns[first + 1].values
            axis.used.add(first + 1)
            axis.said.append(said("Microseconds in {column} added to it.", column=columns[first + 1].name))
        return axis
    if are_sheet_days(main.values) and time_unit is None:
        days = said("Time from {column}: days of a spreadsheet.", column=main.name)
        return TimeAxis({first: 86400.0 * (main.values - 25569.0)}, "s", used, [days])
    told = time_unit or UNITS.get(main.unit.lower().rstrip("."), "") or UNITS.get(main.name.lower().rstrip("."), "")
    factor, unit = _in_kept_unit(told or "s")
    given = said("Time from {column}, {in_unit}.", column=main.name, in_unit=IN_UNIT[told or "s"])
    if factor != 1:
        given = said(
            "Time from {column}, {in_unit}, shown {in_other}.",
            column=main.name,
            in_unit=IN_UNIT[told],
            in_other=IN_UNIT[unit],
        )
    axis = TimeAxis({i: factor * columns[i].values for i in found}, unit, used, [given])
    if not told:
        axis.questions.append(
            Question("time_unit", said("The unit of time is not told."), ("s", "ms", "min", "h"), "s")
        )
    return axis


def _counts(columns: Sequence[Column], time: int) -> set[int]:
    """Other columns that only count the rows."""
    return {
        i
        for i, column in enumerate(columns)
        if i != time and column.kind == NUMBERS and COUNTED.fullmatch(column.name) and _rising(column, strictly=True)
    }


def _are_parts(main: Column, parts: Column) -> bool:
    """Whether the next column holds the microseconds of whole seconds."""
    seconds, micro = main.values[main.finite], parts.values[parts.finite]
    whole = bool(np.all(seconds % 1 == 0)) and bool(np.all(micro % 1 == 0)) if micro.size else False
    return whole and micro.min() >= 0 and 100_000 < micro.max() < 1_000_000


def _in_kept_unit(unit: str) -> tuple[float, str]:
    return (1.0, unit) if unit in KEPT_UNITS else (UNIT_SECONDS[unit], "s")


def signals(columns: Sequence[Column], axis: TimeAxis) -> list[int]:
    """Columns that may be PV, OP or SP."""
    return [
        i
        for i, each in enumerate(columns)
        if i not in axis.used and each.kind not in (WORDS, INSTANTS) and each.finite.any()
    ]
