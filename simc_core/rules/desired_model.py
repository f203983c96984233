"""The desired model method: PI for k e^{-theta s}/(tau1 s + 1) by the overshoot that is wanted [V06].

    Kc = tau1/(beta k theta)     tau_I = tau1

The loop is e^{-theta s}/(beta theta s) whatever the plant. beta = e: the fastest without overshoot (a double real
pole); 1.944: 5 %; 2: SIMC with tau_c = theta.
"""

from simc_core import checks
from simc_core.controllers.forms import IdealPid
from simc_core.plants.models import Model
from simc_core.rules.domain import dead_time, kind_of, lag
from simc_core.wording import said


def desired_model(model: Model, kind: str = "PI", beta: float = 2.0) -> IdealPid:
    """PI settings of the module docstring; beta > 0 has no unit. [V06]"""
    rule = said("desired model")
    kind_of(kind, ("PI",), rule)
    model = lag(model, rule)
    beta = checks.real("beta", beta, 0.1, 1000.0)
    return IdealPid(model.tau1 / (beta * model.k * dead_time(model.theta, rule)), model.tau1)
