"""Numbers that others printed, that follow by hand, or that were computed in many digits by another method.

Each beside the function of this library that gives it. The Accuracy page computes them while you watch.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from simc_core.cascade.by_synthesis import synthesis_cascade
from simc_core.certificate.verdict import stability
from simc_core.controllers.forms import Controller, IController, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import SimcError
from simc_core.loops.loop import Loop
from simc_core.loops.nested import CascadeLoop
from simc_core.metrics.nested_performance import NestedPerformance
from simc_core.metrics.performance import Performance, performance
from simc_core.plants.plant import Plant
from simc_core.published.values import (
    DOUBLE_INTEGRATING,
    FIRST_ORDER,
    INTEGRATING,
    MARGIN_CASES,
    PURE_DELAY,
    STEP_METRICS,
    TIME_CASES,
    TimeCase,
)
from simc_core.reduction.half_rule import half_rule
from simc_core.rules.simc import simc
from simc_core.sensitivity.margins import margins
from simc_core.simulation import Scenario, simulate
from simc_core.wording import Text, counted, said

SETPOINT, LOAD = said("set point"), said("load")
METRIC_NAMES = {"overshoot": said("overshoot"), "peak_time": said("peak time")}
HAND, DIGITS = said("by hand"), said("mpmath, 60 digits")
TIME, METRICS, MARGINS = said("Time responses"), said("Metrics of steps"), said("Margins")
LIMITS, RULES, CASCADE = said("Stability at the limit"), said("Half rule and settings"), said("Cascade")
GROUPS = (TIME, METRICS, MARGINS, LIMITS, RULES, CASCADE)
STABLE, MARGINAL, UNSTABLE = said("stable"), said("marginal"), said("unstable, ∞ poles")
VERDICTS = {"stable": STABLE, "marginal": MARGINAL}
MARGIN_NAMES = {
    "first order": said("First order, tight"),
    "integrating": said("Integrating, tight"),
    "double integrating": said("Double integrating, tight"),
}
TABLE_4 = said("[SK03 Table 4]")
EXACT = 1e-9  # relative, or absolute below 1: what responses and margins promise
INTEGRALS = 1e-8  # what metrics promise
TIE = 0.005 + 1e-12  # half a printed digit where the exact number lies just between two


@dataclass(frozen=True, slots=True)
class Reference:
    """quantity of what: `expected` says the source, `compute` gives ours.

    expected: a number, met within tolerance; or words, to be met exactly.
    """

    group: str
    what: str
    quantity: str
    source: str
    expected: float | str
    tolerance: float
    compute: Callable[[], float | str]

    @property
    def exact(self) -> bool:
        """Whether the expected value is known to more digits than any computer number has; printed ones are not."""
        return not self.source.startswith("[")


@dataclass(frozen=True, slots=True)
class Check:
    """A reference computed now. difference: nan for words.   fault: why there is no number of ours, else empty."""

    reference: Reference
    ours: float | str
    fault: str = ""

    @property
    def difference(self) -> float:
        """Ours less the expected one."""
        ours, expected = self.ours, self.reference.expected
        return math.nan if isinstance(ours, str) or isinstance(expected, str) else ours - expected

    @property
    def met(self) -> bool:
        """Whether it is within the tolerance; nan is not, and neither is what could not be computed."""
        if self.fault:
            return False
        if isinstance(self.reference.expected, str):
            return self.ours == self.reference.expected
        return abs(self.difference) <= self.reference.tolerance


def check(reference: Reference) -> Check:
    """Compute it; what the library refuses to compute is a fault, not an exception."""
    try:
        return Check(reference, reference.compute())
    except SimcError as error:
        return Check(reference, math.nan, str(error))


def check_all() -> list[Check]:
    """All references, computed now."""
    _performance.cache_clear()
    _cascade_performance.cache_clear()
    return [check(reference) for reference in REFERENCES]


@lru_cache(maxsize=8)  # several rows show metrics of one loop; check_all begins with an empty one
def _performance(loop: Loop) -> Performance:
    return performance(loop)


@lru_cache(maxsize=8)
def _cascade_performance(loop: CascadeLoop) -> NestedPerformance:
    return performance(loop)


def _y(loop: Loop, t: float, load: bool = False) -> float:
    scenario = Scenario(0.0 if load else 1.0, 1.0 if load else 0.0, 0.0, t=np.array([t]))
    return float(simulate(loop, scenario).y[0])


def _y_of(t: float, step: Text) -> Text:
    return said("y({t:g}), {step}", t=t, step=step)


def _time_rows(case: TimeCase) -> list[Reference]:
    loop = Loop(case.plant, case.controller)
    return [
        Reference(
            TIME,
            case.what,
            said("y({t:g}), {step}", t=case.t, step=word),
            DIGITS,
            expected,
            EXACT,
            partial(_y, loop, case.t, load),
        )
        for word, load, expected in ((SETPOINT, False, case.setpoint), (LOAD, True, case.load))
    ]


DELAYED_INTEGRATOR = Loop(Plant(1, 1), IController(2))  # L = 2 e^{-s}/s


def _times() -> list[Reference]:
    rows = [
        Reference(
            TIME,
            "L = 2 e⁻ˢ/s",
            said("y({t:g}), {step}", t=t, step=SETPOINT),
            HAND,
            y,
            EXACT,
            partial(_y, DELAYED_INTEGRATOR, t),
        )
        for t, y in ((1.5, 1.0), (2.5, 2.5), (3.0, 2.0))
    ]
    return rows + [row for case in TIME_CASES for row in _time_rows(case)]


LAG_DOMINANT = Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))


def _metrics() -> list[Reference]:
    def row(what: str, loop: Loop, step: str, name: str, source: str, expected: float, tolerance: float) -> Reference:
        step_name = LOAD if step == "disturbance" else SETPOINT
        shown = said("{metric}, {step}", metric=METRIC_NAMES.get(name, name), step=step_name)
        return Reference(
            *(METRICS, what, shown, source, expected, tolerance),
            lambda: getattr(getattr(_performance(loop), step), name),
        )

    by_hand = said("by hand: {value}", value="τI/Kc")
    delay = said("Pure dead time, tight")
    rows = [
        row(delay, PURE_DELAY, "setpoint", name, DIGITS, expected, INTEGRALS) for name, expected in STEP_METRICS.items()
    ]
    return [
        *rows,
        row(delay, PURE_DELAY, "setpoint", "IAE", said("[SK03 Table 3]"), 2.17, 0.005),
        row(
            said("Lag dominant, tight"),
            LAG_DOMINANT,
            "disturbance",
            "IAE",
            by_hand,
            2.0,
            2 * INTEGRALS,
        ),
        row(
            said("Integrating, tight"),
            INTEGRATING,
            "disturbance",
            "IAE",
            by_hand,
            16.0,
            16 * INTEGRALS,
        ),
    ]


def _margins() -> list[Reference]:
    def row(what: str, loop: Loop, name: str, source: str, expected: float, tolerance: float) -> Reference:
        shown = {"PM_deg": said("PM, degrees"), "delay_margin": said("delay margin")}.get(name, name)
        return Reference(MARGINS, what, shown, source, expected, tolerance, lambda: getattr(margins(loop), name))

    first = said("First order, tight")
    rows = [
        row(first, FIRST_ORDER, "GM", said("by hand: {value}", value="π"), math.pi, EXACT * math.pi),
        row(first, FIRST_ORDER, "PM_deg", said("by hand: {value}", value="90 − 90/π"), 90 - 90 / math.pi, EXACT * 61),
        row(first, FIRST_ORDER, "delay_margin", said("by hand: {value}", value="π − 1"), math.pi - 1, EXACT * 2),
    ]
    for what, (loop, values) in MARGIN_CASES.items():
        rows += [
            row(MARGIN_NAMES[what], loop, name, DIGITS, expected, EXACT * expected) for name, expected in values.items()
        ]
    return [
        *rows,
        row(first, FIRST_ORDER, "Ms", said("[SK03 Table 2]"), 1.59, 0.005),
        row(said("Integrating, tight"), INTEGRATING, "Ms", said("[SK03 Table 2]"), 1.70, 0.005),
        row(said("Double integrating, tight"), DOUBLE_INTEGRATING, "Ms", said("[SK03 Table 3]"), 1.96, 0.005),
    ]


def _verdict(loop: Loop) -> str:
    found = stability(loop)
    if found.verdict != "unstable":
        return VERDICTS[found.verdict]
    return UNSTABLE if math.isinf(found.unstable_poles) else _unstable(int(found.unstable_poles))


def _unstable(poles: int) -> Text:
    return counted("unstable, {n} pole", "unstable, {n} poles", poles)


def _limits() -> list[Reference]:
    def row(what: str, plant: Plant, controller: Controller, name: str, expected: str) -> Reference:
        return Reference(LIMITS, what, name, HAND, expected, 0.0, lambda: _verdict(Loop(plant, controller)))

    delay, unstable, around = Plant(1, 1), Plant(-1, 1, (-2,)), ((-1e-9, "(1 − 1e-9)"), (0.0, ""), (1e-9, "(1 + 1e-9)"))
    integral = [(STABLE, "K = π/2"), (MARGINAL, "K = π/2"), (_unstable(2), "K = π/2")]
    proportional = [(_unstable(1), "k = 1"), (MARGINAL, "k = 1"), (STABLE, "k = 1")]
    rows = [
        row("L = K e⁻ˢ/s", delay, IController(math.pi / 2 * (1 + off)), f"{name} {more}".strip(), verdict)
        for (verdict, name), (off, more) in zip(integral, around, strict=True)
    ]
    rows.append(row("L = K e⁻ˢ/s", delay, IController(20), "K = 20", _unstable(6)))
    rows += [
        row("L = k e⁻ˢ/(2s − 1)", unstable, SeriesPid(1 + off, math.inf), f"{name} {more}".strip(), verdict)
        for (verdict, name), (off, more) in zip(proportional, around, strict=True)
    ]
    neutral = ParallelPid(1, 0.1, 1.01)  # |L(inf)| = Kd/tau
    rows.append(row(said("Unfiltered D on a first-order lag"), Plant(1, 1, (1,)), neutral, "|L(∞)| = 1.01", UNSTABLE))
    return rows


V06_1 = Plant(1, 3, (6, 4, 2))
E2 = Plant(1, 0, (2, 1, 0.4, 0.2, 0.05, 0.05, 0.05), (-0.3, 0.08))
E6 = Plant(1, 0, (1, 1, 0.028), (0.17, 0.17), 1)
E12 = Plant(1, 0.3, (10, 8, 1), (6, 3))


def _rules() -> list[Reference]:
    def row(what: str, name: str, source: str, expected: float, tolerance: float, compute: Callable) -> Reference:
        return Reference(RULES, what, name, source, expected, tolerance, lambda: getattr(compute(), name))

    def ideal() -> IdealPid:
        return simc(half_rule(V06_1, 2).model).to_ideal()

    return [
        row(said("Example 1, PI"), "Kc", "[V06]", 0.57, 0.005, lambda: simc(half_rule(V06_1).model)),
        row(said("Example 1, ideal PID"), "Kc", "[V06]", 1.38, TIE, ideal),
        row(said("Example 1, ideal PID"), "tau_D", "[V06]", 2.73, 0.005, ideal),
        row(said("E2, first order"), "theta", TABLE_4, 1.47, 0.005, lambda: half_rule(E2).model),
        row(
            said("E6, integrating with lag"),
            "theta",
            TABLE_4,
            0.358,
            5e-4,
            lambda: half_rule(E6, 2).model,
        ),
        row(said("E12, two zeros"), "k", TABLE_4, 0.225, 5e-4, lambda: half_rule(E12).model),
    ]


PAIR_1 = (Plant(2, 2, (5,)), Plant(1, 1, (2, 3)))
ROW_1A = CascadeLoop(
    *PAIR_1, ParallelPid(0.5524, 0.1061, 0.4884, 0.1025, b=0.3), ParallelPid(3.3928, 0.8250, 3.7773, 0.0521)
)


def _cascade() -> list[Reference]:
    def row(name: str, expected: float, tolerance: float, compute: Callable[[], float]) -> Reference:
        return Reference(CASCADE, said("Pair 1, row a"), name, "[PSB]", expected, tolerance, compute)

    def outer() -> ParallelPid:
        return synthesis_cascade(*PAIR_1, 2.0, 2.0, lambda_inner=1.04275, lambda_outer=2.05).outer.to_parallel()

    return [
        row(said("IAE of d1"), 9.47, 0.005, lambda: _cascade_performance(ROW_1A).disturbance.IAE),
        row(said("IAE of d2"), 2.31, 0.005, lambda: _cascade_performance(ROW_1A).disturbance2.IAE),
        row("Msa", 2.0, 0.05, lambda: margins(ROW_1A.outer_loop).Ms),
        row("Msb", 2.0, 0.05, lambda: margins(ROW_1A.inner_loop).Ms),
        row(said("k of Ca at λ = 2.05"), 0.5524, 5e-4, lambda: outer().Kp),
        row(said("ki of Ca at λ = 2.05"), 0.1061, 1e-4, lambda: outer().Ki),
    ]


REFERENCES = (*_times(), *_metrics(), *_margins(), *_limits(), *_rules(), *_cascade())
