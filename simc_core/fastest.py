"""The fastest design whose loop is stable and has a given peak Ms.

Ms as a function of the speed tau (tau_c or lambda) may reach the value asked for several times, at unstable loops too.
All crossings on a grid of speeds are found with |S| on a grid of frequencies; from the smallest tau on each is polished
with the exact peak, and the first that belongs to a stable loop is it.
"""

import math
from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

from simc_core.cascade import Ms_of
from simc_core.errors import InvalidParameter
from simc_core.nested import NestedLoops, closed_inside
from simc_core.stability import count_unstable

FASTEST, SLOWEST, SPEEDS = 1e-2, 1e2, 65  # in units of the scale
OMEGAS = 240
PRECISION = 1e-10  # of log tau
TRIED = 12  # loops of small Ms that are tried for an answer in the error message


def fastest(at: Callable[[float], NestedLoops], Ms: float, scale: float, name: str, Ms_name: str) -> float:
    """The smallest tau with `at(tau)` stable and Ms its peak; at(tau) may differ in the outermost controller only.

    Raises InvalidParameter where there is none; the message tells the smallest Ms of a stable loop.
    """
    taus = scale * np.geomspace(FASTEST, SLOWEST, SPEEDS)
    loops = [at(tau) for tau in taus.tolist()]
    peaks = _peaks(loops, scale)
    below = peaks <= Ms
    for i in np.flatnonzero(below[1:] != below[:-1]):
        found = _polished(at, Ms, float(taus[i]), float(taus[i + 1]))
        if found is not None and count_unstable(at(found).terms).verdict == "stable":
            return found
    raise InvalidParameter(f"{Ms_name} = {Ms:g} cannot be met: {_instead(loops, taus, peaks, name)}")


def _peaks(loops: list[NestedLoops], scale: float) -> np.ndarray:
    """Largest |S| of each loop on one grid of frequencies, shape (len(loops),)."""
    theta = loops[0].terms[-1].theta
    high = max(30 / theta if theta else 0.0, 1e3 / scale)
    s = 1j * np.geomspace(1e-3 / scale, high, OMEGAS)
    block = NestedLoops(loops[0].blocks, loops[0].controllers)
    own = math.prod([each.factored(s) for each in _outermost(block)], start=closed_inside(block, s))
    C = np.array([loop.controllers[-1].factored(s) for loop in loops])
    with np.errstate(divide="ignore"):
        return np.max(1 / np.abs(1 + own * C), axis=1)


def _outermost(loop: NestedLoops) -> tuple:
    """Blocks between the outermost controller and the loop inside."""
    return loop.blocks[len(loop.inside.blocks) if loop.inside else 0 :]


def _polished(at, Ms: float, low: float, high: float) -> float | None:
    """Where the exact peak is Ms; None where the grid saw a crossing that is none."""

    def excess(x: float) -> float:
        return math.log(min(Ms_of(at(math.exp(x))), 1e6) / Ms)

    ends = math.log(low), math.log(high)
    if excess(ends[0]) * excess(ends[1]) > 0:
        return None
    return math.exp(brentq(excess, *ends, xtol=PRECISION))


def _instead(loops: list[NestedLoops], taus: np.ndarray, peaks: np.ndarray, name: str) -> str:
    for i in np.argsort(peaks, kind="stable")[:TRIED]:
        if count_unstable(loops[i].terms).verdict == "stable":
            return (
                f"the smallest peak of a stable loop is about {peaks[i]:.3g}, at {name} = {taus[i]:.4g}; "
                "ask for a larger one"
            )
    return f"no {name} between {taus[0]:.4g} and {taus[-1]:.4g} gives a stable loop with it; ask for a larger one"
