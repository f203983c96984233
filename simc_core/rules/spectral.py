"""Pole cancelling: the zeros of the controller are the slow poles of the model, and Ki is free. Series form.

    C(s) = Ki (T1 s + 1)(T2 s + 1)/s:   Kc = Ki T1,  tau_I = T1,  tau_D = T2,   so that G C = k Ki e^{-theta s}/s

In parallel form Kp = Ki (T1 + T2) and Kd = Ki T1 T2; the quotient T1 T2/(T1 + T2), printed for Kd in places, is tau_D
of the ideal form.
"""

from simc_core import checks
from simc_core.controllers.forms import SeriesPid
from simc_core.errors import OutOfDomain
from simc_core.plants.models import Model, SecondOrderDelay
from simc_core.rules.domain import dead_time, in_words, kind_of, lag
from simc_core.wording import said


def spectral(model: Model, kind: str = "PI", Ki: float | None = None) -> SeriesPid:
    """Settings of the module docstring. Ki in input units per output unit and time; by default 1/(2 k theta)."""
    rule = said("pole cancelling")
    kind_of(kind, ("PI", "PID"), rule)
    if kind == "PID":
        if not isinstance(model, SecondOrderDelay):
            raise OutOfDomain(
                said(
                    "model must be a second-order one with dead time for the rule {rule}, found {model}",
                    rule=rule,
                    model=in_words(model),
                )
            )
        k, T1, T2 = model.k, model.tau1, model.tau2
        if T1 == 0:
            raise OutOfDomain(said("tau1 must be > 0 for the rule {rule}, found 0", rule=rule))
    else:
        first = lag(model, rule)
        k, T1, T2 = first.k, first.tau1, 0.0
    if Ki is None:
        Ki = 1 / (2 * k * dead_time(model.theta, rule))
    Ki = checks.gain("Ki", Ki)
    return SeriesPid(Ki * T1, T1, T2)
