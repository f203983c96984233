"""Step metrics over an infinite horizon, from the piecewise polynomials of the engine (metrics.py).

A response is followed until y and u stay within REST = 1e-10 of their largest value from where they end
(one_delay/step_control.py). Truncation error: what a decaying mode still adds behind that, REST times its time
constant. A loop that needs more than limits.MOST_TO_REST elements to come to rest is too close to its stability limit
for that, and is told so.
"""

from dataclasses import dataclass

import numpy as np

from simc_core.certificate.verdict import stability
from simc_core.errors import NotStable
from simc_core.loops.loop import Loop
from simc_core.loops.nested import CascadeLoop, NestedLoops, not_a_loop
from simc_core.metrics.nested_performance import NestedPerformance, nested_performance
from simc_core.metrics.step_metrics import StepMetrics, Steps, metrics_of
from simc_core.simulation.one_delay.unit_responses import UnitResponses
from simc_core.simulation.simulate import settled

OFFSET = 1e-7


@dataclass(frozen=True, slots=True)
class Performance:
    """Unit step of the set point, and of the disturbance at the plant input."""

    setpoint: StepMetrics
    disturbance: StepMetrics


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


def _of_single(loop: Loop) -> Performance:
    verdict = stability(loop)
    if verdict.verdict != "stable":
        raise NotStable(f"step metrics exist for a stable loop only, got one that is {verdict.verdict}")
    course = settled(loop)
    if not course.at_rest[0]:
        reached = course.begin[-1] + course.length[-1]
        raise NotStable(f"the loop must come to rest within {reached:.3g}, got one too close to its stability limit")
    right = np.add.reduce(course.coefficients[0], axis=-1)
    offsets, largest = right[:, -1] - (1.0, 0.0), np.maximum.reduce(np.abs(right), axis=1)
    for name, offset, size in zip(("set-point", "load"), offsets.tolist(), largest.tolist(), strict=True):
        if abs(offset) > OFFSET * max(size, 1e-300):
            raise NotStable(f"IAE needs a loop that settles without offset, got {-offset:.4g} after a {name} step")
    return Performance(*metrics_of(both_steps(course)))


def both_steps(course: UnitResponses) -> Steps:
    """Set-point steps of all tunings, then their load steps."""
    n, m = len(course.first) - 1, len(course.owner)
    return Steps(
        np.concatenate([course.owner, course.owner + n]),
        np.concatenate([course.begin, course.begin]),
        np.concatenate([course.length, course.length]),
        course.coefficients.reshape(2, 2 * m, -1),
        np.concatenate([course.first[:-1], course.first[:-1] + m]),
        np.array([1.0, 0.0]).repeat(n),
    )
