"""Fits to the smallest IAE or ITAE of k e^{-theta s}/(tau1 s + 1), r = theta/tau1 from 0.1 to 1. Ideal form.

    loads [M67]        k Kc = A r^B    tau1/tau_I = C r^D      tau_D/tau1 = E r^F
    set points [R69]   k Kc = A r^B    tau1/tau_I = C + D r    tau_D/tau1 = E r^F

The fits hold for no robustness in particular: IAE for loads gives Ms of 3 to 4. Those for set points have no setting
where C + D r <= 0.
"""

from simc_core.controllers.forms import IdealPid
from simc_core.errors import OutOfDomain
from simc_core.plants.models import Model
from simc_core.rules.domain import dead_time, kind_of, lag
from simc_core.wording import said

LOAD = {  # A, B, C, D, E, F
    ("IAE", "PI"): (0.984, -0.986, 0.608, -0.707, 0.0, 0.0),
    ("IAE", "PID"): (1.435, -0.921, 0.878, -0.749, 0.482, 1.137),
    ("ITAE", "PI"): (0.859, -0.977, 0.674, -0.680, 0.0, 0.0),
    ("ITAE", "PID"): (1.357, -0.947, 0.842, -0.738, 0.381, 0.995),
}
SET_POINT = {
    ("IAE", "PI"): (0.758, -0.861, 1.02, -0.323, 0.0, 0.0),
    ("IAE", "PID"): (1.086, -0.869, 0.74, -0.13, 0.348, 0.914),
    ("ITAE", "PI"): (0.586, -0.916, 1.03, -0.165, 0.0, 0.0),
    ("ITAE", "PID"): (0.965, -0.855, 0.796, -0.147, 0.308, 0.929),
}

LOAD_NAMES = {"IAE": said("IAE, load"), "ITAE": said("ITAE, load")}
SET_POINT_NAMES = {"IAE": said("IAE, set point"), "ITAE": said("ITAE, set point")}


def iae_load(model: Model, kind: str = "PI") -> IdealPid:
    """Smallest IAE after a load step. [M67]"""
    return _load(model, "IAE", kind)


def itae_load(model: Model, kind: str = "PI") -> IdealPid:
    """Smallest ITAE after a load step. [M67]"""
    return _load(model, "ITAE", kind)


def iae_setpoint(model: Model, kind: str = "PI") -> IdealPid:
    """Smallest IAE after a set-point step. [R69]"""
    return _set_point(model, "IAE", kind)


def itae_setpoint(model: Model, kind: str = "PI") -> IdealPid:
    """Smallest ITAE after a set-point step. [R69]"""
    return _set_point(model, "ITAE", kind)


def _load(model: Model, criterion: str, kind: str) -> IdealPid:
    k, r, tau1 = _model(model, kind, LOAD_NAMES[criterion])
    A, B, C, D, E, F = LOAD[criterion, kind]
    return IdealPid(A * r**B / k, tau1 / (C * r**D), E * tau1 * r**F)


def _set_point(model: Model, criterion: str, kind: str) -> IdealPid:
    rule = SET_POINT_NAMES[criterion]
    k, r, tau1 = _model(model, kind, rule)
    A, B, C, D, E, F = SET_POINT[criterion, kind]
    if C + D * r <= 0:
        raise OutOfDomain(
            said(
                "theta/tau1 must be < {limit:.3g} for the rule {rule}, found {ratio:.4g}: tau_I would be negative",
                limit=-C / D,
                rule=rule,
                ratio=r,
            )
        )
    return IdealPid(A * r**B / k, tau1 / (C + D * r), E * tau1 * r**F)


def _model(model: Model, kind: str, rule: str) -> tuple[float, float, float]:
    kind_of(kind, ("PI", "PID"), rule)
    model = lag(model, rule)
    return model.k, dead_time(model.theta, rule) / model.tau1, model.tau1
