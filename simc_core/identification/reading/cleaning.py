"""Order of the samples, repeated instants, a changed clock, rubbish at the start: what is mended, and said."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from simc_core.wording import counted, said

HOUR = 3600.0
CLOCK_CHANGE = (0.9 * HOUR, 1.1 * HOUR)  # how far a clock is put back
RESTART = 0.1  # of the span: a jump back to before it begins another record
BACKWARDS, ANEW = "Time went backwards", "Time begins anew"  # how sentences of it begin that ask to be checked
FAR = 10.0  # times the next steps: a jump of the first sample that is rubbish


@dataclass(slots=True)
class Order:
    """Which rows are kept, in order, and their instants.   said: what was mended."""

    rows: NDArray[np.intp]
    t: NDArray[np.float64]
    said: list[str] = field(default_factory=list)


def in_order(t: NDArray[np.float64], hour: float = HOUR) -> Order:
    """Rows with an instant, in order of time. hour: in the unit of t."""
    rows = np.flatnonzero(np.isfinite(t))
    notes: list[str] = []
    if rows.size < t.size:
        missing = t.size - rows.size
        notes.append(counted("{n} row without a time left out.", "{n} rows without a time left out.", missing))
    t = t[rows]
    steps = np.diff(t)
    if steps.size and np.mean(steps < 0) > 0.5:
        rows, t = rows[::-1], t[::-1]
        notes.append(said("The newest came first: turned round."))
        steps = np.diff(t)
    back = np.flatnonzero(steps < 0)
    lost = float(np.median(steps) - steps[back[0]]) * HOUR / hour if back.size == 1 else 0.0
    if CLOCK_CHANGE[0] <= lost <= CLOCK_CHANGE[1]:
        t = t.copy()
        t[back[0] + 1 :] += hour
        at = rows[back[0]] + 1
        notes.append(
            said(
                "The clock was put back by an hour after row {row} of the numbers: an hour is added from there.",
                row=int(at),
            )
        )
        return Order(rows, t, notes)
    if back.size:
        return _sorted(rows, t, back, notes)
    return Order(rows, t, notes)


def _sorted(rows: NDArray[np.intp], t: NDArray[np.float64], back: NDArray[np.intp], notes: list[str]) -> Order:
    span = float(t.max() - t.min())
    restarts = [int(i) for i in back if t[i + 1] <= t.min() + RESTART * span]
    parts = np.split(np.arange(t.size), [i + 1 for i in restarts])
    longest = max(parts, key=len)
    if restarts and len(longest) < t.size and min(map(len, parts)) > 2:
        at = int(rows[longest[0]]) + 1
        notes.append(
            counted(
                "Time begins anew: {n} record. The longest is taken, from row {row} of the numbers on.",
                "Time begins anew: {n} records. The longest is taken, from row {row} of the numbers on.",
                len(parts),
                row=at,
            )
        )
        rows, t = rows[longest], t[longest]
        back = np.flatnonzero(np.diff(t) < 0)
    if back.size:
        order = np.argsort(t, kind="stable")
        rows, t = rows[order], t[order]
        notes.append(
            counted(
                "Time went backwards once: sorted. Where a clock was put back this mixes what was measured before and "
                "after: then take the file apart there.",
                "Time went backwards {n} times: sorted. Where a clock was put back this mixes what was measured before "
                "and after: then take the file apart there.",
                back.size,
            )
        )
    return Order(rows, t, notes)


def without_repeats(t: NDArray[np.float64], u: NDArray[np.float64] | None) -> tuple[NDArray[np.bool_], str]:
    """Which samples are kept: of one instant the last, and the one before it too where OP differs: it steps there."""
    same = np.diff(t) == 0
    if not same.any():
        return np.ones(t.size, dtype=bool), ""
    drop = np.append(same, False)
    stepped = 0
    if u is not None:
        steps = np.append(same & (np.diff(u) != 0), False)
        stepped = int(steps.sum())
        drop &= ~steps
    count = int(same.sum())
    if stepped:
        return ~drop, counted(
            "{n} repeated instant: the last value is kept; OP steps at {stepped} of them, there both are kept.",
            "{n} repeated instants: the last value is kept; OP steps at {stepped} of them, there both are kept.",
            count,
            stepped=stepped,
        )
    return ~drop, counted(
        "{n} repeated instant: the last value is kept.", "{n} repeated instants: the last value is kept.", count
    )


def first_is_rubbish(y: NDArray[np.float64]) -> bool:
    """Whether the first sample is far from the next ones, as a sensor gives that has just been switched on."""
    if y.size < 12:
        return False
    jump, later = abs(float(y[1] - y[0])), np.abs(np.diff(y[1:50]))
    return jump > FAR * float(later[:10].max()) and jump > 4 * float(later.max()) and jump > 0.02 * float(np.ptp(y[1:]))
