"""How far in frequency a loop reaches: bandwidths of S and T, and the largest gain from measurement noise to u.

    bandwidth of S      |S| = 1/sqrt 2, the first time from below [RMS86]
    bandwidth of T      |T| = 1/sqrt 2, the last time from above
    |KS|                |C/(1 + L)|, its largest value, the ends omega = 0 and infinity included

Each crossing and peak is bracketed on a grid that follows the turns of the dead time, and then found by Brent's method.
|T| >= 1/sqrt 2 asks for |L| >= sqrt 2 - 1: where |L| stays below that the search ends.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from simc_core.algebra.factors import Factored
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.loop import Loop
from simc_core.sensitivity.log_response import FactoredResponse
from simc_core.sensitivity.margins import margins

HALF_POWER = math.sqrt(0.5)
SMALLEST_L = math.sqrt(2) - 1
PHASE_STEP = 0.1  # omega theta, from node to node
MOST_NODES = 20_000
DOUBLINGS = 60
PRECISION = 1e-12  # relative, of a frequency


@dataclass(frozen=True, slots=True)
class Bandwidth:
    """See the module docstring.

    Attributes
    ----------
    omega_bS : float
        In rad per time unit; nan where abs(S) is above 1/sqrt 2 from the beginning.
    omega_bT : float
        In rad per time unit; math.inf where abs(T) never stays below, nan where it is below from the beginning on.
    max_KS : float
        Largest abs(K S), in input units per output unit; math.inf for a derivative without filter.
    omega_KS : float
        Where that is, in rad per time unit.
    """

    omega_bS: float
    omega_bT: float
    max_KS: float
    omega_KS: float


NO_BANDWIDTH = Bandwidth(math.nan, math.nan, math.nan, math.nan)


def bandwidth(loop: Loop) -> Bandwidth:
    """Bandwidths of S and T, and the largest |KS|; all nan where the loop is not stable.

    Parameters
    ----------
    loop : Loop
        A plant under feedback, dead time exact.

    Returns
    -------
    Bandwidth
        Frequencies in rad per time unit.

    References
    ----------
    [RMS86]

    Examples
    --------
    >>> from simc_core import Loop, Plant, SeriesPid, bandwidth
    >>> found = bandwidth(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)))
    >>> round(found.omega_bS, 4), round(found.omega_bT, 4)
    (0.3554, 1.1243)
    """
    judged = margins(loop)
    if not judged.stable:
        return NO_BANDWIDTH
    L, C = loop.L, loop.controller.factored
    marks = (judged.omega_c, judged.omega_180, judged.omega_Ms, judged.omega_Mt)
    omega = _grid(L, C, marks)
    response = L(1j * omega)
    at_S = _crossing(omega, np.abs(1 / (1 + response)), lambda x: float(abs(1 / (1 + L(1j * x)))), first=True)
    KS, omega_KS = _peak(omega, L, C, loop.plant.k if not loop.plant.integrators else math.inf)
    return Bandwidth(at_S, _last_of_T(omega, response, L), KS, omega_KS)


def _grid(L: Factored, C: Factored, marks: tuple[float, ...]) -> np.ndarray:
    """The grid of figures, on to where |L| is small, with every turn of the dead time."""
    omega = omega_grid([L, C], marks)
    end = float(omega[-1])
    if L.relative_degree > 0:
        for _ in range(DOUBLINGS):
            if abs(L(1j * end)) < SMALLEST_L / 2:
                break
            end *= 2
    parts = [omega, np.geomspace(omega[-1], end, 200)]
    if L.theta:
        steps = min(int(end * L.theta / PHASE_STEP), MOST_NODES)
        parts.append(PHASE_STEP / L.theta * np.arange(1, steps + 1))
    return np.unique(np.concatenate(parts))


def _crossing(omega: np.ndarray, size: np.ndarray, at: Callable[[float], float], first: bool) -> float:
    """Where a magnitude rises for the first time, or falls for the last time, through 1/sqrt 2; nan for never."""
    above = size > HALF_POWER
    places = np.flatnonzero(above[1:] & ~above[:-1] if first else ~above[1:] & above[:-1])
    if not places.size or (first and above[0]):
        return math.nan
    i = int(places[0 if first else -1])
    return float(
        brentq(lambda x: at(x) - HALF_POWER, omega[i], omega[i + 1], xtol=PRECISION * omega[i], rtol=PRECISION)
    )


def _last_of_T(omega: np.ndarray, response: np.ndarray, L: Factored) -> float:
    if L.relative_degree == 0:
        ratio = abs(FactoredResponse(L).at_infinity[0])
        if ratio >= SMALLEST_L if L.theta else ratio / (1 + ratio) >= HALF_POWER:
            return math.inf
    size = np.abs(response / (1 + response))
    return _crossing(omega, size, lambda x: float(abs(1 - 1 / (1 + L(1j * x)))), first=False)


def _peak(omega: np.ndarray, L: Factored, C: Factored, at_rest: float) -> tuple[float, float]:
    """Largest |KS| and where. at_rest: G(0), math.inf for an integrating plant."""

    def size(x: np.ndarray) -> np.ndarray:
        return np.abs(C(1j * x) / (1 + L(1j * x)))

    if C.relative_degree < 0:
        return math.inf, math.inf
    values = size(omega)
    i = int(values.argmax())
    best = float(values[i]), float(omega[i])
    if 0 < i < len(omega) - 1:
        found = minimize_scalar(
            lambda x: -float(size(x)),
            bounds=(omega[i - 1], omega[i + 1]),
            method="bounded",
            options={"xatol": 1e-9 * omega[i]},
        )
        best = max(best, (-float(found.fun), float(found.x)))
    if C.relative_degree == 0:
        best = max(best, (_at_infinity(L, C), math.inf))
    integral = any(abs(pole) == 0 for pole in C.poles)
    return max(best, (1 / abs(at_rest), 0.0)) if integral and math.isfinite(at_rest) else best


def _at_infinity(L: Factored, C: Factored) -> float:
    """The supremum of |KS| beyond all corners."""
    gain, loop = abs(FactoredResponse(C).at_infinity[0]), abs(FactoredResponse(L).at_infinity[0])
    if L.relative_degree > 0:
        return gain
    return gain / (1 - loop) if L.theta else gain / (1 + loop)
