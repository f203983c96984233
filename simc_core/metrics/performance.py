"""Step metrics over an infinite horizon, from the piecewise polynomials of the engine (metrics.py).

A response is followed until y and u stay within REST = 1e-10 of their largest value from where they end
(one_delay/step_control.py). What the slowest mode, e^{-sigma t}, still adds behind that instant T is added in closed
form,

    IAE: |e(T)|/sigma    ITAE: |e(T)| (T/sigma + 1/sigma^2)

and where it counts but is not that mode alone, the integral is nan: not known to better than KNOWN. A loop that needs
more than limits.MOST_TO_REST elements to come to rest is too close to its stability limit for that, and is told so.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import overload

import numpy as np

from simc_core.certificate.characteristic import shifted
from simc_core.certificate.poles import dominant_poles
from simc_core.certificate.verdict import IN_WORDS, Stability, count_unstable_many, stability
from simc_core.errors import InvalidParameter, NotStable, SimcError
from simc_core.loops.loop import Loop
from simc_core.loops.nested import CascadeLoop, NestedLoops, not_a_loop
from simc_core.loops.on_demand import Later
from simc_core.metrics.nested_performance import NestedPerformance, nested_performance
from simc_core.metrics.step_metrics import both_steps, metrics_of
from simc_core.metrics.step_quality import Quality, known_of, quality_of
from simc_core.metrics.step_records import StepMetrics
from simc_core.simulation.collocation.pieces import ENDS
from simc_core.simulation.one_delay.march_plants import march_plants
from simc_core.simulation.one_delay.unit_responses import UnitResponses
from simc_core.simulation.simulate import settled
from simc_core.wording import said

LARGEST_OFFSET = 1e-7  # of the largest value: with more at rest the integrals diverge
INTEGRAL_PRECISION = 1e-6  # relative, of an integral
MARCH_ROUNDING = 1e-12  # of the largest y, that a march leaves in y
TARGETS = np.array([[1.0], [0.0]])  # where y ends after a step of r, and of d
TINY = 1e-300


@dataclass(frozen=True, slots=True)
class Performance:
    """What is measured on the steps of a single loop.

    Attributes
    ----------
    setpoint, disturbance : StepMetrics
        Unit step of the set point, and of the disturbance at the plant input.
    """

    setpoint: StepMetrics
    disturbance: StepMetrics


@overload
def performance(loop: Loop) -> Performance: ...
@overload
def performance(loop: CascadeLoop | NestedLoops) -> NestedPerformance: ...
def performance(loop: Loop | CascadeLoop | NestedLoops) -> Performance | NestedPerformance:
    """IAE, overshoot, settling time and the like, of unit steps of set point and load; the dead time is exact.

    Parameters
    ----------
    loop : Loop, CascadeLoop or NestedLoops
        Of nested loops, y is the outermost output.

    Returns
    -------
    Performance or NestedPerformance
        Times in the user's unit.

    Raises
    ------
    NotStable
        The loop is not stable, or an offset remains, so that the integrals diverge.
    WrongType
        `loop` is no loop.

    Examples
    --------
    A load response that does not change its sign has IAE = tau_I/Kc [SK03]; here 8/4:

    >>> from simc_core import Loop, Plant, SeriesPid, performance
    >>> round(performance(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))).disturbance.IAE, 6)
    2.0
    """
    match loop:
        case Loop():
            return _of_single(loop)
        case NestedLoops():
            return nested_performance(loop)
        case CascadeLoop():
            return nested_performance(loop.nested)
        case _:
            raise not_a_loop(loop)


def step_quality(loop: Loop) -> Quality:
    """ITSE, settling to 1 % and 5 %, first arrival, decay ratio and period, largest u; the dead time is exact.

    Parameters
    ----------
    loop : Loop
        A plant under feedback.

    Returns
    -------
    Quality
        Of unit steps of set point and load. `performance` has the same numbers.

    Raises
    ------
    NotStable
        As `performance` does.

    Examples
    --------
    Without dead time SIMC leaves 1 - e^{-t/tau_c}, which is within 5 % after tau_c ln 20:

    >>> from simc_core import Loop, Plant, SeriesPid, step_quality
    >>> found = step_quality(Loop(Plant(1, 0, (8,)), SeriesPid(4, 8)))
    >>> round(found.setpoint.settling_5, 4)
    5.9915
    """
    found = performance(loop)
    return Quality(found.setpoint.quality, found.disturbance.quality)


def performance_many(
    loops: Sequence[Loop], verdicts: Sequence[Stability] | None = None
) -> list[Performance | SimcError]:
    """Performance of many stable loops, each with its own plant, worked on together where their structure is the same.

    Parameters
    ----------
    loops : sequence of Loop, n of them
        Known to be stable.
    verdicts : sequence of Stability, n of them, optional
        What `stability_many` says of `loops`, where that is known: it saves work.

    Returns
    -------
    list of Performance or SimcError, n of them
        In the order of `loops`; the error that `performance` raises in the place of a loop that has none.
    """
    found: dict[int, Performance | SimcError] = {}
    decays = [0.0] * len(loops) if verdicts is None else [each.decay for each in verdicts]
    forms = [loop.controller.to_parallel() for loop in loops]
    for which, course in march_plants([loop.plant for loop in loops], forms):
        some, known = [loops[i] for i in which], [decays[i] for i in which]
        measured = [course] if isinstance(course, InvalidParameter) else _measured(some, course, known)
        found |= zip(which, measured, strict=True)
    return [found[i] for i in range(len(loops))]


def _of_single(loop: Loop) -> Performance:
    verdict = stability(loop)
    if verdict.verdict != "stable":
        raise NotStable(
            said(
                "step metrics exist for a stable loop only, found one that is {verdict}",
                verdict=IN_WORDS[verdict.verdict],
            )
        )
    (found,) = _measured([loop], settled(loop), [verdict.decay])
    if isinstance(found, SimcError):
        raise found
    return found


def _measured(loops: Sequence[Loop], course: UnitResponses, decays: Sequence[float]) -> list[Performance | SimcError]:
    """The metrics of loops whose responses, and decay as far as certified, are known, or why there are none."""
    n, found = len(loops), metrics_of(both_steps(course))
    refusals = _refusals(course)
    pairs = [(found[i], found[n + i]) for i in range(n)]
    tails = _tails(pairs, course)
    rates = [max(one.negligible_rate(), other.negligible_rate()) for one, other in tails]
    open_ = [i for i in range(n) if refusals[i] is None and decays[i] < rates[i]]
    none_is_slower = _no_mode_is_slower([loops[i] for i in open_], [rates[i] for i in open_]) if open_ else []
    to_add = {i for i, none_is in zip(open_, none_is_slower, strict=True) if not none_is}
    result: list[Performance | SimcError] = []
    for i, refusal in enumerate(refusals):
        if refusal is not None:
            result.append(refusal)
            continue
        poles = dominant_poles(loops[i], most=1) if i in to_add else ()
        steps = [tail.added(poles[0].s) for tail in tails[i]] if poles else list(pairs[i])
        Later(quality_of, loops[i], [known_of(step) for step in steps]).attach(steps)
        result.append(Performance(*steps))
    return result


OFFSET = (  # after a step of r, and of d
    said("IAE needs a loop that settles without offset, found {offset:.4g} after a set-point step", offset=0.0),
    said("IAE needs a loop that settles without offset, found {offset:.4g} after a load step", offset=0.0),
)


def _refusals(course: UnitResponses) -> list[NotStable | None]:
    """Of each loop, why the integrals diverge, or cannot be known."""
    right = np.add.reduce(course.coefficients[0], axis=-1)  # y at the end of each piece
    offsets = right[:, course.first[1:] - 1] - TARGETS
    largest = np.maximum.reduceat(np.abs(right), course.first[:-1], axis=1)
    remain = np.abs(offsets) > LARGEST_OFFSET * np.maximum(largest, TINY)
    reasons: list[NotStable | None] = [None] * len(course.at_rest)
    for source, i in np.argwhere(remain)[::-1].tolist():  # of two, that of the set point is told
        reasons[i] = NotStable(OFFSET[source].put(offset=-float(offsets[source, i])))
    for i, at_rest in enumerate(course.at_rest):
        if not at_rest:
            last = course.first[i + 1] - 1
            reasons[i] = NotStable(
                said(
                    "the loop must come to rest within {reached:.3g}, found one too close to its stability limit",
                    reached=float(course.begin[last] + course.length[last]),
                )
            )
    return reasons


def _no_mode_is_slower(loops: Sequence[Loop], rates: Sequence[float]) -> list[bool]:
    """Of each loop, whether all its closed-loop poles lie to the left of -rate, by the certificate."""
    terms = [[shifted(loop.L, -rate)] for loop, rate in zip(loops, rates, strict=True)]
    try:
        return [found.unstable_poles == 0 for found in count_unstable_many(terms)]
    except InvalidParameter:  # one of them is too wild to be counted
        if len(loops) == 1:
            return [False]
        return [_no_mode_is_slower([loop], [rate])[0] for loop, rate in zip(loops, rates, strict=True)]


def _tails(pairs: Sequence[tuple[StepMetrics, StepMetrics]], course: UnitResponses) -> list[list["_Tail"]]:
    """Of each loop, behind its step of the set point and of the load."""
    last = course.first[1:] - 1
    ends = course.coefficients[0][:, last] @ ENDS.T - TARGETS[..., None]  # (2, n, 2), of the last piece
    length, begin = course.length[last], course.begin[last]
    rows = zip(pairs, (begin + length).tolist(), length.tolist(), *ends.tolist(), strict=True)
    return [[_Tail(found, T, h, *at) for found, at in zip(pair, both, strict=True)] for pair, T, h, *both in rows]


@dataclass(frozen=True, slots=True)
class _Tail:
    """What the integrals of a step miss after the instant T, where its course ends.

    length: of the last piece.   left, right: y at its ends, less the target.
    """

    found: StepMetrics
    T: float
    length: float
    left: float
    right: float

    @property
    def rounding(self) -> float:
        """Of y."""
        return MARCH_ROUNDING * abs(self.found.peak)

    @property
    def largest(self) -> float:
        """What is left of the step."""
        return max(abs(self.left), abs(self.right))

    def negligible_rate(self) -> float:
        """A mode that decays at this rate, or faster, adds less than is known of any integral."""
        rest = (self.largest + self.rounding) / INTEGRAL_PRECISION
        if not rest:
            return 0.0
        slowest = (math.sqrt(self.T**2 + 4 * self.found.ITAE / rest) - self.T) / 2  # T x + x^2 = ITAE/rest
        return 1 / max(min(self.found.IAE / rest, slowest), TINY)

    def added(self, slowest: complex) -> StepMetrics:
        """The metrics with what a slowest mode adds; nan where what is left is not that mode alone and counts."""
        sigma, decay = -slowest.real, math.exp(max(slowest.real * self.length, -700.0))
        # all of an oscillation, and by how much a real mode misses its decay over the last piece
        strange = self.largest if slowest.imag else abs(self.right - self.left * decay) / (1 - decay)
        unknown = min(strange, self.largest) + self.rounding
        values = {}
        for name, factor in (("IAE", 1 / sigma), ("ITAE", self.T / sigma + 1 / sigma**2)):
            whole = getattr(self.found, name) + abs(self.right) * factor
            values[name] = whole if unknown * factor <= INTEGRAL_PRECISION * whole else math.nan
        return replace(self.found, **values)
