"""Guards that speak: what to look at in a tuning, why, and one thing to do, as a change of the design that was tried.

Each guard is one function of the design; making its change ends it.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from simc_core.controllers.forms import Controller, IController, IdealPid, SeriesPid
from simc_core.errors import SimcError
from simc_core.metrics.performance import performance
from simc_core.notation import number
from simc_core.plants.models import (
    DoubleIntegratingDelay,
    Model,
    OscillatingDelay,
    UnstableDelay,
)
from simc_core.plants.plant import Plant
from simc_core.plants.step_response import rise_time
from simc_core.reduction.equal_peak import load_error
from simc_core.reduction.explanation import of_orders
from simc_core.reduction.records import LARGEST_MS
from simc_core.studies.bands import exceeds
from simc_core.studies.remedies import FILTERS, calmer, filter_that_costs_little, tight
from simc_core.studies.tuned import Tuned
from simc_core.wording import joined, said

GOOD_PM = 45.0  # degrees; what most would call a good phase margin
SLOW_INTEGRATING = 8.0  # tau_c/theta of the "moderate" choice [V06 eq. 7]; an integrating plant has no time of its own
HARD_A_THETA = 0.25  # Ms of the rule for unstable poles is 2.06 here, 4.62 at 0.4
LIMIT_ROUNDING = 1e-9  # tau_c = theta is at the limit, up to this
LARGE_OVERSHOOT = 0.2  # of a set-point step
WEIGHTS = (0.7, 0.5, 0.3, 0.2, 0.0)  # set-point weights that are tried
LEVELS = ("error", "warning", "note")
NOT_STABLE = said("The loop is not stable, so it has neither margins nor IAE.")
FRAGILE = said("L passes close to -1: small errors of the model can make the loop unstable.")
UNFILTERED = said("The derivative has no filter: measurement noise passes without limit.")
UNSTABLE = said("Not stable")
BY_MODEL = {
    DoubleIntegratingDelay: said("Two integrators need derivative action: the rule for this plant is a PID."),
    OscillatingDelay: said("The rule for an oscillating plant is a PID, in ideal form."),
}


@dataclass(frozen=True, slots=True)
class Advice:
    """One thing to look at.

    level: one of LEVELS.   quantity: its name; value: its number, nan where it has none.   limit: what it is held
    against, nan where there is nothing of the kind; at_least: which side of the limit is the good one.
    text: what that means.   remedy: what to do, in words.   change: the same as a change of the design, {} where no
    setting helps.
    """

    level: str
    quantity: str
    text: str
    value: float = math.nan
    limit: float = math.nan
    at_least: bool = False
    remedy: str = ""
    change: dict[str, Any] = field(default_factory=dict)

    @property
    def headline(self) -> str:
        """Quantity, value and limit, as "Ms = 2.31, should be at most 2"."""
        if math.isnan(self.value):
            return self.quantity
        value, limit = number(self.value, 3), number(self.limit, 3)
        if math.isnan(self.limit):
            return said("{quantity} = {value}", quantity=self.quantity, value=value)
        if self.at_least:
            return said(
                "{quantity} = {value}, should be at least {limit}", quantity=self.quantity, value=value, limit=limit
            )
        return said("{quantity} = {value}, should be at most {limit}", quantity=self.quantity, value=value, limit=limit)


def advice(of: Tuned) -> tuple[Advice, ...]:
    """All that applies to a design, the gravest first."""
    found = [item for guard in GUARDS if (item := guard(of))]
    return tuple(sorted(found, key=lambda item: LEVELS.index(item.level)))


def not_stable(of: Tuned) -> Advice | None:
    """No stable loop."""
    if of.margins.stable:
        return None
    change, gives = calmer(of)
    return Advice("error", UNSTABLE, NOT_STABLE, remedy=_calmed(of, change, gives), change=change)


def large_Ms(of: Tuned) -> Advice | None:
    """Ms > 2."""
    Ms, PM = of.margins.Ms, of.margins.PM_deg
    if math.isnan(Ms) or not exceeds(Ms, LARGEST_MS):
        return None
    text = [FRAGILE]
    if PM >= GOOD_PM:
        text.append(
            said("The phase margin ({PM} deg) hides it: it looks at one frequency only.", PM=number(PM, 3)),
        )
    if isinstance(of.model, UnstableDelay) and of.model.a * of.model.theta >= HARD_A_THETA:
        product = number(of.model.a * of.model.theta, 3)
        text.append(said("The dead time is long for this pole: a theta = {product}, limit 0.5.", product=product))
    change, gives = calmer(of)
    remedy = _calmed(of, change, gives)
    return Advice("warning", "Ms", joined(text, " "), Ms, LARGEST_MS, remedy=remedy, change=change)


def faster_than_dead_time(of: Tuned) -> Advice | None:
    """tau_c shorter than the rule has it, where that costs robustness."""
    usual, tau_c, change = of.usual_tau_c, of.tau_c, tight(of)
    if not of.model.theta or tau_c >= usual * (1 - LIMIT_ROUNDING) or not of.margins.stable:
        return None
    calm = of.at(usual).margins.Ms
    if not calm < of.margins.Ms:
        return None
    name = "theta/2" if of.rule == "isimc" else "theta"
    text = said(
        "This is faster than the tight setting tau_c = {tight}. Ms is {Ms}, with tau_c = {tight} it is {calm}.",
        tight=name,
        Ms=number(of.margins.Ms, 3),
        calm=number(calm, 3),
    )
    return Advice("note", "tau_c", text, tau_c, usual, True, said("Take tau_c = {tau_c}.", tau_c=name), change)


def slower_than_plant(of: Tuned) -> Advice | None:
    """The closed loop slower than the plant is without a controller; for integrating plants, slower than usual."""
    if isinstance(of.model, UnstableDelay):
        return None
    limit = slowest_useful(of.plant, of.model)
    if not of.tau_c > limit * (1 + LIMIT_ROUNDING):
        return None
    if of.plant.integrators:
        worse = load_error(of.controller) / load_error(of.at(of.model.theta).controller)
        text = said("Sluggish: the load error tau_I/Kc is {times} times that of tau_c = theta.", times=number(worse, 3))
    else:
        text = said(
            "Sluggish: set-point steps take longer than a step of the plant without a controller, "
            "which reaches 63 % after {time}.",
            time=number(rise_time(of.plant), 3),
        )
    remedy = said("Take tau_c = {tau_c}, or less.", tau_c=number(limit, 4))
    return Advice("note", "tau_c", text, of.tau_c, limit, remedy=remedy, change={"tau_c": limit})


def slowest_useful(plant: Plant, model: Model) -> float:
    """The largest tau_c with which the loop is not slower than the plant alone, and theta at least.

    The loop reaches 63 % after theta + tau_c. An integrating plant has no time of its own: 8 theta [V06 eq. 7].
    """
    theta = model.theta
    if plant.integrators:
        return SLOW_INTEGRATING * theta or math.inf
    return max(rise_time(plant) - theta, theta) or math.inf


def derivative_noise(of: Tuned) -> Advice | None:
    """Derivative action without a filter, or the high-frequency gain Kd/tau_F with it."""
    form = of.controller.to_parallel()
    if not form.Kd:
        return None
    if form.tau_F:
        gain = abs(form.Kd) / form.tau_F
        text = said("Fast measurement noise reaches the input with this gain. A larger tau_F lowers it.")
        if form.Kp:
            text = said(
                "Fast measurement noise reaches the input with this gain, {times} times Kp. A larger tau_F lowers it.",
                times=number(gain / abs(form.Kp), 3),
            )
        return Advice("note", said("High-frequency gain Kd/tau_F"), text, gain)
    change, Ms = filter_that_costs_little(of)
    if not change:
        least = number(FILTERS[-1])
        remedy = said("A filter of {ratio} tau_D already makes the loop fragile: do without D.", ratio=least)
        if isinstance(of.model, OscillatingDelay):
            remedy = said(
                "A filter of {ratio} tau_D already makes the loop fragile: damp the plant by an inner loop.",
                ratio=least,
            )
        return Advice("warning", "tau_F = 0", UNFILTERED, remedy=remedy)
    assert isinstance(of.controller, SeriesPid | IdealPid)  # SIMC with derivative action
    ratio, tau_F = number(change["filter"]), number(change["filter"] * of.controller.tau_D, 3)
    remedy = said("Set tau_F/tau_D = {ratio}, tau_F = {tau_F}.", ratio=ratio, tau_F=tau_F)
    if math.isfinite(Ms):
        remedy = said(
            "Set tau_F/tau_D = {ratio}, tau_F = {tau_F}: Ms becomes {Ms}.", ratio=ratio, tau_F=tau_F, Ms=number(Ms, 3)
        )
    return Advice("warning", "tau_F = 0", UNFILTERED, remedy=remedy, change=change)


def oscillating_plant(of: Tuned) -> Advice | None:
    """The rule for oscillating models cancels the poles: nothing damps them."""
    if not isinstance(of.model, OscillatingDelay):
        return None
    text = said(
        "The controller cancels the oscillating poles and does not damp them. D acts on the measurement, "
        "so both set-point steps and disturbances at the plant input ring with the damping of the open plant."
    )
    return Advice("note", "zeta", text, of.model.zeta, remedy=said("If that matters, damp the plant by an inner loop."))


def order_two(of: Tuned) -> Advice | None:
    """Whether derivative action pays, by the load errors at equal Ms."""
    orders = of.reduction.orders
    if orders is None or math.isnan(orders.ratio) or of.rule != "simc":
        return None
    derivative = delivered(of.controller) == "PID"
    if orders.second_pays and of.order == 1:
        return Advice("note", "PI", of_orders(orders), remedy=said("Take PID."), change={"order": 2})
    if not orders.second_pays and of.order == 2 and derivative:
        return Advice("note", "PID", of_orders(orders), remedy=said("PI will do."), change={"order": 1})
    return None


def other_than_chosen(of: Tuned) -> Advice | None:
    """PI chosen and PID delivered, or the reverse."""
    chosen, got = ("PI", "PID")[of.order - 1], delivered(of.controller)
    if chosen == got or of.rule != "simc":
        return None
    quantity = said("{chosen} chosen, {delivered} delivered", chosen=chosen, delivered=got)
    if got == "I":
        text = said("The model is pure dead time: its SIMC controller is a pure integrator, K_I/s.")
        return Advice("note", quantity, text)
    if got == "PID":
        text = BY_MODEL[type(of.model)]
        remedy = said("Choose PID; the settings stay as they are.")
        return Advice("note", quantity, text, remedy=remedy, change={"order": 2})
    text = said("The model has no second lag: tau_D = 0, and the controller is a PI.")
    return Advice("note", quantity, text, remedy=said("Choose PI."), change={"order": 1})


def set_point_overshoot(of: Tuned) -> Advice | None:
    """The overshoot that integral action behind an integrator must have, and the set-point weight that takes it off."""
    if not of.plant.integrators or of.choices["b"] != 1 or not of.margins.stable:
        return None
    now = _overshoot(of)
    if not now > LARGE_OVERSHOOT:
        return None
    for b in WEIGHTS:
        less = _overshoot(of.changed(b=b))
        if less <= LARGE_OVERSHOOT / 2:
            break
    else:
        return None
    text = said(
        "Behind an integrator, integral action with b = 1 overshoots after a step of the set point at any speed."
    )
    remedy = said(
        "Take b = {b}: {overshoot} %, and margins and the load response stay.",
        b=number(b),
        overshoot=number(100 * less, 3),
    )
    quantity, limit = said("Overshoot [%]"), 100 * LARGE_OVERSHOOT
    return Advice("note", quantity, text, 100 * now, limit, remedy=remedy, change={"b": b})


def _overshoot(of: Tuned) -> float:
    try:
        return performance(of.loop).setpoint.overshoot
    except SimcError:
        return math.nan


GUARDS: tuple[Callable[[Tuned], Advice | None], ...] = (
    not_stable,
    large_Ms,
    derivative_noise,
    faster_than_dead_time,
    slower_than_plant,
    order_two,
    other_than_chosen,
    oscillating_plant,
    set_point_overshoot,
)


def delivered(controller: Controller) -> str:
    """What the controller is: I, PI or PID."""
    if isinstance(controller, IController):
        return "I"
    return "PID" if controller.derivative else "PI"


def in_words(change: dict[str, Any]) -> str:
    """A change of the design as an order, as "Take tau_c = 9"."""
    parts: list[str] = []
    if "order" in change:
        parts.append(("PI", "PID")[change["order"] - 1])
    if "tau_c" in change:
        parts.append(equation("tau_c", "theta" if change["tau_c"] is None else number(change["tau_c"], 4)))
    if "filter" in change:
        parts.append(equation("tau_F/tau_D", number(change["filter"])))
    parts += [equation(name, number(change[name], 4)) for name in ("h", "r", "d", "b") if name in change]
    return said("Take {what}", what=joined(parts, said(" with ")))


def equation(name: str, value: str) -> str:
    """One setting, as "tau_c = 9", in which a number may have another decimal sign."""
    return joined((name, value), " = ")


def _calmed(of: Tuned, change: dict[str, Any], gives: str) -> str:
    """The remedy that `calmer` found, and what it gives; or that there is none."""
    if change:
        return said("{order}: {gives}.", order=in_words(change), gives=gives)
    if isinstance(of.model, UnstableDelay):
        return said("Shorten the dead time, or close a fast inner loop around the unstable part (cascade).")
    return said("No SIMC setting of this plant was found with Ms of at most 2.")
