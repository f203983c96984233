"""Internal model control, Rivera, Morari and Skogestad 1986. Ideal form; epsilon is the closed-loop time constant.

    k e^{-theta s}/(tau1 s + 1)  [RMS86 Table II]                                                    recommended
    PID          Kc = (2 tau1 + theta)/(k (2 eps + theta))   tau_I = tau1 + theta/2                  eps > 0.8 theta
                                                             tau_D = tau1 theta/(2 tau1 + theta)
    PI           Kc = tau1/(k eps)                           tau_I = tau1                            eps > 1.7 theta
    improved PI  Kc = (2 tau1 + theta)/(2 k eps)             tau_I = tau1 + theta/2                  eps > 1.7 theta

PI and PID besides: eps > 0.1 tau1. In circulation and wrong: improved PI with theta/4.

Without dead time the loop is y/ys exactly [RMS86 Table I]; f = 1/(eps s + 1), g = (2 eps s + 1)/(eps s + 1)^2:

    k/(tau s + 1)                            k Kc = tau/eps          tau_I = tau                       y/ys = f
    k/((t1 s + 1)(t2 s + 1))                 (t1 + t2)/eps           t1 + t2, t1 t2/(t1 + t2)          f
    k/(tau^2 s^2 + 2 zeta tau s + 1)         2 zeta tau/eps          2 zeta tau, tau/(2 zeta)          f
    the same with zero 1 - beta s            2 zeta tau/(2 beta + eps), tau_F = beta eps/(2 beta + eps)
                                                                         f (1 - beta s)/(1 + beta s)
        without the all-pass                 2 zeta tau/(beta + eps)                                   f (1 - beta s)
    k/s                                      1/eps                                                     f
        for ramps                            2/eps                   2 eps                             g
    k/(s (tau s + 1))                        1/eps                   -, tau                            f
        for ramps                            (2 eps + tau)/eps^2     2 eps + tau, 2 eps tau/(2 eps + tau)   g
    k (1 - beta s)/s                         1/(2 beta + eps), tau_F = beta eps/(2 beta + eps)
                                                                         f (1 - beta s)/(1 + beta s)
        for ramps                            (2 eps + beta)/(eps + beta)^2       2 eps + beta
                                                     (1 - beta s)((2 eps + beta) s + 1)/(eps s + 1)^2
"""

import math

from simc_core import checks
from simc_core.controllers.forms import IdealPid
from simc_core.errors import OutOfDomain
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.rules.domain import dead_time, first_order, kind_of, lag
from simc_core.wording import said

PI_EPSILON, PID_EPSILON = 1.7, 0.8  # times theta: the smallest that is recommended, and what is taken by default


def imc_1986(model: Model, kind: str = "PI", epsilon: float | None = None) -> IdealPid:
    """PI or PID of Table II; epsilon > 0 in the user's time unit, by default 1.7 theta, PID 0.8 theta. [RMS86]"""
    rule = said("IMC 1986")
    kind_of(kind, ("PI", "PID"), rule)
    if kind == "PI":
        model = lag(model, rule)
        eps = _epsilon(model.theta, epsilon, PI_EPSILON, rule)
        return IdealPid(model.tau1 / (model.k * eps), model.tau1)
    model = first_order(model, rule)
    theta, twice = model.theta, 2 * model.tau1 + model.theta
    eps = _epsilon(theta, epsilon, PID_EPSILON, rule)
    return IdealPid(twice / (model.k * (2 * eps + theta)), twice / 2, model.tau1 * theta / twice)


def imc_1986_improved(model: Model, kind: str = "PI", epsilon: float | None = None) -> IdealPid:
    """Improved PI of Table II; epsilon > 0 in the user's time unit, by default 1.7 theta. [RMS86]"""
    rule = said("IMC 1986, improved PI")
    kind_of(kind, ("PI",), rule)
    model = first_order(model, rule)
    twice = 2 * model.tau1 + model.theta
    return IdealPid(twice / (2 * model.k * _epsilon(model.theta, epsilon, PI_EPSILON, rule)), twice / 2)


def imc_without_delay(plant: Plant, epsilon: float, ramp: bool = False, all_pass: bool = True) -> IdealPid:
    """Settings of Table I.

    Parameters
    ----------
    plant : Plant
        One of the table; its dead time is 0.
    epsilon : float
        Closed-loop time constant, > 0, in the user's time unit.
    ramp : bool
        Follow ramps of the set point without offset, and reject steps of the load; integrating plants only.
    all_pass : bool
        Where there is a zero 1 - beta s: mirror it into the poles of the closed loop, which takes a filter. False is
        for oscillating plants only.

    Returns
    -------
    IdealPid

    Raises
    ------
    OutOfDomain
        For a plant that is not in the table.

    References
    ----------
    [RMS86 Table I]
    """
    eps = checks.positive_time("epsilon", epsilon)
    beta, order = _zero(plant), (plant.integrators, len(plant.lags), len(plant.lag_pairs))
    if not all_pass and (order != (0, 0, 1) or not beta):
        raise OutOfDomain(
            said("all_pass must be True but for an oscillating plant with a zero 1 - beta s, found False")
        )
    if ramp and not plant.integrators:
        raise OutOfDomain(said("ramp must be False for a plant without integrator, found True"))
    times = sorted(plant.lags)
    match (*order, bool(beta), ramp):
        case (0, 1, 0, False, _):
            Kc, tau_I, tau_D, tau_F = times[0] / eps, times[0], 0.0, 0.0
        case (0, 2, 0, False, _):
            total = sum(times)
            Kc, tau_I, tau_D, tau_F = total / eps, total, times[0] * times[1] / total, 0.0
        case (0, 0, 1, _, _):
            tau, zeta = plant.lag_pairs[0]
            if zeta <= 0:
                raise OutOfDomain(said("zeta must be > 0 for the rule IMC 1986, found {zeta:g}", zeta=zeta))
            below = eps + (2 if all_pass else 1) * beta
            Kc, tau_I, tau_D = 2 * zeta * tau / below, 2 * zeta * tau, tau / (2 * zeta)
            tau_F = beta * eps / below if all_pass else 0.0
        case (1, 0, 0, False, False):
            Kc, tau_I, tau_D, tau_F = 1 / eps, math.inf, 0.0, 0.0
        case (1, 0, 0, False, True):
            Kc, tau_I, tau_D, tau_F = 2 / eps, 2 * eps, 0.0, 0.0
        case (1, 1, 0, False, False):
            Kc, tau_I, tau_D, tau_F = 1 / eps, math.inf, times[0], 0.0
        case (1, 1, 0, False, True):
            total = 2 * eps + times[0]
            Kc, tau_I, tau_D, tau_F = total / eps**2, total, 2 * eps * times[0] / total, 0.0
        case (1, 0, 0, True, False):
            Kc, tau_I, tau_D, tau_F = 1 / (2 * beta + eps), math.inf, 0.0, beta * eps / (2 * beta + eps)
        case (1, 0, 0, True, True):
            Kc, tau_I, tau_D, tau_F = (2 * eps + beta) / (eps + beta) ** 2, 2 * eps + beta, 0.0, 0.0
        case _:
            raise OutOfDomain(
                said(
                    "plant must be one of Table I of IMC 1986, found {kind} of order {order}",
                    kind=plant.kind,
                    order=plant.order,
                )
            )
    return IdealPid(Kc / plant.k, tau_I, tau_D, tau_F)


def _zero(plant: Plant) -> float:
    """beta of a zero 1 - beta s, 0 if there is none."""
    if plant.theta or plant.unstable_poles or plant.lead_pairs or any(T > 0 for T in plant.leads[:1]):
        raise OutOfDomain(
            said("plant must have no dead time, no unstable pole and no zero but 1 - beta s for IMC 1986")
        )
    if len(plant.leads) > 1:
        raise OutOfDomain(said("plant must have at most one zero for IMC 1986, found {n}", n=len(plant.leads)))
    return -plant.leads[0] if plant.leads else 0.0


def _epsilon(theta: float, epsilon: float | None, default: float, rule: str) -> float:
    if epsilon is None:
        return default * dead_time(theta, rule)
    return checks.positive_time("epsilon", epsilon)
