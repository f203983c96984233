"""A tuning rule made as robust as any other: detuned, or sharpened, until max(Ms, Mt) of the loop is M.

A rule with a parameter of its own uses it. Every other rule is applied to the same model with its
dead time multiplied by F (an ultimate point becomes Ku/F, F Pu), tau_D kept. F is the value nearest to 1 at which
max(Ms, Mt) of the loop round the plant falls through M: F = 1 is the rule as published, with F = 2 it needs its dead
time doubled to be as robust as M, and with F < 1 it is more cautious than M. The parameters follow F as

    tau_c + theta = F (their sum as published)      simc, improved_simc, isimc
    epsilon, lambda_, beta times F, Ki over F       all others

Gain alone would be no fair measure: rules with tau_I ~ theta oscillate slowly at low gain too.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from simc_core import checks
from simc_core.controllers.forms import Controller, IController
from simc_core.errors import SimcError
from simc_core.loops.loop import Loop
from simc_core.optimal.robust_gains import peak_bound
from simc_core.plants.models import FirstOrderDelay, Model, SecondOrderDelay, UnstableDelay
from simc_core.plants.plant import Plant
from simc_core.plants.ultimate_point import Ultimate
from simc_core.rules.catalogue import Rule
from simc_core.rules.imc_1986 import PI_EPSILON, PID_EPSILON
from simc_core.rules.simc import default_tau_c
from simc_core.sensitivity.margins import margins_many
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.studies.optimum import FILTER, scale_of
from simc_core.studies.tune import rule_of, subject_of, tune

FACTORS = np.geomspace(0.3, 6, 41)
WIDE = np.geomspace(0.01, 30, 61)  # of rules that start from the lag, or from another unit than theta
FROM_ELSEWHERE = ("lambda", "lee_1998", "spectral")  # rules whose F = 1 may be far from M
BETA = 2.0  # of the desired model as published: SIMC with tau_c = theta
LOG_F_PRECISION = 1e-10  # of log F
HIGHEST = 1e6  # a peak beyond counts as no loop


@dataclass(frozen=True, slots=True)
class EqualRobustness:
    """A rule detuned, or sharpened, to max(Ms, Mt) = M.

    Attributes
    ----------
    controller : controller or None
        With the filter; None where M is not reachable.
    factor : float or None
        F of the module docstring, 1 for the rule as published; None where M is not reachable.
    published_Ms : float
        max(Ms, Mt) of the rule as published, nan where that loop is not stable.
    """

    controller: Controller | None
    factor: float | None
    published_Ms: float


def at_equal_robustness(
    key: str,
    plant: Plant,
    kind: str = "PI",
    Ms: float = 1.59,
    tau_F: float | None = None,
    model: Model | None = None,
) -> EqualRobustness:
    """A tuning rule made as robust as any other: max(Ms, Mt) = Ms round the plant.

    Parameters
    ----------
    key : str
        A name in RULES.
    plant : Plant
        The plant that the loops are judged on, dead time exact.
    kind : str
        "P", "PI", "PD" or "PID", as the rule has it.
    Ms : float
        Peak asked for, > 1.
    tau_F : float, optional
        Filter of controllers with derivative action, in the user's time unit. None: 0.1 theta of the half-rule model.
    model : Model, optional
        The reduced model that the rule is applied to. None: that of the half rule.

    Returns
    -------
    EqualRobustness
        Controller, factor and the peak of the rule as published; controller and factor None where Ms is not reachable.

    Raises
    ------
    OutOfDomain
        The rule has no setting for this plant.
    NotReducible
        The plant has no reduced model, or no ultimate point.
    InvalidParameter
        No such rule, or a number out of its bounds.

    References
    ----------
    [SG12], [GS18]

    Examples
    --------
    SIMC itself has Ms = 1.59 on a first-order plant:

    >>> from simc_core import Plant, at_equal_robustness
    >>> round(at_equal_robustness("simc", Plant(1, 1, (8,))).factor, 4)
    1.0006
    """
    M = peak_bound("Ms", Ms)
    detuned = detunable(key, plant, kind, tau_F, model)
    published = peaks(plant, [detuned(1.0)])[0]
    factor = _factor(plant, detuned, M, WIDE if key in FROM_ELSEWHERE else FACTORS)
    return EqualRobustness(
        None if factor is None else detuned(factor), factor, published if published < HIGHEST else math.nan
    )


def detunable(
    key: str, plant: Plant, kind: str, tau_F: float | None = None, model: Model | None = None
) -> Callable[[float], Controller]:
    """The rule as a function of F; at F = 1 it is the rule as published, with the filter."""
    rule = rule_of(key)
    subject = subject_of(rule, plant if model is None or rule.needs != "model" else model, kind)
    filter_ = checks.optional_time("tau_F", FILTER * scale_of(plant) if tau_F is None else tau_F)
    knob = rule.knob
    if knob and isinstance(subject, Model) and not isinstance(subject, UnstableDelay):  # which knows one value only
        if knob != "tau_c" or subject.theta:
            tune(key, subject, kind)  # raises where the rule has no setting
        setting = _knob(rule, subject, kind)
        return lambda factor: filtered(tune(key, subject, kind, **{knob: setting(factor)}), filter_)
    published = tune(key, subject, kind)

    def at(factor: float) -> Controller:
        controller = tune(key, _longer(subject, factor), kind) if factor != 1 else published
        if not isinstance(controller, IController) and not isinstance(published, IController):
            controller = replace(controller, tau_D=published.tau_D)
        return filtered(controller, filter_)

    return at


def filtered(controller: Controller, tau_F: float) -> Controller:
    """With the filter, and c = 1, where there is derivative action."""
    if isinstance(controller, IController) or not controller.derivative:
        return controller
    return replace(controller, tau_F=tau_F, c=float(tau_F > 0))


def _knob(rule: Rule, subject: Model, kind: str) -> Callable[[float], float]:
    """The rule's own parameter as a function of F."""
    theta = subject.theta
    match rule.knob:
        case "tau_c":
            usual = theta / 2 if rule.key == "isimc" else default_tau_c(subject)
            return lambda factor: factor * (usual + theta) - theta
        case "lambda_":
            if rule.key == "lambda":
                usual = subject.tau1 if isinstance(subject, FirstOrderDelay) else 3 * theta
            else:
                usual = theta
        case "epsilon":
            usual = (PID_EPSILON if kind == "PID" else PI_EPSILON) * theta
        case "beta":
            usual = BETA
        case _:
            assert isinstance(subject, FirstOrderDelay | SecondOrderDelay)  # the only ones that "spectral" takes
            k = subject.k
            return lambda factor: 1 / (2 * k * theta * factor)
    return lambda factor: factor * usual


def _longer(subject: Model | Ultimate | Plant, factor: float) -> Model | Ultimate | Plant:
    """With its dead time multiplied."""
    if isinstance(subject, Ultimate):
        return Ultimate(subject.Ku / factor, subject.Pu * factor)
    return replace(subject, theta=subject.theta * factor)


def _factor(plant: Plant, detuned: Callable[[float], Controller], M: float, factors: np.ndarray) -> float | None:
    """F nearest to 1 at which the peak falls through M."""
    made = []
    for factor in factors.tolist():
        try:
            made.append((factor, detuned(factor)))
        except SimcError:
            continue  # no setting with this F
    heights = np.array(peaks(plant, [controller for _, controller in made]))
    tried = np.array([factor for factor, _ in made])
    falls = np.flatnonzero((heights[:-1] > M) & (heights[1:] <= M)).tolist()
    found = []
    for i in falls:
        low, high = math.log(tried[i]), math.log(tried[i + 1])

        def excess(x: float) -> float:
            return math.log(peaks(plant, [detuned(math.exp(x))])[0] / M)

        found.append(math.exp(brentq(excess, low, high, xtol=LOG_F_PRECISION)))
    return min(found, key=lambda factor: abs(math.log(factor)), default=None)


def peaks(plant: Plant, controllers: Sequence[Controller]) -> list[float]:
    """max(Ms, Mt) of each loop, HIGHEST where it is not stable."""
    return [peak_of(each) for each in margins_many([Loop(plant, each) for each in controllers])]


def peak_of(found: Margins) -> float:
    """max(Ms, Mt), HIGHEST where the loop is not stable."""
    return min(max(found.Ms, found.Mt), HIGHEST) if found.stable else HIGHEST
