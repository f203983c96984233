"""Figures 4 and 5 of [RMS86]: peak of |T| and ISE of IMC-PI and IMC-PID over epsilon/theta, for any first-order plant.

With the controllers of Table II the loop depends on epsilon/theta alone. In units of theta, with beta = 1/2 for PID and
0 for PI,

    L = (1 + beta s) e^{-s}/((epsilon + beta) s),   a = 1/(epsilon + beta)

PID without filter makes the loop neutral, and y jumps. On the interval n <= t < n + 1 the error after a step of the set
point is a polynomial, with e_0 = 1 and

    e_n' = -a (e_{n-1} + beta e_{n-1}'),   e_n jumps at its start by -a beta times the jump before, the first being 1

so that the integral of e^2 is exact. The smallest ISE that any controller can have is theta.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from simc_core import checks
from simc_core.certificate.verdict import stability
from simc_core.controllers.forms import IdealPid
from simc_core.loops.loop import Loop
from simc_core.plants.plant import Plant
from simc_core.sensitivity.delay_bound import delay_bound
from simc_core.sensitivity.margins import margins

BETA = {"PI": 0.0, "PID": 0.5}
SETTLED, MOST_INTERVALS = 1e-15, 5000
NEGLIGIBLE_COEFFICIENT = 1e-18  # coefficients below are left out


@dataclass(frozen=True, slots=True)
class ImcPoint:
    """M: largest |T|.   J: ISE over the smallest possible one.   delay_margin, delay_bound: in units of theta.

    All nan where the loop is not stable.
    """

    M: float
    J: float
    delay_margin: float
    delay_bound: float


def imc_point(ratio: float, kind: str = "PID") -> ImcPoint:
    """What [RMS86] plot at epsilon/theta = ratio > 0, for "PI" or "PID"."""
    loop = imc_loop(ratio, kind)
    if stability(loop).verdict != "stable":
        return ImcPoint(*[math.nan] * 4)
    found = margins(loop)
    return ImcPoint(found.Mt, _squared_error(ratio, BETA[kind]), found.delay_margin, delay_bound(loop))


def imc_loop(ratio: float, kind: str) -> Loop:
    """L of the module docstring, as an integrator with dead time 1."""
    beta = BETA[checks.one_of("kind", kind, BETA)]
    ratio = checks.positive_time("epsilon/theta", ratio)
    return Loop(Plant(1.0, 1.0, integrators=1), IdealPid(1 / (ratio + beta), math.inf, beta))


def _squared_error(ratio: float, beta: float) -> float:
    """ISE in units of theta, by intervals; Legendre coefficients over x in [-1, 1], t = n + (x + 1)/2."""
    a = 1 / (ratio + beta)
    e, jump, total = np.ones(1), 1.0, 0.0
    for _ in range(MOST_INTERVALS):
        own = float(np.sum(e**2 / (2 * np.arange(len(e)) + 1)))
        total += own
        if own < SETTLED * total:
            break
        jump *= -a * beta
        start = float(e.sum()) + jump  # P_n(1) = 1
        change = -a * (legendre.legint(e, scl=0.5, lbnd=-1) + beta * np.pad(e - _at_start(e), (0, 1)))
        kept = np.where(np.abs(change) > NEGLIGIBLE_COEFFICIENT, change, 0.0)
        e = np.trim_zeros(kept, "b") if change.any() else np.zeros(1)
        e = np.pad(e, (0, max(1 - len(e), 0)))
        e[0] += start
    return total


def _at_start(e: np.ndarray) -> np.ndarray:
    """The value at x = -1 as a constant polynomial."""
    constant = np.zeros(len(e))
    constant[0] = float(np.sum(e * (-1.0) ** np.arange(len(e))))
    return constant
