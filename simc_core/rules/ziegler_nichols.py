"""The two rules of Ziegler and Nichols [ZN42], made for a decay of 1/4 from one peak to the next.

    step response, a = k theta/tau1 or k' theta     P 1/a     PI 0.9/a, theta/0.3     PID 1.2/a, 2 theta, theta/2
    ultimate point                                  P Ku/2    PI 0.45 Ku, Pu/1.2      PID 0.6 Ku, Pu/2, Pu/8

They were made for the tangent at the steepest point of a step response; with another model, as that of the half rule,
they are other settings. Taken as series settings the PID would get 1.25 times the gain: they are ideal ones.
"""

import math

from simc_core.controllers.forms import IdealPid
from simc_core.plants.models import Model
from simc_core.plants.ultimate_point import Ultimate
from simc_core.rules.domain import kind_of, reaction_curve
from simc_core.wording import said

KINDS = ("P", "PI", "PID")


def zn_step(model: Model, kind: str = "PI") -> IdealPid:
    """Settings from the step response. Recommended: theta/tau1 between 0.1 and 1. [ZN42]"""
    rule = said("Ziegler-Nichols, step response")
    kind_of(kind, KINDS, rule)
    a, theta, _ = reaction_curve(model, rule)
    return {
        "P": IdealPid(1 / a, math.inf),
        "PI": IdealPid(0.9 / a, theta / 0.3),
        "PID": IdealPid(1.2 / a, 2 * theta, theta / 2),
    }[kind]


def zn_ultimate(point: Ultimate, kind: str = "PI") -> IdealPid:
    """Settings from the ultimate point. [ZN42]"""
    kind_of(kind, KINDS, said("Ziegler-Nichols, ultimate point"))
    Ku, Pu = point.Ku, point.Pu
    return {
        "P": IdealPid(0.5 * Ku, math.inf),
        "PI": IdealPid(0.45 * Ku, Pu / 1.2),
        "PID": IdealPid(0.6 * Ku, Pu / 2, Pu / 8),
    }[kind]
