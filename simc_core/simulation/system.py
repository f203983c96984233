"""The closed loop with its dead time pulled out.

    x' = A x + B w + E v        z = C x + D w + F v        w(t) = z(t - theta)
    o  = Co x + Do w + Fo v     o = (y, u),  v = (r, d),  z = u + d

x holds the states of the plant (without its dead time), the integral and, for tau_F > 0, the filter. The controller is
taken in its parallel form, so that the set-point weights apply as in controllers.py:

    tau_F = 0   u = Kp (b r - y) + xi - Kd y'               xi' = Ki (r - y),  y' = Cp (Ap xp + Bp w)
    tau_F > 0   u = xf + (Kd/tau_F) (c r - y)               tau_F xf' = -xf + xi + Kp (b r - y) - (Kd/tau_F) (c r - y)

For theta = 0 the algebraic loop w = z is solved and w is gone: B, C, D have no columns or rows left.
"""

from dataclasses import dataclass

import numpy as np

from simc_core.controllers import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loop import Loop
from simc_core.realisation import chain

WELL_POSED = 1e-12  # |1 + L(inf)| of a loop without dead time


@dataclass(frozen=True, slots=True, eq=False)
class DelaySystem:
    """Matrices of the module docstring. A (n, n), B (n, m), C (m, n), D (m, m), E (n, 2), F (m, 2), Co (2, n), ...

    m is 1, or 0 where there is no dead time.
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    E: np.ndarray
    F: np.ndarray
    Co: np.ndarray
    Do: np.ndarray
    Fo: np.ndarray
    theta: float


def closed_loop(loop: Loop) -> DelaySystem:
    """The loop as a DelaySystem.

    Raises InvalidParameter: unfiltered derivative action where y or r may jump, an algebraic loop without solution.
    """
    form = loop.controller.to_parallel()
    Ap, Bp, Cp, Dp = chain(loop.plant.factored)
    n = len(Bp)
    filtered, integral = form.tau_F > 0, form.Ki != 0
    size = n + integral + filtered
    y, y_w = np.zeros(size), Dp
    y[:n] = Cp
    A, B, E = np.zeros((size, size)), np.zeros(size), np.zeros((size, 2))
    A[:n, :n], B[:n] = Ap, Bp
    xi = np.zeros(size)
    if integral:
        A[n], B[n], E[n, 0] = -form.Ki * y, -form.Ki * y_w, form.Ki
        xi[n] = 1.0
    if filtered:
        kick, f = form.Kd / form.tau_F, size - 1
        A[f] = (xi - (form.Kp - kick) * y) / form.tau_F
        A[f, f] -= 1 / form.tau_F
        B[f] = -(form.Kp - kick) * y_w / form.tau_F
        E[f, 0] = (form.Kp * form.b - kick * form.c) / form.tau_F
        u, u_w, u_r = -kick * y, -kick * y_w, kick * form.c
        u[f] += 1.0
    else:
        _check_derivative(form, Dp)
        u, u_w, u_r = xi - form.Kp * y, -form.Kp * y_w, form.Kp * form.b
        u[:n] -= form.Kd * (Cp @ Ap)
        u_w -= form.Kd * (Cp @ Bp)
    outputs, through, direct = np.array([y, u]), np.array([[y_w], [u_w]]), np.array([[0.0, 0.0], [u_r, 0.0]])
    system = DelaySystem(
        A, B[:, None], u[None], np.array([[u_w]]), E, np.array([[u_r, 1.0]]), outputs, through, direct, loop.plant.theta
    )
    return system if system.theta else _without_delay(system)


def _check_derivative(form: ParallelPid, Dp: float) -> None:
    if form.Kd and Dp:
        raise InvalidParameter(
            f"tau_F must be > 0 for derivative action on a plant whose response starts with a jump, got {form.tau_F:g}"
        )
    if form.Kd and form.c:
        raise InvalidParameter(
            f"tau_F must be > 0 where the derivative acts on the set point (c > 0), got {form.tau_F:g}"
        )


def _without_delay(system: DelaySystem) -> DelaySystem:
    """w = z solved for w = (C x + F v)/(1 - D)."""
    rest = 1 - system.D[0, 0]
    if abs(rest) < WELL_POSED:
        raise InvalidParameter("1 + L(inf) must not be zero in a loop without dead time, got 0: u is not defined")
    C, F = system.C / rest, system.F / rest
    return DelaySystem(
        system.A + system.B @ C,
        np.zeros((len(system.A), 0)),
        np.zeros((0, len(system.A))),
        np.zeros((0, 0)),
        system.E + system.B @ F,
        np.zeros((0, 2)),
        system.Co + system.Do @ C,
        np.zeros((2, 0)),
        system.Fo + system.Do @ F,
        0.0,
    )
