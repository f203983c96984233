"""Plants, controllers and loops to and from python-control and scipy.signal.

Neither library knows dead time in a linear system, so going out means an approximation, and its order is always given:

    e^{-theta s} ~ Pade(n, n)       pade_order = n; needed where theta > 0, ignored where theta = 0

Coming in, theta is told apart from the rational part: `plant_from(system, theta)`; a Pade factor inside `system`
stays what it is, a rational function. State spaces are chains of sections of order two, as products of the plant's own
factors: one polynomial of order 12 has lost its small time constants to rounding.

This module alone imports python-control (2 s); `simc_core` does not import it.
"""

from typing import TypeAlias

import control
import numpy as np
from scipy import signal

from simc_core import checks
from simc_core.algebra.factors import Factored
from simc_core.controllers.forms import Controller, ParallelPid
from simc_core.errors import FormError, InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.loops.well_posed import require_well_posed
from simc_core.plants.plant import Plant
from simc_core.wording import said

HIGHEST_PADE = 20  # beyond it the coefficients of the approximation itself are rounding
RATIONAL = (control.TransferFunction, control.StateSpace, signal.lti)
NEGLIGIBLE = 1e-11  # of the fastest pole: an integrator that rounding moved
INFINITE = 1e9  # times the fastest pole: a zero that rounding brought in from infinity

System: TypeAlias = control.TransferFunction | control.StateSpace | signal.lti


def to_tf(system: Plant | Controller, pade_order: int | None = None) -> control.TransferFunction:
    """`system` as one transfer function of python-control. Raises InvalidParameter: theta > 0 without pade_order."""
    form = system.factored
    num, den = form.gain * _product(form.num), _product(form.den)
    if form.theta:
        delay = control.pade(form.theta, _order(form.theta, pade_order))
        num, den = np.polymul(num, delay[0]), np.polymul(den, delay[1])
    return control.tf(num, den)


def to_ss(system: Plant | Controller, pade_order: int | None = None) -> control.StateSpace:
    """`system` as a state space of python-control; the states of the Pade approximation come last.

    Raises InvalidParameter: theta > 0 without pade_order. FormError: derivative action without a filter.
    """
    form = system.factored
    if form.relative_degree < 0:
        raise FormError(said("tau_F must be > 0 for derivative action in a state space, found 0"))
    parts = [control.ss([], [], [], [[form.gain]])]
    parts += [control.tf2ss(num, den) for num, den in _sections(form)]
    if form.theta:
        parts.append(control.tf2ss(*control.pade(form.theta, _order(form.theta, pade_order))))
    return control.series(*parts)


def to_scipy(system: Plant | Controller, pade_order: int | None = None) -> signal.ZerosPolesGain:
    """`system` as zeros, poles and gain of scipy.signal, which has .to_tf() and .to_ss() for the other forms.

    Raises InvalidParameter: theta > 0 without pade_order.
    """
    form = system.factored
    zeros, poles = form.zeros, form.poles
    gain = form.gain * np.prod(_leading(form.num)) / np.prod(_leading(form.den))
    if form.theta:
        num, den = control.pade(form.theta, _order(form.theta, pade_order))
        zeros, poles = np.append(zeros, np.roots(num)), np.append(poles, np.roots(den))
        gain *= num[0] / den[0]
    return signal.ZerosPolesGain(zeros, poles, gain)


def plant_from(system: System, theta: float = 0.0) -> Plant:
    """The rational `system` of python-control or scipy.signal, one input and one output, with dead time theta.

    Raises InvalidParameter: another kind of object, more inputs or outputs, discrete time, what Plant refuses.
    """
    num, den = _polynomials(system)
    return Plant.from_polynomials(num, den, theta)


def controller_from(system: System) -> ParallelPid:
    """(Kd s^2 + Kp s + Ki)/(s (tau_F s + 1)) in `system` as a controller.

    Raises FormError where `system` is not of this shape; InvalidParameter as plant_from does.
    """
    num, den = _polynomials(system)
    degrees = f"degree {len(num) - 1} over degree {len(den) - 1}"
    if den[-1] == 0:
        integral = den[:-1]
    else:  # no integral action: Ki = 0
        num, integral = np.append(num, 0.0), den
    if len(num) > 3 or len(integral) > 2 or integral[-1] == 0:
        raise FormError(
            said("a PID controller is (Kd s^2 + Kp s + Ki)/(s (tau_F s + 1)), found {degrees}", degrees=degrees)
        )
    Kd, Kp, Ki = np.concatenate([np.zeros(3 - len(num)), num]) / integral[-1]
    tau_F = integral[0] / integral[-1] if len(integral) == 2 else 0.0
    return ParallelPid(float(Kp), float(Ki), float(Kd), float(tau_F))


def closed_loop(loop: Loop, pade_order: int | None = None) -> control.StateSpace:
    """The loop as one state space: inputs r, d, outputs y, u; signs as in loop.py.

    Derivative action without a filter takes y' from the plant's states, which needs a plant that has inertia.
    Raises InvalidParameter: theta > 0 without pade_order; a loop that is not well-posed. FormError: y' does not exist
    (a plant without inertia, or c > 0 without a filter).
    """
    plant, form = to_ss(loop.plant, pade_order), loop.controller.to_parallel()
    A, B, C, D = (np.asarray(matrix, dtype=float) for matrix in (plant.A, plant.B, plant.C, plant.D))
    if form.tau_F == 0 and form.Kd and (D.any() or form.c):
        raise FormError(said("tau_F must be > 0 for derivative action on a signal that may jump, found 0"))
    # measured: y and y' of the plant, driven by u + d; the regulator turns r, y and y' into u
    Ar, Br, Cr, Dr = _filtered(form) if form.tau_F else _unfiltered(form)
    C, D = np.vstack([C, C @ A]), np.vstack([D, C @ B])
    into_u, from_y = Dr[:, :1], Dr[:, 1:]
    # u = Cr xr + into_u r + from_y (C x + D (u + d)), solved for u; from_y holds zero where y' is not used
    gain = 1.0 - float((from_y @ D)[0, 0])
    require_well_posed(gain)
    K = np.hstack([from_y @ C, Cr]) / gain
    F = np.hstack([into_u, from_y @ D]) / gain
    load = np.array([[0.0, 1.0]])
    y = np.hstack([C, np.zeros((2, len(Ar)))]) + D @ K
    through = D @ (F + load)
    zeros = np.zeros((len(A), len(Ar)))
    return control.ss(
        np.block([[A, zeros], [zeros.T, Ar]]) + np.vstack([B @ K, Br[:, 1:] @ y]),
        np.vstack([B @ (F + load), Br[:, 1:] @ through + Br[:, :1] @ np.array([[1.0, 0.0]])]),
        np.vstack([y[:1], K]),
        np.vstack([through[:1], F]),
        inputs=["r", "d"],
        outputs=["y", "u"],
    )


def _unfiltered(form: ParallelPid) -> tuple[np.ndarray, ...]:
    """A, B, C, D from (r, y, y') to u: xi' = r - y, u = Kp (b r - y) + Ki xi - Kd y'."""
    direct = np.array([[form.b * form.Kp, -form.Kp, -form.Kd]])
    return np.zeros((1, 1)), np.array([[1.0, -1.0, 0.0]]), np.array([[form.Ki]]), direct


def _filtered(form: ParallelPid) -> tuple[np.ndarray, ...]:
    """A, B, C, D from (r, y, y') to u: (tau_F s^2 + s) u = (n2 s^2 + n1 s + n0) (r, y), observer form; y' unused."""
    n2, n1, n0 = (
        np.array([[weight * gain, -gain, 0.0]]) / form.tau_F
        for weight, gain in ((form.c, form.Kd), (form.b, form.Kp), (1.0, form.Ki))
    )
    A = np.array([[-1 / form.tau_F, 1.0], [0.0, 0.0]])
    return A, np.vstack([n1 - n2 / form.tau_F, n0]), np.array([[1.0, 0.0]]), n2


def _order(theta: float, pade_order: int | None) -> int:
    if pade_order is None:
        raise InvalidParameter(said("pade_order must be given where theta = {theta:g} > 0, found None", theta=theta))
    return checks.whole("pade_order", pade_order, 1, HIGHEST_PADE)


def _polynomials(system: System) -> tuple[np.ndarray, np.ndarray]:
    """Numerator and denominator, descending powers, leading coefficients that are only rounding removed."""
    if not isinstance(system, RATIONAL):
        raise InvalidParameter(
            said(
                "system must be of control.TransferFunction, StateSpace or scipy.signal.lti, found {what}",
                what=type(system).__name__,
            )
        )
    if isinstance(system, signal.lti):
        form = system.to_tf()
        num, den = np.atleast_1d(form.num), np.array(form.den)
        if num.ndim != 1:
            raise InvalidParameter(said("system must have one input and one output, found {n} outputs", n=len(num)))
    else:
        if not system.issiso():
            raise InvalidParameter(
                said(
                    "system must have one input and one output, found {ninputs} and {noutputs}",
                    ninputs=system.ninputs,
                    noutputs=system.noutputs,
                )
            )
        if system.isdtime(strict=True):
            raise InvalidParameter(
                said("system must be in continuous time, found a sampling period of {dt}", dt=system.dt)
            )
        form = control.tf(system)
        num, den = form.num[0][0], np.array(form.den[0][0])
    num, den = (np.trim_zeros(np.real(np.asarray(each)), "f") for each in (num, den))
    fastest = np.max(np.abs(np.roots(den)), initial=0.0)
    while fastest and len(num) > 1 and abs(num[0]) * fastest * INFINITE <= abs(num[1]):
        num = num[1:]
    if len(den) > 1 and 0 < abs(den[-1]) <= NEGLIGIBLE * fastest * abs(den[-2]):
        den[-1] = 0.0
    return num, den


def _row(row: np.ndarray) -> np.ndarray:
    """A factor without its leading zeros."""
    return np.trim_zeros(row, "f")


def _leading(rows: np.ndarray) -> list[float]:
    return [float(_row(row)[0]) for row in rows]


def _product(rows: np.ndarray) -> np.ndarray:
    total = np.ones(1)
    for row in rows:
        total = np.polymul(total, _row(row))
    return total


def _sections(form: Factored) -> list[tuple[np.ndarray, np.ndarray]]:
    """Numerator and denominator of proper sections, order at most two, whose product is form / gain."""
    nums, dens = _second_order(form.num), _second_order(form.den)
    sections = []
    for den in dens:  # quadratics first in both lists, so that no numerator outgrows its denominator
        num = nums.pop(0) if nums and len(nums[0]) <= len(den) else np.ones(1)
        sections.append((num, den))
    return sections


def _second_order(rows: np.ndarray) -> list[np.ndarray]:
    """Factors of degree two, then at most one of degree one; neighbouring time constants go together."""
    polynomials = [_row(row) for row in rows]
    quadratic = [each for each in polynomials if len(each) == 3]
    linear = sorted(
        (each for each in polynomials if len(each) == 2), key=lambda each: abs(each[0] / (each[1] or np.inf))
    )
    quadratic += [np.polymul(a, b) for a, b in zip(linear[::2], linear[1::2], strict=False)]
    return quadratic + ([linear[-1]] if len(linear) % 2 else [])
