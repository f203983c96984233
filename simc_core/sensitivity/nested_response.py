"""L of nested loops (loops/nested.py) on the imaginary axis, as the search for margins sees it."""

import math
from functools import lru_cache

import numpy as np

from simc_core.loops.nested import NestedLoops
from simc_core.sensitivity.crossings import search
from simc_core.sensitivity.log_response import Closed, FactoredResponse, Response, Series
from simc_core.sensitivity.margins_of_response import margins_of

RECENT = 64  # loops that are remembered
RESONANCE = 1.05  # a peak of |T| above this bends the response enough to deserve nodes of its own


def nested_response(loop: NestedLoops) -> Response:
    """L of the outermost loop, the others closed."""
    own = FactoredResponse(loop.own)
    return own if loop.inside is None else Series(own, closed(loop.inside))


@lru_cache(maxsize=RECENT)  # many outer loops are tried round one inner loop
def closed(loop: NestedLoops) -> Closed:
    """T of these loops, remembered."""
    inner = nested_response(loop)
    return Closed(inner, _resonances(inner))


def _resonances(inner: Response) -> np.ndarray:
    """Rough places of the lightly damped closed-loop poles, from the peaks of |T|: one of height h has zeta = 1/2h."""
    found = search(inner)
    high = found.T_peak > RESONANCE
    omega, zeta = found.T_omega[high], 0.5 / found.T_peak[high]
    return omega * (-zeta + 1j * np.sqrt(1 - zeta**2))


def Ms_of(loop: NestedLoops) -> float:
    """Peak of |S| of the outermost loop, whether it is stable or not: for those who look for a given Ms."""
    found = margins_of(nested_response(loop)).Ms
    return found if math.isfinite(found) else math.inf
