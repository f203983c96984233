"""Lambda tuning: PI with a closed-loop time constant lambda_, as in paper mills.

    k e^{-theta s}/(tau1 s + 1)   Kc = tau1/(k (lambda_ + theta))                       tau_I = tau1
    k' e^{-theta s}/s             Kc = (2 lambda_ + theta)/(k' (lambda_ + theta)^2)     tau_I = 2 lambda_ + theta

Usual choices: tau1 to 3 tau1 for a lag, 3 theta for an integrating process.
"""

from simc_core import checks
from simc_core.controllers.forms import IdealPid
from simc_core.errors import OutOfDomain
from simc_core.plants.models import IntegratingDelay, Model
from simc_core.rules.domain import dead_time, kind_of, lag
from simc_core.wording import said


def lambda_tuning(model: Model, kind: str = "PI", lambda_: float | None = None) -> IdealPid:
    """PI settings of the module docstring; lambda_ > 0 in the user's time unit, by default tau1, or 3 theta."""
    rule = said("Lambda")
    kind_of(kind, ("PI",), rule)
    if isinstance(model, IntegratingDelay):
        if model.tau2:
            raise OutOfDomain(said("tau2 must be 0 for the rule {rule}, found {tau2:g}", rule=rule, tau2=model.tau2))
        if lambda_ is None:
            lambda_ = 3 * dead_time(model.theta, rule)
        time = checks.positive_time("lambda_", lambda_)
        tau_I = 2 * time + model.theta
        return IdealPid(tau_I / (model.k_prime * (time + model.theta) ** 2), tau_I)
    model = lag(model, rule)
    time = checks.positive_time("lambda_", model.tau1 if lambda_ is None else lambda_)
    return IdealPid(model.tau1 / (model.k * (time + model.theta)), model.tau1)
