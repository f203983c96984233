"""Step metrics over an infinite horizon, from the piecewise polynomials of the engine (metrics.py).

A response is followed until y and u stay within REST = 1e-10 of their largest value from where they end (pace.py).
What the slowest mode, e^{-sigma t}, still adds behind that instant T is added in closed form,

    IAE: |e(T)|/sigma    ITAE: |e(T)| (T/sigma + 1/sigma^2)

and where it counts but is not that mode alone, the integral is nan: not known to better than KNOWN. A loop that needs
more than march.MOST_TO_REST elements to come to rest is too close to its stability limit for that, and is told so.
"""

import math
from dataclasses import dataclass, replace
from functools import singledispatch

import numpy as np

from simc_core.certificate.poles import dominant_poles
from simc_core.certificate.verdict import stability
from simc_core.errors import NotStable
from simc_core.loops.loop import Loop
from simc_core.metrics.step_metrics import Steps, measures
from simc_core.simulation.collocation.pieces import ENDS
from simc_core.simulation.one_delay.unit_responses import Course
from simc_core.simulation.simulate import settled

OFFSET = 1e-7
KNOWN = 1e-6  # relative, of an integral
ROUNDING = 1e-12  # of the largest y, that a march leaves in y


@dataclass(frozen=True, slots=True)
class StepMetrics:
    """For a unit step. Times in the user's unit, from the step on.

    overshoot: of a set-point step, beyond 1 as a fraction; of a load step, beyond 0 on the other side as a fraction of
    the peak.   peak, peak_time: largest y of a set-point step, largest abs(y) of a load step (with its sign).
    rise_time: 10 % to 90 %, nan for a load step.   settling_time: within 2 % of the step, of the peak for a load step.
    """

    IAE: float
    ISE: float
    ITAE: float
    TV: float
    overshoot: float
    peak: float
    peak_time: float
    rise_time: float
    settling_time: float


@dataclass(frozen=True, slots=True)
class Performance:
    """Unit step of the set point, and of the disturbance at the plant input."""

    setpoint: StepMetrics
    disturbance: StepMetrics


@singledispatch
def performance(loop: Loop) -> Performance:
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

    Examples
    --------
    A load response that does not change its sign has IAE = tau_I/Kc [SK03]; here 8/4:

    >>> from simc_core import Loop, Plant, SeriesPid, performance
    >>> round(performance(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))).disturbance.IAE, 6)
    2.0
    """
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
    found = metrics_of(both_steps(course))
    return Performance(*(_with_tail(each, loop, course, i) for i, each in enumerate(found)))


def _with_tail(found: StepMetrics, loop: Loop, course: Course, source: int) -> StepMetrics:
    """With what the integrals still get after the end of the course. source: 0 for the set point, 1 for the load."""
    poles = dominant_poles(loop, most=1)
    if not poles:
        return found
    sigma, T = -poles[0].s.real, float(course.begin[-1] + course.length[-1])
    left, right = (course.coefficients[0, source, -1] @ ENDS.T - (1.0, 0.0)[source]).tolist()
    largest = max(abs(left), abs(right))
    decay = math.exp(max(-sigma * float(course.length[-1]), -700.0))
    # what is not that one mode: all of an oscillation, and by how much a real one misses its decay over the last piece
    strange = largest if poles[0].s.imag else abs(right - left * decay) / (1 - decay)
    unknown = min(strange, largest) + ROUNDING * abs(found.peak)
    tails = {"IAE": 1 / sigma, "ITAE": T / sigma + 1 / sigma**2}
    values = {}
    for name, factor in tails.items():
        whole = getattr(found, name) + abs(right) * factor
        values[name] = whole if unknown * factor <= KNOWN * whole else math.nan
    return replace(found, **values)


def both_steps(course: Course) -> Steps:
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


def metrics_of(steps: Steps) -> tuple[StepMetrics, ...]:
    """All metrics of each response."""
    found = measures(steps)
    columns = (getattr(found, name).tolist() for name in StepMetrics.__slots__)
    return tuple(StepMetrics(*row) for row in zip(*columns, strict=True))
