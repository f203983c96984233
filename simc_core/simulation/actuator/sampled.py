"""A sampled controller: the law of module saturation at t = 0, h, 2h, ...

It acts on what it measures just before each sample, holds u in between, and the plant is then exact for any theta
(not a multiple of h):

    yF, rF and the derivatives by backward differences,   I_k = I_{k-1} + h Ki e_k + (h/T_t) (u_{k-1} - v_{k-1})

A sampling period is one step, or several where it is long. How a step is taken: module actuation.
"""

import math
from collections.abc import Callable

import numpy as np
from scipy.signal import lfilter

from simc_core.algebra.state_space import chain
from simc_core.controllers.forms import ParallelPid
from simc_core.loops.loop import Loop
from simc_core.simulation.actuator.actuation import (
    OF_PLANT,
    SAME,
    STEPS,
    W1,
    W2,
    Actuation,
    Driven,
    Inputs,
    Stepped,
    affordable,
    stepped,
    tracking_time_in_use,
)
from simc_core.simulation.actuator.one_step import Linear, whole_steps

# Columns of z behind x. MEASURED: y at the end of the step before, but for its u.   FILTERED, INTEGRAL, ASKED: yF, I, v
# of the last sample.   GIVEN: u of the step before.   NOISE, SETPOINT, MOVE: see _known, in the rows of the samples.
MEASURED, FILTERED, INTEGRAL, ASKED, GIVEN, NOISE, SETPOINT, MOVE = OF_LAW = range(8)
COLUMNS = len(OF_LAW) + len(OF_PLANT)


def sampled(loop: Loop, form: ParallelPid, actuation: Actuation, inputs: Inputs) -> Stepped:
    """As saturation.actuated, for h > 0. Raises InvalidParameter beyond actuation.MOST_STEPS steps."""
    A, B, C, D = chain(loop.plant.factored)
    system, theta, h, n = Linear(A, B, C[None, :], np.array([D])), loop.plant.theta, actuation.h, len(B)
    fine = whole_steps(h * STEPS / inputs.t_end)  # steps a sampling period
    dt = h / fine
    N = affordable(inputs.t_end / dt, f"a sampling period of {h:g}")
    m = min(math.ceil(theta / dt * (1 - SAME)), N)
    late = max(m * dt - theta, 0.0)  # w over step j is u of step j - m, for the last `late` that of j - m + 1
    reach = m, m - (late > 0)  # steps from u to w1 and to w2
    plant = Driven(system, system.late_hold(dt, late), dt, theta, inputs)
    pull = min(
        h / tracking_time_in_use(loop, actuation), 1.0
    )  # T_t is at least h: the excess is gone at the next sample
    with_sample, without, y = _law(plant, form, h, pull, reach)
    z, ahead = plant.rows(N + m, n + COLUMNS), [without.dot] * N
    samples = math.ceil(N / fine)
    z[:N:fine, n + NOISE : n + MOVE + 1] = _known(form, actuation, inputs, samples)
    ahead[::fine] = [with_sample.dot] * samples
    _march(z, n, ahead, reach, actuation)
    v, u = (np.repeat(z[1 : N + 1, n + column, None], 2, axis=1) for column in (ASKED, GIVEN))
    return stepped(dt, z[:N] @ y.T, v, u, h)


def _march(z: np.ndarray, n: int, ahead: list[Callable], reach: tuple[int, int], actuation: Actuation) -> None:
    """All steps, each with its matrix. Columns as memoryviews: an array takes three times as long to index."""
    low, high = actuation.u_min, actuation.u_max
    asked, given = memoryview(z[1:, n + ASKED]), memoryview(z[1:, n + GIVEN])
    w1, w2 = memoryview(z[reach[0] :, W1]), memoryview(z[reach[1] :, W2])
    for j, (take, row, head) in enumerate(zip(ahead, z, z[1:, : n + GIVEN], strict=False)):
        take(row, head)
        u = asked[j]
        given[j] = w1[j] = w2[j] = low if u < low else high if u > high else u


def _law(plant: Driven, form: ParallelPid, h: float, pull: float, reach: tuple[int, int]):
    """Matrices of a step that begins with a sample and of one that does not; rows of y at the start and at the end."""
    system, (_, G1, G2) = plant.system, plant.step
    at_once1, at_once2 = (steps == 0 for steps in reach)
    own = at_once1 * G1 + at_once2 * G2  # what u of a step adds to x in the same step
    n = len(own)
    rows = np.eye(n + COLUMNS)
    x, z = rows[:n] + np.outer(own, rows[n + GIVEN]), rows[n:]
    y = z[MEASURED] + (system.C @ own + at_once2 * system.D) * z[GIVEN]
    keep = form.tau_F / (form.tau_F + h)
    yF = keep * z[FILTERED] + (1 - keep) * (y + z[NOISE])
    integral = z[INTEGRAL] + h * form.Ki * (z[SETPOINT] - yF) + pull * (z[GIVEN] - z[ASKED])
    slopes = form.c * z[MOVE] - (yF - z[FILTERED])
    v = form.Kp * (form.b * z[SETPOINT] - yF) + integral + form.Kd * slopes / h
    after, (y0,), (y1,) = plant.over(x, z[OF_PLANT])
    with_sample = np.array([*after, y1, yF, integral, v])
    without = np.array([*after, y1, *z[FILTERED:GIVEN]])
    return with_sample, without, np.array([y0, y1])


def _known(form: ParallelPid, actuation: Actuation, inputs: Inputs, samples: int) -> np.ndarray:
    """Noise, rF and its moves at the samples, (samples, 3)."""
    noise = actuation.noise * np.random.default_rng(actuation.seed).standard_normal(samples)
    keep = form.tau_F / (form.tau_F + actuation.h)
    r = np.append(0.0, inputs.r(actuation.h * np.arange(samples)))
    rF = lfilter([1 - keep], [1.0, -keep], r)
    return np.stack([noise, rF[1:], np.diff(rF)], axis=1)
