"""Is the loop stable? Certified, with exact dead time.

The closed-loop poles in the right half plane are counted by the argument principle (modules characteristic and
winding), which is exact for any number of dead times, integrators and unstable poles. Open-loop poles that the
controller cancels count as closed-loop poles, since a disturbance still excites them: cancelling an unstable
pole leaves the loop unstable.

Neutral loops. With derivative action that reaches through to the output at once, e.g. an unfiltered PID on a
first-order plant, |L| does not vanish at high frequency. Above |L(inf)| = 1 there are infinitely many unstable
poles; below it the count is finite, and `Stability.neutral` shows how near the loop is to that limit. With
several dead times |L(inf)| is the sum over the terms: stability for all ratios of the dead times (Hale and
Verduyn Lunel 1993, strong stability).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import singledispatch
from typing import Literal

from simc_core.characteristic import characteristic, shifted
from simc_core.errors import InvalidParameter
from simc_core.factors import Factored
from simc_core.loop import Loop
from simc_core.winding import winding

SAME = 1e-12  # relative: closer than this to |L(inf)| = 1 is on it
ASIDE = 1e-6  # relative shift of the contour past zeros on the axis
LOST = 1e8  # radians of theta omega; beyond them a zero "within rounding" may be rounding alone

Verdict = Literal["stable", "unstable", "marginal"]


@dataclass(frozen=True, slots=True)
class Stability:
    """verdict, and the number of closed-loop poles with positive real part (math.inf where they are countless).

    marginal: poles on the imaginary axis within rounding, none to the right of it.
    neutral: |L(inf)| of the part with dead time; 0 for the usual, retarded loop.
    """

    verdict: Verdict
    unstable_poles: int | float
    neutral: float = 0.0


@singledispatch
def stability(loop: Loop) -> Stability:
    """Verdict on a single loop. Raises InvalidParameter where it is ill-posed, L(inf) = -1 without dead time."""
    return count_unstable([loop.L])


def count_unstable(terms: Sequence[Factored]) -> Stability:
    """Verdict on 1 + sum of `terms` = 0, each with its own dead time.

    Factors of the denominators that are equal in several terms are the same block, as in the cascade
    1 + Lb + Lb Ca Ga: Lb's poles count once. Nothing is cancelled.
    Raises InvalidParameter: ill-posed loops, those that would cost more than winding.MOST_SEGMENTS, and dead times
    that turn the phase so far that doubles no longer hold it.
    """
    terms = [term for term in terms if term.gain]
    f = characteristic(terms)
    if f.delayed == 0 and abs(f.limit) <= SAME:
        raise InvalidParameter("1 + L(inf) must not be 0 in a loop without dead time, got 0: the loop is ill-posed")
    if abs(f.neutral - 1) <= SAME:
        return Stability("marginal", 0, f.neutral)
    if f.neutral > 1:
        return Stability("unstable", math.inf, f.neutral)
    found = winding(f)
    if found.zeros is None:
        return _beside(terms, found.touches, f.neutral)
    return Stability("unstable" if found.zeros else "stable", found.zeros, f.neutral)


def _beside(terms: Sequence[Factored], touches: float, neutral: float) -> Stability:
    """Verdict on a loop with zeros on the axis: those to the right of them are counted on a contour beside it."""
    theta = max(term.theta for term in terms)
    if theta * touches > LOST:
        raise InvalidParameter(
            f"theta must be <= {LOST / touches:.3g} for a loop with a pole near {touches:.3g} rad per unit of time, "
            f"got {theta:g}: its phase is lost in rounding"
        )
    sigma = ASIDE * (touches or _slowest(terms))
    zeros = winding(characteristic([shifted(term, sigma) for term in terms])).zeros
    return Stability("unstable", zeros, neutral) if zeros else Stability("marginal", 0, neutral)


def _slowest(terms: Sequence[Factored]) -> float:
    """Smallest corner frequency of the loop."""
    corners = [abs(root) for term in terms for root in (*term.poles, *term.zeros) if root]
    return min([*corners, *(1 / term.theta for term in terms if term.theta)], default=1.0)
