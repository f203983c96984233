"""Time responses of a loop: unit steps put together to a scenario."""

import math
from functools import singledispatch

import numpy as np

from simc_core.errors import SimcError
from simc_core.loop import Loop
from simc_core.poles import dominant_poles
from simc_core.simulation.actuation import Course, Inputs
from simc_core.simulation.pieces import Pieces, clenshaw
from simc_core.simulation.saturation import actuated
from simc_core.simulation.scenario import Scenario, TimeResponse
from simc_core.simulation.steps import unit_steps
from simc_core.simulation.system import closed_loop

SETTLED = 4.6  # time constants of the slowest mode, e^{-4.6} = 1 %
GROWN = 6.0  # time constants of an unstable mode that are shown
LONGEST = 1e5  # default horizon, in units of all times of plant and controller together
JUMP = 1e-9  # of the largest value; smaller steps between pieces are rounding
MOST_JUMPS = 400
NICE = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)


@singledispatch
def simulate(loop: Loop, scenario: Scenario | None = None) -> TimeResponse:
    """y and u for the scenario, exact dead time, from rest. Unstable loops are simulated as well.

    Raises InvalidParameter: see system.closed_loop and steps.unit_steps.
    """
    scenario = scenario or Scenario()
    begins, t_end = times(loop, scenario)
    if not scenario.actuation.linear:
        return _as_built(loop, scenario, begins, t_end)
    pieces = unit_steps(closed_loop(loop), t_end)
    heights = np.array([scenario.setpoint, scenario.disturbance])
    starts = np.array([0.0, begins])
    t, left = (scenario.t, None) if scenario.t is not None else grid(pieces, heights, starts, t_end, scenario.points)
    outputs = sum(heights[i] * pieces(t - starts[i])[:, :, i] for i in range(2))
    r, d = held(t, 0.0, scenario.setpoint), held(t, begins, scenario.disturbance)
    if left is not None:
        outputs[left] = sum(heights[i] * left_limits(pieces, t[left] - starts[i])[:, :, i] for i in range(2))
        r[left[t[left] == 0.0]] = 0.0
        d[left[t[left] == begins]] = 0.0
    return TimeResponse(t, r, d, outputs[:, 0], outputs[:, 1])


def _as_built(loop: Loop, scenario: Scenario, begins: float, t_end: float) -> TimeResponse:
    """With actuator limits, noise or sampling: the course of the steps, at the instants of the scenario."""
    inputs = Inputs(scenario.setpoint, scenario.disturbance, begins, t_end)
    return on_grid(actuated(loop, scenario.actuation, inputs), inputs, scenario.points, scenario.t)


def on_grid(course: Course, inputs: Inputs, points: int, t: np.ndarray | None = None) -> TimeResponse:
    """A course at the instants t; None: at `points` instants, both limits at its jumps."""
    begins, left = inputs.disturbance_time, []
    if t is None:
        jumps = np.unique(np.concatenate([[0.0, begins], course.jumps()]))
        t, left = doubled(np.linspace(0.0, inputs.t_end, points), jumps[jumps <= inputs.t_end])
    y, u = course.at(t)
    r, d = held(t, 0.0, inputs.setpoint), held(t, begins, inputs.disturbance)
    y[left], u[left] = course.before(t[left])
    r[left] *= t[left] > 0
    d[left] *= t[left] > begins
    return TimeResponse(t, r, d, y, u)


def times(loop: Loop, scenario: Scenario) -> tuple[float, float]:
    """disturbance_time and t_end, chosen where the scenario leaves them open."""
    if scenario.t is not None:
        t_end = float(scenario.t[-1]) or 1.0
        begins = scenario.disturbance_time
        return (t_end / 2 if begins is None else begins), t_end
    if scenario.t_end is not None:
        begins = scenario.t_end / 2 if scenario.disturbance_time is None else scenario.disturbance_time
        return begins, scenario.t_end
    part = settling_horizon(loop)
    begins = part if scenario.disturbance_time is None else scenario.disturbance_time
    return begins, begins + part


def settling_horizon(loop: Loop) -> float:
    """A round time in which the slowest closed-loop mode settles to 1 %; of an unstable loop, shows what grows."""
    scale = loop.plant.theta + sum(map(abs, loop.plant.lags)) + sum(tau for tau, _ in loop.plant.lag_pairs)
    form = loop.controller.to_parallel()
    scale += abs(form.Kp / form.Ki) if form.Ki else 0.0
    scale = scale or 1.0
    try:
        rates = np.array([pole.s.real for pole in dominant_poles(loop)])
    except SimcError:
        rates = np.zeros(0)
    growing, falling = rates[rates > 0], -rates[rates < 0]
    if len(growing):
        time = GROWN / float(np.max(growing))
    elif len(falling):
        time = SETTLED / float(np.min(falling)) + loop.plant.theta
    else:
        time = 10 * scale
    return round_up(min(max(time, 3 * loop.plant.theta, scale * 1e-6), LONGEST * scale))


def round_up(time: float) -> float:
    """The next round number."""
    power = 10.0 ** math.floor(math.log10(time))
    return next(nice * power for nice in NICE if nice * power >= time * (1 - 1e-9))


def held(t: np.ndarray, begins: float, height: float) -> np.ndarray:
    """A step of `height` at t = begins."""
    return np.where(t >= begins, height, 0.0)


def grid(pieces: Pieces, heights, starts, t_end: float, points: int) -> tuple[np.ndarray, np.ndarray]:
    """Instants with jumps twice, and the indices of those that mean the left limit."""
    t = np.linspace(0.0, t_end, points)
    jumps = np.concatenate([starts, *(jump_times(pieces, i) + starts[i] for i in range(len(heights)) if heights[i])])
    return doubled(t, np.unique(jumps[jumps <= t_end])[:MOST_JUMPS])


def doubled(t: np.ndarray, jumps: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """t with each of `jumps` in it twice, and the indices of the first of the two."""
    grid = np.sort(np.concatenate([t[~np.isin(t, jumps)], jumps, jumps]))
    return grid, np.flatnonzero(np.append(grid[1:] == grid[:-1], False))


def jump_times(pieces: Pieces, column: int) -> np.ndarray:
    """Where y or u of this input jumps, t = 0 included."""
    left, right = pieces.ends()
    size = np.abs(left[:, :, column])
    size[1:] = np.abs(left[1:, :, column] - right[:-1, :, column])
    scale = np.max(np.abs(right[:, :, column]), axis=0) + 1e-300
    return pieces.edges[:-1][np.any(size > JUMP * scale, axis=1)]


def left_limits(pieces: Pieces, t: np.ndarray) -> np.ndarray:
    """As pieces(t), left limits at edges."""
    at = np.searchsorted(pieces.edges, t * (1 - 1e-12), side="left") - 1
    values = np.zeros((len(t), *pieces.coefficients.shape[2:]))
    inside = (at >= 0) & (t > 0)
    piece = np.clip(at[inside], 0, len(pieces.coefficients) - 1)
    x = 2 * (t[inside] - pieces.edges[piece]) / (pieces.edges[piece + 1] - pieces.edges[piece]) - 1
    values[inside] = clenshaw(pieces.coefficients[piece], np.clip(x, -1.0, 1.0))
    return values
