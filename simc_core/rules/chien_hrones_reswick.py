"""Chien, Hrones and Reswick 1952: for set points or loads, without or with 20 % overshoot [CHR52]. Ideal form.

    a = k theta/tau1 or k' theta        P        PI                    PID
    set point, 0 %                      0.3/a    0.35/a, 1.2 tau1      0.6/a, tau1, 0.5 theta
    set point, 20 %                     0.7/a    0.6/a, tau1           0.95/a, 1.4 tau1, 0.47 theta
    load, 0 %                           0.3/a    0.6/a, 4 theta        0.95/a, 2.4 theta, 0.42 theta
    load, 20 %                          0.7/a    0.7/a, 2.3 theta      1.2/a, 2 theta, 0.42 theta

tau_I of the set-point rules is a multiple of tau1, not of theta; they need a process that comes to rest.
"""

import math

from simc_core.controllers.forms import IdealPid
from simc_core.plants.models import Model
from simc_core.rules.domain import kind_of, lag, reaction_curve
from simc_core.wording import said

KINDS = ("P", "PI", "PID")


def chr_setpoint_0(model: Model, kind: str = "PI") -> IdealPid:
    """Set-point steps without overshoot. [CHR52]"""
    a, theta, tau1 = _lag_curve(model, kind, said("Chien-Hrones-Reswick, set point, 0 %"))
    return {
        "P": IdealPid(0.3 / a, math.inf),
        "PI": IdealPid(0.35 / a, 1.2 * tau1),
        "PID": IdealPid(0.6 / a, tau1, 0.5 * theta),
    }[kind]


def chr_setpoint_20(model: Model, kind: str = "PI") -> IdealPid:
    """Set-point steps with 20 % overshoot. [CHR52]"""
    a, theta, tau1 = _lag_curve(model, kind, said("Chien-Hrones-Reswick, set point, 20 %"))
    return {
        "P": IdealPid(0.7 / a, math.inf),
        "PI": IdealPid(0.6 / a, tau1),
        "PID": IdealPid(0.95 / a, 1.4 * tau1, 0.47 * theta),
    }[kind]


def chr_load_0(model: Model, kind: str = "PI") -> IdealPid:
    """Load steps without overshoot. [CHR52]"""
    a, theta = _curve(model, kind, said("Chien-Hrones-Reswick, load, 0 %"))
    return {
        "P": IdealPid(0.3 / a, math.inf),
        "PI": IdealPid(0.6 / a, 4 * theta),
        "PID": IdealPid(0.95 / a, 2.4 * theta, 0.42 * theta),
    }[kind]


def chr_load_20(model: Model, kind: str = "PI") -> IdealPid:
    """Load steps with 20 % overshoot. [CHR52]"""
    a, theta = _curve(model, kind, said("Chien-Hrones-Reswick, load, 20 %"))
    return {
        "P": IdealPid(0.7 / a, math.inf),
        "PI": IdealPid(0.7 / a, 2.3 * theta),
        "PID": IdealPid(1.2 / a, 2 * theta, 0.42 * theta),
    }[kind]


def _curve(model: Model, kind: str, rule: str) -> tuple[float, float]:
    kind_of(kind, KINDS, rule)
    a, theta, _ = reaction_curve(model, rule)
    return a, theta


def _lag_curve(model: Model, kind: str, rule: str) -> tuple[float, float, float]:
    tau1 = lag(model, rule).tau1
    return (*_curve(model, kind, rule), tau1)
