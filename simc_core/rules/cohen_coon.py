"""Cohen and Coon 1953: a decay of 1/4 and the load error as small as that leaves it [CC53]. Ideal form.

    a = k theta/tau1, r = theta/tau1
    P     (1 + r/3)/a
    PI    (0.9 + r/12)/a      tau_I = theta (30 + 3 r)/(9 + 20 r)
    PD    (1.25 + r/6)/a                                             tau_D = theta (6 - 2 r)/(22 + 3 r)
    PID   (4/3 + r/4)/a       tau_I = theta (32 + 6 r)/(13 + 8 r)    tau_D = 4 theta/(11 + 2 r)

In circulation and wrong: 1.1 in place of 0.9 for PI, and tau_I without its theta.
"""

import math

from simc_core.controllers.forms import IdealPid
from simc_core.plants.models import Model
from simc_core.rules.domain import kind_of, positive, reaction_curve
from simc_core.wording import said

KINDS = ("P", "PI", "PD", "PID")


def cohen_coon(model: Model, kind: str = "PI") -> IdealPid:
    """Settings of the module docstring. Recommended: theta/tau1 < 1. [CC53]"""
    rule = said("Cohen-Coon")
    kind_of(kind, KINDS, rule)
    a, theta, r = reaction_curve(model, rule)
    match kind:
        case "P":
            return IdealPid((1 + r / 3) / a, math.inf)
        case "PI":
            return IdealPid((0.9 + r / 12) / a, theta * (30 + 3 * r) / (9 + 20 * r))
        case "PD":
            tau_D = positive("tau_D", theta * (6 - 2 * r) / (22 + 3 * r), rule)
            return IdealPid((1.25 + r / 6) / a, math.inf, tau_D)
        case _:
            return IdealPid((4 / 3 + r / 4) / a, theta * (32 + 6 * r) / (13 + 8 * r), 4 * theta / (11 + 2 * r))
