"""Lee, Park, Lee and Brosilow 1998: PID whose closed loop comes near e^{-theta s}/(lambda_ s + 1) [LPLB98].

t = tau1 + theta^2/(2 (lambda_ + theta))
Kc = t/(k (lambda_ + theta))     tau_I = t     tau_D = theta^2/(6 (lambda_ + theta)) (3 - theta/t)
"""

from simc_core import checks
from simc_core.controllers.forms import IdealPid
from simc_core.plants.models import Model
from simc_core.rules.domain import dead_time, first_order, kind_of, positive
from simc_core.wording import said


def lee_1998(model: Model, kind: str = "PID", lambda_: float | None = None) -> IdealPid:
    """PID settings in ideal form; lambda_ > 0 in the user's time unit, by default theta. [LPLB98]"""
    rule = said("Lee et al. 1998")
    kind_of(kind, ("PID",), rule)
    model = first_order(model, rule)
    k, theta, tau1 = model.k, dead_time(model.theta, rule), model.tau1
    q = theta + checks.positive_time("lambda_", theta if lambda_ is None else lambda_)
    t = tau1 + theta**2 / (2 * q)
    tau_D = theta**2 / (6 * q) * (3 - theta / t)
    return IdealPid(t / (k * q), t, positive("tau_D", tau_D, rule))
