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
from simc_core.loops.frequency_response import open_loop
from simc_core.loops.loop import Loop
from simc_core.loops.nested import NestedLoops
from simc_core.sensitivity.log_response import Closed, Ends, FactoredResponse, Response, Series

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


def bandwidth_of(loop: Loop | NestedLoops, marks: tuple[float, ...]) -> tuple[Bandwidth]:
    """Of a loop known to be stable. marks: frequencies of its margins."""
    reach = _reach(loop)
    omega = _grid(reach, marks)
    response = reach.L(omega)
    at_S = _crossing(omega, np.abs(1 / (1 + response)), lambda x: float(abs(1 / (1 + reach.at(x)))), first=True)
    return (Bandwidth(at_S, _last_of_T(omega, response, reach), *_peak(omega, reach)),)


@dataclass(frozen=True, slots=True, eq=False)
class _Reach:
    """L on the imaginary axis, its ends, the factors whose corners count, and the controller that sees y."""

    L: Callable[[np.ndarray], np.ndarray]
    ends: Ends
    factors: list[Factored]
    C: Factored

    def at(self, omega: float) -> complex:
        """L there."""
        return complex(self.L(np.array([omega]))[0])


def _reach(loop: Loop | NestedLoops) -> _Reach:
    if isinstance(loop, Loop):
        L, C = loop.L, loop.controller.factored
        return _Reach(lambda omega: L(1j * omega), FactoredResponse(L), [L, C], C)
    C = loop.outermost.factored
    return _Reach(lambda omega: open_loop(loop, 1j * omega), _ends(loop), [*loop.terms, C], C)


def _ends(loop: NestedLoops) -> Response:
    own = FactoredResponse(loop.own)
    return own if loop.inside is None else Series(own, Closed(_ends(loop.inside), np.zeros(0)))


def _grid(reach: _Reach, marks: tuple[float, ...]) -> np.ndarray:
    """The grid of figures, on to where |L| is small, with every turn of the dead time."""
    omega, theta = omega_grid(reach.factors, marks), reach.ends.theta
    end = float(omega[-1])
    if reach.ends.at_infinity.power < 0:
        for _ in range(DOUBLINGS):
            if abs(reach.at(end)) < SMALLEST_L / 2:
                break
            end *= 2
    parts = [omega, np.geomspace(omega[-1], end, 200)]
    if theta:
        steps = min(int(end * theta / PHASE_STEP), MOST_NODES)
        parts.append(PHASE_STEP / theta * np.arange(1, steps + 1))
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


def _last_of_T(omega: np.ndarray, response: np.ndarray, reach: _Reach) -> float:
    gain, power = reach.ends.at_infinity
    if power == 0 and (abs(gain) >= SMALLEST_L if reach.ends.theta else abs(gain / (1 + gain)) >= HALF_POWER):
        return math.inf
    size = np.abs(response / (1 + response))
    return _crossing(omega, size, lambda x: float(abs(1 - 1 / (1 + reach.at(x)))), first=False)


def _peak(omega: np.ndarray, reach: _Reach) -> tuple[float, float]:
    """Largest |KS| and where."""

    def size(x: np.ndarray) -> np.ndarray:
        return np.abs(reach.C(1j * x) / (1 + reach.L(x)))

    if reach.C.relative_degree < 0:
        return math.inf, math.inf
    values = size(omega)
    i = int(values.argmax())
    best = float(values[i]), float(omega[i])
    if 0 < i < len(omega) - 1:
        found = minimize_scalar(
            lambda x: -float(size(np.array([x]))[0]),
            bounds=(omega[i - 1], omega[i + 1]),
            method="bounded",
            options={"xatol": 1e-9 * omega[i]},
        )
        best = max(best, (-float(found.fun), float(found.x)))
    return max(best, (_at_infinity(reach), math.inf), (_at_rest(reach), 0.0))


def _at_infinity(reach: _Reach) -> float:
    """The supremum of |KS| beyond all corners."""
    if reach.C.relative_degree > 0:
        return 0.0
    gain, (loop, power) = abs(FactoredResponse(reach.C).at_infinity.gain), reach.ends.at_infinity
    if power < 0:
        return gain
    return gain / (1 - abs(loop)) if reach.ends.theta else gain / abs(1 + loop)


def _at_rest(reach: _Reach) -> float:
    """|KS| at omega = 0 where the controller integrates: the gain of the plant, inverted, or nothing."""
    (gain, power), (loop, of_loop) = FactoredResponse(reach.C).at_zero, reach.ends.at_zero
    return abs(gain / loop) if power < 0 and power == of_loop else 0.0
