"""tau_c as a choice that follows the plant: a multiple of theta, or a word of the literature."""

import re

from simc_core.plants.models import Model, UnstableDelay
from simc_core.rules.simc import default_tau_c
from simc_core.rules.simc_family import presets_of, usual_tau_c

TIMES_THETA = re.compile(r"(\d{1,4}(?:\.\d{1,6})?)theta")
LEAST, MOST = 0.01, 1000.0  # times theta
WORDS = ("aggressive", "moderate", "conservative")  # of Arbogast, Cooper and Rice, see tau_c_presets


def times_theta(speed: str) -> float | None:
    """The multiple that "1.5theta" says; None where the choice is another, or out of bounds."""
    found = TIMES_THETA.fullmatch(speed)
    value = float(found[1]) if found else 0.0
    return value if LEAST <= value <= MOST else None


def is_speed(speed: str) -> bool:
    """Whether this is a choice: "" for the default, a multiple of theta, or one of WORDS."""
    return not speed or speed in WORDS or times_theta(speed) is not None


def tau_c_in_use(model: Model, tau_c: float | None, speed: str, rule: str = "simc") -> float:
    """tau_c as a number, if there is one, else as the choice; the rule of an unstable pole knows theta alone."""
    if isinstance(model, UnstableDelay):
        return default_tau_c(model)
    if tau_c is not None:
        return tau_c
    multiple = times_theta(speed)
    if multiple and model.theta:
        return multiple * model.theta
    named = presets_of(rule, model) if speed else {}
    return named[speed] if speed in named else usual_tau_c(rule, model)
