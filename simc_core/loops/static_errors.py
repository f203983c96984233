"""What is left of the error in the long run, from the lowest powers of s: exact, by the type of the loop.

L ~ K/s^type,   G ~ k/s^n,   C ~ Kp + Ki/s + Kd s        (s -> 0)

set point, feedback on the error     step X: X/(1+K), 0, 0      ramp V t: inf, V/K, 0      t^2/2: inf, inf, 1/K
load with integral action            step: 0                    ramp: 1/Ki
integral of the error                load: 1/Ki = tau_I/Kc      set point: see `_setpoint_integral`
"""

import math
from dataclasses import dataclass

from simc_core.controllers.forms import ParallelPid
from simc_core.loops.loop import Loop


@dataclass(frozen=True, slots=True)
class StaticErrors:
    """Errors of a stable loop as time goes on; math.inf where they grow without end.

    Attributes
    ----------
    type : int
        Of L ~ K/s^type at low frequencies.
    K : float
        Of the same, in 1/(time unit)^type.
    step, ramp, parabola : float
        r - y after a set point of 1, t, t^2/2 with b = c = 1, in output units.
    load_step, load_ramp : float
        y after a load of 1, t, in output units.
    IE_setpoint : float
        int (r - y) after a unit step, b and c as they are, in output units and time.
    IE_load : float
        int y after a unit step of the load, tau_I/Kc, in output units and time.
    """

    type: int
    K: float
    step: float
    ramp: float
    parabola: float
    load_step: float
    load_ramp: float
    IE_setpoint: float
    IE_load: float


def static_errors(loop: Loop) -> StaticErrors:
    """Errors in the long run, by the type of the loop.

    Parameters
    ----------
    loop : Loop
        A stable loop; whether it is stable is not tested here.

    Returns
    -------
    StaticErrors
        In units of the output, and of output times time.

    Examples
    --------
    SIMC lags tau_c + theta behind a ramp of the set point, here 2, and its load error is tau_I/Kc:

    >>> from simc_core import Loop, Plant, SeriesPid, static_errors
    >>> found = static_errors(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)))
    >>> found.type, found.ramp, found.IE_load
    (1, 2.0, 2.0)
    """
    plant, form = loop.plant, loop.controller.to_parallel()
    n, k = plant.integrators, plant.k
    lowest, power = next(
        ((gain, power) for gain, power in ((form.Ki, 1), (form.Kp, 0), (form.Kd, -1)) if gain), (0.0, 0)
    )
    type_, K = n + power, k * lowest
    step, ramp, parabola = (_left(type_, K, order) for order in range(3))
    return StaticErrors(
        type_,
        K,
        step,
        ramp,
        parabola,
        load_step=_load_step(n, k, form),
        load_ramp=1 / form.Ki if form.Ki else math.inf,
        IE_setpoint=_setpoint_integral(n, k, form),
        IE_load=1 / form.Ki if form.Ki else math.inf,
    )


def _left(type_: int, K: float, order: int) -> float:
    """lim s S/s^(order + 1)."""
    if type_ > order:
        return 0.0
    if type_ < order:
        return math.inf
    return 1 / (1 + K) if order == 0 else 1 / K


def _load_step(n: int, k: float, form: ParallelPid) -> float:
    """lim G/(1 + G C)."""
    if form.Ki:
        return 0.0
    if n == 0:
        return k / (1 + k * form.Kp)
    return 1 / form.Kp if form.Kp else math.inf


def _setpoint_integral(n: int, k: float, form: ParallelPid) -> float:
    """lim (1 + G (C - C_r))/(s (1 + G C)), C - C_r = Kp (1 - b) + Kd (1 - c) s."""
    lagging = form.Kp * (1 - form.b)
    if form.Ki:
        return ((n == 0) + k * lagging) / (k * form.Ki)
    if n == 0 or lagging or not form.Kp:
        return math.inf
    return ((n == 1) + k * form.Kd * (1 - form.c) * (n == 1)) / (k * form.Kp)
