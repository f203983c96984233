"""Tuning rules compared fairly: on one plant, as published and at equal robustness, beside the optimum.

Equal robustness. A rule with a parameter of its own uses it. Every other rule is applied to the same model with its
dead time multiplied by F (an ultimate point becomes Ku/F, F Pu), tau_D kept. F is the value nearest to 1 at which
max(Ms, Mt) of the loop round the plant falls through M: F = 1 is the rule as published, with F = 2 it needs its dead
time doubled to be as robust as M, and with F < 1 it is more cautious than M. The parameters follow F as

    tau_c + theta = F (their sum as published)      simc, improved_simc, isimc
    epsilon, lambda_, beta times F, Ki over F       all others

Gain alone would be no fair measure: rules with tau_I ~ theta oscillate slowly at low gain too.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from simc_core import checks
from simc_core.certificate.verdict import stability
from simc_core.controllers.forms import Controller, IController, ParallelPid
from simc_core.errors import InvalidParameter, SimcError
from simc_core.loops.loop import Loop
from simc_core.metrics.performance import performance
from simc_core.optimal.criterion import CRITERIA, J, References
from simc_core.optimal.robust_gains import peak_bound
from simc_core.optimal.under_ms import Search, references
from simc_core.plants.models import FirstOrderDelay, Model, UnstableDelay
from simc_core.plants.plant import Plant
from simc_core.plants.ultimate_point import Ultimate
from simc_core.rules.catalogue import RULES, Rule
from simc_core.rules.imc_1986 import PI_EPSILON, PID_EPSILON
from simc_core.rules.simc import default_tau_c
from simc_core.sensitivity.margins import margins_many
from simc_core.studies.optimum import FILTER, front, scale_of, search_for
from simc_core.studies.tune import rule_of, subject_of, tune

FACTORS = np.geomspace(0.3, 6, 41)
WIDE = np.geomspace(0.01, 30, 61)  # of rules that start from the lag, or from another unit than theta
BETA = 2.0  # of the desired model as published: SIMC with tau_c = theta
PRECISION = 1e-10  # of log F
EQUAL = 1e-5  # logarithms of peaks
NEAR = 0.03  # behind the optimum: rules so near are compared with one of their own peak, not with the front
HIGHEST = 1e6  # a peak beyond counts as no loop
FROM_ELSEWHERE = ("lambda", "lee_1998", "spectral")  # rules whose F = 1 may be far from M


@dataclass(frozen=True, slots=True)
class EqualRobustness:
    """A rule detuned, or sharpened, to max(Ms, Mt) = M.

    controller: with the filter; None where M is not reachable, as is factor.   factor: F of the module docstring.
    published_Ms: max(Ms, Mt) of the rule as printed, nan where that loop is not stable.
    """

    controller: Controller | None
    factor: float | None
    published_Ms: float


@dataclass(frozen=True, slots=True)
class Row:
    """One rule on one plant.

    controller: the one that is judged, as published or at equal robustness; None where there is none, `refusal` says
    why.   published_Ms, factor: as in EqualRobustness.   Mst: max(Ms, Mt).   load, setpoint: IAE of unit steps at the
    input and at the output.   J: [SG12], nan where there is no reference.   TV: of u after a load step.
    noise_gain: Kc tau_D/tau_F, Kc for PI.   behind: the criterion over that of the optimum with the same bound, minus
    1.   in_domain: whether the source recommends it here.
    """

    key: str
    kind: str
    controller: Controller | None
    published_Ms: float
    factor: float | None
    Mst: float
    load: float
    setpoint: float
    J: float
    TV: float
    noise_gain: float
    behind: float
    in_domain: bool
    refusal: str = ""


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
    published = _peaks(plant, [detuned(1.0)])[0]
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
    without_default = rule.knob == "tau_c" and not getattr(subject, "theta", 1.0)
    published = None if without_default else tune(key, subject, kind)
    setting = _knob(rule, subject, kind)

    def at(factor: float) -> Controller:
        if setting is not None:
            return filtered(tune(key, subject, kind, **{rule.knob: setting(factor)}), filter_)
        controller = tune(key, _longer(subject, factor), kind) if factor != 1 else published
        if not isinstance(controller, IController):
            controller = replace(controller, tau_D=published.tau_D)
        return filtered(controller, filter_)

    return at


def filtered(controller: Controller, tau_F: float) -> Controller:
    """With the filter, and c = 1, where there is derivative action."""
    if isinstance(controller, IController) or not controller.to_parallel().Kd:
        return controller
    return replace(controller, tau_F=tau_F, c=float(tau_F > 0))


def _knob(rule: Rule, subject: Model | Ultimate | Plant, kind: str) -> Callable[[float], float] | None:
    """The rule's own parameter as a function of F, None if it has none or knows one value only."""
    if rule.knob is None or isinstance(subject, UnstableDelay):
        return None
    theta = subject.theta
    match rule.knob:
        case "tau_c":
            usual = theta / 2 if rule.key == "isimc" else default_tau_c(subject)
            return lambda factor: factor * (usual + theta) - theta
        case "lambda_":
            lag = rule.key == "lambda" and isinstance(subject, FirstOrderDelay)
            usual = subject.tau1 if lag else 3 * theta if rule.key == "lambda" else theta
        case "epsilon":
            usual = (PID_EPSILON if kind == "PID" else PI_EPSILON) * theta
        case "beta":
            usual = BETA
        case _:
            return lambda factor: 1 / (2 * subject.k * theta * factor)
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
    peaks = np.array(_peaks(plant, [controller for _, controller in made]))
    tried = np.array([factor for factor, _ in made])
    falls = np.flatnonzero((peaks[:-1] > M) & (peaks[1:] <= M)).tolist()
    found = []
    for i in falls:
        low, high = math.log(tried[i]), math.log(tried[i + 1])

        def excess(x: float) -> float:
            return math.log(_peaks(plant, [detuned(math.exp(x))])[0] / M)

        found.append(math.exp(brentq(excess, low, high, xtol=PRECISION)))
    return min(found, key=lambda factor: abs(math.log(factor)), default=None)


def _peaks(plant: Plant, controllers: Sequence[Controller]) -> list[float]:
    """max(Ms, Mt) of each loop, HIGHEST where it is not stable."""
    found = margins_many([Loop(plant, each) for each in controllers])
    return [min(max(each.Ms, each.Mt), HIGHEST) if each.stable else HIGHEST for each in found]


def comparison(
    plant: Plant,
    kinds: Sequence[str] = ("PI", "PID"),
    Ms: float | None = None,
    tau_F: float | None = None,
    keys: Sequence[str] = tuple(RULES),
    criterion: str = "load",
) -> Iterator[Row]:
    """Every rule on one plant, row by row as they are computed; the optimum of each kind comes first.

    Parameters
    ----------
    plant : Plant
        The plant, dead time exact.
    kinds : sequence of str
        Controllers to compare, of "PI" and "PID".
    Ms : float, optional
        Peak at which all are compared. None: as published, and the optimum beside each has the rule's own peak.
    tau_F : float, optional
        Filter of all controllers with derivative action, in the user's time unit. None: 0.1 theta.
    keys : sequence of str
        Names in RULES.
    criterion : str
        What the optimum is best for: "load", "setpoint" or "J", as in `optimal`.

    Returns
    -------
    iterator of Row
        The optima have the key "optimal". A rule that has no setting here has a refusal.

    Raises
    ------
    InvalidParameter
        A number out of its bounds, or no such rule.
    """
    M = None if Ms is None else peak_bound("Ms", Ms)
    for key in keys:
        rule_of(key)
    if criterion not in CRITERIA:
        raise InvalidParameter(f"criterion must be one of {', '.join(CRITERIA)}, got {criterion!r}")
    return _rows(_Judge(plant, M, FILTER * scale_of(plant) if tau_F is None else tau_F, criterion), kinds, keys)


def _rows(judge: "_Judge", kinds: Sequence[str], keys: Sequence[str]) -> Iterator[Row]:
    for kind in kinds:
        if judge.M is not None:
            yield judge.best(kind)
        for key in keys:
            if kind in RULES[key].kinds:
                yield judge.rule(key, kind)


class _Judge:
    """One plant, one bound, one filter, one criterion."""

    def __init__(self, plant: Plant, M: float | None, tau_F: float, criterion: str):
        self.plant, self.M, self.tau_F, self.criterion = plant, M, tau_F, criterion
        self.references = self._references()
        self.fronts: dict[str, np.ndarray] = {}

    def best(self, kind: str) -> Row:
        """The optimum."""
        try:
            found = self._search(kind).best(self.M)[0]
        except SimcError as refused:
            return _none("optimal", kind, math.nan, str(refused))
        controller = filtered(found.controller, found.controller.tau_F)
        return self._row("optimal", kind, controller, math.nan, 1.0, True)

    def rule(self, key: str, kind: str) -> Row:
        """One rule."""
        try:
            detuned = detunable(key, self.plant, kind, self.tau_F)
            controller = detuned(1.0)
            published, factor = _peaks(self.plant, [controller])[0], 1.0
            published = published if published < HIGHEST else math.nan
            if self.M is not None:
                found = at_equal_robustness(key, self.plant, kind, self.M, self.tau_F)
                controller, factor = found.controller, found.factor
                if controller is None:
                    return _none(key, kind, published, f"Ms = {self.M:g} is not reachable by this rule")
            return self._row(key, kind, controller, published, factor, self._recommended(key, kind))
        except SimcError as refused:
            return _none(key, kind, math.nan, str(refused))

    def _row(self, key: str, kind: str, controller: Controller, published: float, factor: float, honoured: bool) -> Row:
        loop = Loop(self.plant, controller)
        Mst = _peaks(self.plant, [controller])[0]
        if stability(loop).verdict != "stable":
            return replace(_none(key, kind, published, "the loop is not stable"), controller=controller)
        both = performance(loop)
        load, setpoint = both.disturbance.IAE, both.setpoint.IAE
        combined = float(J(self.references, setpoint, load)) if self.references else math.nan
        value = {"load": load, "setpoint": setpoint, "J": combined}[self.criterion]
        return Row(
            key,
            kind,
            controller,
            published,
            factor,
            Mst,
            load,
            setpoint,
            combined,
            both.disturbance.TV,
            noise_gain(controller),
            self._behind(kind, Mst, value),
            honoured,
        )

    def _behind(self, kind: str, Mst: float, value: float) -> float:
        """Relative distance of the criterion to that of the best controller with the same peak."""
        x, y = self._front(kind)
        log_Mst = math.log(Mst)
        if not len(x) or not x[0] - EQUAL <= log_Mst <= x[-1] + EQUAL:
            return math.nan
        if len(x) == 1:
            return value / math.exp(y[0]) - 1
        behind = value / math.exp(float(PchipInterpolator(x, y)(log_Mst))) - 1
        if behind < NEAR:
            behind = value / self._search(kind).best(Mst)[0].value - 1
        return behind

    def _front(self, kind: str) -> np.ndarray:
        """Logarithms of bounds and of the least values of the criterion."""
        if kind not in self.fronts:
            self.fronts[kind] = np.log(self._least(kind)).T.reshape(2, -1)
        return self.fronts[kind]

    def _least(self, kind: str) -> list[tuple[float, float]]:
        try:
            if self.M is not None:
                return [(self.M, self._search(kind).best(self.M)[0].value)]
            return [(M, each.value) for M, each in front(self.plant, kind, self.criterion, self._filter(kind))]
        except SimcError:
            return []

    def _search(self, kind: str) -> Search:
        return search_for(self.plant, kind, self.criterion, self._filter(kind), False)

    def _filter(self, kind: str) -> float | None:
        return self.tau_F if kind == "PID" else None

    def _recommended(self, key: str, kind: str) -> bool:
        rule = RULES[key]
        if rule.needs != "model":
            return True
        return rule.within(subject_of(rule, self.plant, kind), kind, None)

    def _references(self) -> References | None:
        try:
            return references(self.plant, scale_of(self.plant))
        except SimcError:
            return None


def noise_gain(controller: Controller) -> float:
    """|C| at high frequency: Kc tau_D/tau_F in ideal form, Kc without derivative action, 0 of an I controller."""
    form: ParallelPid = controller.to_parallel()
    if form.Kd:
        return abs(form.Kd) / form.tau_F if form.tau_F else math.inf
    return abs(form.Kp)


def _none(key: str, kind: str, published: float, refusal: str) -> Row:
    return Row(key, kind, None, published, None, *[math.nan] * 7, False, refusal)
