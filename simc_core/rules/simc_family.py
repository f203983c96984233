"""SIMC and its two later forms, each with the one knob tau_c; simc.py and simc_variants.py have the equations."""

from simc_core import checks
from simc_core.controllers.forms import Controller
from simc_core.plants.models import FirstOrderDelay, Model, SecondOrderDelay
from simc_core.rules.simc import default_tau_c, simc, tau_c_multiples, tau_c_presets
from simc_core.rules.simc_variants import improved_simc, isimc

FAMILY = ("simc", "improved_simc", "isimc")
ISIMC_TIGHT = 0.5  # tau_c/theta [GS18]


def settings_of(rule: str, model: Model, tau_c: float | None = None) -> Controller:
    """Settings of one of FAMILY. tau_c in the user's time unit, None for the rule's own choice.

    Raises InvalidParameter and OutOfDomain as the rules do.
    """
    match checks.one_of("rule", rule, FAMILY):
        case "simc":
            return simc(model, tau_c)
        case "improved_simc":
            return improved_simc(model, "PI", tau_c)
        case _:
            return isimc(model, "PID", tau_c)


def usual_tau_c(rule: str, model: Model) -> float:
    """tau_c where none is given: that of SIMC, theta/2 for iSIMC."""
    return ISIMC_TIGHT * model.theta if rule == "isimc" and model.theta else default_tau_c(model)


def presets_of(rule: str, model: Model) -> dict[str, float]:
    """tau_c_presets, "tight" being the rule's own choice."""
    presets = tau_c_presets(model)
    return presets | {"tight": usual_tau_c(rule, model)} if "tight" in presets else presets


def multiples_of(rule: str, model: Model) -> dict[float, float]:
    """tau_c_multiples, from the rule's own choice on."""
    multiples = tau_c_multiples(model)
    return {ISIMC_TIGHT: usual_tau_c(rule, model)} | multiples if rule == "isimc" and multiples else multiples


def lag_of(rule: str, model: Model) -> float:
    """The lag that tau_I is cut from: min(lag, 4 (tau_c + theta)); 0 where there is none."""
    if not isinstance(model, FirstOrderDelay | SecondOrderDelay):
        return 0.0
    return model.tau1 + model.theta / 3 if rule == "improved_simc" else model.tau1
