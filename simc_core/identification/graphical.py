"""First order with dead time read off one step, as it is done by hand: to compare, and to see what it costs.

    two-point   tau1 = 1.5 (t63 - t28), theta = t63 - tau1, from the times at which 28.3 and 63.2 % are reached [S72]
    tangent     the steepest tangent: theta where it leaves the old level, tau1 until it reaches the new one [ZN42]
    areas       theta + tau1 = A0/k du, tau1 = e A1/k du, from areas above and below the response [AH95]

All need a response that begins and ends at rest, and take levels and times from noisy samples as they are.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simc_core.errors import NotIdentifiable
from simc_core.identification.moves import Move, find_moves
from simc_core.identification.trend import Trend, check_trend
from simc_core.plants.models import FirstOrderDelay
from simc_core.wording import counted, said

LEAST_SAMPLES = 12  # of the response
AT_REST = 0.1  # of the response: its last part is taken for the new level
SLOPE_WINDOW = 0.25  # of the time from 28 to 63 %: the tangent is a line through the samples of it
BEFORE = 20  # samples before the step that give the old level
FRACTION_28, FRACTION_63 = 1 - np.exp(-1 / 3), 1 - np.exp(-1)

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ByHand:
    """What one graphical method gives.

    Attributes
    ----------
    method : str
        "two-point", "tangent" or "areas".
    model : FirstOrderDelay
    source : str
        Key of the publication.
    """

    method: str
    model: FirstOrderDelay
    source: str


def by_hand(trend: Trend) -> tuple[ByHand, ...]:
    """The graphical methods on the move of OP with the longest rest after it.

    Parameters
    ----------
    trend : Trend
        With at least one move of OP.

    Returns
    -------
    tuple of ByHand
        Those methods that give a model.

    Raises
    ------
    NotIdentifiable
        No move of OP, too few samples after it, or no response.

    References
    ----------
    [S72], [ZN42], [AH95]

    Examples
    --------
    2 e^{-3.5s}/(8s + 1), a step of 5 at t = 10:

    >>> import numpy as np
    >>> from simc_core import Trend, by_hand
    >>> t = np.arange(0.0, 90.0, 0.1)
    >>> y = 10 * np.where(t > 13.5, 1 - np.exp(-(t - 13.5).clip(0) / 8), 0)
    >>> model = by_hand(Trend(t, y, np.where(t >= 10, 55, 50)))[0].model
    >>> round(model.k, 2), round(model.theta, 1), round(model.tau1, 1)
    (2.0, 3.5, 8.0)
    """
    trend = check_trend(trend)
    move, t, y, low = _response(trend)
    high = float(np.mean(y[-max(3, round(AT_REST * y.size)) :]))
    if high == low:
        raise NotIdentifiable(said("PV does not answer the move of OP: there is nothing to read off"))
    z = (y - low) / (high - low)
    k = (high - low) / move.size
    found: list[ByHand] = []
    for method, reading, source in (
        ("two-point", _two_points(t, z), "S72"),
        ("tangent", _tangent(t, z), "ZN42"),
        ("areas", _areas(t, z), "AH95"),
    ):
        theta, tau1 = reading
        if np.isfinite(theta) and tau1 > 0:
            found.append(ByHand(method, FirstOrderDelay(k, max(theta, 0.0), tau1), source))
    return tuple(found)


def _response(trend: Trend) -> tuple[Move, Array, Array, float]:
    """The move with the longest rest after it, time since it, PV, and its level before."""
    moves = find_moves(trend)
    if not moves:
        raise NotIdentifiable(said("OP never moves: there is no step to read off"))
    ends = [move.t for move in moves[1:]] + [float(trend.t[-1])]
    rests = [end - move.t for move, end in zip(moves, ends, strict=True)]
    at = int(np.argmax(rests))
    move = moves[at]
    first, last = np.searchsorted(trend.t, move.t, "left"), np.searchsorted(trend.t, ends[at], "left")
    if last - first < LEAST_SAMPLES:
        raise NotIdentifiable(
            counted(
                "{n} sample after the move of OP is too little: at least {least}",
                "{n} samples after the move of OP are too few: at least {least}",
                int(last - first),
                least=LEAST_SAMPLES,
            )
        )
    before = trend.y[max(0, first - BEFORE) : first]
    level = float(before.mean() if before.size else trend.y[first])
    return move, trend.t[first:last] - move.t, trend.y[first:last], level


def _two_points(t: Array, z: Array) -> tuple[float, float]:
    first, second = (_reached(t, z, fraction) for fraction in (FRACTION_28, FRACTION_63))
    tau1 = 1.5 * (second - first)
    return second - tau1, tau1


def _reached(t: Array, z: Array, level: float) -> float:
    """When z first reaches a level, between samples on the line that joins them."""
    above = np.flatnonzero(z >= level)
    if above.size == 0 or above[0] == 0:
        return float("nan")
    i = int(above[0])
    return float(t[i - 1] + (t[i] - t[i - 1]) * (level - z[i - 1]) / (z[i] - z[i - 1]))


def _tangent(t: Array, z: Array) -> tuple[float, float]:
    rise = _reached(t, z, FRACTION_63) - _reached(t, z, FRACTION_28)
    if not rise > 0:
        return float("nan"), 0.0
    n = max(3, int(np.searchsorted(t, t[0] + SLOPE_WINDOW * rise)))
    sums = [np.cumsum(np.insert(each, 0, 0.0)) for each in (t, z, t * t, t * z)]
    st, sz, stt, stz = (each[n:] - each[:-n] for each in sums)
    slopes = (n * stz - st * sz) / np.maximum(n * stt - st**2, np.finfo(float).tiny)
    i = int(np.argmax(slopes))
    best = float(slopes[i])
    if best <= 0:
        return float("nan"), 0.0
    return float(st[i] / n - sz[i] / n / best), 1 / best


def _areas(t: Array, z: Array) -> tuple[float, float]:
    residence = float(np.trapezoid(1 - z, t))
    if not 0 < residence < t[-1]:
        return float("nan"), 0.0
    inside = t < residence
    ends = np.append(t[inside], residence), np.append(z[inside], np.interp(residence, t, z))
    tau1 = float(np.e * np.trapezoid(ends[1], ends[0]))
    return residence - tau1, tau1
