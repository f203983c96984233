"""A sampled controller: a law of controllers/discrete.py at t = 0, h, 2h, ...

It acts on what it measures just before each sample and holds u in between; u may be written some samples later. The
plant is then exact for any theta (not a multiple of h). A sampling period is one step, or several where it is long.
How a step is taken: actuation.py.
"""

import math
from collections import deque
from collections.abc import Callable

import numpy as np

from simc_core.algebra.state_space import chain
from simc_core.controllers.discrete import State, law_for
from simc_core.controllers.forms import ParallelPid
from simc_core.loops.loop import Loop
from simc_core.simulation.actuator.actuation import (
    FEWEST_STEPS,
    OF_PLANT,
    SAME_INSTANT,
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
from simc_core.simulation.actuator.mechanism import Moved, mechanism
from simc_core.simulation.actuator.one_step import Linear, whole_steps
from simc_core.wording import said

# Columns of z behind x. MEASURED: y at the end of the step before, but for its u.   From STATE on: State of the last
# sample, its v in ASKED, its u, between the limits, in KNOWN.   GIVEN: u of the step before, as the actuator makes it.
# NOISE, SETPOINT: in the rows of the samples.
MEASURED, STATE, ASKED, KNOWN, GIVEN, NOISE, SETPOINT = 0, 1, 8, 9, 10, 11, 12
COLUMNS = 13 + len(OF_PLANT)


def sampled(loop: Loop, form: ParallelPid, actuation: Actuation, inputs: Inputs) -> Stepped:
    """As saturation.actuated, for h > 0. Raises InvalidParameter beyond actuation.MOST_STEPS steps."""
    A, B, C, D = chain(loop.plant.factored)
    system, theta, h, n = Linear(A, B, C[None, :], np.array([D])), loop.plant.theta, actuation.h, len(B)
    fine = whole_steps(h * FEWEST_STEPS / inputs.t_end)  # steps a sampling period
    dt = h / fine
    N = affordable(inputs.t_end / dt, said("a sampling period of {h:g}", h=h))
    m = min(math.ceil(theta / dt * (1 - SAME_INSTANT)), N)
    late = max(m * dt - theta, 0.0)  # w over step j is u of step j - m, for the last `late` that of j - m + 1
    reach = m, m - (late > 0)  # steps from u to w1 and to w2
    plant = Driven(system, system.late_hold(dt, late), dt, theta, inputs)
    pull = min(h / tracking_time_in_use(loop, actuation), 1.0)  # where T_t < h the excess is gone at the next sample
    with_sample, without, y = _matrices(plant, form, actuation, pull, reach)
    z, ahead = plant.rows(N + m, n + COLUMNS), [without.dot] * N
    samples = math.ceil(N / fine)
    z[:N:fine, n + NOISE] = actuation.noise * np.random.default_rng(actuation.seed).standard_normal(samples)
    z[:N:fine, n + SETPOINT] = inputs.r(h * np.arange(samples))
    ahead[::fine] = [with_sample.dot] * samples
    _march(z, n, ahead, reach, actuation, dt, fine * actuation.delay_scans)
    v, u = (np.repeat(z[1 : N + 1, n + column, None], 2, axis=1) for column in (ASKED, GIVEN))
    return stepped(dt, z[:N] @ y.T, v, u, h)


def _march(
    z: np.ndarray, n: int, ahead: list[Callable], reach: tuple[int, int], actuation: Actuation, dt: float, late: int
) -> None:
    """All steps, each with its matrix. late: steps after which the output is written."""
    low, high = actuation.u_min, actuation.u_max
    asked, known, given = (column(z, n + each, 1) for each in (ASKED, KNOWN, GIVEN))
    w1, w2 = column(z, W1, reach[0]), column(z, W2, reach[1])
    moved, u = _mechanism(actuation, dt), 0.0
    unwritten = deque([0.0] * late)
    for j, (take, row, head) in enumerate(zip(ahead, z, z[1:, : n + KNOWN], strict=False)):
        take(row, head)
        sent = asked[j]
        sent = known[j] = low if sent < low else high if sent > high else sent
        if late:
            unwritten.append(sent)
            sent = unwritten.popleft()
        u = given[j] = w1[j] = w2[j] = moved(sent, u) if moved else sent


def _mechanism(actuation: Actuation, dt: float) -> Moved | None:
    if not actuation.mechanical:
        return None
    return mechanism(actuation.resolution, actuation.dead_band, actuation.rate_limit * dt, actuation.backlash)


def _matrices(
    plant: Driven, form: ParallelPid, actuation: Actuation, pull: float, reach: tuple[int, int]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Matrices of a step that begins with a sample and of one that does not; rows of y at the start and at the end."""
    system, (_, G1, G2) = plant.system, plant.step
    at_once1, at_once2 = (steps == 0 for steps in reach)
    own = at_once1 * G1 + at_once2 * G2  # what u of a step adds to x in the same step
    n = len(own)
    rows = np.eye(n + COLUMNS)
    x, z = rows[:n] + np.outer(own, rows[n + GIVEN]), rows[n:]
    y = z[MEASURED] + (system.C @ own + at_once2 * system.D) * z[GIVEN]
    law = law_for(actuation.law, form, actuation.h)
    state = law.step(form, actuation.h, pull, State(*z[STATE:GIVEN]), z[SETPOINT], y + z[NOISE])
    after, (y0,), (y1,) = plant.over(x, z[OF_PLANT])
    with_sample = np.array([*after, y1, *state[:-1]])
    without = np.array([*after, y1, *z[STATE:KNOWN]])
    return with_sample, without, np.array([y0, y1])
