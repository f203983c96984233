"""Tuning rules compared fairly: on one plant, as published and at equal robustness, beside the optimum."""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import PchipInterpolator

from simc_core import checks
from simc_core.controllers.forms import Controller
from simc_core.errors import SimcError
from simc_core.loops.loop import Loop
from simc_core.metrics.performance import Performance, performance_many
from simc_core.optimal.criterion import CRITERIA, J, References
from simc_core.optimal.robust_gains import peak_bound
from simc_core.optimal.under_ms import Search, references
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.rules.catalogue import RULES
from simc_core.sensitivity.margins import margins_many
from simc_core.studies.equal_robustness import HIGHEST, at_equal_robustness, detunable, filtered, peak_of
from simc_core.studies.optimum import FILTER, front, scale_of, search_for
from simc_core.studies.tune import rule_of, subject_of
from simc_core.wording import said

EQUAL_PEAKS = 1e-5  # logarithms of peaks that are one
NEAR_OPTIMUM = 0.03  # behind the optimum: rules so near are compared with one of their own peak, not with the front


@dataclass(frozen=True, slots=True)
class Row:
    """One rule on one plant.

    controller: the one that is judged, as published or at equal robustness; None where there is none, `refusal` says
    why.   published_Ms, factor: as in EqualRobustness.   Mst: max(Ms, Mt).   load, setpoint: IAE of unit steps at the
    input and at the output.   J: [SG12], nan where there is no reference.   TV: of u after a load step.
    high_frequency_gain: |C| there, Kd/tau_F, or Kp without derivative action.
    behind: the criterion over that of the optimum with the same bound, minus 1.
    in_domain: whether the source recommends it here.
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
    high_frequency_gain: float
    behind: float
    in_domain: bool
    refusal: str = ""


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

    Examples
    --------
    SIMC as published has the load error tau_I/Kc = 8/4 on a first-order plant [SK03]; Ziegler and Nichols' is sharper:

    >>> from simc_core import Plant, comparison
    >>> rows = comparison(Plant(1, 1, (8,)), ["PI"], keys=["simc", "zn_step"])
    >>> [(row.key, round(row.load, 3), round(row.Mst, 2)) for row in rows]
    [('simc', 2.0, 1.59), ('zn_step', 0.498, 3.27)]
    """
    M = None if Ms is None else peak_bound("Ms", Ms)
    for key in keys:
        rule_of(key)
    checks.one_of("criterion", criterion, CRITERIA)
    return _rows(_Judge(plant, M, FILTER * scale_of(plant) if tau_F is None else tau_F, criterion), kinds, keys)


def _rows(judge: "_Judge", kinds: Sequence[str], keys: Sequence[str]) -> Iterator[Row]:
    if judge.M is None:
        judge.prepare([(key, kind) for kind in kinds for key in keys if kind in RULES[key].kinds])
    for kind in kinds:
        if judge.M is not None:
            yield judge.best(kind, judge.M)
        for key in keys:
            if kind in RULES[key].kinds:
                yield judge.rule(key, kind)


@dataclass(frozen=True, slots=True)
class _Judged:
    """Mst: max(Ms, Mt).   performance: None where the loop is not stable, an error where it cannot be told."""

    Mst: float
    performance: Performance | SimcError | None


class _Judge:
    """One plant, one bound, one filter, one criterion."""

    def __init__(self, plant: Plant, M: float | None, tau_F: float, criterion: str):
        self.plant, self.M, self.tau_F, self.criterion = plant, M, tau_F, criterion
        self.references = self._references()
        self.fronts: dict[str, np.ndarray] = {}
        self.judged: dict[Controller, _Judged] = {}
        self.published: dict[str, list[Controller]] = defaultdict(list)
        self.least: dict[str, dict[float, float]] = {}

    def best(self, kind: str, M: float) -> Row:
        """The optimum."""
        try:
            found = self._search(kind).best(M)
        except SimcError as refused:
            return _none("optimal", kind, math.nan, str(refused))
        controller = filtered(found.controller, found.controller.tau_F)
        return self._row("optimal", kind, controller, math.nan, 1.0, True)

    def prepare(self, asked: Sequence[tuple[str, str]]) -> None:
        """Judge the rules as published, all together."""
        for key, kind in asked:
            with suppress(SimcError):
                self.published[kind].append(detunable(key, self.plant, kind, self.tau_F)(1.0))
        self._judge([each for own in self.published.values() for each in own])

    def rule(self, key: str, kind: str) -> Row:
        """One rule."""
        try:
            if self.M is None:
                controller = detunable(key, self.plant, kind, self.tau_F)(1.0)
                highest = self._judge([controller])[0].Mst
                published, factor = highest if highest < HIGHEST else math.nan, 1.0
            else:
                found = at_equal_robustness(key, self.plant, kind, self.M, self.tau_F)
                published = found.published_Ms
                if found.controller is None or found.factor is None:
                    return _none(key, kind, published, said("Ms = {Ms:g} is not reachable by this rule", Ms=self.M))
                controller, factor = found.controller, found.factor
            return self._row(key, kind, controller, published, factor, self._recommended(key, kind))
        except SimcError as refused:
            return _none(key, kind, math.nan, str(refused))

    def _row(self, key: str, kind: str, controller: Controller, published: float, factor: float, honoured: bool) -> Row:
        judged = self._judge([controller])[0]
        if judged.performance is None:
            return replace(_none(key, kind, published, said("the loop is not stable")), controller=controller)
        if isinstance(judged.performance, SimcError):
            raise judged.performance
        both = judged.performance
        load, setpoint = both.disturbance.IAE, both.setpoint.IAE
        combined, value = self._values(both)
        return Row(
            key,
            kind,
            controller,
            published,
            factor,
            judged.Mst,
            load,
            setpoint,
            combined,
            both.disturbance.TV,
            high_frequency_gain(controller),
            self._behind(kind, judged.Mst, value),
            honoured,
        )

    def _judge(self, controllers: Sequence[Controller]) -> list["_Judged"]:
        """Peaks and metrics of loops, each computed once, those that are asked for at a time together."""
        new = list(dict.fromkeys(each for each in controllers if each not in self.judged))
        loops = [Loop(self.plant, each) for each in new]
        found = margins_many(loops) if loops else []
        stable = [i for i, each in enumerate(found) if each.stable]
        performed = dict(zip(stable, performance_many([loops[i] for i in stable]), strict=True))
        for i, (controller, each) in enumerate(zip(new, found, strict=True)):
            self.judged[controller] = _Judged(peak_of(each), performed.get(i))
        return [self.judged[each] for each in controllers]

    def _values(self, both: Performance) -> tuple[float, float]:
        """J, and the criterion."""
        load, setpoint = both.disturbance.IAE, both.setpoint.IAE
        combined = float(J(self.references, setpoint, load)) if self.references else math.nan
        return combined, {"load": load, "setpoint": setpoint, "J": combined}[self.criterion]

    def _behind(self, kind: str, Mst: float, value: float) -> float:
        """Relative distance of the criterion to that of the best controller with the same peak."""
        behind = self._behind_front(kind, Mst, value)
        return value / self._least_at(kind, Mst) - 1 if self._too_near(behind) else behind

    def _behind_front(self, kind: str, Mst: float, value: float) -> float:
        """The same, by what lies between the bounds of the front; -inf for more cautious than it begins."""
        x, y = self._front(kind)
        log_Mst = math.log(Mst)
        if not len(x) or log_Mst > x[-1] + EQUAL_PEAKS:
            return math.nan
        if log_Mst < x[0] - EQUAL_PEAKS:
            return -math.inf
        if len(x) == 1:
            return value / math.exp(y[0]) - 1
        return value / math.exp(float(PchipInterpolator(x, y)(log_Mst))) - 1

    def _too_near(self, behind: float) -> bool:
        """Whether the front, which is known at its bounds only, does not tell it."""
        return behind < NEAR_OPTIMUM and (self.M is None or behind == -math.inf)

    def _least_at(self, kind: str, Mst: float) -> float:
        """The least criterion with that peak; those of all rules that need it are found together. Raises NoOptimum."""
        if kind not in self.least:
            wanted = sorted(self._near(kind), reverse=True)
            with suppress(SimcError):
                found = self._search(kind).front(wanted) if wanted else []
                self.least[kind] = {M: each.value for M, each in zip(wanted, found, strict=False)}
        known = self.least.setdefault(kind, {})
        if Mst not in known:
            known[Mst] = self._search(kind).best(Mst).value
        return known[Mst]

    def _near(self, kind: str) -> set[float]:
        """Peaks of the rules as published that are too near the front."""
        judged = [self.judged[each] for each in self.published[kind]]
        return {
            each.Mst
            for each in judged
            if isinstance(each.performance, Performance)
            and self._too_near(self._behind_front(kind, each.Mst, self._values(each.performance)[1]))
        }

    def _front(self, kind: str) -> np.ndarray:
        """Logarithms of bounds and of the least values of the criterion."""
        if kind not in self.fronts:
            self.fronts[kind] = np.log(self._least(kind)).T.reshape(2, -1)
        return self.fronts[kind]

    def _least(self, kind: str) -> list[tuple[float, float]]:
        try:
            if self.M is not None:
                return [(self.M, self._search(kind).best(self.M).value)]
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
        model = subject_of(rule, self.plant, kind)
        return isinstance(model, Model) and rule.within(model, kind, None)

    def _references(self) -> References | None:
        try:
            return references(self.plant, scale_of(self.plant))
        except SimcError:
            return None


def high_frequency_gain(controller: Controller) -> float:
    """|C| at high frequency: Kc tau_D/tau_F in ideal form, Kc without derivative action, 0 of an I controller."""
    form = controller.to_parallel()
    if form.Kd:
        return abs(form.Kd) / form.tau_F if form.tau_F else math.inf
    return abs(form.Kp)


def _none(key: str, kind: str, published: float, refusal: str) -> Row:
    nan = math.nan
    return Row(key, kind, None, published, None, nan, nan, nan, nan, nan, nan, nan, False, refusal)
