"""The best PI or PID controller of a plant with max(Ms, Mt) <= M, and what says that there is none.

No optimum exists where the gain may grow without end: without dead time, and with a phase that never falls below -180
degrees. None is found where no shape has a robust gain. Settings are found for |k|; the gain gets the sign it needs.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from simc_core import checks
from simc_core.controllers.forms import IdealPid, SeriesPid
from simc_core.errors import InvalidParameter, NoOptimum
from simc_core.loops.loop import Loop
from simc_core.optimal.criterion import Criterion, References
from simc_core.optimal.pi import best_pi
from simc_core.optimal.pid import best_pid
from simc_core.optimal.problem import Found, Problem
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins import margins
from simc_core.wording import Text, said

KINDS = ("PI", "PID")
REFERENCE_M = 1.59  # of the controllers that J is counted in [SG12]
LOOK = np.geomspace(0.1, 100, 13)  # tau_I in units of the scale, and tau_D/tau_I, for the smallest possible peak
DERIVATIVE = (0.1, 0.25, 0.5, 1.0)
ACTIVE = 2e-5  # relative: peaks this near the bound are on it
BISECTIONS, HIGHEST = 12, 30.0
NONE_OF_PI = said(
    "Ms must be large enough for a stable PI loop, found {M:g}: no PI controller with a peak below {highest:g} was "
    "found; take PID",
    M=math.nan,
    highest=HIGHEST,
)
NONE_OF_PID = said(
    "Ms must be large enough for a stable PID loop, found {M:g}: no PID controller with a peak below {highest:g} was "
    "found; take a smaller tau_F, or a cascade",
    M=math.nan,
    highest=HIGHEST,
)


@dataclass(frozen=True, slots=True)
class Optimum:
    """The best controller under a bound.

    Attributes
    ----------
    controller : IdealPid or SeriesPid
        Its settings, with the filter.
    value : float
        The criterion: IAE of a unit step of load or set point, or J of [SG12].
    Ms, Mt : float
        Peaks of its loop.
    active : bool
        Whether the bound holds it back.
    """

    controller: IdealPid | SeriesPid
    value: float
    Ms: float
    Mt: float
    active: bool


@dataclass(frozen=True, slots=True)
class Search:
    """What does not change along a front. guess: tau_I and tau_D of a PID controller to look around."""

    plant: Plant
    kind: str
    criterion: Criterion
    scale: float
    tau_F: float
    series: bool = False
    guess: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        checks.one_of("kind", self.kind, KINDS)
        if self.kind == "PI":
            return
        if not self.tau_F and self.criterion.name != "load":
            raise InvalidParameter(
                said(
                    "tau_F must be > 0 for the criterion {name} of a PID controller, whose derivative acts on "
                    "the set point, found 0",
                    name=self.criterion.name,
                )
            )
        if not self.tau_F and self.plant.factored.relative_degree == 0:
            raise InvalidParameter(
                said(
                    "tau_F must be > 0 for a PID controller of a plant that answers at once (of relative degree "
                    "0), found 0"
                )
            )

    def best(self, M: float) -> Optimum:
        """The optimum for max(Ms, Mt) <= M. Raises NoOptimum."""
        problem = self._problem(M)
        found = best_pi([problem])[0] if self.kind == "PI" else best_pid(problem, self.series, self.guess)
        if found is None:
            raise NoOptimum(self._infeasible(problem))
        return self._optimum(problem, found)

    def front(self, bounds: Sequence[float]) -> list[Optimum]:
        """The optima for bounds in descending order, up to the first that has none. Raises NoOptimum without any.

        What is best without a bound is best under all bounds that it meets. PI controllers are searched for together,
        each PID controller from those for larger bounds.
        """
        found = [self.best(bounds[0])]
        free = [] if found[0].active else [M for M in bounds[1:] if max(found[0].Ms, found[0].Mt) <= M]
        found += found * len(free)
        problems = [self._problem(M) for M in bounds[len(found) :]]
        if self.kind == "PID":
            return self._one_after_the_other(found, problems)
        for problem, best in zip(problems, best_pi(problems) if problems else [], strict=True):
            if best is None:
                break
            found.append(self._optimum(problem, best))
        return found

    def _one_after_the_other(self, found: list[Optimum], problems: Sequence[Problem]) -> list[Optimum]:
        """PID: each search begins where the last ones ended."""
        for problem in problems:
            last = found[-1]
            if not last.active and max(last.Ms, last.Mt) <= problem.M:
                found.append(last)
                continue
            best = best_pid(problem, self.series, self.guess, _warm(found, problem.M))
            best = best or best_pid(problem, self.series, self.guess)
            if best is None:
                break
            found.append(self._optimum(problem, best))
        return found

    def _problem(self, M: float) -> Problem:
        """Raises NoOptimum where ever better controllers meet the bound."""
        problem = Problem(self.plant, self.criterion, M, self.scale, self.tau_F)
        self._refuse_endless(problem)
        return problem

    def _optimum(self, problem: Problem, found: Found) -> Optimum:
        sign, c = problem.sign, problem.criterion.weighs_derivative if found.tau_D else 0.0
        controller = IdealPid(sign * found.Kc, found.tau_I, found.tau_D, self.tau_F, 1.0, c)
        peaks = margins(Loop(self.plant, controller))
        active = max(peaks.Ms, peaks.Mt) > problem.M * (1 - ACTIVE)
        return Optimum(controller.to_series() if self.series else controller, found.value, peaks.Ms, peaks.Mt, active)

    def _shapes(self) -> tuple[np.ndarray, np.ndarray]:
        tau_I = self.scale * LOOK
        if self.kind == "PI":
            return tau_I, np.zeros(len(tau_I))
        tau_D = np.outer(DERIVATIVE, tau_I).ravel()
        return np.tile(tau_I, len(DERIVATIVE)), tau_D

    def _refuse_endless(self, problem: Problem) -> None:
        if problem.plant.theta:
            return
        tau_I, tau_D = self._shapes()
        if np.isinf(problem.edges(tau_I, tau_D)[1]).any():
            raise NoOptimum(
                said(
                    "the plant must have dead time, or more lags, for an optimal {kind} controller, found one "
                    "whose gain may grow without end within the bound: the error can be made as small as you like",
                    kind=self.kind,
                )
            )

    def _infeasible(self, problem: Problem) -> Text:
        tau_I, tau_D = self._shapes()

        def feasible(M: float) -> bool:
            return bool(np.isfinite(problem.gains.highest(problem.shapes(tau_I, tau_D), M)[1]).any())

        if not feasible(HIGHEST):
            return (NONE_OF_PI if self.kind == "PI" else NONE_OF_PID).put(M=problem.M)
        low, high = problem.M, HIGHEST
        for _ in range(BISECTIONS):
            middle = math.sqrt(low * high)
            low, high = (low, middle) if feasible(middle) else (middle, high)
        return said(
            "Ms must be large enough for a stable {kind} loop, found {M:g}: the smallest that was found is about "
            "{high:.3g}",
            kind=self.kind,
            M=problem.M,
            high=high,
        )


def _warm(found: Sequence[Optimum], M: float) -> Found:
    """Where the search for the next bound begins: where the last two point to."""
    last = _settings(found[-1])
    if len(found) > 1 and found[-1].active and found[-2].active:
        before, (M_before, M_last) = _settings(found[-2]), (max(each.Ms, each.Mt) for each in found[-2:])
        share = math.log(M / M_last) / math.log(M_last / M_before)
        ahead = last * (last / before) ** share
        last = ahead if np.isfinite(ahead).all() else last
    Kc, tau_I, tau_D = last.tolist()
    return Found(Kc, tau_I, tau_D, found[-1].value)


def _settings(optimum: Optimum) -> np.ndarray:
    form = optimum.controller.to_ideal()
    return np.array([abs(form.Kc), form.tau_I, form.tau_D])


@lru_cache(maxsize=64)
def references(plant: Plant, scale: float) -> References:
    """IAE of the PI controllers that are best for set point and for load with Ms = 1.59 [SG12]. Raises NoOptimum."""
    values = [
        Search(plant, "PI", Criterion(plant, name), scale, 0.0).best(REFERENCE_M).value for name in ("setpoint", "load")
    ]
    return References(*values)


def criterion_of(plant: Plant, name: str, scale: float) -> Criterion:
    """The criterion by name; J with its references."""
    criterion = Criterion(plant, name)
    return replace(criterion, references=references(plant, scale)) if name == "J" else criterion
