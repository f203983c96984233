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

Nested loops. The verdict is on 1 + A_1 + ... + A_N (loops/nested.py). A loop whose inner loop is unstable on its own
may be stable as a whole: the outer controller then holds up an inner loop that falls over as soon as the outer one
saturates or is switched to manual. So `NestedStability.inner` is the verdict on the loop inside.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Literal, overload

from simc_core.algebra.factors import Factored, rows_of
from simc_core.certificate.characteristic import Characteristic, characteristic, shifted
from simc_core.certificate.winding import winding, windings
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.loops.nested import CascadeLoop, NestedLoops, not_a_loop
from simc_core.loops.well_posed import require_well_posed
from simc_core.wording import said

ON_NEUTRAL_LIMIT = 1e-12  # relative: closer than this to |L(inf)| = 1 is on it
ASIDE = 1e-6  # relative shift of the contour past zeros on the axis
DECAY = 0.03  # over the sum of all times of a loop: the rate that is certified where its poles allow it
NEUTRAL_TURNS, MOST_TURNS = 1e3, 1e6  # omega theta up to which a zero on the axis is taken for the only one near

Verdict = Literal["stable", "unstable", "marginal"]
IN_WORDS = {"stable": said("stable"), "unstable": said("unstable"), "marginal": said("marginal")}


@dataclass(frozen=True, slots=True)
class Stability:
    """A certified verdict on a loop.

    Attributes
    ----------
    verdict : {"stable", "unstable", "marginal"}
        marginal: poles on the imaginary axis within rounding, none to the right of it.
    unstable_poles : int, or math.inf where they are countless
        Number of closed-loop poles with positive real part.
    neutral : float
        abs(L(inf)) of the part with dead time; 0 for the usual, retarded loop.
    decay : float
        Every closed-loop pole is certain to lie left of -decay; 0 where no more is known than the verdict says.
    """

    verdict: Verdict
    unstable_poles: int | float
    neutral: float = 0.0
    decay: float = field(default=0.0, compare=False)


@dataclass(frozen=True, slots=True)
class NestedStability:
    """A certified verdict on nested loops, all of them closed.

    Attributes
    ----------
    verdict, unstable_poles, neutral : str, int or float, float
        As in Stability.
    inner : Stability, NestedStability or None
        Of the next loop inside on its own, None where there is none.
    """

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


@overload
def stability(loop: Loop) -> Stability: ...
@overload
def stability(loop: CascadeLoop | NestedLoops) -> NestedStability: ...
def stability(loop: Loop | CascadeLoop | NestedLoops) -> Stability | NestedStability:
    """Whether a loop is stable, by the argument principle, with its dead time exact.

    Parameters
    ----------
    loop : Loop, CascadeLoop or NestedLoops
        Of nested loops, all of them closed.

    Returns
    -------
    Stability or NestedStability
        The verdict, and the number of closed-loop poles in the right half plane.

    Raises
    ------
    InvalidParameter
        The loop is ill-posed: L(inf) = -1 without dead time.
    WrongType
        `loop` is no loop.

    Examples
    --------
    e^{-s}/s under a gain is stable up to pi/2:

    >>> from simc_core import Loop, Plant, SeriesPid, stability
    >>> [stability(Loop(Plant(1, 1, integrators=1), SeriesPid(Kc, float("inf")))).verdict for Kc in (1.57, 1.58)]
    ['stable', 'unstable']
    """
    match loop:
        case Loop():
            return remembered(loop)
        case NestedLoops():
            return remembered_nested(loop)
        case CascadeLoop():
            return remembered_nested(loop.nested)
        case _:
            raise not_a_loop(loop)


@lru_cache(maxsize=64)
def remembered(loop: Loop) -> Stability:
    """margins, performance and pages all ask for the same few loops."""
    return count_unstable([loop.L])


@lru_cache(maxsize=64)  # margins, metrics and whoever shows the loop all ask for it
def remembered_nested(loop: NestedLoops) -> NestedStability:
    """Verdict on all loops closed, and on those inside."""
    found = count_unstable(loop.terms)
    inner = remembered_nested(loop.inside) if loop.inside else None
    return NestedStability(found.verdict, found.unstable_poles, found.neutral, inner)


def stability_many(loops: Sequence[Loop]) -> list[Stability]:
    """Verdicts on single loops, worked on together: cheapest where all have the same plant and form of controller.

    Parameters
    ----------
    loops : sequence of Loop, n of them
        The loops.

    Returns
    -------
    list of Stability, n of them
        In the order of `loops`.

    Raises
    ------
    InvalidParameter
        Where `stability` does for one of them.

    Examples
    --------
    >>> from simc_core import Loop, Plant, SeriesPid, stability_many
    >>> loops = [Loop(Plant(1, 1, integrators=1), SeriesPid(Kc, float("inf"))) for Kc in (1.57, 1.58)]
    >>> [each.verdict for each in stability_many(loops)]
    ['stable', 'unstable']
    """
    return count_unstable_many([[loop.L] for loop in loops])


def count_unstable(terms: Sequence[Factored]) -> Stability:
    """Verdict on 1 + sum of `terms` = 0, each term with its own dead time.

    Factors of the denominators that are equal in several terms are the same block, as in the cascade
    1 + Lb + Lb Ca Ga: the poles of Lb count once. Nothing is cancelled.

    Parameters
    ----------
    terms : sequence of Factored
        What is fed back.

    Returns
    -------
    Stability
        The verdict, and the number of poles in the right half plane.

    Raises
    ------
    InvalidParameter
        The loop is ill-posed, or would cost more than winding.MOST_SEGMENTS.

    Examples
    --------
    A gain in series with e^{-s}/s: above pi/2 one pair of poles has crossed the axis.

    >>> from simc_core import Loop, Plant, SeriesPid, count_unstable
    >>> count_unstable([Loop(Plant(1, 1, integrators=1), SeriesPid(1.58, float("inf"))).L]).unstable_poles
    2
    """
    return count_unstable_many([terms])[0]


def count_unstable_many(loops: Sequence[Sequence[Factored]]) -> list[Stability]:
    """count_unstable of each, worked on together. Raises InvalidParameter where it does for one of them."""
    loops = [[term for term in terms if term.gain] for terms in loops]
    functions = {i: characteristic(terms) for i, terms in enumerate(loops) if not _vanishes_at_infinity(terms)}
    found = {i: verdict for i, f in functions.items() if (verdict := _at_infinity(f))}
    for i, decay in _decays({i: terms for i, terms in enumerate(loops) if i not in found}).items():
        found[i] = Stability("stable", 0, functions[i].neutral if i in functions else 0.0, decay)
    functions |= {i: characteristic(terms) for i, terms in enumerate(loops) if i not in found and i not in functions}
    open_ = [i for i in functions if i not in found]
    for i, turns in zip(open_, windings([functions[i] for i in open_]), strict=True):
        neutral = functions[i].neutral
        if turns.zeros is None:
            assert turns.touches is not None  # that is why there is no number
            found[i] = _beside(loops[i], turns.touches, neutral)
        else:
            found[i] = Stability("unstable" if turns.zeros else "stable", turns.zeros, neutral)
    return [found[i] for i in range(len(loops))]


def _vanishes_at_infinity(terms: Sequence[Factored]) -> bool:
    """Whether each term has more poles than zeros: |L(inf)| = 0 decides nothing then."""
    return all(term.relative_degree > 0 for term in terms)


def _decays(loops: dict[int, Sequence[Factored]]) -> dict[int, float]:
    """DECAY/(sum of all times) of the loops that have no pole to the right of minus that.

    These are stable: counted beside the axis they need not be counted on it, two answers for the work of one.
    """
    rates = {i: DECAY / total for i, terms in loops.items() if (total := _total_time(terms))}
    moved = {i: characteristic([shifted(term, -rate) for term in loops[i]]) for i, rate in rates.items()}
    moved = {i: f for i, f in moved.items() if f.neutral < 1 - ON_NEUTRAL_LIMIT}
    try:
        counts = windings(list(moved.values()))
    except InvalidParameter:  # one of them is too wild to be counted there
        return {}
    return {i: rates[i] for i, turns in zip(moved, counts, strict=True) if turns.zeros == 0}


def _total_time(terms: Sequence[Factored]) -> float:
    """Dead times, lags and leads of a loop, summed."""
    rows = [row for term in terms for row in (*rows_of(term.num), *rows_of(term.den))]
    times = [abs(b / c) + math.sqrt(abs(a / c)) for a, b, c in rows if c]
    return sum(times) + sum([term.theta for term in terms])


def _at_infinity(f: Characteristic) -> Stability | None:
    """The verdict where |L(inf)| decides on it. Raises InvalidParameter for ill-posed loops."""
    neutral = f.neutral
    if f.delayed == 0:
        require_well_posed(f.limit)
    if abs(neutral - 1) <= ON_NEUTRAL_LIMIT:
        return Stability("marginal", 0, neutral)
    return Stability("unstable", math.inf, neutral) if neutral > 1 else None


def _beside(terms: Sequence[Factored], touches: float, neutral: float) -> Stability:
    """Verdict on a loop with zeros on the axis: those to the right of them are counted on a contour beside it.

    Raises InvalidParameter where the dead time turns so often up to there that zeros crowd about the axis.
    """
    turns = touches * max((term.theta for term in terms), default=0.0)
    sigma = ASIDE * (touches or _slowest(terms))
    most = NEUTRAL_TURNS if neutral else MOST_TURNS
    found = winding(characteristic([shifted(term, sigma) for term in terms])) if turns <= most else None
    if found is None or found.zeros is None:
        raise InvalidParameter(
            said(
                "omega theta of poles on the imaginary axis must be <= {most:g}, found {turns:g} (|L(inf)| = "
                "{neutral:.12g}): the poles beside them cannot be told from these in double precision",
                most=most,
                turns=turns,
                neutral=neutral,
            )
        )
    return Stability("unstable", found.zeros, neutral) if found.zeros else Stability("marginal", 0, neutral)


def _slowest(terms: Sequence[Factored]) -> float:
    """Smallest corner frequency of the loop."""
    corners = [abs(root) for term in terms for root in (*term.poles, *term.zeros) if root]
    return min([*corners, *(1 / term.theta for term in terms if term.theta)], default=1.0)
