"""A closed loop whose OP was not written down: it is computed from PV, SP and the controller, where that is known."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from simc_core.algebra.recursion import first_order
from simc_core.controllers.forms import Controller, IController
from simc_core.errors import InvalidParameter, NotIdentifiable, WrongType
from simc_core.identification.trend import MOST_SAMPLES, Trend, check_trend
from simc_core.wording import said

Array = NDArray[np.float64]
PARTS = 4  # of the time from sample to sample, in which OP is held
COMPUTED = said(
    "OP was computed from PV, SP and the controller: that must have been in automatic, with these settings and within "
    "the limits of its output, throughout."
)


def op_of_controller(trend: Trend, controller: Controller) -> Trend:
    """The trend with OP as the controller made it of PV and SP.

    u = [Kp (b r - y) + Ki int (r - y) dt + Kd d(c r - y)/dt]/(tau_F s + 1), y straight between its samples, r held; its
    level is not known, and no model depends on it.

    Parameters
    ----------
    trend : Trend
        With SP; its own u is not used.
    controller : controller
        That was in the loop, in any form, in the units of the trend.

    Returns
    -------
    Trend
        With u at instants of its own; its notes say what it rests on.

    Raises
    ------
    NotIdentifiable
        SP is missing or never moves: the loop was not excited, and OP would only show the controller.
    InvalidParameter
        A controller with derivative action but no filter for records that are not evenly spaced, or too many samples.

    Examples
    --------
    P control with Kc = 2: a step of SP moves OP by 2, and PV takes it back. In the last quarter of the last second PV
    is 0.4375 on the mean:

    >>> from simc_core import IdealPid, Trend, op_of_controller
    >>> record = Trend([0, 1, 2, 3], [0, 0, 0, 0.5], [0, 0, 0, 0], r=[0, 1, 1, 1])
    >>> found = op_of_controller(record, IdealPid(2.0, float("inf")))
    >>> float(found.u[0]), float(found.u[4]), float(found.u[-1])
    (0.0, 2.0, 1.125)
    """
    trend = check_trend(trend)
    if not isinstance(controller, Controller):
        raise WrongType(said("controller must be a controller, found {found}", found=type(controller).__name__))
    if trend.r is None or np.ptp(trend.r) == 0:
        raise NotIdentifiable(
            said(
                "OP is not in the record and the set point never moves: nothing excites the loop, so that PV and the "
                "controller tell nothing of the process. Move the set point, or log OP."
            )
        )
    if PARTS * trend.t.size > MOST_SAMPLES:
        raise InvalidParameter(
            said("The record may have {most} samples, found {found}", most=MOST_SAMPLES // PARTS, found=trend.t.size)
        )
    Kp, Ki, Kd, tau_F, b, c = _parallel(controller)
    steps = np.diff(trend.t)
    positive = steps[steps > 0]
    uneven = np.ptp(positive) > 0.01 * float(np.median(positive))
    if Kd and not tau_F and uneven:
        raise InvalidParameter(
            said("tau_F must be > 0 where the derivative of an unevenly spaced record is taken, found 0")
        )
    share = (np.arange(PARTS) + 0.5) / PARTS  # middles of the parts
    r = trend.r[:-1, None]
    y = trend.y[:-1, None] + share * np.diff(trend.y)[:, None]
    h = steps[:, None]
    level = trend.y[:-1, None] + share / 2 * np.diff(trend.y)[:, None]  # mean of y from the sample on
    begun = np.concatenate([[0.0], np.cumsum(steps * (trend.r[:-1] - (trend.y[:-1] + trend.y[1:]) / 2))])[:-1, None]
    slope = np.diff(trend.y)[:, None] / np.where(h > 0, h, np.inf)
    u = Kp * (b * r - y) + Ki * (begun + share * h * (r - level)) - Kd * slope
    u = u.ravel()
    at = (trend.t[:-1, None] + np.arange(PARTS) / PARTS * h).ravel()
    if Kd and c:  # a jump of c r gives an impulse, held for the first part; the filter spreads it
        jump = np.concatenate([[0.0], np.diff(trend.r)])[:-1]
        u.reshape(-1, PARTS)[:, 0] += Kd * c * jump * PARTS / np.where(steps > 0, steps, np.inf)
    if tau_F:
        u = _filtered(u, np.repeat(steps / PARTS, PARTS), tau_F)
    kept = np.repeat(steps > 0, PARTS)
    names = {**trend.names, "u": said("OP, computed")}
    units = {name: unit for name, unit in trend.units.items() if name != "u"}
    return replace(trend, u=u[kept], t_u=at[kept], names=names, units=units, notes=(*trend.notes, COMPUTED))


def _parallel(controller: Controller) -> tuple[float, float, float, float, float, float]:
    if isinstance(controller, IController):
        return 0.0, controller.K_I, 0.0, 0.0, 1.0, 0.0
    form = controller.to_parallel()
    return form.Kp, form.Ki, form.Kd, form.tau_F, form.b, form.c


def _filtered(u: Array, h: Array, tau: float) -> Array:
    """1/(tau s + 1) of a held signal, at rest at first; the mean over each of the times h."""
    if np.ptp(h) <= 1e-6 * float(h.mean()):
        a = float(np.exp(-h[0] / tau))
        moved = (1 - a) * first_order(u - u[0], a)
        state = u[0] + np.append(0.0, moved[:-1])
    else:
        state, now = np.empty(u.size), float(u[0])
        for i, (value, step) in enumerate(zip(u.tolist(), h.tolist(), strict=True)):
            state[i] = now
            now = value + (now - value) * float(np.exp(-step / tau))
    left = np.where(h > 0, -np.expm1(-h / tau) * tau / np.where(h > 0, h, 1.0), 1.0)
    return u + (state - u) * left
