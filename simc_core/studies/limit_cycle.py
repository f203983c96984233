"""A loop that goes on swinging at the end of its course, by an actuator that does not move as it is told."""

from typing import NamedTuple

import numpy as np

PART = 0.25  # of the time after the last change, at the end of the course, in each of two windows
LASTING = 0.9  # of the former window's swing; less is dying out
CYCLES = 2  # at least, in the last window
SMALLEST = 1e-7  # of the whole course's range; less is rounding


class LimitCycle(NamedTuple):
    """swing: of y, from peak to peak.   period: in the time unit of the loop."""

    swing: float
    period: float


def limit_cycle(t: np.ndarray, y: np.ndarray, begin: float) -> LimitCycle | None:
    """The swing that lasts at the end of a course whose last change was at `begin`; None for one that dies out.

    Parameters
    ----------
    t, y : arrays of shape (n,)
        The course.
    begin : float
        Of the last change of set point or load.
    """
    length = PART * (t[-1] - begin)
    last, former = t >= t[-1] - length, (t >= t[-1] - 2 * length) & (t < t[-1] - length)
    if not last.any() or not former.any():
        return None
    swing = float(np.ptp(y[last]))
    if not swing > max(LASTING * float(np.ptp(y[former])), SMALLEST * float(np.ptp(y))):
        return None
    middle = (float(y[last].max()) + float(y[last].min())) / 2
    above = y[last] >= middle
    rises = t[last][1:][above[1:] & ~above[:-1]]
    if len(rises) <= CYCLES:
        return None
    return LimitCycle(swing, float(rises[-1] - rises[0]) / (len(rises) - 1))
