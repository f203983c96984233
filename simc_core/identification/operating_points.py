"""The model at each operating point that a trend visits: what a gain schedule is made of."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.errors import NotIdentifiable, SimcError
from simc_core.identification.identified import Identified
from simc_core.identification.identify import identify, trends_of
from simc_core.identification.moves import find_moves
from simc_core.identification.trend import Trend
from simc_core.wording import said

MOST = 20  # moves that are looked at
SAME = 0.1  # share of the range of OP within which moves are at one operating point
BEFORE = 0.5  # share of the rest before a move that goes along, to tell what was left of the one before
SAMPLES = 12  # of a window, without which nothing can be fitted


@dataclass(frozen=True, slots=True, eq=False)
class OperatingPoint:
    """A model, and where it holds.

    Attributes
    ----------
    OP, PV : float
        In the middle of the moves that show it, and of the answers of PV to them.
    moves : int
        That show it.
    identified : Identified
        Fitted to them alone.
    """

    OP: float
    PV: float
    moves: int
    identified: Identified


@dataclass(frozen=True, slots=True, eq=False)
class _Window:
    trend: Trend
    OP: float
    PV: float


def operating_points(trend: Trend | Sequence[Trend], structure: str = "FOPDT") -> tuple[OperatingPoint, ...]:
    """A model for each operating point, from the moves of OP that are there.

    Each move is taken with what follows until the next; moves with the same middle, as up and back, go together.

    Parameters
    ----------
    trend : Trend, or several
    structure : str
        Of all of them, as for `identify`.

    Returns
    -------
    tuple of OperatingPoint
        With rising OP. Moves that tell nothing are left out.

    Raises
    ------
    NotIdentifiable
        No move of OP can be told from its noise, or none tells a model.
    InvalidParameter
        As for `identify`.

    Examples
    --------
    The gain is 1 between 40 and 50, and 3 between 50 and 60:

    >>> import numpy as np
    >>> from simc_core import Trend, operating_points
    >>> t = np.arange(0.0, 200.0)
    >>> def answer(begin):
    ...     return np.where(t > begin, 1 - np.exp(-(t - begin).clip(0) / 8), 0)
    >>> found = operating_points(Trend(t, 10 * answer(13) + 30 * answer(113), 40 + 10.0 * (t >= 10) + 10 * (t >= 110)))
    >>> [(point.OP, round(point.identified.parameters["k"], 2)) for point in found]
    [(45.0, 1.0), (55.0, 3.0)]
    """
    trends = trends_of(trend)
    windows = [window for one in trends for window in _windows(one)]
    if not windows:
        raise NotIdentifiable(
            said("No move of OP with an answer of PV is there: a gain schedule is made of steps of OP.")
        )
    low = min(window.trend.u.min() for window in windows)
    high = max(window.trend.u.max() for window in windows)
    found: list[OperatingPoint] = []
    reason: SimcError | None = None
    for group in _groups(windows, SAME * float(high - low)):
        try:
            identified = identify([window.trend for window in group], structure)
        except NotIdentifiable as error:
            reason = reason or error
            continue
        middle = float(np.mean([window.OP for window in group]))
        found.append(OperatingPoint(middle, float(np.mean([window.PV for window in group])), len(group), identified))
    if not found:
        raise reason or NotIdentifiable(said("No move of OP tells a model."))
    return tuple(found)


def _windows(trend: Trend) -> list[_Window]:
    """Each move of OP with the rest before it and what follows until the next."""
    moves = find_moves(trend)
    if not 1 <= len(moves) <= MOST:
        return []
    starts = [float(trend.t[0]), *(move.t for move in moves), float(trend.t[-1])]
    found = []
    for i, move in enumerate(moves, start=1):
        begin = starts[i] - BEFORE * (starts[i] - starts[i - 1])
        inside = (trend.t >= begin) & (trend.t < starts[i + 1])
        if np.count_nonzero(inside) < SAMPLES:
            continue
        last = float(trend.t[inside][-1])
        part = trend.between(begin, last)
        tail = part.y[-max(part.y.size // 10, 1) :]
        before = part.y[part.t < move.t]
        level = float(np.median(before[-max(before.size // 4, 1) :])) if before.size else float(part.y[0])
        found.append(_Window(part, (move.before + move.after) / 2, (level + float(np.median(tail))) / 2))
    return found


def _groups(windows: list[_Window], near: float) -> list[list[_Window]]:
    """Windows with the same middle of OP, in its order."""
    found: list[list[_Window]] = []
    for window in sorted(windows, key=lambda one: one.OP):
        if found and near >= window.OP - found[-1][0].OP:
            found[-1].append(window)
        else:
            found.append([window])
    return found
