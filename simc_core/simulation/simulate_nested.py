"""Time responses of nested loops, exact, with all their dead times: unit steps put together to a scenario."""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.errors import InvalidParameter
from simc_core.loops.nested import NestedLoops
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.collocation.pieces import Pieces
from simc_core.simulation.horizon import round_up
from simc_core.simulation.scenario import Scenario
from simc_core.simulation.several_delays.stepper import steps_of
from simc_core.simulation.superposition import superposed
from simc_core.wording import said

SETTLED_PART = 0.01  # of the largest value; where a default horizon ends
FIRST_HORIZON = 2.0  # first horizon, in units of all times of the loops together
MOST_DOUBLINGS = 7
GROWN = 30.0  # an unstable response is shown until it is this large
SAMPLES = 24  # instants in a piece at which a horizon is judged


@dataclass(frozen=True, slots=True, eq=False)
class NestedResponse:
    """What nested loops do in time; of a cascade also y = y1, y2, its set point r2, d = d1, d2, and u, the input of Gb.

    Attributes
    ----------
    t, r : np.ndarray, shape (n,)
        Instants, in the user's time unit, and set point of the outermost loop.
    ds, ys, us : np.ndarray, shape (N, n)
        From the inside out: disturbances at the inputs of the blocks, their outputs, outputs of the controllers.
    """

    t: np.ndarray
    r: np.ndarray
    ds: np.ndarray
    ys: np.ndarray
    us: np.ndarray

    @property
    def y(self) -> np.ndarray:
        """Output of the outermost block."""
        return self.ys[-1]

    @property
    def y2(self) -> np.ndarray:
        """Output of the innermost block."""
        return self.ys[0]

    @property
    def r2(self) -> np.ndarray:
        """Output of the outermost controller: the set point of the next loop inside."""
        return self.us[-1]

    @property
    def u(self) -> np.ndarray:
        """Output of the innermost controller: what goes to the actuator."""
        return self.us[0]

    @property
    def d(self) -> np.ndarray:
        """Disturbance at the input of the outermost block."""
        return self.ds[-1]

    @property
    def d2(self) -> np.ndarray:
        """Disturbance at the input of the innermost block."""
        return self.ds[0]


def simulate_nested(loop: NestedLoops, scenario: Scenario) -> NestedResponse:
    """simulate of nested loops. Raises InvalidParameter."""
    if not scenario.actuation.linear:
        raise InvalidParameter(
            said(
                "actuation must be left out for nested loops, whose limits are in simulation/nested_windup.py, "
                "found {actuation}",
                actuation=scenario.actuation,
            )
        )
    if scenario.setpoint_ramp or scenario.disturbance_ramp:
        given = said(
            "{setpoint_ramp:g} and {disturbance_ramp:g}",
            setpoint_ramp=scenario.setpoint_ramp,
            disturbance_ramp=scenario.disturbance_ramp,
        )
        raise InvalidParameter(
            said("setpoint_ramp and disturbance_ramp must be 0 for nested loops, found {given}", given=given)
        )
    N = len(loop.blocks)
    heights = np.zeros(1 + N)
    heights[[0, 1, N]] = scenario.setpoint, scenario.disturbance2, scenario.disturbance  # of one loop there is one d
    starts, t_end = _times(loop, scenario, heights)
    pieces = steps_of(loop).run(t_end)
    t, inputs, outputs = superposed(pieces, heights.tolist(), starts.tolist(), t_end, scenario)
    return NestedResponse(t, inputs[0], inputs[1:], outputs[:N], outputs[N:])


def unit_steps(loop: NestedLoops, t: np.ndarray) -> np.ndarray:
    """y of the outermost block after unit steps at t = 0 of r, d_1 .. d_N, one at a time: (n, 1 + N)."""
    return steps_of(loop).run(float(t[-1]))(t)[:, len(loop.blocks) - 1]


def time_scale(loop: NestedLoops) -> float:
    """All times of blocks and controllers together."""
    total = 0.0
    for block, controller in zip(loop.blocks, loop.controllers, strict=True):
        total += block.total_time
        form = controller.to_parallel() if controller else None
        total += abs(form.Kp / form.Ki) if form and form.Ki else 0.0
    return total or 1.0


def _times(loop: NestedLoops, scenario: Scenario, heights: np.ndarray) -> tuple[np.ndarray, float]:
    """When r, d_1 .. d_N begin, and the end; inputs of height 0 take no time of their own."""
    order = [0, len(heights) - 1, 1] if len(heights) > 2 else [0, 1]  # r, then d1, then d2
    used = [i for i in order if heights[i]] or [0]
    if scenario.t is not None:
        end = float(scenario.t[-1]) or 1.0
        part = end / len(used)
    elif scenario.t_end is not None:
        end = scenario.t_end
        part = end / len(used)
    else:
        part, end = horizon(loop), 0.0
    starts = np.zeros(len(heights))
    for position, i in enumerate(used):
        starts[i] = position * part
    given = {len(heights) - 1: scenario.disturbance_time, 1: scenario.disturbance2_time}
    for i, time in given.items():
        starts[i] = starts[i] if time is None else time
    return starts, end or float(np.max(starts[used])) + part


def horizon(loop: NestedLoops) -> float:
    """A round time in which all unit steps settle to 1 %, or an unstable response has grown enough to be seen."""
    steps, t_end = steps_of(loop), FIRST_HORIZON * time_scale(loop)
    for _ in range(MOST_DOUBLINGS):
        t, values = _sampled(steps.run(t_end), t_end, len(loop.blocks))
        size = np.abs(values)
        if size.max() > GROWN * max(size[t < t[-1] / 4].max(), 1.0):
            return round_up(float(t[np.argmax(size.max(axis=(1, 2)) > GROWN)]))
        away = np.abs(values - values[-1]) > SETTLED_PART * size.max(axis=0)
        last = int(np.max(np.flatnonzero(away.any(axis=(1, 2))), initial=0))
        if t[last] < 0.7 * t[-1]:
            return round_up(float(t[last + 1]))
        t_end *= 2
    return round_up(t_end / 2)


def _sampled(pieces: Pieces, t_end: float, N: int) -> tuple[np.ndarray, np.ndarray]:
    """Instants up to about t_end, SAMPLES in each piece, and all y there, (n, N, inputs)."""
    count = max(int(np.searchsorted(pieces.edges, t_end)), 1)
    left, right = pieces.edges[:count], pieces.edges[1 : count + 1]
    places = np.linspace(-1.0, 1.0, SAMPLES)
    t = left[:, None] + (right - left)[:, None] * (places + 1) / 2
    values = np.tensordot(pieces.coefficients[:count, :, :N], chebyshev.chebvander(places, P - 1), (1, 1))
    return t.ravel(), np.moveaxis(values, -1, 1).reshape(-1, *values.shape[1:-1])
