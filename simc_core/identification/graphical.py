"""Graphical methods for one step of OP, to see beside the fit what noise, drift and an unsettled end do to them.

| method | what is read | model |
|---|---|---|
| two-point [S72] | t28, t63: 28.3 and 63.2 % of the way | tau1 = 1.5 (t63 - t28), theta = t63 - tau1 |
| tangent [ZN42] | steepest slope R and where it is | theta: the tangent meets the old level; tau1 = change/R |
| areas [AH95] | A0 = int (y_end - y)/change, A1 = int_0^A0 y/change | tau1 = e A1, theta = A0 - tau1 |
"""

from collections.abc import Mapping
from math import e

import numpy as np
from numpy.typing import NDArray

from simc_core.errors import NotIdentifiable, SimcError
from simc_core.identification.moves import Move, find_moves
from simc_core.identification.trend import Trend, check_trend
from simc_core.plants.models import FirstOrderDelay

END = 0.1  # share of the record after the step, at its end, of which the new level is the mean
SMOOTH = 0.25  # share of the time from 28 to 63 % over which a slope is taken
FEWEST = 10

Array = NDArray[np.float64]


def graphical_methods(trend: Trend) -> Mapping[str, FirstOrderDelay]:
    """First-order models read from the first step of OP as one would with a ruler.

    Parameters
    ----------
    trend : Trend
        With a level before the step, and a new one before the next step or at the end.

    Returns
    -------
    mapping from str to FirstOrderDelay
        By "two-point", "tangent", "areas"; a method that gives no model, as theta < 0, is left out.

    Raises
    ------
    NotIdentifiable
        OP never moves, fewer than 10 samples show the response, or PV ends where it began.

    References
    ----------
    [S72], [ZN42], [AH95]

    Examples
    --------
    >>> import numpy as np
    >>> from simc_core import Trend, graphical_methods
    >>> t = np.arange(0.0, 100.0, 0.1)
    >>> y = 2 * np.where(t > 13, 1 - np.exp(-(t - 13).clip(0) / 8), 0)
    >>> model = graphical_methods(Trend(t, y, t >= 10))["two-point"]
    >>> round(model.k, 2), round(model.theta, 1), round(model.tau1, 1)
    (2.0, 3.0, 8.0)
    """
    moves = find_moves(check_trend(trend))
    if not moves:
        raise NotIdentifiable("OP never moves: there is no step to read from")
    t, share, k = _response(trend, moves[0], moves[1].t if len(moves) > 1 else np.inf)
    found = {}
    for name, method in (("two-point", _two_point), ("tangent", _tangent), ("areas", _areas)):
        theta, tau1 = method(t, share)
        try:
            found[name] = FirstOrderDelay(k, theta, tau1)
        except SimcError:
            continue
    return found


def _response(trend: Trend, move: Move, end: float) -> tuple[Array, Array, float]:
    """Times after the step, PV as a share of its change, and the gain."""
    after = (trend.t >= move.t) & (trend.t < end)
    if np.count_nonzero(after) < FEWEST:
        raise NotIdentifiable(f"At least {FEWEST} samples must follow the step, found {np.count_nonzero(after)}")
    t, y = trend.t[after] - move.t, trend.y[after]
    before = trend.y[trend.t < move.t]
    level = float(before.mean()) if before.size else float(y[0])
    change = float(y[t >= (1 - END) * t[-1]].mean()) - level
    if change == 0:
        raise NotIdentifiable("PV ends where it began: there is no response to read from")
    return t, (y - level) / change, change / move.size


def _two_point(t: Array, share: Array) -> tuple[float, float]:
    early, late = _reached(t, share, 1 - e ** (-1 / 3)), _reached(t, share, 1 - 1 / e)
    tau1 = 1.5 * (late - early)
    return late - tau1, tau1


def _reached(t: Array, share: Array, level: float) -> float:
    """When the share first reaches a level, straight between samples."""
    i = int(np.argmax(share >= level))
    return float(np.interp(level, share[i - 1 : i + 1], t[i - 1 : i + 1])) if i else float(t[0])


def _tangent(t: Array, share: Array) -> tuple[float, float]:
    rising = _reached(t, share, 1 - 1 / e) - _reached(t, share, 1 - e ** (-1 / 3))
    width = max(int(SMOOTH * rising / (t[-1] - t[0]) * t.size), 1)
    slope = (share[width:] - share[:-width]) / np.maximum(t[width:] - t[:-width], 1e-300)
    i = int(np.argmax(slope))
    middle, level = (t[i] + t[i + width]) / 2, (share[i] + share[i + width]) / 2
    return float(middle - level / slope[i]), float(1 / slope[i])


def _areas(t: Array, share: Array) -> tuple[float, float]:
    whole = float(np.trapezoid(1 - share, t))
    inside = np.linspace(0.0, max(whole, 0.0), 2000)
    tau1 = e * float(np.trapezoid(np.interp(inside, t, share), inside))
    return whole - tau1, tau1
