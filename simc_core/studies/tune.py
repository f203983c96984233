"""Any rule of the catalogue on any plant: the model, ultimate point or plant that the rule needs is made here."""

from simc_core import checks
from simc_core.controllers.forms import IController, IdealPid, SeriesPid
from simc_core.errors import InvalidParameter, OutOfDomain
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.plants.ultimate_point import Ultimate
from simc_core.reduction.half_rule import reduced_model
from simc_core.rules.catalogue import RULES, Rule
from simc_core.sensitivity.ultimate import ultimate
from simc_core.wording import joined, said

SECOND_ORDER = ("simc", "spectral")  # their PID needs a second lag


def tune(
    key: str, subject: Model | Ultimate | Plant, kind: str = "PI", **knobs: float | None
) -> SeriesPid | IdealPid | IController:
    """Settings of a rule.

    Parameters
    ----------
    key : str
        A name in RULES.
    subject : Model, Ultimate or Plant
        A reduced model or an ultimate point, as the rule needs it; of a plant the half rule's model, or the exact
        ultimate point, is taken.
    kind : str
        "P", "PI", "PD" or "PID".
    **knobs : float
        The rule's own parameter by name: tau_c, ``lambda_`` and epsilon in the user's time unit, beta without unit, Ki
        in input units per output unit and time. Left out, or None: the rule's default.

    Returns
    -------
    SeriesPid, IdealPid or IController
        In the form of the source, without filter.

    Raises
    ------
    OutOfDomain
        The rule has no setting for this subject, kind or parameter.
    NotReducible
        The plant has no reduced model, or no ultimate point.
    InvalidParameter
        No such rule or parameter, or a number out of its bounds.

    Examples
    --------
    >>> from simc_core import FirstOrderDelay, tune
    >>> pid = tune("zn_step", FirstOrderDelay(k=1, theta=1, tau1=8), "PID")
    >>> round(pid.Kc, 3), pid.tau_I, pid.tau_D
    (9.6, 2.0, 0.5)
    """
    rule = rule_of(key)
    knob = knob_of(rule, knobs)
    made = subject_of(rule, subject, kind)
    if rule.knob is None or knob is None:
        return _of_kind(rule.settings(made, kind), rule, kind)
    return _of_kind(rule.settings(made, kind, knob), rule, kind)


def rule_of(key: str) -> Rule:
    """The rule of that name."""
    return RULES[checks.one_of("rule", key, RULES)]


def knob_of(rule: Rule, knobs: dict[str, float | None]) -> float | None:
    """The rule's own parameter among the keywords, None if it is left to the rule."""
    for name in knobs:
        if name != rule.knob:
            if rule.knob:
                raise InvalidParameter(
                    said("{title} has only {knob}, found {name}", title=rule.title, knob=rule.knob, name=name)
                )
            raise InvalidParameter(
                said("{title} has no parameter of its own, found {name}", title=rule.title, name=name)
            )
    if rule.knob is None or knobs.get(rule.knob) is None:
        return None
    return checks.real(rule.knob, knobs[rule.knob])


def subject_of(rule: Rule, subject: Model | Ultimate | Plant, kind: str) -> Model | Ultimate | Plant:
    """What the rule needs, made from what is there."""
    if kind not in rule.kinds:
        raise OutOfDomain(
            said(
                "kind must be {kinds} for the rule {title}, found {kind!r}",
                kinds=joined(rule.kinds, said(" or ")),
                title=rule.title,
                kind=kind,
            )
        )
    if isinstance(subject, Ultimate):
        if rule.needs != "ultimate":
            raise OutOfDomain(
                said(
                    "subject must be a model or a plant for the rule {title}, found an ultimate point", title=rule.title
                )
            )
        return subject
    if isinstance(subject, Model):
        plant = subject.plant
    elif isinstance(subject, Plant):
        plant = subject
    else:
        raise InvalidParameter(
            said(
                "subject must be a reduced model, an ultimate point or a plant, found {what}",
                what=type(subject).__name__,
            )
        )
    if rule.needs == "ultimate":
        return ultimate(plant)
    if rule.needs == "plant":
        return plant
    if isinstance(subject, Model):
        return subject
    return reduced_model(plant, 2 if kind == "PID" and rule.key in SECOND_ORDER else 1)


def _of_kind(
    controller: SeriesPid | IdealPid | IController, rule: Rule, kind: str
) -> SeriesPid | IdealPid | IController:
    """The controller, which must be of the kind asked for: of SIMC the model decides it."""
    found = "PI" if isinstance(controller, IController) or not controller.tau_D else "PID"
    if rule.key in SECOND_ORDER and kind != found:
        raise OutOfDomain(
            said(
                "kind must be {found} for the rule {title} and this model, found {kind!r}",
                found=found,
                title=rule.title,
                kind=kind,
            )
        )
    return controller
