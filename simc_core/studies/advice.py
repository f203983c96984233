"""Guards that speak: what to look at in a tuning, why, and one thing to do. Each rule is one function."""

import math
from dataclasses import dataclass

from simc_core.controllers.forms import Controller
from simc_core.errors import FormError
from simc_core.notation import number
from simc_core.plants.models import (
    FirstOrderDelay,
    IntegratingDelay,
    Model,
    OscillatingDelay,
    SecondOrderDelay,
    UnstableDelay,
)
from simc_core.reduction.records import LARGEST_MS, Reduction

GOOD_PM = 45.0  # degrees; what most would call a good phase margin
SLOW_LIMIT = 4.0  # Kc k' tau_I below it: slow oscillation [SK03 eq. 22]
HARD_A_THETA = 0.25  # Ms of the rule for unstable poles is 2.06 here, 4.62 at 0.4
SOLVED = 1e-6  # a loop designed for Ms = 2 has it to this
ROUNDING = 1e-9  # tau_I = 4 (tau_c + theta) gives Kc k' tau_I = 4 exactly, up to this


@dataclass(frozen=True, slots=True)
class Advice:
    """quantity with its value, the limit it is held against, what that means, and one thing to do about it.

    level: "warning" or "note".
    """

    level: str
    quantity: str
    limit: str
    text: str
    remedy: str


def advice(
    model: Model,
    controller: Controller,
    Ms: float,
    PM_deg: float,
    tau_c: float | None = None,
    reduction: Reduction | None = None,
) -> tuple[Advice, ...]:
    """All that apply, warnings first. Ms, PM_deg: of the loop round the full plant, nan where it is not stable."""
    found = [
        large_Ms(Ms),
        deceptive_PM(PM_deg, Ms),
        slow_oscillation(model, controller),
        hard_unstable_pole(model),
        faster_than_dead_time(model, tau_c),
        derivative_noise(controller),
        oscillating_disturbance(model),
        order_two(model, reduction),
    ]
    return tuple(sorted((item for item in found if item), key=lambda item: item.level, reverse=True))


def large_Ms(Ms: float) -> Advice | None:
    """Ms > 2."""
    if not Ms > LARGEST_MS * (1 + SOLVED):
        return None
    return Advice(
        "warning",
        f"Ms = {number(Ms, 3)}",
        f"Ms <= {LARGEST_MS:g}",
        "The loop comes too close to -1: it is sensitive to errors of the model and amplifies some disturbances.",
        "Increase tau_c.",
    )


def deceptive_PM(PM_deg: float, Ms: float) -> Advice | None:
    """A good phase margin with a bad Ms."""
    if not (PM_deg >= GOOD_PM and Ms > LARGEST_MS):
        return None
    return Advice(
        "warning",
        f"PM = {number(PM_deg, 3)} deg with Ms = {number(Ms, 3)}",
        f"Ms <= {LARGEST_MS:g}",
        "The phase margin looks good, but it is taken at one frequency only; L passes -1 closely at another one.",
        "Judge by Ms, not by the phase margin; increase tau_c.",
    )


def slow_oscillation(model: Model, controller: Controller) -> Advice | None:
    """Kc k' tau_I < 4 with tau_I < tau1: oscillation of period above 25 theta [SK98; SK03 eq. 22; SG12]."""
    match model:
        case IntegratingDelay():
            slope, tau1 = model.k_prime, math.inf
        case FirstOrderDelay() | SecondOrderDelay() if model.tau1:
            slope, tau1 = model.k / model.tau1, model.tau1
        case _:
            return None
    try:
        series = controller.to_series()
    except FormError:
        return None
    if series.tau_I >= tau1 or series.tau_I == math.inf:
        return None
    product = series.Kc * slope * series.tau_I
    if product >= SLOW_LIMIT * (1 - ROUNDING) or product < 0:
        return None
    return Advice(
        "warning",
        f"Kc k' tau_I = {number(product, 3)}",
        f"Kc k' tau_I >= {SLOW_LIMIT:g}",
        "The gain is too LOW for this much integral action: slow oscillation.",
        f"Raise Kc or tau_I until Kc tau_I >= {number(SLOW_LIMIT / abs(slope), 3)}.",
    )


def hard_unstable_pole(model: Model) -> Advice | None:
    """a theta near the end of the rule at 0.5 [SK98]: Ms 1.80, 2.06, 4.62 at a theta = 0.1, 0.25, 0.4."""
    if not isinstance(model, UnstableDelay) or model.a * model.theta < HARD_A_THETA:
        return None
    return Advice(
        "warning",
        f"a theta = {number(model.a * model.theta, 3)}",
        "a theta < 0.5",
        "The dead time is long for this unstable pole: the rule ends at 0.5, and Ms is large well before that.",
        "Shorten the dead time, or close a fast inner loop round the unstable part.",
    )


def faster_than_dead_time(model: Model, tau_c: float | None) -> Advice | None:
    """tau_c < theta."""
    if tau_c is None or tau_c >= model.theta * (1 - ROUNDING):
        return None
    return Advice(
        "note",
        f"tau_c = {number(tau_c, 3)}",
        f"tau_c >= theta = {number(model.theta, 3)}",
        "Faster than the tight setting of the rule: robustness is lost quickly for little speed.",
        "Take tau_c = theta unless Ms says that there is room.",
    )


def derivative_noise(controller: Controller) -> Advice | None:
    """Derivative action without a filter, or the noise gain Kd/tau_F with it."""
    form = controller.to_parallel()
    if not form.Kd:
        return None
    if form.tau_F:
        gain = abs(form.Kd) / form.tau_F
        times = f" ({number(gain / abs(form.Kp), 3)} times Kp)" if form.Kp else ""
        return Advice(
            "note",
            f"noise gain Kd/tau_F = {number(gain, 3)}",
            "what the actuator bears",
            f"Fast measurement noise reaches the input with this gain{times}.",
            "A larger tau_F lowers it; up to about tau_D/10 it costs little robustness.",
        )
    return Advice(
        "warning",
        "tau_F = 0 with derivative action",
        "tau_F > 0",
        "Without a filter the noise gain Kd/tau_F is infinite; no real controller has that.",
        f"Set tau_F, for instance tau_D/10 = {number(form.Kd / form.Kp / 10, 3)}." if form.Kp else "Set tau_F.",
    )


def oscillating_disturbance(model: Model) -> Advice | None:
    """The rule for oscillating models cancels the poles; an input disturbance still excites them."""
    if not isinstance(model, OscillatingDelay):
        return None
    return Advice(
        "note",
        f"zeta = {number(model.zeta, 3)}",
        "zeta near 1",
        "The controller cancels the oscillating poles: set-point steps are smooth, but disturbances at the plant input "
        "ring with the damping of the open plant.",
        "If such disturbances matter, damp the plant by an inner loop.",
    )


def order_two(model: Model, reduction: Reduction | None) -> Advice | None:
    """Whether derivative action pays: tau2 > theta of the second-order model."""
    if reduction is None or reduction.order_two_pays is None:
        return None
    of_order_two = isinstance(model, SecondOrderDelay) or (isinstance(model, IntegratingDelay) and model.tau2 > 0)
    if reduction.order_two_pays and not of_order_two:
        return Advice(
            "note",
            "PI",
            "tau2 <= theta",
            "The second-order model has tau2 > theta: derivative action pays.",
            "Try PID.",
        )
    if not reduction.order_two_pays and of_order_two:
        return Advice(
            "note", "PID", "tau2 > theta", "tau2 is not above theta: derivative action brings little.", "PI will do."
        )
    return None
