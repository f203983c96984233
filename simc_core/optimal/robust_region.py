"""Gains of a controller, and settings of PI control, with which the loop is stable and max(Ms, Mt) <= Ms."""

import math

import numpy as np
from numpy.typing import ArrayLike

from simc_core import checks
from simc_core.certificate.verdict import stability
from simc_core.controllers.forms import Controller, ParallelPid
from simc_core.loops.loop import Loop
from simc_core.optimal.robust_gains import FINE_ZOOMS, Gap, RobustGains, Shapes, peak_bound, robust_gains, sign_of_gain
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins import margins

EXACT_PEAK, RETRIES = 1e-8, 6  # relative, of the peak at an edge; how often what the grid missed is added to it


def gain_intervals(plant: Plant, shape: Controller, Ms: float) -> tuple[tuple[float, float], ...]:
    """Gains by which a controller may be multiplied with a stable loop and max(Ms, Mt) <= Ms.

    Parameters
    ----------
    plant : Plant
        The plant, dead time exact.
    shape : Controller
        A controller, of any form; its gain is multiplied.
    Ms : float
        Bound of both peaks, > 1.

    Returns
    -------
    tuple of (low, high)
        Intervals of factors > 0, ascending; empty where there is none. low may be 0, high math.inf.

    Raises
    ------
    InvalidParameter
        Ms <= 1, or too large to mean anything.

    Examples
    --------
    e^{-s}/s under a gain reaches Ms = 2 at 0.7012:

    >>> from simc_core import Plant, SeriesPid, gain_intervals
    >>> [(low, high)] = gain_intervals(Plant(1, 1, integrators=1), SeriesPid(1, float("inf")), 2)
    >>> low, round(high, 6)
    (0.0, 0.70117)
    """
    M = peak_bound("Ms", Ms)
    form = shape.to_parallel()
    shapes = Shapes(np.array([[form.Kp, form.Ki, form.Kd]]), form.tau_F)
    times = [1 / abs(root) for root in (*shape.factored.zeros, *shape.factored.poles) if root]
    more: list[float] = []
    for _ in range(RETRIES):
        gains = RobustGains(plant, 0.0, [*more, *(1 / time for time in times)])
        (gaps,) = gains.gaps(shapes, M, FINE_ZOOMS)
        stable = [(gap.low, gap.high) for gap in gaps if _is_stable(plant, form, gap)]
        missed = [omega for gap in stable for edge in gap for omega in _beyond(plant, form, edge, M)]
        if not missed:
            break
        more += missed
    return tuple(stable)


def robust_region(plant: Plant, tau_I: ArrayLike, Ms: float) -> tuple[np.ndarray, np.ndarray]:
    """The contour max(Ms, Mt) = Ms of PI control in the plane of Kc and tau_I.

    Parameters
    ----------
    plant : Plant
        The plant, dead time exact.
    tau_I : array_like, shape (n,)
        Integral times > 0, in the user's time unit.
    Ms : float
        Bound of both peaks, > 1.

    Returns
    -------
    low, high : np.ndarray, shape (n,)
        Edges of the highest stable interval of Kc at each tau_I, with the sign that can stabilise the plant; nan where
        no gain will do.

    Raises
    ------
    InvalidParameter
        Ms <= 1, or a tau_I out of bounds.

    Examples
    --------
    With tau_I = 8 a first-order plant is an integrator under a gain: Ms = 1.59 at Kc = 4 [SK03]:

    >>> from simc_core import Plant, robust_region
    >>> low, high = robust_region(Plant(1, 1, (8,)), [8.0], Ms=1.59)
    >>> float(low[0]), round(float(high[0]), 2)
    (0.0, 4.0)
    """
    M = peak_bound("Ms", Ms)
    times = np.array([checks.positive_time("tau_I", each) for each in checks.array("tau_I", tau_I, 10_000).tolist()])
    sign = sign_of_gain(plant)
    low, high = robust_gains(plant, float(times.max())).highest(Shapes.ideal(sign, times), M)
    return sign * low, sign * high


def _is_stable(plant: Plant, form: ParallelPid, gap: Gap) -> bool:
    """By the certificate, at a gain inside."""
    high = gap.high if gap.high < math.inf else 2 * gap.low or 1.0
    gain = math.sqrt(gap.low * high) if gap.low else high / 2
    return stability(Loop(plant, form.rescaled(gain=gain))).verdict == "stable"


def _beyond(plant: Plant, form: ParallelPid, edge: float, M: float) -> list[float]:
    """Frequencies of peaks at an edge that the grid has missed."""
    if not 0 < edge < math.inf:
        return []
    found = margins(Loop(plant, form.rescaled(gain=edge)))
    peaks = ((found.Ms, found.omega_Ms), (found.Mt, found.omega_Mt))
    return [omega for peak, omega in peaks if peak > M * (1 + EXACT_PEAK) and 0 < omega < math.inf]
