"""Nested loops with a limited actuator: windup between the loops, and how it is avoided.

The linear loops of network.py, with what the limits take away as one more input, e = sat(u_1) - u_1:

    z_1 = u_1 + d_1 + e
    "none"    nothing more: both integrals go on growing
    "inner"   xi_1' += e/T_1                     back calculation in the inner controller alone
    "both"    and xi_i' += (e/K_1)/T_i outside   the set point that the inner loop could have followed is r_2 + e/K_1;
                                                 the outer controller is led back to it, and takes over without a bump

K_1 is the proportional gain of the inner controller, T as in controllers/tracking.py. Steps are of second order:
the linear part exact for signals that run linearly over a step, e by predictor and corrector.
"""

import numpy as np

from simc_core import checks
from simc_core.controllers.tracking import tracking_time
from simc_core.errors import InvalidParameter
from simc_core.loops.nested import CascadeLoop, NestedLoops
from simc_core.simulation.actuator.actuation import rest_within
from simc_core.simulation.actuator.one_step import ON_GRID, Linear, whole_steps
from simc_core.simulation.rise import risen
from simc_core.simulation.several_delays.network import Network, integral_states, network
from simc_core.simulation.simulate_nested import NestedResponse, horizon
from simc_core.wording import said

FEWEST_STEPS, MOST_STEPS = 3000, 40_000
PROTECTIONS = ("none", "inner", "both")


def limited(
    loop: CascadeLoop | NestedLoops,
    u_min: float,
    u_max: float,
    protection: str = "both",
    setpoint: float = 1.0,
    disturbance2: float = 0.0,
    disturbance2_time: float = 0.0,
    t_end: float | None = None,
) -> NestedResponse:
    """Steps of r at 0 and of d at the input of the innermost block, from rest; us[0] is the limited signal.

    Raises InvalidParameter: limits that do not enclose 0, unknown protection, a dead time too short for MOST_STEPS, an
    innermost block without dead time that starts with a jump.
    """
    rest_within(u_min, u_max)
    checks.one_of("protection", protection, PROTECTIONS)
    loops = loop.nested if isinstance(loop, CascadeLoop) else loop
    t_end = horizon(loops) if t_end is None else t_end
    system = network(loops)
    if system.Fo[len(loops.blocks), 1]:
        raise InvalidParameter(
            said("theta of the innermost block must be > 0 where it passes a jump of u on at once, found 0")
        )
    dt = _step(system, t_end)
    t = dt * np.arange(round(t_end / dt) + 1)
    arrives = disturbance2_time + loops.blocks[0].theta
    load = disturbance2 * np.clip(
        (t + dt - arrives) / dt, 0.0, 1.0
    )  # as a mean over each step: it may begin within one
    N = len(loops.blocks)
    tracking = _tracking(loops, len(system.A), protection)
    outputs, u = _run(system, tracking, (u_min, u_max), setpoint, load, loops.blocks[0].theta > 0, dt)
    us = outputs[:, N:].T.copy()
    us[0] = u
    ds = np.zeros((N, len(t)))
    ds[0] = disturbance2 * risen(t - disturbance2_time, 0.0)
    return NestedResponse(t, np.full(len(t), setpoint), ds, outputs[:, :N].T, us)


def _step(system: Network, t_end: float) -> float:
    """A part of the shortest dead time, so that the jump at t = 0 comes back at an instant of the grid."""
    if not system.theta.size:
        return t_end / FEWEST_STEPS
    shortest = float(np.min(system.theta))
    if t_end / shortest > MOST_STEPS:
        raise InvalidParameter(
            said(
                "t_end must be at most {most_steps} theta = {longest:g}, found {t_end:g}",
                most_steps=MOST_STEPS,
                longest=MOST_STEPS * shortest,
                t_end=t_end,
            )
        )
    return shortest / whole_steps(FEWEST_STEPS * shortest / t_end)


def _tracking(loops: NestedLoops, n: int, protection: str) -> np.ndarray:
    """Column of e in x' from back calculation."""
    column = np.zeros(n)
    if protection == "none":
        return column
    integrals = integral_states(loops)
    gain, innermost, k, integrators = 1.0, True, 1.0, 0
    for block, controller, state in zip(loops.blocks, loops.controllers, integrals, strict=True):
        k *= block.k  # of all blocks since the last controller: the loops inside follow their set points
        integrators += block.integrators
        if controller is None:
            continue
        form, time = controller.to_parallel(), tracking_time(controller, k, integrators)
        if state is not None and (innermost or protection == "both"):
            column[state] = 1 / (gain * time)
        gain *= form.Kp or form.Ki * time
        innermost, k, integrators = False, 1.0, 0
    return column


def _run(
    system: Network,
    tracking: np.ndarray,
    limits: tuple[float, float],
    setpoint: float,
    load: np.ndarray,
    late: bool,
    dt: float,
) -> tuple[np.ndarray, np.ndarray]:
    """Outputs (n, 2 N) at all instants, and the limited u. e enters where d_1 does; late: behind a dead time."""
    n, m = system.B.shape
    N = len(system.Co) // 2
    Phi, first, second = _ramps(system, tracking, dt)
    x, z = np.zeros(n), np.zeros((len(load) + 1, m))
    outputs, limited_u = np.empty((len(load), len(system.Co))), np.empty(len(load))
    v, arriving = np.zeros(system.E.shape[1]), np.zeros(m)
    v[0] = setpoint
    reach = system.theta / dt
    for k, d in enumerate(load.tolist()):
        if late:
            arriving[0] = d  # w_1 is the first of those behind a dead time
        else:
            v[1] = d
        w = _delayed(z, k, reach) + arriving
        o = system.Co @ x + system.Do @ w + system.Fo @ v
        outputs[k] = o
        limited_u[k] = min(max(o[N], limits[0]), limits[1])
        excess = limited_u[k] - o[N]
        z[k] = system.C @ x + system.D @ w + system.F @ v + system.F[:, 1] * excess
        if k + 1 == len(load):
            break
        w_next = _delayed(z, k + 1, reach, from_left=True) + arriving
        start = first @ np.concatenate([w, v, [excess]]) + Phi @ x
        known = np.concatenate([w_next, v, [excess]])  # v is held over the step
        o_next = system.Co @ (start + second @ known) + system.Do @ w_next + system.Fo @ v
        known[-1] = min(max(o_next[N], limits[0]), limits[1]) - o_next[N]
        x = start + second @ known
    return outputs, limited_u


def _delayed(z: np.ndarray, k: int, reach: np.ndarray, from_left: bool = False) -> np.ndarray:
    """z_i at (k - reach_i), linear between instants, 0 before the start, where from_left also means at the start."""
    found = np.zeros(len(reach))
    for i, back in enumerate(reach):
        at = k - back
        nearest = round(at)
        if abs(at - nearest) < ON_GRID:
            if nearest > 0 or (nearest == 0 and not from_left):
                found[i] = z[nearest, i]
        elif at > 0:
            j = int(at)
            found[i] = (1 - at + j) * z[j, i] + (at - j) * z[j + 1, i]
    return found


def _ramps(system: Network, tracking: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Phi, and what (w, v, e) at the start and at the end of a step add, all running linearly."""
    n = len(system.A)
    inputs = np.column_stack([system.B, system.E, system.E[:, 1] + tracking])
    first, second, Phi = np.empty_like(inputs), np.empty_like(inputs), np.eye(n)
    for j in range(inputs.shape[1]):
        Phi, first[:, j], second[:, j] = Linear(system.A, inputs[:, j], np.zeros((0, n)), np.zeros(0)).ramp(dt)
    return Phi, first, second
