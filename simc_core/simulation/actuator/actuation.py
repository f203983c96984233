"""What stands between controller and plant, and how a loop with it is stepped.

Between the limits such a loop is linear. What is known at the start of step j is a row

    z_j = (x, controller, u asked for | u of the step before, set point and noise | w1, w2, d, arriving d)

w1, w2: u that reaches the plant in this step, behind the dead time.   d: the disturbance that reaches it for the whole
step; arriving: for its last part.   One matrix W makes of z_j what stands before the first bar in z_{j+1}. What is left
to do in each step is u = min(max(asked, u_min), u_max), written into z_{j+1}, and as w a dead time later. Without dead
time w comes too late for W: x then lacks what u of the step before adds to it, and W puts it in.

The plant's part of W is made here (Driven), that of the controller in modules saturation (continuous) and sampling.
Each quantity is a row there, of the coefficients by which it is made of z_j, so the laws stand as one knows them.
"""

import math
from dataclasses import dataclass
from typing import cast

import numpy as np

from simc_core import checks
from simc_core.controllers.discrete import known_law, scans
from simc_core.controllers.tracking import tracking_time
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.simulation.actuator.one_step import Linear, Step
from simc_core.simulation.rise import mean_risen, risen
from simc_core.wording import said

FEWEST_STEPS = 5000  # at least; more where theta or h is short against the horizon
MOST_STEPS = 50_000  # less than 0.1 s
SAME_INSTANT = 1e-9  # relative; instants closer than this to the grid are on it
MOST_JUMPS = 1000  # of a course that are shown as jumps
CUT_OFF = 1e200  # an unstable response is cut off here
W1, W2, LOAD, ARRIVING = OF_PLANT = range(-4, 0)  # the last columns of z


@dataclass(frozen=True, slots=True)
class Actuation:
    """What is not linear, or not known in advance, between controller and plant.

    Parameters
    ----------
    u_min, u_max : float
        Limits of u, infinite where there is none; u = 0, the state of rest, must be within.
    tracking_time : float or None
        T_t of the anti-windup, in the user's time unit. None: sqrt(tau_I tau_D), or tau_I without derivative action;
        math.inf: no anti-windup. Shorter than a step of the controller it acts like that step.
    noise : float
        Standard deviation of the measurement noise, in output units; a new value each step of the controller.
    seed : int
        Of the noise.
    h : float
        Sampling period of the controller, in the user's time unit; 0 if continuous.
    law : {"backward", "tustin"}
        Of a sampled controller, see controllers/discrete.py.
    delay_scans : int
        Sampling periods after which its output is written: 0, or 1 in a box that writes at its next scan.
    resolution, dead_band, backlash : float
        Of the actuator, in units of u, 0 for none; see mechanism.py.
    rate_limit : float
        The largest |du/dt|, infinite for none.

    Raises
    ------
    InvalidParameter
        A number is out of its bounds.

    Examples
    --------
    A valve that opens by 1.2 at most:

    >>> from simc_core import Actuation, Loop, Plant, Scenario, SeriesPid, simulate
    >>> found = simulate(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)), Scenario(actuation=Actuation(u_max=1.2)))
    >>> float(found.u.max())
    1.2
    """

    u_min: float = -math.inf
    u_max: float = math.inf
    tracking_time: float | None = None
    noise: float = 0.0
    seed: int = 0
    h: float = 0.0
    law: str = "backward"
    delay_scans: int = 0
    resolution: float = 0.0
    dead_band: float = 0.0
    backlash: float = 0.0
    rate_limit: float = math.inf

    def __post_init__(self) -> None:
        put = object.__setattr__
        for name, none in (("u_min", -math.inf), ("u_max", math.inf)):
            value = getattr(self, name)
            bound = none if value == none else checks.real(name, value, -checks.LARGEST_GAIN, checks.LARGEST_GAIN)
            put(self, name, float(bound))
        rest_within(self.u_min, self.u_max)
        if self.tracking_time is not None and self.tracking_time != math.inf:
            put(self, "tracking_time", checks.positive_time("tracking_time", self.tracking_time))
        put(self, "noise", checks.real("noise", self.noise, 0.0, checks.LARGEST_GAIN))
        put(self, "seed", checks.whole("seed", self.seed, 0, 2**32 - 1))
        put(self, "h", checks.optional_time("h", self.h))
        known_law(self.law)
        put(self, "delay_scans", scans("delay_scans", self.delay_scans))
        for name in ("resolution", "dead_band", "backlash"):
            put(self, name, checks.real(name, getattr(self, name), 0.0, checks.LARGEST_GAIN))
        if self.rate_limit != math.inf:
            put(self, "rate_limit", checks.positive("rate_limit", self.rate_limit))

    @property
    def limited(self) -> bool:
        """Whether u has a limit on either side."""
        return self.u_min > -math.inf or self.u_max < math.inf

    @property
    def mechanical(self) -> bool:
        """Whether the actuator does something else than it is told, within its limits."""
        return bool(self.resolution or self.dead_band or self.backlash) or self.rate_limit < math.inf

    @property
    def linear(self) -> bool:
        """Whether the exact engine of linear loops does the same."""
        return not self.limited and not self.mechanical and self.noise == 0 and self.h == 0


def rest_within(u_min: float, u_max: float) -> None:
    """Raises InvalidParameter unless u = 0, where the loop is at rest, is within the limits, and something else too."""
    if u_min > 0:
        raise InvalidParameter(
            said("{name} must be <= 0, where the loop is at rest, found {found:g}", name="u_min", found=u_min)
        )
    if u_max < 0:
        raise InvalidParameter(
            said("{name} must be >= 0, where the loop is at rest, found {found:g}", name="u_max", found=u_max)
        )
    if u_min == u_max:
        raise InvalidParameter(
            said("{name} must be > u_min = {u_min:g}, found {found:g}", name="u_max", u_min=u_min, found=u_max)
        )


@dataclass(frozen=True, slots=True)
class Inputs:
    """Heights of r from 0 and of d from disturbance_time on; the horizon; times in which the heights are reached."""

    setpoint: float
    disturbance: float
    disturbance_time: float
    t_end: float
    setpoint_ramp: float = 0.0
    disturbance_ramp: float = 0.0

    def r(self, t: np.ndarray) -> np.ndarray:
        """The set point, right-hand limits."""
        return self.setpoint * risen(t, self.setpoint_ramp)

    def d(self, t: np.ndarray) -> np.ndarray:
        """The disturbance, right-hand limits."""
        return self.disturbance * risen(t - self.disturbance_time, self.disturbance_ramp)


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
        return self._within(np.searchsorted(self.t, t * (1 + SAME_INSTANT), side="right") - 1, t)

    def before(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As at(t), left-hand limits; at rest before t = 0."""
        step = np.searchsorted(self.t, t * (1 - SAME_INSTANT), side="left") - 1
        y, u = self._within(step, t)
        return np.where(step < 0, 0.0, y), np.where(step < 0, 0.0, u)

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
        return np.sort(self.t[largest[size[largest] > SAME_INSTANT]])


def stepped(dt: float, y: np.ndarray, v: np.ndarray, u: np.ndarray, h: float) -> Stepped:
    """A course of steps of equal length dt, without those behind an overflow."""
    good = np.all((np.abs(y) < CUT_OFF) & (np.abs(v) < CUT_OFF), axis=1)
    N = len(y) if good.all() else max(int(np.argmin(good)), 1)
    return Stepped(dt * np.arange(N + 1), y[:N], v[:N], u[:N], h)


def tracking_time_in_use(loop: Loop, actuation: Actuation) -> float:
    """T_t: as given, else the usual one."""
    if actuation.tracking_time is not None:
        return actuation.tracking_time
    return tracking_time(loop.controller, loop.plant.k, loop.plant.integrators)


class Driven:
    """The plant over one step, driven by u behind its dead time and by d; see the module docstring.

    A ramp of d acts by its mean over each step.
    step: Phi, G1, G2.   first, whole: the step in which d arrives, and the first that it drives from start to end, the
    same if it comes just with a step.   kick: what d = 1 adds to x in step `first`.
    """

    def __init__(self, system: Linear, step: Step, dt: float, theta: float, inputs: Inputs):
        self.system, self.step, self.dt, self.theta, self.inputs = system, step, dt, theta, inputs
        arrives = (inputs.disturbance_time + theta) / dt
        near = round(arrives)
        self.first = self.whole = near if abs(arrives - near) < SAME_INSTANT * arrives else math.floor(arrives)
        self.kick = np.zeros(len(system.B))
        rest = max(self.first + 1 - arrives, 0.0) * dt  # of step `first`
        if rest < dt * (1 - SAME_INSTANT):
            self.whole, self.kick = self.first + 1, system.hold(rest)[1]

    def over(self, x: np.ndarray, last: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Rows of x after the step, of the outputs at its start and at its end. x, last: rows of x, of OF_PLANT."""
        system, (Phi, G1, G2), (w1, w2, d, arriving) = self.system, self.step, last
        after = Phi @ x + np.outer(G1, w1 + d) + np.outer(G2, w2 + d) + np.outer(self.kick, arriving)
        start = system.C @ x + np.outer(system.D, w1 + d)
        return after, start, system.C @ after + np.outer(system.D, w2 + d + arriving)

    def rows(self, steps: int, columns: int) -> np.ndarray:
        """z_0 ... z_steps, (steps + 1, columns), zero but for d."""
        z, height = np.zeros((steps + 1, columns)), self.inputs.disturbance
        if ramp := self.inputs.disturbance_ramp:
            since = self.dt * np.arange(steps + 1) - self.theta - self.inputs.disturbance_time
            z[:, LOAD] = height * mean_risen(since, self.dt, ramp)
        else:
            z[self.whole :, LOAD] = z[self.first : self.whole, ARRIVING] = height
        return z


def column(z: np.ndarray, k: int, begin: int) -> "memoryview[float]":
    """Column k of z from row `begin` on, one number after the other: an array takes three times as long to index."""
    return cast("memoryview[float]", z[begin:, k].data)


def affordable(steps: float, why: str) -> int:
    """Whole steps that go beyond `steps`, so that a jump at the end is seen. Raises InvalidParameter: MOST_STEPS."""
    if steps > MOST_STEPS:
        raise InvalidParameter(
            said(
                "t_end must be <= {most_steps} steps for {why}, found {steps:.3g}",
                most_steps=MOST_STEPS,
                why=why,
                steps=steps,
            )
        )
    return math.floor(steps * (1 + SAME_INSTANT)) + 1
