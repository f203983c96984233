"""The limit of stability of PI control in the plane of Kc and tau_I.

On the limit -1/G(j omega) = Kp + Ki/(j omega), so that Kp = -Re(1/G) and Ki = omega Im(1/G) at some omega, or Ki = 0.
At one Kc each omega with Kc = -Re(1/G) gives such a Ki; between two of them the number of unstable poles is constant.
"""

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from simc_core import checks
from simc_core.certificate.verdict import stability
from simc_core.controllers.forms import ParallelPid
from simc_core.errors import NotStable
from simc_core.loops.loop import Loop
from simc_core.optimal.robust_gains import RobustGains
from simc_core.plants.plant import Plant
from simc_core.wording import said

MOST_LIMITS = 24  # that are tried, the smallest Ki first: beyond them the dead time has turned often
PRECISION = 1e-14


def stability_limit(plant: Plant, Kc: float) -> float:
    """The smallest integral time with which a PI controller of this gain keeps the loop stable.

    Parameters
    ----------
    plant : Plant
        The plant, dead time exact.
    Kc : float
        Gain, in input units per output unit.

    Returns
    -------
    float
        tau_I in the user's time unit: the lower end of the range of stable integral times that lies lowest, 0.0 where
        any integral time will do.

    Raises
    ------
    NotStable
        No integral time keeps the loop stable.
    InvalidParameter
        Kc is 0 or out of bounds.

    Examples
    --------
    >>> from simc_core import Plant, stability_limit
    >>> round(stability_limit(Plant(1, 1, integrators=1), 0.5), 6)
    1.234587
    """
    Kc = checks.gain("Kc", Kc)
    limits = sorted({0.0, *_limits(plant, Kc)})[:MOST_LIMITS]
    for low, high in reversed(list(zip(limits, [*limits[1:], math.inf], strict=True))):
        middle = math.sqrt(low * high) if low and high < math.inf else 2 * low or min(high, 2 * _usual(plant, Kc)) / 2
        if stability(Loop(plant, ParallelPid(Kc, math.copysign(middle, Kc)))).verdict == "stable":
            return Kc / math.copysign(high, Kc)
    raise NotStable(
        said(
            "Kc must be a gain with which some integral time keeps the loop stable, found {Kc:g}: take a smaller "
            "one, or one of the other sign, and for an unstable plant a larger one",
            Kc=Kc,
        )
    )


def _limits(plant: Plant, Kc: float) -> list[float]:
    """|Ki| > 0 on the limit, of the sign of Kc."""
    grid = RobustGains(plant)
    omega, G = grid.omega, grid.G

    def excess(at: ArrayLike) -> np.ndarray:
        return (1 / G(1j * np.asarray(at))).real + Kc

    signs = np.sign(excess(omega))
    found = []
    for i in np.flatnonzero(signs[1:] * signs[:-1] < 0).tolist():
        at = brentq(excess, omega[i], omega[i + 1], xtol=PRECISION * omega[i], rtol=PRECISION)
        Ki = at * float((1 / G(1j * at)).imag)
        if Ki * Kc > 0:
            found.append(abs(Ki))
    return found


def _usual(plant: Plant, Kc: float) -> float:
    """A |Ki| of the size that fits the plant's times, where there is no limit to go by."""
    times = plant.theta + sum(map(abs, plant.lags)) + sum(tau for tau, _ in plant.lag_pairs)
    return abs(Kc) / (times or 1.0)
