"""Two later forms of SIMC for k e^{-theta s}/(tau1 s + 1) and k' e^{-theta s}/s, in series form, q = tau_c + theta.

    improved SIMC, PI   SIMC with tau1 + theta/3 in place of tau1 [SG12]
    iSIMC, PID          Kc and tau_I of SIMC, tau_D = theta/3 [GS18]

The first is nearer to the optimum where dead time dominates; it turns pure integral action into a PI controller.
The second lets tau_c be as small as theta/2.
"""

from simc_core import checks
from simc_core.controllers.forms import SeriesPid
from simc_core.errors import OutOfDomain
from simc_core.plants.models import IntegratingDelay, Model
from simc_core.rules.domain import dead_time, first_order, kind_of
from simc_core.wording import said


def improved_simc(model: Model, kind: str = "PI", tau_c: float | None = None) -> SeriesPid:
    """Improved SIMC PI: Kc = (tau1 + theta/3)/(k q), tau_I = min(tau1 + theta/3, 4 q).

    tau_c > 0 in the user's time unit, by default theta. For k' e^{-theta s}/s it is SIMC. [SG12]
    """
    rule = said("improved SIMC")
    kind_of(kind, ("PI",), rule)
    k, theta, tau1 = _gain_delay_lag(model, rule)
    q = theta + (theta if tau_c is None else checks.positive_time("tau_c", tau_c))
    if tau1 is None:
        return SeriesPid(1 / (k * q), 4 * q)
    raised = tau1 + theta / 3
    return SeriesPid(raised / (k * q), min(raised, 4 * q))


def isimc(model: Model, kind: str = "PID", tau_c: float | None = None) -> SeriesPid:
    """iSIMC PID: Kc = tau1/(k q), tau_I = min(tau1, 4 q), tau_D = theta/3.

    tau_c > 0 in the user's time unit, by default theta/2. For pure dead time what is left is (tau_D s + 1)/(k q s),
    a PI controller. [GS18]
    """
    rule = said("iSIMC")
    kind_of(kind, ("PID",), rule)
    k, theta, tau1 = _gain_delay_lag(model, rule)
    q = theta + (theta / 2 if tau_c is None else checks.positive_time("tau_c", tau_c))
    tau_D = theta / 3
    if tau1 is None:
        return SeriesPid(1 / (k * q), 4 * q, tau_D)
    if tau1 == 0:
        return SeriesPid(tau_D / (k * q), tau_D)
    return SeriesPid(tau1 / (k * q), min(tau1, 4 * q), tau_D)


def _gain_delay_lag(model: Model, rule: str) -> tuple[float, float, float | None]:
    """k, theta, tau1 of a first-order model; k', theta, None of an integrating one."""
    if isinstance(model, IntegratingDelay):
        if model.tau2:
            raise OutOfDomain(said("tau2 must be 0 for the rule {rule}, found {tau2:g}", rule=rule, tau2=model.tau2))
        return model.k_prime, dead_time(model.theta, rule), None
    model = first_order(model, rule)
    return model.k, dead_time(model.theta, rule), model.tau1
