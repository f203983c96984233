"""Time responses of a loop: unit steps put together to a scenario."""

import math
from functools import lru_cache, singledispatch

import numpy as np

from simc_core.errors import SimcError
from simc_core.loop import Loop
from simc_core.poles import dominant_poles
from simc_core.simulation.course import Course
from simc_core.simulation.march import march
from simc_core.simulation.pieces import Pieces, clenshaw
from simc_core.simulation.saturation import Actuation, actuated
from simc_core.simulation.scenario import Scenario, TimeResponse
from simc_core.stability import stability

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
    actuation = Actuation(
        scenario.u_min, scenario.u_max, scenario.tracking_time, scenario.noise, scenario.seed, scenario.h
    )
    if not actuation.linear:
        t = np.linspace(0.0, t_end, scenario.points) if scenario.t is None else scenario.t
        course = actuated(loop, actuation, scenario.setpoint, scenario.disturbance, begins, max(t_end, float(t[-1])))
        y, u = course.at(t)
        return TimeResponse(t, np.full(len(t), scenario.setpoint), held(t, begins, scenario.disturbance), y, u)
    pieces = unit_steps(loop, t_end)
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


@lru_cache(maxsize=32)  # one design is simulated and measured, and both begin here
def settled(loop: Loop) -> Course:
    """Unit step responses of a stable loop, to their rest."""
    return march(loop.plant, [loop.controller.to_parallel()], None)


def unit_steps(loop: Loop, t_end: float) -> Pieces:
    """y and u for unit steps of r and of d at t = 0, from rest: values [y, u] x [r, d] to t_end, or to their rest.

    Raises InvalidParameter as march does.
    """
    if stability(loop).verdict == "stable":
        course = settled(loop)
        if course.at_rest[0] or course.begin[-1] + course.length[-1] >= t_end:
            return course.pieces(0)
    return march(loop.plant, [loop.controller.to_parallel()], t_end).pieces(0)


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
    jumps = np.unique(jumps[jumps <= t_end])[:MOST_JUMPS]
    both = np.concatenate([t[~np.isin(t, jumps)], jumps, jumps])
    order = np.argsort(both, kind="stable")
    grid = both[order]
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
