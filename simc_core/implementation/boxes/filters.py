"""A filter on the whole controller, as the design has it, or on the derivative only, as most boxes have it. Exact.

    whole           (Kp + Ki/s + Kd s)/(tau_F s + 1)
    derivative      Kp' + Ki/s + Kd' s/(Tf s + 1)
    same poles and zeros with   Tf = tau_F    Kp' = Kp - Ki tau_F    Kd' = Kd - Kp' tau_F

The set-point weights b, c of the one and b', c' of the other then are

    b Kp = b' Kp' + Ki Tf       c Kd = b' Kp' Tf + c' Kd'.
"""

import math
from dataclasses import dataclass

from simc_core.controllers.forms import ParallelPid


@dataclass(frozen=True, slots=True)
class DerivativeFiltered:
    """Kp + Ki/s + Kd s/(Tf s + 1); b, c weigh the set point in its first and last term."""

    Kp: float
    Ki: float
    Kd: float
    Tf: float
    b: float
    c: float


def derivative_filtered(whole: ParallelPid) -> DerivativeFiltered | None:
    """The same controller with its filter on the derivative only; None where Kp or Kd would change its sign.

    b and c may come out below 0, where the box has nothing of the kind.
    """
    tau_F = whole.tau_F
    Kp = whole.Kp - whole.Ki * tau_F
    Kd = whole.Kd - Kp * tau_F
    if tau_F and (Kp * whole.Kp <= 0 or Kd * whole.Kp < 0):
        return None
    b = (whole.b * whole.Kp - whole.Ki * tau_F) / Kp if Kp else whole.b
    c = (whole.c * whole.Kd - b * Kp * tau_F) / Kd if Kd else whole.c
    return DerivativeFiltered(Kp, whole.Ki, Kd, tau_F, b, c)


def unfiltered(whole: ParallelPid) -> DerivativeFiltered:
    """The controller without its filter."""
    return DerivativeFiltered(whole.Kp, whole.Ki, whole.Kd, 0.0, whole.b, whole.c)


def whole_filtered(own: DerivativeFiltered) -> ParallelPid:
    """The same controller with its filter on the whole, the set-point response included."""
    if own.Tf == 0 or own.Kd == 0:  # without derivative action its filter filters nothing
        return ParallelPid(own.Kp, own.Ki, own.Kd, 0.0, own.b, own.c)
    Kp, Kd = own.Kp + own.Ki * own.Tf, own.Kd + own.Kp * own.Tf
    b = (own.b * own.Kp + own.Ki * own.Tf) / Kp if Kp else own.b
    c = (own.b * own.Kp * own.Tf + own.c * own.Kd) / Kd if Kd else own.c
    return ParallelPid(Kp, own.Ki, Kd, own.Tf, b, c)


def fixed_ratio_filter(design: ParallelPid, N: float) -> float | None:
    """tau_F with which the box of Tf = Td/N keeps Ki and the zeros of `design`; None where there is none.

    tau_F = (tau_I/2) (1 - sqrt(1 - 4 tau_D/((N + 1) tau_I))), tau_D/(N + 1) without integral action.
    """
    tau_D = design.Kd / design.Kp
    root = 1 - 4 * tau_D * design.Ki / design.Kp / (N + 1)
    return None if root < 0 else 2 * tau_D / (N + 1) / (1 + math.sqrt(root))
