"""From a plant and what was chosen to the SIMC loop round the full plant; where the rule ends, what to do instead."""

from dataclasses import dataclass
from functools import lru_cache
from inspect import signature
from typing import Any

from simc_core.controllers.forms import Controller
from simc_core.errors import InvalidParameter, OutOfDomain, RuleEnds, SimcError
from simc_core.loops.loop import Loop
from simc_core.notation import number
from simc_core.plants.models import Model, UnstableDelay
from simc_core.plants.plant import Plant
from simc_core.reduction.half_rule import half_rule
from simc_core.reduction.records import Reduction
from simc_core.rules.simc import A_THETA_LIMIT
from simc_core.rules.simc_family import settings_of, usual_tau_c
from simc_core.rules.speed import tau_c_in_use
from simc_core.sensitivity.margins import margins
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.wording import joined, said


@dataclass(frozen=True, slots=True, eq=False)
class Tuned:
    """A SIMC design.

    choices: what was chosen, by the names of `tuned`.   tau_c: in use.   margins: of the loop round the full plant.
    """

    plant: Plant
    choices: dict[str, Any]
    reduction: Reduction
    tau_c: float
    loop: Loop
    margins: Margins

    @property
    def order(self) -> int:
        """Order asked of the model."""
        return self.choices["order"]

    @property
    def rule(self) -> str:
        """Which of SIMC and its later forms."""
        return self.choices["rule"]

    @property
    def usual_tau_c(self) -> float:
        """tau_c that the rule takes where none is given."""
        return usual_tau_c(self.rule, self.model)

    @property
    def model(self) -> Model:
        """The reduced model."""
        return self.reduction.model

    @property
    def controller(self) -> Controller:
        """The controller, with set-point weight and derivative filter."""
        return self.loop.controller

    def at(self, tau_c: float) -> "Tuned":
        """The same model tuned at another tau_c."""
        return _closed(self.plant, {**self.choices, "tau_c": tau_c}, self.reduction)

    def changed(self, **change: object) -> "Tuned":
        """The design with other choices. Raises SimcError."""
        return tuned(self.plant, **{**self.choices, **change})


def tuned(
    plant: Plant,
    order: int = 1,
    h: float = 0.0,
    tau_c: float | None = None,
    b: float = 1.0,
    filter: float = 0.0,
    rules: str = "2003",
    speed: str = "",
    tau_F: float = 0.0,
    rule: str = "simc",
) -> Tuned:
    """Reduce, tune, close the loop, judge it.

    Parameters
    ----------
    plant : Plant
        The full plant.
    order, h, rules, tau_F
        Of the reduction, as in `half_rule`.
    tau_c : float, optional
        Closed-loop time constant; None for `speed`. The rule of an unstable pole knows theta alone.
    b : float
        Set-point weight.
    filter : float
        tau_F/tau_D, 0 for no filter.
    speed : str
        tau_c as a choice that follows the model, "1.5theta" or "moderate"; "" for the rule's own.
    rule : str
        "simc", or "improved_simc" or "isimc", which take the first-order model whatever the order.

    Raises
    ------
    RuleEnds
        Where SIMC has no setting for the model; says why, and holds the changes that do work.
    SimcError
        Where there is no model, or a number is out of bounds.
    """
    choices = {"order": order, "h": h, "tau_c": tau_c, "b": b, "filter": filter, "rules": rules, "speed": speed}
    choices["tau_F"] = tau_F
    choices["rule"] = rule
    reduction = reduced(plant, order if rule == "simc" else 1, h, rules, tau_F)
    try:
        return _closed(plant, choices, reduction)
    except OutOfDomain as error:
        raise RuleEnds(said("{error}; take SIMC itself", error=str(error)), {"rule": "simc"}) from error
    except InvalidParameter as error:
        if isinstance(reduction.model, UnstableDelay):
            raise _no_setting(plant, choices, reduction.model, str(error)) from error
        raise


USUAL: dict[str, Any] = {name: each.default for name, each in signature(tuned).parameters.items() if name != "plant"}


def _closed(plant: Plant, choices: dict[str, Any], reduction: Reduction) -> Tuned:
    model = reduction.model
    tau_c = tau_c_in_use(model, choices["tau_c"], choices["speed"], choices["rule"])
    loop = Loop(
        plant, settings_of(choices["rule"], model, tau_c).with_filter(choices["filter"]).with_weight(choices["b"])
    )
    return Tuned(plant, choices, reduction, tau_c, loop, margins(loop))


def _no_setting(plant: Plant, choices: dict[str, Any], model: UnstableDelay, error: str) -> RuleEnds:
    """Why the rule of an unstable pole ends here, and the order that has a setting, if the other one has."""
    if model.theta == 0:
        return RuleEnds(
            said(
                "theta must be > 0 for the SIMC rule of an unstable pole, found 0: the gain would be without limit; "
                "enter the dead time or the lag of the actuator as part of the plant"
            )
        )
    product = model.a * model.theta
    if product < A_THETA_LIMIT:
        return RuleEnds(error)
    why = said(
        "a theta must be < {limit:g} for the SIMC rule of an unstable pole, found {product}",
        limit=A_THETA_LIMIT,
        product=number(product, 4),
    )
    added = model.theta - plant.theta
    if choices["order"] == 2 or not added > 0:
        theta, a = number(model.theta, 4), number(model.a, 4)
        return RuleEnds(said("{why}: theta = {theta} is too long for a = {a}, shorten it", why=why, theta=theta, a=a))
    why = said(
        "{why}: order 1 adds {added} to the dead time {theta} of the plant, for its lags and zeros",
        why=why,
        added=number(added, 4),
        theta=number(plant.theta, 4),
    )
    try:
        other = tuned(plant, **{**choices, "order": 2})
    except RuleEnds as refusal:
        return RuleEnds(said("{why}; for order 2: {refusal}", why=why, refusal=str(refusal)))
    except SimcError:
        return RuleEnds(said("{why}; shorten the dead time", why=why))
    if not other.margins.stable:
        return RuleEnds(said("{why}; order 2 gives no stable loop either, shorten the dead time", why=why))
    values = joined(
        said("{name} = {value}", name=name, value=number(value, 5)) for name, value in other.controller.settings.items()
    )
    return RuleEnds(
        said("{why}; take PID (order 2): {values}, Ms = {Ms}", why=why, values=values, Ms=number(other.margins.Ms, 4)),
        {"order": 2},
    )


@lru_cache(maxsize=16)  # a second for a plant of forty poles, and every remedy that is tried asks for the same
def reduced(plant: Plant, order: int, h: float, rules: str, tau_F: float) -> Reduction:
    """`half_rule`, kept."""
    return half_rule(plant, order, h, rules, tau_F)
