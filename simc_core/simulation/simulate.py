"""Time responses of a loop: unit steps put together to a scenario, or, with limits, noise or sampling, step by step."""

from functools import lru_cache
from typing import overload

import numpy as np

from simc_core.certificate.verdict import stability
from simc_core.loops.loop import Loop
from simc_core.loops.nested import CascadeLoop, NestedLoops, not_a_loop
from simc_core.simulation.actuator.actuation import Inputs, Stepped
from simc_core.simulation.actuator.continuous import actuated
from simc_core.simulation.collocation.pieces import Pieces
from simc_core.simulation.horizon import times
from simc_core.simulation.one_delay.march import march
from simc_core.simulation.one_delay.unit_responses import UnitResponses
from simc_core.simulation.scenario import Scenario, TimeResponse
from simc_core.simulation.simulate_nested import NestedResponse, simulate_nested
from simc_core.simulation.superposition import doubled, superposed


@overload
def simulate(loop: Loop, scenario: Scenario | None = None) -> TimeResponse: ...
@overload
def simulate(loop: CascadeLoop | NestedLoops, scenario: Scenario | None = None) -> NestedResponse: ...
def simulate(loop: Loop | CascadeLoop | NestedLoops, scenario: Scenario | None = None) -> TimeResponse | NestedResponse:
    """y and u for a scenario, from rest, with the dead time exact. Unstable loops are simulated as well.

    Parameters
    ----------
    loop : Loop, CascadeLoop or NestedLoops
        The loop.
    scenario : Scenario, optional
        Steps, horizon and actuator. None: `Scenario()`, unit steps of set point and load.

    Returns
    -------
    TimeResponse or NestedResponse
        Arrays of shape (n,); times in the user's unit.

    Raises
    ------
    InvalidParameter
        The loop is ill-posed, or cannot be simulated within the bounds of time and memory.
    WrongType
        `loop` is no loop.

    Examples
    --------
    Nothing happens before the dead time 1; then y rises as (Kc/8) (t - 1) = (t - 1)/2:

    >>> from simc_core import Loop, Plant, Scenario, SeriesPid, simulate
    >>> found = simulate(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)), Scenario(disturbance=0, t=[0.5, 1.5]))
    >>> [abs(round(y, 9)) for y in found.y.tolist()]
    [0.0, 0.25]
    """
    scenario = scenario or Scenario()
    match loop:
        case Loop():
            return _single(loop, scenario)
        case NestedLoops():
            return simulate_nested(loop, scenario)
        case CascadeLoop():
            return simulate_nested(loop.nested, scenario)
        case _:
            raise not_a_loop(loop)


def _single(loop: Loop, scenario: Scenario) -> TimeResponse:
    begins, t_end = times(loop, scenario)
    ramps = scenario.setpoint_ramp, scenario.disturbance_ramp
    if not scenario.actuation.linear:
        inputs = Inputs(scenario.setpoint, scenario.disturbance, begins, t_end, *ramps)
        return on_grid(actuated(loop, scenario.actuation, inputs), inputs, scenario.points, scenario.t)
    heights, starts = (scenario.setpoint, scenario.disturbance), (0.0, begins)
    t, (r, d), (y, u) = superposed(unit_steps(loop, t_end), heights, starts, t_end, scenario, ramps)
    return TimeResponse(t, r, d, y, u)


@lru_cache(maxsize=32)  # one design is simulated and measured, and both begin here
def settled(loop: Loop) -> UnitResponses:
    """Unit step responses of a stable loop, to their rest."""
    return march(loop.plant, [loop.controller.to_parallel()], None)


def unit_steps(loop: Loop, t_end: float) -> Pieces:
    """y and u for unit steps of r and of d at t = 0, from rest: values [y, u] x [r, d] to t_end, or to their rest.

    Raises InvalidParameter as march does.
    """
    if stability(loop).verdict == "stable":
        course = settled(loop)
        if course.at_rest[0] or course.begin[-1] + course.length[-1] > t_end:
            return course.pieces(0)
    return march(loop.plant, [loop.controller.to_parallel()], t_end).pieces(0)


def on_grid(course: Stepped, inputs: Inputs, points: int, t: np.ndarray | None = None) -> TimeResponse:
    """A course of steps at the instants t; None: at `points` instants, both limits at its jumps."""
    begins = inputs.disturbance_time
    if t is None:
        jumps = np.unique(np.concatenate([[0.0, begins], course.jumps()]))
        t, left = doubled(np.linspace(0.0, inputs.t_end, points), jumps[jumps <= inputs.t_end].tolist())
    else:
        left = np.zeros(len(t), dtype=bool)
    y, u = course.at(t)
    r, d = inputs.r(t), inputs.d(t)
    y[left], u[left] = course.before(t[left])
    r[left] *= t[left] > 0
    d[left] *= t[left] > begins
    return TimeResponse(t, r, d, y, u)
