"""The loop as it is built: actuator limits with anti-windup, measurement noise, a sampled controller.

    measured, filtered    yF = (y + noise)/(tau_F s + 1),   rF = r/(tau_F s + 1)
    v = Kp (b rF - yF) + I + Kd (c rF' - yF')               what the controller asks for
    u = min(max(v, u_min), u_max)                           what the actuator does
    I' = Ki (rF - yF) + (u - v)/T_t                         back calculation [Astrom and Hagglund, 2006, sect. 3.5]

Without limits this is the law of controllers.py. The tracking time T_t is sqrt(tau_I tau_D), tau_I for PI.

A continuous controller (h = 0) is stepped here with the input linear and the integrals by trapezoids, of second order
in the step theta/m; jumps at t = 0 and their echoes at k theta stay jumps. A sampled one is in module sampling.
Only the scalar law above is stepped in Python.
"""

import math
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.signal import lfilter

from simc_core.controllers import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loop import Loop
from simc_core.realisation import chain
from simc_core.simulation.actuation import (
    LONGEST_BLOCK,
    STEPS,
    Actuation,
    Course,
    Driven,
    Inputs,
    affordable,
    arrival,
    course,
    tracking_time,
)
from simc_core.simulation.blocks import Linear, blocks
from simc_core.simulation.sampling import sampled
from simc_core.simulation.system import WELL_POSED


def actuated(loop: Loop, actuation: Actuation, inputs: Inputs) -> Course:
    """Steps of r at 0 and of d at inputs.disturbance_time, from rest, as the module docstring says.

    Raises InvalidParameter: derivative action without a filter on a plant without inertia or on a set-point step,
    more than actuation.MOST_STEPS steps.
    """
    form = loop.controller.to_parallel()
    with np.errstate(over="ignore", invalid="ignore"):
        return sampled(loop, form, actuation, inputs) if actuation.h else _continuous(loop, form, actuation, inputs)


def _continuous(loop: Loop, form: ParallelPid, actuation: Actuation, inputs: Inputs) -> Course:
    system, theta = _measured(loop, form), loop.plant.theta
    m = max(1, math.ceil(theta * STEPS / inputs.t_end)) if theta else 0
    dt = theta / m if m else inputs.t_end / STEPS
    N = affordable(inputs.t_end / dt, f"a dead time of {theta:g}")
    ask, rate = _known(form, actuation, inputs.setpoint, dt, N)
    law = _Law(actuation, dt / 2, tracking_time(loop, actuation))
    run = partial(_delayed, m) if m else _undelayed
    return course(dt, *run(system, form.Ki, law, inputs, dt, ask, rate), dt)


def _delayed(m: int, system: Linear, Ki: float, law: "_Law", inputs: Inputs, dt: float, ask, rate):
    """y, v, u at starts and ends of the steps, (N, 2) each, where u takes m steps to the plant."""
    plant = Driven(system, blocks(system, system.ramp(dt), min(m, LONGEST_BLOCK)), dt, m * dt, inputs)
    N = len(ask)
    y, v, u = np.zeros((N, 2)), np.zeros((N, 2)), np.zeros((N, 2))
    now = 0
    while now < N:
        until = plant.end_of_block(now, min(N, now + m))
        late = np.zeros((until - now, 2))
        if until > m:
            late[max(m - now, 0) :] = u[max(now - m, 0) : until - m]
        o = plant(late, now)
        here = slice(now, until)
        v[here] = law(ask[here] - o[:, :, 1], rate[here] - Ki * o[:, :, 2])
        u[here] = v[here].clip(law.low, law.high)
        y[here] = o[:, :, 0]
        now = until
    return y, v, u


def _undelayed(system: Linear, Ki: float, law: "_Law", inputs: Inputs, dt: float, ask, rate):
    """The same for theta = 0: outputs at both ends of a step are affine in u there, and u answers to them at once."""
    (Phi, G1, G2), C, D, n = system.ramp(dt), system.C, system.D, len(system.B)
    if abs(1 + D[1]) < WELL_POSED:
        raise InvalidParameter("1 + L(inf) must not be zero in a loop without dead time, got 0: u is not defined")
    N, moved = len(ask), np.concatenate([C, C @ Phi, Phi])
    extra = np.zeros((N, 2, 3))  # what d adds to the outputs
    first, kick, whole = arrival(system, dt, 0.0, inputs)
    extra[whole:] = inputs.disturbance * np.stack([D, C @ (G1 + G2) + D])
    push = np.zeros((N, n))
    push[whole:] = inputs.disturbance * (G1 + G2)
    if kick is not None and first < N:
        extra[first, 1], push[first] = C @ kick + D * inputs.disturbance, kick
    ask, rate = (ask - extra[:, :, 1]).tolist(), (rate - Ki * extra[:, :, 2]).tolist()
    answer = _Answer(*D.tolist(), *(C @ G1).tolist(), *(C @ G2 + D).tolist(), Ki)
    x, free, v, u = np.zeros(n), [], [], []
    for j in range(N):
        out = moved @ x
        y0, p0, i0, y1, p1, i1 = out[:6].tolist()
        asked, (a, b) = law.implicit(answer, *ask[j], *rate[j], p0, i0, p1, i1)
        x = out[6:] + (G1 * a + G2 * b + push[j])
        free.append((y0, y1))
        v.append(asked)
        u.append((a, b))
    u = np.array(u)
    y = np.array(free) + extra[:, :, 0]
    y[:, 0] += D[0] * u[:, 0]
    y[:, 1] += answer.y_first * u[:, 0] + answer.y_last * u[:, 1]
    return y, np.array(v), u


class _Answer(NamedTuple):
    """What u at the start (jump, first) and at the end (last) of a step adds to y, Kp yF + Kd yF' and yF."""

    y_jump: float
    p_jump: float
    i_jump: float
    y_first: float
    p_first: float
    i_first: float
    y_last: float
    p_last: float
    i_last: float
    Ki: float


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
    """v = ask + I, u = v within its limits, I' = rate + (u - v)/T_t by trapezoids; I is kept from call to call.

    T_t is at least half a step: a shorter one would make the trapezoids ring, this one forgets the excess in one step.
    """

    def __init__(self, actuation: Actuation, half: float, T_t: float):
        self.low, self.high = actuation.u_min, actuation.u_max
        self.half, self.pull, self.integral = half, min(half / T_t, 1.0), 0.0

    def __call__(self, ask: np.ndarray, rate: np.ndarray) -> np.ndarray:
        """v at starts and ends, (m, 2), like ask and rate. The end is implicit in v, and solved for it."""
        low, high, pull, integral = self.low, self.high, self.pull, self.integral
        asked = []
        gains = (self.half * rate.sum(axis=1)).tolist()
        for (begin, end), gain in zip(ask.tolist(), gains, strict=True):
            v = begin + integral
            first = low if v < low else high if v > high else v
            w = end + integral + gain + pull * (first - v)  # v at the end less its own pull
            last = low if w < low else high if w > high else w
            after = (w + pull * last) / (1 + pull)
            integral = after - end
            asked.append((v, after))
        self.integral = integral
        return np.array(asked)

    def implicit(self, to: _Answer, ask0, ask1, rate0, rate1, p0, i0, p1, i1) -> tuple[tuple, tuple]:
        """v and u for one step without dead time; p, i: the outputs at its ends as they would be with u = 0."""
        low, high, pull, half = self.low, self.high, self.pull, self.half
        free = ask0 - p0 + self.integral
        first = min(max(free / (1 + to.p_jump), low), high)
        v = free - to.p_jump * first
        rates = rate0 + rate1 - to.Ki * (i0 + i1 + (to.i_jump + to.i_first) * first)
        known = ask1 - p1 - to.p_first * first
        w = known + self.integral + half * rates + pull * (first - v)
        answer = to.p_last + half * to.Ki * to.i_last
        last = min(max(w / (1 + answer), low), high)
        after = (w - answer * last + pull * last) / (1 + pull)
        self.integral = after - known + to.p_last * last
        return (v, after), (first, last)


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
    if form.Kd and form.c:
        raise InvalidParameter("tau_F must be > 0 where the derivative acts on the set point (c > 0), got 0")
    slope, jump = C @ A, C @ B
    return Linear(A, B, np.array([C, form.Kp * C + form.Kd * slope, C]), np.array([D, form.Kp * D + form.Kd * jump, D]))
