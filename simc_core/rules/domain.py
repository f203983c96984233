"""What tuning rules ask of a model. Each question that is answered with no raises OutOfDomain."""

from simc_core.errors import OutOfDomain
from simc_core.plants.models import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    Model,
    OscillatingDelay,
    SecondOrderDelay,
    UnstableDelay,
)
from simc_core.wording import joined, said

IN_WORDS: dict[type, str] = {
    FirstOrderDelay: said("a first-order one"),
    SecondOrderDelay: said("a second-order one"),
    IntegratingDelay: said("an integrating one"),
    DoubleIntegratingDelay: said("a double integrating one"),
    UnstableDelay: said("an unstable one"),
    OscillatingDelay: said("an oscillating one"),
}


def in_words(model: object) -> str:
    """What a sentence calls a model; of anything else its type."""
    return IN_WORDS.get(type(model), type(model).__name__)


def first_order(model: Model, rule: str) -> FirstOrderDelay:
    """The model, which must be k e^{-theta s}/(tau1 s + 1)."""
    if not isinstance(model, FirstOrderDelay):
        raise OutOfDomain(
            said(
                "model must be a first-order one with dead time for the rule {rule}, found {model}",
                rule=rule,
                model=in_words(model),
            )
        )
    return model


def reaction_curve(model: Model, rule: str) -> tuple[float, float, float]:
    """a, theta, r of a step response that rises with its largest slope after theta.

    First order: a = k theta/tau1, r = theta/tau1. Integrating without a second lag: a = k' theta, r = 0.
    """
    if isinstance(model, IntegratingDelay):
        if model.tau2:
            raise OutOfDomain(said("tau2 must be 0 for the rule {rule}, found {tau2:g}", rule=rule, tau2=model.tau2))
        return model.k_prime * dead_time(model.theta, rule), model.theta, 0.0
    model = lag(model, rule)
    return model.k * model.theta / model.tau1, dead_time(model.theta, rule), model.theta / model.tau1


def lag(model: Model, rule: str) -> FirstOrderDelay:
    """The first-order model, which must have a lag."""
    model = first_order(model, rule)
    if model.tau1 == 0:
        raise OutOfDomain(
            said("tau1 must be > 0 for the rule {rule}, found 0: it is made for a process with a lag", rule=rule)
        )
    return model


def dead_time(theta: float, rule: str) -> float:
    """theta, which must be > 0."""
    if theta == 0:
        raise OutOfDomain(
            said("theta must be > 0 for the rule {rule}, found 0: without dead time it has no finite gain", rule=rule)
        )
    return theta


def kind_of(kind: str, kinds: tuple[str, ...], rule: str) -> str:
    """The kind of controller, which must be one that the rule has."""
    if kind not in kinds:
        raise OutOfDomain(
            said(
                "kind must be {kinds} for the rule {rule}, found {kind!r}",
                kinds=joined(kinds, said(" or ")),
                rule=rule,
                kind=kind,
            )
        )
    return kind


def positive(name: str, value: float, rule: str) -> float:
    """A result of the formula, which must be > 0 to be a setting."""
    if not value > 0:
        raise OutOfDomain(
            said(
                "{name} must be > 0, found {value:.4g} from the rule {rule}: the model is outside its domain",
                name=name,
                value=value,
                rule=rule,
            )
        )
    return value
