"""The fastest design whose loop is stable and has a given peak Ms.

Ms as a function of the speed tau (tau_c or lambda) may reach the value asked for several times, at unstable loops too.
All crossings on a grid of speeds are found with |S| on a grid of frequencies; from the smallest tau on each is polished
with the largest |S| round the grid's peak, and the first that belongs to a stable loop is it. The exact peak has the
last word: where a second one is as high, the search goes by it.
"""

import math
from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

from simc_core.certificate.verdict import count_unstable
from simc_core.errors import InvalidParameter
from simc_core.loops.frequency_response import closed_inside
from simc_core.loops.nested import NestedLoops
from simc_core.sensitivity.nested_response import Ms_of
from simc_core.wording import Text, said

FASTEST, SLOWEST, SPEEDS = 1e-2, 1e2, 65  # in units of the scale
OMEGAS = 240
ZOOM, ZOOMS = 33, 3  # frequencies between the neighbours of a peak, and how often: omega to 1e-5, |S| to 1e-10
LOG_TAU_PRECISION = 1e-10  # of log tau
EQUAL_PEAKS = 1e-8  # of the peaks
HIGHEST = 1e6  # peaks beyond are as good as infinite
TRIED = 12  # loops of small Ms that are tried for an answer in the error message

At = Callable[[float], NestedLoops]


def smallest_speed_with_peak(at: At, Ms: float, scale: float, name: str, Ms_name: str) -> float:
    """The smallest tau with `at(tau)` stable and Ms its peak; at(tau) may differ in the outermost controller only.

    Raises InvalidParameter where there is none; the message tells the smallest Ms of a stable loop.
    """
    taus = scale * np.geomspace(FASTEST, SLOWEST, SPEEDS)
    loops = [at(tau) for tau in taus.tolist()]
    search = _Peaks(loops[0], scale)
    peaks = search.on_grid(loops)
    below = peaks <= Ms
    for i in np.flatnonzero(below[1:] != below[:-1]):
        found = _polished(at, Ms, float(taus[i]), float(taus[i + 1]), search)
        if found is not None and _stable(at(found)):
            return found
    raise InvalidParameter(
        said(
            "{Ms_name} = {Ms:g} cannot be met: {instead}",
            Ms_name=Ms_name,
            Ms=Ms,
            instead=_instead(loops, taus, peaks, name),
        )
    )


class _Peaks:
    """Largest |S| of loops that differ in the outermost controller only; the rest is computed once on a grid."""

    def __init__(self, loop: NestedLoops, scale: float):
        self.loop = loop
        theta = loop.terms[-1].theta
        self.omega = np.geomspace(1e-3 / scale, max(30 / theta if theta else 0.0, 1e3 / scale), OMEGAS)
        self.rest = self._rest(self.omega)

    def on_grid(self, loops: list[NestedLoops]) -> np.ndarray:
        """Of each loop, (len(loops),)."""
        return np.max(np.array([self._S(loop, self.omega, self.rest) for loop in loops]), axis=1)

    def refined(self, loop: NestedLoops) -> float:
        """The highest peak on the grid, looked at closely."""
        omega, S = self.omega, self._S(loop, self.omega, self.rest)
        for _ in range(ZOOMS):
            i = int(np.argmax(S))
            omega = np.linspace(omega[max(i - 1, 0)], omega[min(i + 1, len(omega) - 1)], ZOOM)
            S = self._S(loop, omega, self._rest(omega))
        return min(float(np.max(S)), HIGHEST)

    def _S(self, loop: NestedLoops, omega: np.ndarray, rest: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore"):
            return 1 / np.abs(1 + rest * loop.outermost.factored(1j * omega))

    def _rest(self, omega: np.ndarray) -> np.ndarray:
        """Blocks between the outermost controller and the loop inside, and that loop closed."""
        s = 1j * omega
        own = self.loop.blocks[len(self.loop.inside.blocks) if self.loop.inside else 0 :]
        return math.prod([each.factored(s) for each in own], start=closed_inside(self.loop, s))


def _polished(at: At, Ms: float, low: float, high: float, search: _Peaks) -> float | None:
    """Where the peak is Ms; None where the grid saw a crossing that is none."""
    found = _root(at, Ms, low, high, search.refined)
    if found is not None and abs(Ms_of(at(found)) / Ms - 1) < EQUAL_PEAKS:
        return found
    return _root(at, Ms, low, high, lambda loop: min(Ms_of(loop), HIGHEST))


def _root(at: At, Ms: float, low: float, high: float, peak: Callable[[NestedLoops], float]) -> float | None:
    def excess(x: float) -> float:
        return math.log(peak(at(math.exp(x))) / Ms)

    ends = math.log(low), math.log(high)
    if excess(ends[0]) * excess(ends[1]) > 0:
        return None
    return math.exp(brentq(excess, *ends, xtol=LOG_TAU_PRECISION))


def _stable(loop: NestedLoops) -> bool:
    with np.errstate(over="ignore", invalid="ignore"):  # gains without bounds belong to speeds nobody wants
        return count_unstable(loop.terms).verdict == "stable"


def _instead(loops: list[NestedLoops], taus: np.ndarray, peaks: np.ndarray, name: str) -> Text:
    for i in np.argsort(peaks, kind="stable")[:TRIED]:
        if _stable(loops[i]):
            return said(
                "the smallest peak of a stable loop is about {peak:.3g}, at {name} = {tau:.4g}; ask for a larger one",
                peak=float(peaks[i]),
                name=name,
                tau=float(taus[i]),
            )
    return said(
        "no {name} between {fastest:.4g} and {slowest:.4g} gives a stable loop with it; ask for a larger one",
        name=name,
        fastest=float(taus[0]),
        slowest=float(taus[-1]),
    )
