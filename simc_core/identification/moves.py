"""Moves of OP that are meant as such, found in a trend: what a page offers as the step to be fitted."""

from dataclasses import dataclass

import numpy as np

from simc_core.identification.trend import Trend, check_trend

TOGETHER = 3  # samples within which several changes are one move
LARGE = 5 * 1.4826  # times the median change


@dataclass(frozen=True, slots=True)
class Move:
    """A move of OP.

    Parameters
    ----------
    t : float
        Instant of its first change, in the time unit of the trend.
    before, after : float
        OP before the first and after the last of its changes.
    first, last : int
        Its changes are first <= j < last among all changes of OP.
    """

    t: float
    before: float
    after: float
    first: int
    last: int

    @property
    def size(self) -> float:
        """after - before."""
        return self.after - self.before


def find_moves(trend: Trend) -> tuple[Move, ...]:
    """The moves of OP that stand out of its noise.

    A change counts where it is larger than 7.4 times the median change, or where all are about as large; changes within
    three samples are one move.

    Parameters
    ----------
    trend : Trend
        The record.

    Returns
    -------
    tuple of Move
        In the order of time.

    Examples
    --------
    >>> from simc_core import Trend, find_moves
    >>> [(move.t, move.size) for move in find_moves(Trend(range(6), [0, 0, 0, 1, 2, 3], [40, 40, 45, 45, 45, 45]))]
    [(2.0, 5.0)]
    """
    trend = check_trend(trend)
    at = trend.instants_of_u
    changed = 1 + np.flatnonzero(np.diff(trend.u))
    if changed.size == 0:
        return ()
    sizes = np.abs(trend.u[changed] - trend.u[changed - 1])
    typical = float(np.median(sizes))
    large = sizes > LARGE * typical if np.any(sizes > LARGE * typical) else sizes > 0.2 * sizes.max()
    near = TOGETHER * float(np.median(np.diff(trend.t)))
    found: list[Move] = []
    for j in np.flatnonzero(large).tolist():
        i = int(changed[j])
        if found and at[i] - at[changed[found[-1].last - 1]] <= near:
            begun = found.pop()
            found.append(Move(begun.t, begun.before, float(trend.u[i]), begun.first, j + 1))
        else:
            found.append(Move(float(at[i]), float(trend.u[i - 1]), float(trend.u[i]), j, j + 1))
    return tuple(found)
