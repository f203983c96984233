"""The loop as it is built: actuator limits with anti-windup, measurement noise, a sampled controller.

    measured, filtered    yF = (y + noise)/(tau_F s + 1),   rF = r/(tau_F s + 1)
    v = Kp (b rF - yF) + I + Kd (c rF' - yF')               what the controller asks for
    u = min(max(v, u_min), u_max)                           what the actuator does
    I' = Ki (rF - yF) + (u - v)/T_t                         back calculation [Astrom and Hagglund, 2006, sect. 3.5]

Without limits this is the law of controllers.py. The tracking time T_t is sqrt(tau_I tau_D), tau_I for PI.

A continuous controller (h = 0) is stepped here with the input linear and the integrals by trapezoids, of second order
in the step theta/m; jumps at t = 0 and their echoes at k theta stay jumps. A sampled one is in module sampling. How a
step is taken: module actuation.
"""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from simc_core.algebra.recursion import first_order
from simc_core.algebra.state_space import chain
from simc_core.controllers.forms import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.loops.well_posed import require_well_posed
from simc_core.simulation.actuator.actuation import (
    FEWEST_STEPS,
    MOST_STEPS,
    OF_PLANT,
    W1,
    W2,
    Actuation,
    Driven,
    Inputs,
    Stepped,
    affordable,
    column,
    stepped,
    tracking_time_in_use,
)
from simc_core.simulation.actuator.one_step import Linear, whole_steps
from simc_core.simulation.actuator.sampled import sampled
from simc_core.wording import said

# Columns of z behind x. ASKED: u at the start and the end of the step before if there were no limits, GIVEN: as it is.
# ASKED1 and INTEGRAL lack what u of that step adds to them.   ASK, RATE: see _known, RATE over the whole step.
INTEGRAL, ASKED0, ASKED1, GIVEN0, GIVEN1, ASK0, ASK1, RATE = OF_LAW = range(8)
PER_DEAD_TIME = 50  # samples that stand for a continuous controller whose actuator jumps
COLUMNS = len(OF_LAW) + len(OF_PLANT)


def actuated(loop: Loop, actuation: Actuation, inputs: Inputs) -> Stepped:
    """r from 0 and d from inputs.disturbance_time on, from rest, as the module docstring says.

    Raises InvalidParameter: derivative action without a filter on a plant without inertia or on a set-point step,
    more than actuation.MOST_STEPS steps.

    A continuous controller whose actuator has a resolution, a dead band, play or a limited rate is stepped as one that
    is sampled very often: such an actuator jumps, and between jumps there is nothing to be gained by a ramp.
    """
    form = loop.controller.to_parallel()
    if actuation.mechanical and not actuation.h:
        actuation = replace(actuation, h=_often(loop, inputs))
    with np.errstate(over="ignore", invalid="ignore"):
        return sampled(loop, form, actuation, inputs) if actuation.h else _continuous(loop, form, actuation, inputs)


def _often(loop: Loop, inputs: Inputs) -> float:
    """A sampling period that is as good as none, for an actuator that moves by jumps."""
    shortest = min(inputs.t_end / FEWEST_STEPS, loop.plant.theta / PER_DEAD_TIME or math.inf)
    return max(shortest, inputs.t_end / MOST_STEPS * (1 + 1e-9))


def _continuous(loop: Loop, form: ParallelPid, actuation: Actuation, inputs: Inputs) -> Stepped:
    system, theta = _measured(loop, form), loop.plant.theta
    m = whole_steps(theta * FEWEST_STEPS / inputs.t_end) if theta else 0
    dt = theta / m if m else inputs.t_end / FEWEST_STEPS
    N = affordable(inputs.t_end / dt, said("a dead time of {theta:g}", theta=theta))
    m, n = min(m, N), len(system.B)
    plant = Driven(system, system.ramp(dt), dt, theta, inputs)
    law = _law(plant, form.Ki, dt / 2, tracking_time_in_use(loop, actuation), at_once=m == 0)
    z = plant.rows(N + m, n + COLUMNS)
    ask, rate = _known(form, actuation, inputs, dt, N)
    z[:N, n + ASK0 : n + RATE], z[:N, n + RATE] = ask, dt / 2 * rate.sum(axis=1)
    _march(z, n, N, m, law, actuation)
    now, then = z[:N], z[1 : N + 1]
    y, v = now @ law.y.T, now @ law.v.T
    v[:, 1] += then @ law.integral
    return stepped(dt, y, v, then[:, n + GIVEN0 : n + ASK0], dt)


def _march(z: np.ndarray, n: int, N: int, m: int, law: "_Law", actuation: Actuation) -> None:
    """N steps; u takes m of them to the plant."""
    low, high, through, ahead = actuation.u_min, actuation.u_max, law.through, law.matrix.dot
    asked0, asked1, given0, given1 = (column(z, n + k, 1) for k in (ASKED0, ASKED1, GIVEN0, GIVEN1))
    w1, w2 = column(z, W1, m), column(z, W2, m)
    for j, row, head in zip(range(N), z, z[1:, : n + GIVEN0], strict=False):
        ahead(row, head)
        u = asked0[j]
        u = low if u < low else high if u > high else u
        given0[j] = w1[j] = u
        u = asked1[j] + through * u
        given1[j] = w2[j] = low if u < low else high if u > high else u


class _Law(NamedTuple):
    """matrix: W.   through: what u at the start of a step adds to what is asked for at its end.

    Rows: y at start and end; v at start and, but for the integral there, at the end; the integral at the start.
    """

    matrix: np.ndarray
    through: float
    y: np.ndarray
    v: np.ndarray
    integral: np.ndarray


def _law(plant: Driven, Ki: float, half: float, T_t: float, at_once: bool) -> _Law:
    """The loop over one step, with p = Kp yF + Kd yF' and i = yF at its start (0) and end (1), half a step `half`:

        v0 = ask0 - p0 + I0                   I1 = I0 + RATE - half Ki (i0 + i1) + pull (u0 - v0 + u1 - v1)
        v1 = ask1 - p1 + I1                   pull = half/T_t

    at_once: no dead time, so that u of this very step is in p, i and y. Both equations are solved for v1 and I1, and
    v = u for what is asked for. T_t is at least half a step: a shorter one would make the trapezoids ring, this one
    forgets the excess in one step. Raises InvalidParameter: u answers to itself, and 1 + L(inf) = 0.
    """
    system, (_, G1, G2), pull, J = plant.system, plant.step, min(half / T_t, 1.0), half * Ki
    # What u0 adds to (y, p, i) at once and at the end, u1 at the end; what both add to I1.
    jump, first, last = at_once * system.D, at_once * (system.C @ G1), at_once * (system.C @ G2 + system.D)
    require_well_posed(1 + jump[1])
    of_u0 = (pull * (1 + jump[1] + first[1]) - J * (jump[2] + first[2])) / (1 + pull)
    of_u1 = (pull * (1 + last[1]) - J * last[2]) / (1 + pull)
    n = len(G1)
    rows = np.eye(n + COLUMNS)
    x, z = rows[:n], rows[n:]
    x = x + at_once * (np.outer(G1, z[GIVEN0]) + np.outer(G2, z[GIVEN1]))
    integral = z[INTEGRAL] + of_u0 * z[GIVEN0] + of_u1 * z[GIVEN1]
    after, (y0, p0, i0), (y1, p1, i1) = plant.over(x, z[OF_PLANT])
    v0, rest = z[ASK0] - p0 + integral, z[ASK1] - p1  # v1 = rest + I1
    I1 = (integral + z[RATE] - J * (i0 + i1) - pull * (v0 + rest)) / (1 + pull)
    own = 1 + last[1] - of_u1  # asked for at the end is the u1 that is v1: own u1 = rest + I1 + (of_u0 - first) u0
    matrix = np.array([*after, I1, v0 / (1 + jump[1]), (rest + I1) / own])
    return _Law(matrix, (of_u0 - first[1]) / own, np.array([y0, y1]), np.array([v0, rest]), integral)


def _known(form: ParallelPid, actuation: Actuation, inputs: Inputs, dt: float, N: int) -> tuple[np.ndarray, np.ndarray]:
    """What set point and noise give to P + D and to I', at the starts and ends of the steps, (N, 2) each."""
    t = dt * np.arange(N + 1)
    n = actuation.noise * np.random.default_rng(actuation.seed).standard_normal(N + 1)
    if form.tau_F:
        rF, slope = _filtered(t, form.tau_F, inputs.setpoint_ramp)
        rF, r_slope = inputs.setpoint * rF, _both(inputs.setpoint * slope)
        ratio = dt / form.tau_F  # the filter under an input that is linear over a step
        held = -math.expm1(-ratio)
        grown = 1 - held / ratio
        nF = first_order(grown * n + (held - grown) * np.append(0.0, n[:-1]), math.exp(-ratio))
        n_slope = _both((n - nF) / form.tau_F)
    else:
        rF, nF = inputs.r(t), n
        r_slope = np.repeat(np.diff(rF)[:, None] / dt, 2, axis=1)
        n_slope = np.repeat(np.diff(n)[:, None] / dt, 2, axis=1)
    ask = form.Kp * _both(form.b * rF - nF) + form.Kd * (form.c * r_slope - n_slope)
    return ask, form.Ki * _both(rF - nF)


def _filtered(t: np.ndarray, tau_F: float, ramp: float) -> tuple[np.ndarray, np.ndarray]:
    """A set point of height 1 behind the filter, and its slope, at t >= 0."""
    decay = np.exp(-t / tau_F)
    if not ramp:
        return 1 - decay, decay / tau_F
    since = np.maximum(t - ramp, 0.0)
    decayed = np.exp(-since / tau_F)
    return (t - since + tau_F * (decay - decayed)) / ramp, (decayed - decay) / ramp


def _both(values: np.ndarray) -> np.ndarray:
    """Values at the instants as those at the starts and ends of the steps."""
    return np.stack([values[:-1], values[1:]], axis=1)


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
        raise InvalidParameter(
            said("tau_F must be > 0 for derivative action on a plant whose response starts with a jump, found 0")
        )
    if form.Kd and form.c:
        raise InvalidParameter(said("tau_F must be > 0 for derivative action on a set-point step (c > 0), found 0"))
    slope, jump = C @ A, C @ B
    return Linear(A, B, np.array([C, form.Kp * C + form.Kd * slope, C]), np.array([D, form.Kp * D + form.Kd * jump, D]))
