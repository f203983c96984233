"""Calmer or bolder settings than those of Ziegler and Nichols, from the same ultimate point. All in ideal form.

Tyreus-Luyben [TL92]      PI Ku/3.2, 2.2 Pu     PID Ku/2.2, 2.2 Pu, Pu/6.3     for lag-dominant, integrating loops
Pessen integral rule      PID 0.7 Ku, 0.4 Pu, 0.15 Pu
some overshoot            PID Ku/3, Pu/2, Pu/3
no overshoot              PID Ku/5, Pu/2, Pu/3
"""

from simc_core.controllers.forms import IdealPid
from simc_core.plants.ultimate_point import Ultimate
from simc_core.rules.domain import kind_of
from simc_core.wording import said


def tyreus_luyben(point: Ultimate, kind: str = "PI") -> IdealPid:
    """For integrating and lag-dominant processes. [TL92]"""
    kind_of(kind, ("PI", "PID"), said("Tyreus-Luyben"))
    Ku, Pu = point.Ku, point.Pu
    return IdealPid(Ku / 3.2, 2.2 * Pu) if kind == "PI" else IdealPid(Ku / 2.2, 2.2 * Pu, Pu / 6.3)


def pessen(point: Ultimate, kind: str = "PID") -> IdealPid:
    """Pessen's integral rule: bolder than Ziegler and Nichols in all three actions."""
    kind_of(kind, ("PID",), said("Pessen"))
    return IdealPid(0.7 * point.Ku, 0.4 * point.Pu, 0.15 * point.Pu)


def some_overshoot(point: Ultimate, kind: str = "PID") -> IdealPid:
    """Ziegler-Nichols times, a third of the ultimate gain."""
    kind_of(kind, ("PID",), "some overshoot")
    return IdealPid(point.Ku / 3, point.Pu / 2, point.Pu / 3)


def no_overshoot(point: Ultimate, kind: str = "PID") -> IdealPid:
    """As `some_overshoot`, with a fifth of the ultimate gain. The name is the rule's own and no promise."""
    kind_of(kind, ("PID",), "no overshoot")
    return IdealPid(point.Ku / 5, point.Pu / 2, point.Pu / 3)
