"""A sampled controller: the law of module saturation at t = 0, h, 2h, ...

It acts on what it measures just before each sample, holds u in between, and the plant is then exact for any theta
(not a multiple of h):

    yF, rF and the derivatives by backward differences,   I_k = I_{k-1} + h Ki e_k + (h/T_t) (u_{k-1} - v_{k-1})
"""

import math

import numpy as np

from simc_core.controllers import ParallelPid
from simc_core.loop import Loop
from simc_core.realisation import chain
from simc_core.simulation.actuation import (
    LONGEST_BLOCK,
    SAME,
    STEPS,
    Actuation,
    Driven,
    Inputs,
    Stepped,
    affordable,
    stepped,
    tracking_time,
)
from simc_core.simulation.blocks import Linear, blocks


def sampled(loop: Loop, form: ParallelPid, actuation: Actuation, inputs: Inputs) -> Stepped:
    """As saturation.actuated, for h > 0. Raises InvalidParameter beyond actuation.MOST_STEPS steps."""
    A, B, C, D = chain(loop.plant.factored)
    system, theta, h = Linear(A, B, C[None, :], np.array([D])), loop.plant.theta, actuation.h
    fine = max(1, math.ceil(h * STEPS / inputs.t_end))  # steps a sampling period
    dt = h / fine
    N = affordable(inputs.t_end / dt, f"a sampling period of {h:g}")
    m = min(math.ceil(theta / dt * (1 - SAME)), N)
    late = max(m * dt - theta, 0.0)  # v over step j is u of step j - m, for the last `late` that of j - m + 1
    plant = Driven(system, blocks(system, system.late_hold(dt, late), LONGEST_BLOCK), dt, theta, inputs)
    law = _Law(form, actuation, inputs.setpoint, tracking_time(loop, actuation), math.ceil(N / fine))
    y, v, u = np.zeros((N, 2)), np.zeros(N), np.zeros(m + N + 1)  # u[m + j] is that of step j
    now = taken = 0
    while True:
        while taken * fine < min(now + 1, N):  # the newest samples that y is known for
            at = taken * fine
            v[at : at + fine], u[m + at : m + at + fine] = law(y[at - 1, 1] if at else 0.0, taken)
            taken += 1
        if now == N:
            break
        until = plant.end_of_block(now, min(N, taken * fine + m - (late > 0)))
        o = plant(np.stack([u[now:until], u[now + (late > 0) : until + (late > 0)]], axis=1), now)
        y[now:until] = o[:, :, 0]
        now = until
    held = [np.repeat(values[:, None], 2, axis=1) for values in (v, u[m : m + N])]
    return stepped(dt, y, *held, h)


class _Law:
    """The controller at its instants, see the module docstring. T_t is at least h: the excess is gone at the next."""

    def __init__(self, form: ParallelPid, actuation: Actuation, setpoint: float, T_t: float, samples: int):
        self.form, self.actuation, self.setpoint = form, actuation, setpoint
        self.noise = actuation.noise * np.random.default_rng(actuation.seed).standard_normal(samples)
        self.pull = min(actuation.h / T_t, 1.0)
        self.keep = form.tau_F / (form.tau_F + actuation.h)
        self.yF = self.rF = self.integral = self.excess = 0.0

    def __call__(self, y: float, sample: int) -> tuple[float, float]:
        """v and u from now on."""
        form, h = self.form, self.actuation.h
        yF = self.keep * self.yF + (1 - self.keep) * (y + self.noise[sample])
        rF = self.keep * self.rF + (1 - self.keep) * self.setpoint
        self.integral += h * form.Ki * (rF - yF) + self.pull * self.excess
        slopes = form.c * (rF - self.rF) - (yF - self.yF)
        v = form.Kp * (form.b * rF - yF) + self.integral + form.Kd * slopes / h
        u = min(max(v, self.actuation.u_min), self.actuation.u_max)
        self.yF, self.rF, self.excess = yF, rF, u - v
        return v, u
