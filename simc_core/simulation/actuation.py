"""What stands between controller and plant, and what a loop with it is simulated on.

Modules saturation (continuous controllers) and sampling (sampled ones) step the controller; the plant over a block of
steps no longer than its dead time is one matrix product (module blocks), since its input is known: class Driven.
"""

import math
from dataclasses import dataclass

import numpy as np

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.loop import Loop
from simc_core.simulation.blocks import Blocks, Linear

STEPS = 5000  # at least; more where theta or h is short against the horizon
MOST_STEPS = 50_000  # about 0.7 s where theta is so short that every step is one of Python
LONGEST_BLOCK = 80  # steps: beyond it the Toeplitz matrix costs more than it saves
SAME = 1e-9  # relative; instants closer than this to the grid are on it
MOST_JUMPS = 1000  # of a course that are shown as jumps
LARGEST = 1e200  # an unstable response is cut off here


@dataclass(frozen=True, slots=True)
class Actuation:
    """What is not linear, or not known in advance, between controller and plant.

    u_min <= u <= u_max, infinite where there is no limit; u = 0, the state of rest, must be within.
    tracking_time: T_t, None for the default, math.inf for no anti-windup; shorter than a step of the controller it
    acts like that step.   noise: standard deviation of the measurement noise, a new value each step of the controller.
    seed: of the noise.   h: sampling period of the controller, 0 if continuous.
    """

    u_min: float = -math.inf
    u_max: float = math.inf
    tracking_time: float | None = None
    noise: float = 0.0
    seed: int = 0
    h: float = 0.0

    def __post_init__(self):
        put = object.__setattr__
        for name, none in (("u_min", -math.inf), ("u_max", math.inf)):
            value = getattr(self, name)
            bound = none if value == none else checks.real(name, value, -checks.LARGEST_GAIN, checks.LARGEST_GAIN)
            put(self, name, float(bound))
        if not self.u_min <= 0 <= self.u_max or self.u_min == self.u_max:
            raise InvalidParameter(
                "u_min <= 0 <= u_max and u_min < u_max must hold, since the loop starts from rest at u = 0, "
                f"got {self.u_min:g} and {self.u_max:g}"
            )
        if self.tracking_time is not None and self.tracking_time != math.inf:
            put(self, "tracking_time", checks.positive_time("tracking_time", self.tracking_time))
        put(self, "noise", checks.real("noise", self.noise, 0.0, checks.LARGEST_GAIN))
        put(self, "seed", checks.whole("seed", self.seed, 0, 2**32 - 1))
        put(self, "h", checks.optional_time("h", self.h))

    @property
    def limited(self) -> bool:
        """Whether u has a limit on either side."""
        return self.u_min > -math.inf or self.u_max < math.inf

    @property
    def linear(self) -> bool:
        """Whether the exact engine of linear loops does the same."""
        return not self.limited and self.noise == 0 and self.h == 0


@dataclass(frozen=True, slots=True)
class Inputs:
    """Heights of the steps of r at 0 and of d at disturbance_time; the horizon."""

    setpoint: float
    disturbance: float
    disturbance_time: float
    t_end: float


@dataclass(frozen=True, slots=True, eq=False)
class Stepped:
    """Values at the start and the end of each step, (N, 2); t: starts of the steps and the end, (N + 1,).

    v: what the controller asks for, u: what the actuator does.   h: length of a step of the controller.
    """

    t: np.ndarray
    y: np.ndarray
    v: np.ndarray
    u: np.ndarray
    h: float

    def at(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """y, u at the instants t, linear within a step, right-hand limits at its ends, the last values after them."""
        return self._within(np.searchsorted(self.t, t * (1 + SAME), side="right") - 1, t)

    def before(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As at(t), left-hand limits; at rest before t = 0."""
        step = np.searchsorted(self.t, t * (1 - SAME), side="left") - 1
        return tuple(np.where(step < 0, 0.0, values) for values in self._within(step, t))

    def _within(self, step: np.ndarray, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        step = np.clip(step, 0, len(self.t) - 2)
        part = np.clip((t - self.t[step]) / (self.t[step + 1] - self.t[step]), 0.0, 1.0)
        return tuple(each[step, 0] + part * (each[step, 1] - each[step, 0]) for each in (self.y, self.u))

    def jumps(self) -> np.ndarray:
        """Instants at which y or u jumps, the first one at t = 0; at most MOST_JUMPS, the largest."""
        size = np.zeros(len(self.y))
        for each in (self.y, self.u):
            jump = np.abs(each[:, 0] - np.concatenate([[0.0], each[:-1, 1]]))
            size = np.maximum(size, jump / np.max(np.abs(each), initial=1e-300))
        largest = np.argsort(-size, kind="stable")[:MOST_JUMPS]
        return np.sort(self.t[largest[size[largest] > SAME]])


def stepped(dt: float, y: np.ndarray, v: np.ndarray, u: np.ndarray, h: float) -> Stepped:
    """A course of steps of equal length dt, without those behind an overflow."""
    good = np.all(np.abs(y) < LARGEST, axis=1) & np.all(np.abs(v) < LARGEST, axis=1)
    N = len(y) if good.all() else max(int(np.argmin(good)), 1)
    return Stepped(dt * np.arange(N + 1), y[:N], v[:N], u[:N], h)


def tracking_time(loop: Loop, actuation: Actuation) -> float:
    """T_t: as given, else sqrt(tau_I tau_D), or tau_I without derivative; for pure I action 1/|K_I k|."""
    if actuation.tracking_time is not None:
        return actuation.tracking_time
    form = loop.controller.to_parallel()
    if form.Ki == 0:
        return math.inf
    if form.Kd * form.Ki > 0:
        return math.sqrt(form.Kd / form.Ki)
    return abs(form.Kp / form.Ki) if form.Kp else 1 / abs(form.Ki * loop.plant.k)


def arrival(system: Linear, dt: float, theta: float, inputs: Inputs) -> tuple[int, np.ndarray | None, int]:
    """When d reaches the plant: in which step, what it adds to the state at the end of it, the first whole step.

    None where d comes just with a step, which is then the first whole one.
    """
    arrives = (inputs.disturbance_time + theta) / dt
    first = round(arrives) if abs(arrives - round(arrives)) < SAME * arrives else math.floor(arrives)
    rest = max(first + 1 - arrives, 0.0) * dt  # of step `first`, d acts on this last part
    if rest >= dt * (1 - SAME):
        return first, None, first
    return first, system.hold(rest)[1] * inputs.disturbance, first + 1


class Driven:
    """The plant on its way through time: its state, and the disturbance that adds to the delayed u."""

    def __init__(self, system: Linear, steps: Blocks, dt: float, theta: float, inputs: Inputs):
        self.system, self.steps = system, steps
        self.d, self.x = inputs.disturbance, np.zeros(len(system.B))
        self.first, self.kick, self.whole = arrival(system, dt, theta, inputs)

    def end_of_block(self, now: int, wanted: int) -> int:
        """`wanted`, or earlier, where d begins to act or the longest block ends."""
        until = min(wanted, now + self.steps.most)
        return min((edge for edge in (self.first, self.first + 1) if now < edge < until), default=until)

    def __call__(self, v: np.ndarray, now: int) -> np.ndarray:
        """Outputs (m, 2, o) of the steps from `now` under v (m, 2); the state moves on."""
        o, self.x = self.steps(self.x, v + self.d if now >= self.whole else v)
        if now == self.first and self.kick is not None:
            self.x = self.x + self.kick
            o[-1, 1] += self.system.C @ self.kick + self.system.D * self.d
        return o


def affordable(steps: float, why: str) -> int:
    """Whole steps that go beyond `steps`, so that a jump at the end is seen. Raises InvalidParameter: MOST_STEPS."""
    if steps > MOST_STEPS:
        raise InvalidParameter(f"t_end must be <= {MOST_STEPS} steps for {why}, got {steps:.3g}")
    return math.floor(steps * (1 + SAME)) + 1
