"""AMIGO: fits to settings with Ms = 1.4 that reject loads best, over a large set of processes [AH04].

PI    Kc = 0.15/k + (0.35 - theta tau1/(theta + tau1)^2) tau1/(k theta)
      tau_I = 0.35 theta + 13 theta tau1^2/(tau1^2 + 12 theta tau1 + 7 theta^2)
PID   Kc = (0.2 + 0.45 tau1/theta)/k
      tau_I = theta (0.4 theta + 0.8 tau1)/(theta + 0.1 tau1)
      tau_D = 0.5 theta tau1/(0.3 theta + tau1)
integrating, a = k' theta    PI 0.35/a, 13.4 theta     PID 0.45/a, 8 theta, 0.5 theta
"""

from simc_core.controllers.forms import IdealPid
from simc_core.plants.models import IntegratingDelay, Model
from simc_core.rules.domain import dead_time, first_order, kind_of, reaction_curve
from simc_core.wording import said


def amigo(model: Model, kind: str = "PI") -> IdealPid:
    """PI or PID settings, ideal form. Recommended for PID: theta/(theta + tau1) > 0.3. [AH04]"""
    rule = said("AMIGO")
    kind_of(kind, ("PI", "PID"), rule)
    if isinstance(model, IntegratingDelay):
        a, theta, _ = reaction_curve(model, rule)
        return IdealPid(0.35 / a, 13.4 * theta) if kind == "PI" else IdealPid(0.45 / a, 8 * theta, 0.5 * theta)
    model = first_order(model, rule)
    k, theta, tau1 = model.k, dead_time(model.theta, rule), model.tau1
    if kind == "PI":
        Kc = 0.15 / k + (0.35 - theta * tau1 / (theta + tau1) ** 2) * tau1 / (k * theta)
        tau_I = 0.35 * theta + 13 * theta * tau1**2 / (tau1**2 + 12 * theta * tau1 + 7 * theta**2)
        return IdealPid(Kc, tau_I)
    Kc = (0.2 + 0.45 * tau1 / theta) / k
    tau_I = theta * (0.4 * theta + 0.8 * tau1) / (theta + 0.1 * tau1)
    return IdealPid(Kc, tau_I, 0.5 * theta * tau1 / (0.3 * theta + tau1))
