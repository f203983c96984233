"""The loop as it is built, with its actuator limits, noise and sampling, beside the linear one it was tuned as.

Curves are simulations and exist for every loop; numbers are given only where the linear loop is stable. The horizon is
that of the linear loop, doubled while the loop as built is still on its way: a limited actuator takes its time.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from simc_core.certificate.verdict import stability
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.simulation import Scenario, TimeResponse, simulate
from simc_core.simulation.actuator.actuation import (
    FEWEST_STEPS,
    SAME_INSTANT,
    Actuation,
    Inputs,
    Stepped,
    tracking_time_in_use,
)
from simc_core.simulation.actuator.continuous import actuated
from simc_core.simulation.horizon import times
from simc_core.simulation.simulate import on_grid
from simc_core.studies.limit_cycle import LimitCycle, limit_cycle

MOST_DOUBLINGS = 3
LONGER = 3.0  # times the time after the load, in which a swing of the actuator shows that it lasts
MANY_STEPS = 2 * FEWEST_STEPS  # a course of more has a step that does not grow with the horizon, and is not doubled
STILL = 0.02  # a response that moves less than this part of its range over the last fifth has come to rest
FINE = 4000  # instants for the integral of the linear |e|: trapezoids, good to 1e-5


@dataclass(frozen=True, slots=True)
class BuiltNumbers:
    """u_asked, u_given: smallest and largest value the controller asks for, and that the actuator gives.

    limited: time at a limit.   IAE, IAE_linear: over the horizon, without noise in r - y.   largest_move: of u between
    two samples after the first one, nan for a continuous controller.
    noise_y, noise_u: standard deviation over the horizon of what the noise adds to y and u; 0 without noise.
    cycle: that the actuator keeps up, without noise; None where there is none, or the actuator does what it is told.
    """

    u_asked: tuple[float, float]
    u_given: tuple[float, float]
    limited: float
    IAE: float
    IAE_linear: float
    largest_move: float
    noise_y: float
    noise_u: float
    cycle: LimitCycle | None


@dataclass(frozen=True, slots=True, eq=False)
class AsBuilt:
    """built, linear: with and without `actuation`.   unprotected: without anti-windup, None where u has no limits.

    T_t: the tracking time in use.   step: of the controller, h or that of the simulation, at which noise is drawn.
    numbers: None where the linear loop is not stable.
    """

    actuation: Actuation
    built: TimeResponse
    linear: TimeResponse
    unprotected: TimeResponse | None
    T_t: float
    step: float
    numbers: BuiltNumbers | None


def as_built(loop: Loop, scenario: Scenario) -> AsBuilt:
    """Simulate `scenario` as it is, without anti-windup, and as the linear loop. Raises InvalidParameter."""
    actuation = scenario.actuation
    quiet = replace(actuation, noise=0.0)
    stable = stability(loop).verdict == "stable"
    inputs, course = _long_enough(loop, scenario, quiet, stable)
    noisy = actuated(loop, actuation, inputs) if actuation.noise else course
    unprotected = None
    if actuation.limited:
        wound_up = actuated(loop, replace(actuation, tracking_time=math.inf), inputs)
        unprotected = on_grid(wound_up, inputs, scenario.points)
    linear = _linear(loop, inputs, scenario.points)
    return AsBuilt(
        actuation,
        on_grid(noisy, inputs, scenario.points),
        linear,
        unprotected,
        tracking_time_in_use(loop, actuation),
        course.h,
        _numbers(loop, inputs, course, noisy, actuation) if stable else None,
    )


def _long_enough(loop: Loop, scenario: Scenario, quiet: Actuation, stable: bool) -> tuple[Inputs, Stepped]:
    """The inputs with a horizon in which the loop comes to rest after each step, if it does; its course."""
    begins, t_end = times(loop, scenario)
    ramps = scenario.setpoint_ramp, scenario.disturbance_ramp
    inputs = Inputs(scenario.setpoint, scenario.disturbance, begins, t_end, *ramps)
    course = actuated(loop, quiet, inputs)
    if scenario.t_end is not None or scenario.disturbance_time is not None or not stable:
        return inputs, course
    for _ in range(MOST_DOUBLINGS):
        if _at_rest(course, inputs) or len(course.y) > MANY_STEPS:
            break
        inputs = replace(inputs, disturbance_time=2 * inputs.disturbance_time, t_end=2 * inputs.t_end)
        course = actuated(loop, quiet, inputs)
    return inputs, course


def _at_rest(course: Stepped, inputs: Inputs) -> bool:
    """Whether y has come to rest before the load step and at the end."""
    t, y = course.t[1:], course.y[:, 1]
    span = np.ptp(y) or 1.0
    ends = (inputs.disturbance_time, inputs.t_end)
    parts = [(t >= end - 0.2 * inputs.disturbance_time) & (t < end) for end in ends]
    return all(np.ptp(y[part]) <= STILL * span for part in parts if part.any())


def _linear(loop: Loop, inputs: Inputs, points: int) -> TimeResponse:
    scenario = Scenario(
        inputs.setpoint,
        inputs.disturbance,
        inputs.disturbance_time,
        inputs.t_end,
        points,
        setpoint_ramp=inputs.setpoint_ramp,
        disturbance_ramp=inputs.disturbance_ramp,
    )
    return simulate(loop, scenario)


def _numbers(loop: Loop, inputs: Inputs, course: Stepped, noisy: Stepped, actuation: Actuation) -> BuiltNumbers:
    linear = _linear(loop, inputs, FINE)
    time = np.minimum(np.diff(course.t), inputs.t_end - course.t[:-1])  # of each step within the horizon
    whole = time > SAME_INSTANT * inputs.t_end  # less than that is rounding, of a step that begins with the end
    time = time[whole]
    e = np.abs(np.stack([inputs.r(course.t[:-1]), inputs.r(course.t[1:])], axis=1) - course.y)[whole]
    beyond = np.abs(noisy.v - np.clip(noisy.v, actuation.u_min, actuation.u_max))[whole]
    held = beyond > SAME_INSTANT * np.max(np.abs(noisy.u))
    moves = np.abs(np.diff(noisy.u[whole, 0])) if actuation.h else np.array([math.nan])
    return BuiltNumbers(
        (float(noisy.v[whole].min()), float(noisy.v[whole].max())),
        (float(noisy.u[whole].min()), float(noisy.u[whole].max())),
        float(time @ held.mean(axis=1)),
        float(time @ e.mean(axis=1)),
        float(np.trapezoid(np.abs(linear.r - linear.y), linear.t)),
        float(moves.max(initial=0.0)),
        float(np.std((noisy.y - course.y)[whole, 1])),
        float(np.std((noisy.u - course.u)[whole, 1])),
        _cycle(loop, inputs, actuation) if actuation.mechanical else None,
    )


def _cycle(loop: Loop, inputs: Inputs, actuation: Actuation) -> LimitCycle | None:
    """The swing that is left when set point and load are long past."""
    begin = inputs.disturbance_time + inputs.disturbance_ramp
    longer = replace(inputs, t_end=inputs.t_end + LONGER * max(inputs.t_end - begin, 0.0))
    try:
        course = actuated(loop, replace(actuation, noise=0.0), longer)
    except InvalidParameter:  # too many steps
        return None
    return limit_cycle(course.t[:-1], course.y[:, 0], begin)
