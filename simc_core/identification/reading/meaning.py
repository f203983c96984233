"""What the columns of a file are, and the trend they make."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from simc_core.controllers.forms import Controller
from simc_core.errors import DataError, SimcError
from simc_core.identification.experiments.known_controller import COMPUTED, op_of_controller
from simc_core.identification.reading.cleaning import ANEW, BACKWARDS, HOUR, first_is_rubbish, in_order, without_repeats
from simc_core.identification.reading.columns import QUALITY, Column
from simc_core.identification.reading.historian import by_tags, is_long
from simc_core.identification.reading.inputs import moved_too
from simc_core.identification.reading.instants import UNIT_SECONDS
from simc_core.identification.reading.questions import Question
from simc_core.identification.reading.roles import ROLES, roles_of
from simc_core.identification.reading.table import Table
from simc_core.identification.reading.time_axis import TimeAxis, signals, time_axis
from simc_core.identification.trend import Trend
from simc_core.wording import counted, said

FAR_AWAY = 100.0  # spans from zero: such a time is counted from its first row


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """What a file was understood to be.

    Parameters
    ----------
    trend : Trend or None
        None where something is missing; `refusal` then says what.
    roles : mapping
        Names of the columns that are time, PV, OP and SP; "" for none.
    signals : tuple of str
        Names of all columns that may be PV, OP or SP.
    understood : tuple of str
        One sentence for each step.
    questions : tuple of Question
        What is not clear, with the answer that is assumed meanwhile.
    refusal : str
        Why there is no trend, "" where there is one.
    computable : bool
        OP is missing, but follows from PV, SP and the controller where that is told.
    """

    trend: Trend | None
    roles: Mapping[str, str]
    signals: tuple[str, ...]
    understood: tuple[str, ...]
    questions: tuple[Question, ...] = ()
    refusal: str = ""
    computable: bool = False


def understand(
    table: Table,
    *,
    columns: Mapping[str, str | int | None] | None = None,
    time_unit: str | None = None,
    period: float | None = None,
    day_first: bool | None = None,
    controller: Controller | None = None,
) -> Reading:
    """What the columns are, and the trend they make; parameters as of `read_trend`.

    Raises DataError where a column that is told does not exist, or none can be PV.
    """
    told = {role: _place(table.columns, role, column) for role, column in (columns or {}).items()}
    found: Sequence[Column] = table.columns
    axis = time_axis(found, told.get("time"), time_unit, period, day_first)
    understood = [*table.understood, *axis.said]
    if axis.columns and is_long(found):
        found, axis, in_words = by_tags(found, axis)
        understood = [*table.understood, *axis.said, in_words]
        told = {role: _place(found, role, column) for role, column in (columns or {}).items() if role != "time"}
    candidates = signals(found, axis)
    roles = roles_of(found, candidates, {role: told[role] for role in ROLES if role in told})
    if "OP" in told or "PV" in told:
        roles.questions = [each for each in roles.questions if each.name not in told]
    rivals = moved_too(found, candidates, roles.at)
    questions = (*table.questions, *axis.questions, *roles.questions, *rivals)
    understood += [*roles.said, *(each.text for each in rivals)]
    names = {role: "" if at is None else found[at].name for role, at in roles.at.items()}
    times = [i for i in axis.columns if i >= 0]
    names["time"] = table.columns[times[0]].name if times and found is table.columns else ""
    choices = tuple(found[i].name for i in candidates)
    computed = controller is not None and roles.at["OP"] is None and roles.at["SP"] is not None
    refusal = _refusal(found, axis, roles.at | ({"OP": roles.at["SP"]} if computed else {}))
    trend = None
    if not refusal:
        trend, mended, refusal = _trend(found, axis, roles.at | ({"OP": roles.at["SP"]} if computed else {}))
        understood += mended
        asked = [each for each in mended if each.startswith((BACKWARDS, ANEW))]
        questions += tuple(Question("order", each, (), "sorted") for each in asked)
        if computed and controller is not None and trend is not None:
            trend = op_of_controller(trend, controller)
            understood.append(COMPUTED)
        if trend is not None and roles.mislabelled:
            trend = replace(trend, units={name: unit for name, unit in trend.units.items() if name == "t"})
        trend = trend and replace(trend, notes=tuple(understood))
    computable = roles.at["OP"] is None and _moves(found, roles.at["SP"])
    return Reading(trend, names, choices, tuple(understood), questions, refusal, computable)


def _place(columns: Sequence[Column], role: str, column: str | int | None) -> int | None:
    if role not in ("time", *ROLES):
        raise DataError(said("columns may name time, PV, OP and SP, found {found}", found=str(role)[:20]))
    names = [each.name for each in columns]
    if column is None:
        return None
    if isinstance(column, str) and column in names:
        return names.index(column)
    if isinstance(column, int) and 0 <= column < len(names):
        return column
    raise DataError(
        said(
            "{role} must be one of the columns {columns}, found {found}",
            role=role,
            columns=", ".join(names)[:200],
            found=str(column)[:40],
        )
    )


def _moves(columns: Sequence[Column], at: int | None) -> bool:
    if at is None:
        return False
    good = columns[at].values[columns[at].finite]
    return good.size > 0 and float(np.ptp(good)) > 0


def _refusal(columns: Sequence[Column], axis: TimeAxis, at: Mapping[str, int | None]) -> str:
    if not axis.columns:
        return said(
            "no column is time: tell how long it is from one row to the next{argument}", argument=", period=..."
        )
    if at["OP"] is not None:
        return ""
    if at["SP"] is None:
        return said(
            "no column is the controller output (OP). A model tells how PV follows OP: log both, and SP, and repeat "
            "the test"
        )
    if _moves(columns, at["SP"]):
        return said(
            "no column is the controller output (OP). A model tells how PV follows OP: log both, and SP, and repeat "
            "the test; or, since the set point moved, tell the controller{argument}",
            argument=", controller=...",
        )
    return said(
        "no column is the controller output (OP). A model tells how PV follows OP: log both, and SP, and repeat the "
        "test. The set point never moves, so that OP cannot be computed from the controller either"
    )


def _trend(
    columns: Sequence[Column], axis: TimeAxis, at: Mapping[str, int | None]
) -> tuple[Trend | None, list[str], str]:
    """The trend, what was mended, and why there is none."""
    pv, op, sp = at["PV"], at["OP"], at["SP"]
    if pv is None or op is None:
        return None, [], said("PV and OP are needed")
    notes = [_lost(columns[i]) for i in (pv, op, sp) if i is not None and columns[i].bad]
    y, quality = columns[pv].values, _quality(columns, pv)
    if quality is not None:
        y = np.where(quality == 1, y, np.nan)
        lost = int(np.sum(quality != 1))
        notes.append(counted("{n} value of bad quality left out.", "{n} values of bad quality left out.", lost))
    t_y, y, of_y = _series(axis, pv, y)
    t_u, u, of_u = _series(axis, op, columns[op].values)
    notes += of_y + [each for each in of_u if each not in of_y]
    if t_y.size < 3 or t_u.size < 1:
        few = said("PV has {y} values and OP {u}: at least 3 are needed", y=t_y.size, u=t_u.size)
        return None, notes, few
    shared = t_u.shape == t_y.shape and bool(np.array_equal(t_u, t_y))
    keep, repeated = without_repeats(t_y, u if shared else None)
    t_y, y = t_y[keep], y[keep]
    notes += [repeated] if repeated else []
    if shared:
        t_u, u = t_u[keep], u[keep]
    else:
        notes.append(
            said(
                "PV and OP have instants of their own: {y} and {u}; OP is held between its own.", y=t_y.size, u=t_u.size
            )
        )
    if first_is_rubbish(y):
        notes.append(said("The first PV, {y:g}, is far from the next ones: left out.", y=float(y[0])))
        t_y, y, shared = t_y[1:], y[1:], False
    begin = float(t_y[0])
    span = float(t_y[-1] - begin)
    if abs(begin) > FAR_AWAY * max(span, 1e-9):
        t_y, t_u = t_y - begin, t_u - begin
        notes.append(said("Time counts from the first row."))
    r = None
    if sp is not None:
        t_r, r_own, _ = _series(axis, sp, columns[sp].values)
        shift = begin if abs(begin) > FAR_AWAY * max(span, 1e-9) else 0.0
        r = _held(t_r - shift, r_own, t_y) if t_r.size else None
    names = {"y": columns[pv].name, "u": columns[op].name} | ({"r": columns[sp].name} if sp is not None else {})
    units = {"t": axis.unit, "y": columns[pv].unit, "u": columns[op].unit}
    if r is None:
        names.pop("r", None)
    try:
        trend = Trend(t_y, y, u, r, None if shared else t_u, names=names, units={k: v for k, v in units.items() if v})
    except SimcError as error:
        return None, notes, str(error)
    return trend, [*notes, _sampling(trend)], ""


def _series(
    axis: TimeAxis, at: int, values: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], list[str]]:
    """The values of a signal that there are, in order of time."""
    order = in_order(axis.of(at), HOUR / UNIT_SECONDS[axis.unit])
    values = values[order.rows]
    good = np.isfinite(values)
    return order.t[good], values[good], order.said


def _held(t: NDArray[np.float64], values: NDArray[np.float64], at: NDArray[np.float64]) -> NDArray[np.float64]:
    return values[np.maximum(np.searchsorted(t, at, "right") - 1, 0)]


def _quality(columns: Sequence[Column], pv: int) -> NDArray[np.float64] | None:
    found = [i for i, each in enumerate(columns) if each.kind == QUALITY]
    if pv + 1 in found:
        return columns[pv + 1].values
    return columns[found[0]].values if len(found) == 1 else None


def _lost(column: Column) -> str:
    at, word = column.first_bad or (0, "")
    return counted(
        "{column}: {n} cell is no number and left out, the first in line {line}: {word}.",
        "{column}: {n} cells are no number and left out, the first in line {line}: {word}.",
        column.bad,
        column=column.name,
        line=at,
        word=word,
    )


def _sampling(trend: Trend) -> str:
    steps = np.diff(trend.t)
    steps = steps[steps > 0]
    unit = trend.units.get("t", "")
    usual, low, high = (float(each) for each in (np.median(steps), steps.min(), steps.max()))
    if high - low < 0.01 * usual:
        return counted(
            "{n} sample of PV, every {usual:.4g} {unit}.",
            "{n} samples of PV, every {usual:.4g} {unit}.",
            trend.t.size,
            usual=usual,
            unit=unit,
        )
    return counted(
        "{n} sample of PV, every {usual:.4g} {unit} as a rule, {low:.3g} to {high:.4g}.",
        "{n} samples of PV, every {usual:.4g} {unit} as a rule, {low:.3g} to {high:.4g}.",
        trend.t.size,
        usual=usual,
        unit=unit,
        low=low,
        high=high,
    )
