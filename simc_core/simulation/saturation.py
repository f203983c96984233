"""The loop as it is built: actuator limits with anti-windup, measurement noise, a sampled controller.

    measured, filtered    yF = (y + noise)/(tau_F s + 1),   rF = r/(tau_F s + 1)
    v = Kp (b rF - yF) + I + Kd (c rF' - yF')               what the controller asks for
    u = min(max(v, u_min), u_max)                           what the actuator does
    I' = Ki (rF - yF) + (u - v)/T_t                         back calculation [Astrom and Hagglund, 2006, sect. 3.5]

Without limits this is the law of controllers.py. The tracking time T_t is sqrt(tau_I tau_D), tau_I for PI.

A continuous controller (h = 0) is stepped with the input linear and the integrals by trapezoids, of second order in
the step theta/m; jumps at t = 0 and their echoes at k theta stay jumps. A sampled one acts at t = 0, h, 2h, ... on
what it measures just before, holds u in between, and the plant is then exact for any theta (not a multiple of h):

    yF, rF and the derivatives by backward differences,   I_k = I_{k-1} + h Ki e_k + (h/T_t) (u_{k-1} - v_{k-1})

The plant over a block of steps no longer than its dead time is one matrix product (module blocks): its input is known.
Only the scalar law above is stepped in Python.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from simc_core.controllers import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loop import Loop
from simc_core.realisation import chain
from simc_core.simulation.blocks import Blocks, Linear, blocks

STEPS = 5000  # at least; more where theta or h is short against the horizon
MOST_STEPS = 200_000
LONGEST_BLOCK = 80  # steps: beyond it the Toeplitz matrix costs more than it saves
SAME = 1e-9  # relative; instants closer than this to the grid are on it


@dataclass(frozen=True, slots=True)
class Actuation:
    """What is not linear, or not known in advance, between controller and plant.

    u_min <= u <= u_max.   tracking_time: T_t, None for the default.   noise: standard deviation of the measurement
    noise, a new value each step of the controller.   seed: of the noise.   h: its period, 0 if continuous.
    """

    u_min: float = -math.inf
    u_max: float = math.inf
    tracking_time: float | None = None
    noise: float = 0.0
    seed: int = 0
    h: float = 0.0

    @property
    def linear(self) -> bool:
        """Whether the exact engine of linear loops does the same."""
        return self.u_min == -math.inf and self.u_max == math.inf and self.noise == 0 and self.h == 0


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """Values at the start and the end of each step, (N, 2); t: starts of the steps and the end, (N + 1,)."""

    t: np.ndarray
    y: np.ndarray
    u: np.ndarray

    def at(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """y, u at the instants t, linear within a step, right-hand limits at its ends."""
        step = np.clip(np.searchsorted(self.t, t * (1 + SAME), side="right") - 1, 0, len(self.t) - 2)
        part = np.clip((t - self.t[step]) / (self.t[step + 1] - self.t[step]), 0.0, 1.0)
        return tuple(each[step, 0] + part * (each[step, 1] - each[step, 0]) for each in (self.y, self.u))


def actuated(
    loop: Loop, actuation: Actuation, setpoint: float, disturbance: float, disturbance_time: float, t_end: float
) -> Course:
    """Steps of r at 0 and of d at disturbance_time, from rest, as the module docstring says.

    Raises InvalidParameter: derivative action without a filter on a plant without inertia, more than MOST_STEPS steps.
    """
    run = _sampled if actuation.h else _continuous
    inputs = _Inputs(setpoint, disturbance, disturbance_time, t_end)
    return run(loop, loop.controller.to_parallel(), actuation, inputs)


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


@dataclass(frozen=True, slots=True)
class _Inputs:
    setpoint: float
    disturbance: float
    disturbance_time: float
    t_end: float


class _Driven:
    """The plant on its way through time: its state, and the disturbance that adds to the delayed u."""

    def __init__(self, system: Linear, steps: Blocks, dt: float, theta: float, inputs: _Inputs):
        self.system, self.steps = system, steps
        self.d, self.x = inputs.disturbance, np.zeros(len(system.B))
        arrives = (inputs.disturbance_time + theta) / dt
        self.first = round(arrives) if abs(arrives - round(arrives)) < SAME * arrives else math.floor(arrives)
        rest = max(self.first + 1 - arrives, 0.0) * dt  # of step `first`, d acts on this last part
        self.kick = system.hold(rest)[1] * self.d if rest < dt * (1 - SAME) else None
        self.whole = self.first if self.kick is None else self.first + 1  # first step that d acts on wholly

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

    def add(self, w: np.ndarray, step: tuple[np.ndarray, np.ndarray, np.ndarray]) -> np.ndarray:
        """What w (2,) adds to the outputs (2, o) of the step just made, where it was not known before; theta = 0."""
        moved = step[1] * w[0] + step[2] * w[1]
        self.x = self.x + moved
        return np.array([self.system.D * w[0], self.system.C @ moved + self.system.D * w[1]])


def _continuous(loop: Loop, form: ParallelPid, actuation: Actuation, inputs: _Inputs) -> Course:
    system, theta = _measured(loop, form), loop.plant.theta
    m = max(1, math.ceil(theta * STEPS / inputs.t_end)) if theta else 0
    dt = theta / m if m else inputs.t_end / STEPS
    N = _affordable(inputs.t_end / dt, f"a dead time of {theta:g}")
    ask, rate = _known(form, actuation, inputs.setpoint, dt, N)
    step = system.ramp(dt)
    plant = _Driven(system, blocks(system, step, min(m, LONGEST_BLOCK) or 1), dt, theta, inputs)
    law = _Law(actuation, dt / 2, tracking_time(loop, actuation))
    y, u = np.zeros((N, 2)), np.zeros((N, 2))
    now = 0
    while now < N:
        until = plant.end_of_block(now, N)
        v = np.zeros((until - now, 2))
        if m and until > m:
            v[max(m - now, 0) :] = u[max(now - m, 0) : until - m]
        o = plant(v, now)
        here = slice(now, until)
        proportional, integral = ask[here] - o[:, :, 1], rate[here] - form.Ki * o[:, :, 2]
        if m:
            u[here] = law(proportional, integral)
        else:
            u[now] = law.implicit(proportional[0], integral[0], system, step, form.Ki)
            o[0] += plant.add(u[now], step)
        y[here] = o[:, :, 0]
        now = until
    return Course(dt * np.arange(N + 1), y, u)


def _known(
    form: ParallelPid, actuation: Actuation, setpoint: float, dt: float, N: int
) -> tuple[np.ndarray, np.ndarray]:
    """What set point and noise give to P + D and to I', at the starts and ends of the steps, (N, 2) each."""
    t = dt * np.arange(N + 1)
    n = actuation.noise * np.random.default_rng(actuation.seed).standard_normal(N + 1)
    if form.tau_F:
        decay = np.exp(-t / form.tau_F)
        rF, r_slope = setpoint * (1 - decay), _both(setpoint / form.tau_F * decay)
        ratio = dt / form.tau_F  # the filter under an input that is linear over a step
        held = -math.expm1(-ratio)
        grown = 1 - held / ratio
        nF = lfilter([grown, held - grown], [1.0, -math.exp(-ratio)], n)
        n_slope = _both((n - nF) / form.tau_F)
    else:
        rF, r_slope, nF = np.full(N + 1, setpoint), 0.0, n
        n_slope = np.repeat(np.diff(n)[:, None] / dt, 2, axis=1)
    ask = form.Kp * _both(form.b * rF - nF) + form.Kd * (form.c * r_slope - n_slope)
    return ask, form.Ki * _both(rF - nF)


def _both(values: np.ndarray) -> np.ndarray:
    """Values at the instants as those at the starts and ends of the steps."""
    return np.stack([values[:-1], values[1:]], axis=1)


class _Law:
    """v = ask + I, u = v within its limits, I' = rate + (u - v)/T_t by trapezoids; I is kept from call to call."""

    def __init__(self, actuation: Actuation, half: float, T_t: float):
        self.low, self.high = actuation.u_min, actuation.u_max
        self.half, self.pull, self.integral = half, half / T_t, 0.0

    def __call__(self, ask: np.ndarray, rate: np.ndarray) -> np.ndarray:
        """u at starts and ends, (m, 2), like ask and rate. The end is implicit in v, and solved for it."""
        low, high, pull, integral = self.low, self.high, self.pull, self.integral
        u = []
        gains = (self.half * rate.sum(axis=1)).tolist()
        for (begin, end), gain in zip(ask.tolist(), gains, strict=True):
            v = begin + integral
            first = low if v < low else high if v > high else v
            integral += gain + pull * (first - v)
            w = end + integral  # v at the end less its own pull
            last = low if w < low else high if w > high else w
            integral += pull / (1 + pull) * (last - w)
            u.append((first, last))
        self.integral = integral
        return np.array(u)

    def implicit(self, ask, rate, system: Linear, step, Ki: float) -> np.ndarray:
        """The same for one step without dead time, where y at the end answers to u there, and jumps with it."""
        _, G1, G2 = step
        slope = system.D[1]
        v = (ask[0] + self.integral) / (1 + slope)
        first = min(max(v, self.low), self.high)
        v = ask[0] + self.integral - slope * first
        from_first, from_last = system.C @ G1, system.C @ G2 + system.D
        rate_sum = rate.sum() - Ki * (system.D[2] + from_first[2]) * first
        integral = self.integral + self.half * rate_sum + self.pull * (first - v)
        w = ask[1] - from_first[1] * first + integral
        answer = from_last[1] + self.half * Ki * from_last[2]
        last = min(max(w / (1 + answer), self.low), self.high)
        excess = (last - (w - answer * last)) * self.pull / (1 + self.pull)
        self.integral = integral - self.half * Ki * from_last[2] * last + excess
        return np.array([first, last])


def _sampled(loop: Loop, form: ParallelPid, actuation: Actuation, inputs: _Inputs) -> Course:
    A, B, C, D = chain(loop.plant.factored)
    system, theta, h = Linear(A, B, C[None, :], np.array([D])), loop.plant.theta, actuation.h
    fine = max(1, math.ceil(h * STEPS / inputs.t_end))  # steps a sampling period
    dt = h / fine
    N = fine * math.ceil(_affordable(inputs.t_end / dt, f"a sampling period of {h:g}") / fine)
    m = math.ceil(theta / dt * (1 - SAME))
    late = max(m * dt - theta, 0.0)  # v over step j is u of step j - m, for the last `late` that of j - m + 1
    plant = _Driven(system, blocks(system, system.late_hold(dt, late), LONGEST_BLOCK), dt, theta, inputs)
    law = _SampledLaw(form, actuation, inputs.setpoint, tracking_time(loop, actuation), N // fine)
    y, u = np.zeros((N, 2)), np.zeros(m + N + 1)  # u[m + j] is that of step j
    now = taken = 0
    while now < N:
        while taken * fine <= now:  # the newest samples that y is known for
            at = taken * fine
            u[m + at : m + at + fine] = law(y[at - 1, 1] if at else 0.0, taken)
            taken += 1
        until = plant.end_of_block(now, min(N, taken * fine + m - (late > 0)))
        o = plant(np.stack([u[now:until], u[now + (late > 0) : until + (late > 0)]], axis=1), now)
        y[now:until] = o[:, :, 0]
        now = until
    return Course(dt * np.arange(N + 1), y, np.repeat(u[m : m + N, None], 2, axis=1))


class _SampledLaw:
    """The controller at its instants, by backward differences; see the module docstring."""

    def __init__(self, form: ParallelPid, actuation: Actuation, setpoint: float, T_t: float, samples: int):
        self.form, self.actuation, self.setpoint = form, actuation, setpoint
        self.noise = actuation.noise * np.random.default_rng(actuation.seed).standard_normal(samples)
        self.pull = actuation.h / T_t
        self.keep = form.tau_F / (form.tau_F + actuation.h)
        self.yF = self.rF = self.integral = self.excess = 0.0

    def __call__(self, y: float, sample: int) -> float:
        """u from now on."""
        form, h = self.form, self.actuation.h
        yF = self.keep * self.yF + (1 - self.keep) * (y + self.noise[sample])
        rF = self.keep * self.rF + (1 - self.keep) * self.setpoint
        self.integral += h * form.Ki * (rF - yF) + self.pull * self.excess
        slopes = form.c * (rF - self.rF) - (yF - self.yF)
        v = form.Kp * (form.b * rF - yF) + self.integral + form.Kd * slopes / h
        u = min(max(v, self.actuation.u_min), self.actuation.u_max)
        self.yF, self.rF, self.excess = yF, rF, u - v
        return u


def _measured(loop: Loop, form: ParallelPid) -> Linear:
    """From u + d, after the dead time, to y, Kp yF + Kd yF' and yF."""
    A, B, C, D = chain(loop.plant.factored)
    n = len(B)
    if form.tau_F:
        rate = form.Kd / form.tau_F
        wide = np.zeros((n + 1, n + 1))
        wide[:n, :n], wide[n, :n], wide[n, n] = A, C / form.tau_F, -1 / form.tau_F
        outputs = np.array([[*C, 0.0], [*(rate * C), form.Kp - rate], [*np.zeros(n), 1.0]])
        return Linear(wide, np.array([*B, D / form.tau_F]), outputs, np.array([D, rate * D, 0.0]))
    if form.Kd and D:
        raise InvalidParameter("tau_F must be > 0 for derivative action on a plant without inertia, got 0")
    slope, jump = C @ A, C @ B
    return Linear(A, B, np.array([C, form.Kp * C + form.Kd * slope, C]), np.array([D, form.Kp * D + form.Kd * jump, D]))


def _affordable(steps: float, why: str) -> int:
    if steps > MOST_STEPS:
        raise InvalidParameter(f"t_end must be <= {MOST_STEPS} steps for {why}, got {steps:.3g}")
    return math.ceil(steps * (1 - SAME))
