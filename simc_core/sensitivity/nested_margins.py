"""Stability and margins of nested loops (nested.py), everything exact.

The verdict comes from the certificate on 1 + A_1 + ... + A_N. Margins of a loop mean something only where it is
stable AND every loop inside it is: else the outer controller holds up an inner loop that falls over as soon as
the outer one saturates or is switched to manual. Such a cascade has the verdict of the whole and `inner` of the
loop inside.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from simc_core.certificate.verdict import Stability, Verdict, count_unstable, stability
from simc_core.loops.nested import CascadeLoop, NestedLoops
from simc_core.sensitivity.crossings import Crossings, search
from simc_core.sensitivity.log_response import Closed, FactoredResponse, Response, Series
from simc_core.sensitivity.margins import NOT_STABLE, Margins, crossings, margins, margins_of

RECENT = 64  # loops that are remembered
RESONANCE = 1.05  # a peak of |T| above this bends the response enough to deserve nodes of its own


@dataclass(frozen=True, slots=True)
class NestedStability:
    """As Stability, of all loops closed; inner: of the next loop inside on its own, None where there is none."""

    verdict: Verdict
    unstable_poles: int | float
    neutral: float
    inner: "Stability | NestedStability | None"

    @property
    def sound(self) -> bool:
        """Stable, and so is every loop inside: margins mean something."""
        inside = self.inner is None or (
            self.inner.sound if isinstance(self.inner, NestedStability) else self.inner.verdict == "stable"
        )
        return self.verdict == "stable" and inside


@stability.register
def _(loop: NestedLoops) -> NestedStability:
    return verdict(loop)


@lru_cache(maxsize=RECENT)  # margins, metrics and whoever shows the loop all ask for it
def verdict(loop: NestedLoops) -> NestedStability:
    """stability of these loops, remembered."""
    found = count_unstable(loop.terms)
    inner = verdict(loop.inside) if loop.inside else None
    return NestedStability(found.verdict, found.unstable_poles, found.neutral, inner)


@stability.register
def _(loop: CascadeLoop) -> NestedStability:
    return stability(loop.nested)


@margins.register
def _(loop: NestedLoops) -> Margins:
    return margins_of(response(loop)) if stability(loop).sound else NOT_STABLE


@margins.register
def _(loop: CascadeLoop) -> Margins:
    return margins(loop.nested)


@crossings.register
def _(loop: NestedLoops) -> Crossings:
    return search(response(loop))


def response(loop: NestedLoops) -> Response:
    """L of the outermost loop, the others closed, as the search for margins sees it."""
    own = FactoredResponse(loop.own)
    return own if loop.inside is None else Series(own, closed(loop.inside))


@lru_cache(maxsize=RECENT)  # many outer loops are tried round one inner loop
def closed(loop: NestedLoops) -> Closed:
    """T of these loops, remembered."""
    inner = response(loop)
    return Closed(inner, _resonances(inner))


def _resonances(inner: Response) -> np.ndarray:
    """Rough places of the lightly damped closed-loop poles, from the peaks of |T|: one of height h has zeta = 1/2h."""
    found = search(inner)
    high = found.T_peak > RESONANCE
    omega, zeta = found.T_omega[high], 0.5 / found.T_peak[high]
    return omega * (-zeta + 1j * np.sqrt(1 - zeta**2))


def Ms_of(loop: NestedLoops) -> float:
    """Peak of |S| of the outermost loop, whether it is stable or not: for those who look for a given Ms."""
    found = margins_of(response(loop)).Ms
    return found if math.isfinite(found) else math.inf
