"""A plant under a relay, exactly: matrix exponentials between switchings, a root at each crossing.

The relay sees y(t) = z(t - theta). A crossing of z at s switches OP at s + theta: what comes is known that far.
"""

from collections import deque
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

from simc_core.algebra.state_space import chain
from simc_core.errors import NotStable
from simc_core.identification.estimator.held_input import Array
from simc_core.plants.plant import Plant
from simc_core.wording import said

STEPS = 600  # of the grid on which crossings are bracketed, in a period
MOST_STEPS = 60_000
MOST_SWITCHINGS = 120
SAME = 1e-9  # relative difference of two periods that are one


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """z before the dead time at the instants t, with the switchings: OP is level[j] from at[j] on."""

    t: Array
    z: Array
    at: Array
    level: Array


class _Relay:
    """State [x; u] of the plant without its dead time, u held."""

    def __init__(self, plant: Plant, unit: float):
        A, B, C, D = chain(plant.factored, unit)
        n = len(B)
        self.motion = np.zeros((n + 1, n + 1))
        self.motion[:n, :n], self.motion[:n, n] = A, B
        self.row = np.concatenate([C, [D]])
        self.unit = unit
        self.grid = unit / STEPS
        self.whole = expm(self.motion * (self.grid / unit))

    def moved(self, state: Array, time: float) -> Array:
        """The state `time` later."""
        return expm(self.motion * (time / self.unit)) @ state


def course(plant: Plant, levels: tuple[float, float], hysteresis: float, period: float) -> Course:
    """From rest, with OP first at levels[0], until two periods are equal.

    Parameters
    ----------
    plant : Plant
    levels : (float, float)
        OP while z is below -hysteresis, and while it is above +hysteresis, of a plant that rises with levels[0].
    hysteresis : float
    period : float
        About the period that comes; it sets the grid.

    Raises
    ------
    NotStable
        No lasting oscillation.
    """
    relay = _Relay(plant, period)
    state = np.zeros(len(relay.row))
    state[-1] = levels[0]
    t, asked = 0.0, 0  # asked: which level the relay has asked for last
    times, values = [0.0], [float(relay.row @ state)]
    at, level = [0.0], [levels[0]]
    begun = 0.0 if plant.theta or hysteresis else period / 4  # without either, the relay would chatter at rest
    coming: deque[tuple[float, float]] = deque()
    for _ in range(MOST_STEPS):
        step = min(relay.grid, coming[0][0] - t) if coming else relay.grid
        after = relay.whole @ state if step == relay.grid else relay.moved(state, step)
        sign = 1.0 if asked == 0 else -1.0
        margin = sign * float(relay.row @ after) - hysteresis
        if margin > 0 and t >= begun:
            before = sign * float(relay.row @ state) - hysteresis
            inside = _crossing(relay, state, sign, hysteresis, step) if before < 0 else 0.0
            asked = 1 - asked
            coming.append((t + inside + plant.theta, levels[asked]))
            step = min(step, max(coming[0][0] - t, 0.0))
            after = relay.moved(state, step)
        state, t = after, t + step
        times.append(t)
        values.append(float(relay.row @ state))
        if coming and t >= coming[0][0] - 1e-12 * period:
            instant, to = coming.popleft()
            at.append(instant)
            level.append(to)
            state[-1] = to
            if _repeats(at) or len(at) > MOST_SWITCHINGS:
                break
    if len(at) < 6:
        raise NotStable(
            said("The relay does not keep this plant oscillating: take a larger amplitude or a smaller hysteresis")
        )
    return Course(np.array(times), np.array(values), np.array(at), np.array(level))


def _crossing(relay: _Relay, state: Array, sign: float, hysteresis: float, step: float) -> float:
    def over(time: float) -> float:
        return sign * float(relay.row @ relay.moved(state, time)) - hysteresis

    return float(brentq(over, 0.0, step, xtol=1e-15 * relay.unit + 1e-300, rtol=1e-14))


def _repeats(at: list[float]) -> bool:
    if len(at) < 8:
        return False
    last, before = at[-1] - at[-3], at[-3] - at[-5]
    half, other = at[-1] - at[-2], at[-3] - at[-4]
    return abs(last - before) < SAME * last and abs(half - other) < SAME * last
