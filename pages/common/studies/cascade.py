"""From what the user has decided of a cascade to everything its page shows of it. Pure: no streamlit."""

import math
from dataclasses import dataclass, replace
from functools import lru_cache

from pages.common.session.cascade import Cascade
from simc_core.cascade.by_simc import SEPARATE, simc_cascade, single_loop
from simc_core.cascade.by_synthesis import synthesis_cascade
from simc_core.cascade.design import CascadeDesign
from simc_core.cascade.pairs import PairRow
from simc_core.cascade.verdict import CascadeVerdict, cascade_verdict
from simc_core.certificate.verdict import NestedStability, stability
from simc_core.errors import SimcError
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.frequency_response import FrequencyResponse, frequency_response
from simc_core.loops.nested import CascadeLoop
from simc_core.metrics.nested_performance import NestedPerformance
from simc_core.metrics.performance import performance
from simc_core.notation import rounded_up
from simc_core.sensitivity.margins import margins
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.simulation import NestedResponse, Scenario, simulate
from simc_core.studies.remedies import SLOWER
from simc_core.wording import said

USUAL_MS = 2.0  # what direct synthesis aims at where nothing is asked for
KEPT = 16  # cascades of all sessions; direct synthesis searches 0.05 to 0.2 s, and every click on the page asks again


@dataclass(frozen=True, slots=True)
class SingleLoop:
    """One controller for Ga Gb, with the same disturbances; performance is None where it is not stable, Ms then nan."""

    loop: CascadeLoop
    performance: NestedPerformance | None
    Ms: float


@dataclass(frozen=True, slots=True, eq=False)
class CascadeStudy:
    """A cascade, how it came about and what it does.

    outer, inner: margins of the loops.   performance: None where the cascade is not sound, or cannot be followed until
    it settles; then unsettled says why.   single: the alternative, None where there is none; then no_single says why.
    """

    cascade: Cascade
    design: CascadeDesign
    stability: NestedStability
    outer: Margins
    inner: Margins
    performance: NestedPerformance | None
    unsettled: str
    single: SingleLoop | None
    no_single: str

    @property
    def loop(self) -> CascadeLoop:
        """Blocks and controllers."""
        return self.design.loop

    @property
    def sound(self) -> bool:
        """Both loops are stable, the inner one on its own too: margins and metrics mean something."""
        return self.stability.sound

    @property
    def speeds(self) -> tuple[float, float]:
        """tau_c, or lambda, of the inner and of the outer loop."""
        design = self.design
        if design.tau_c_inner is not None:
            return design.tau_c_inner, design.tau_c_outer
        return design.lambda_inner, design.lambda_outer

    @property
    def separation(self) -> float:
        """How many times slower the outer loop is designed than the inner one; SEPARATE is enough for SIMC."""
        inner, outer = self.speeds
        return outer / inner

    @property
    def separate(self) -> bool:
        """Whether the loops are far enough apart to be looked at one by one."""
        return self.separation >= SEPARATE


@lru_cache(maxsize=KEPT)
def study(cascade: Cascade) -> CascadeStudy:
    """Design, judge, compare. Raises SimcError, in words, where the design is impossible."""
    design = designed(cascade)
    verdict = stability(design.loop)
    found, unsettled = _performance(design.loop) if verdict.sound else (None, "")
    single, no_single = _single(cascade)
    outer, inner = margins(design.loop.outer_loop), margins(design.loop.inner_loop)
    return CascadeStudy(cascade, design, verdict, outer, inner, found, unsettled, single, no_single)


def attempt(cascade: Cascade) -> tuple[CascadeStudy | None, SimcError | None]:
    """The study, or why there is none: the page keeps its controls either way."""
    try:
        return study(cascade), None
    except SimcError as error:
        return None, error


def designed(cascade: Cascade) -> CascadeDesign:
    """By the method chosen. A tau_c goes before an Ms. Raises SimcError."""
    each = cascade
    blocks = each.primary, each.secondary
    if each.method == "simc":
        Ms_inner = each.Ms_inner if each.tau_c_inner is None else None
        Ms_outer = each.Ms_outer if each.tau_c_outer is None else None
        return simc_cascade(
            *blocks, each.tau_c_inner, each.tau_c_outer, each.inner, each.outer, Ms_inner, Ms_outer, each.b
        )
    return synthesis_cascade(
        *blocks,
        Ms_inner=each.Ms_inner or USUAL_MS,
        Ms_outer=each.Ms_outer or USUAL_MS,
        inner=each.inner,
        outer=each.outer,
        N_inner=each.N_inner,
        N_outer=None if each.filter_outer == "zero" else each.N_outer,
        lambda_inner=each.tau_c_inner,
        lambda_outer=each.tau_c_outer,
        b=each.b,
    )


def sounder(study: CascadeStudy) -> dict[str, float]:
    """Larger tau_c (or lambda) that were tried and give a sound cascade: of the loop to blame, else of both; or {}."""
    inner, outer = study.speeds
    inside = study.stability.inner.verdict != "stable"
    blamed = {"tau_c_inner": inner} if inside else {"tau_c_outer": outer}
    for loops in (blamed, {"tau_c_inner": inner, "tau_c_outer": outer}):
        for factor in SLOWER:
            change = {name: rounded_up(factor * speed) for name, speed in loops.items()}
            try:
                found = designed(replace(study.cascade, **change))
            except SimcError:
                continue
            if stability(found.loop).sound:
                return change
    return {}


def time_responses(study: CascadeStudy) -> tuple[tuple[str, NestedResponse], ...]:
    """Steps of r, then of d1, then of d2; of the single loop at the same instants, where it is stable."""
    first = simulate(study.loop, Scenario())
    found = [(said("cascade"), first)]
    if study.single is not None and study.single.performance is not None:
        d1, d2 = starts(first)
        t_end = float(first.t[-1])
        same = Scenario(disturbance_time=d1, disturbance2_time=d2, t_end=t_end)
        found.append((said("single loop"), simulate(study.single.loop, same)))
    return tuple(found)


def starts(response: NestedResponse) -> tuple[float, float]:
    """When d1 and d2 begin."""
    return float(response.t[response.d != 0][0]), float(response.t[response.d2 != 0][0])


def frequency_responses(study: CascadeStudy) -> tuple[FrequencyResponse, FrequencyResponse]:
    """La, with the inner loop closed, and Lb, at the same frequencies, which hold those of the margins."""
    judged = (study.outer, study.inner)
    marks = [omega for m in judged for omega in (m.omega_180, m.omega_c, m.omega_Ms, m.omega_Mt)]
    omega = omega_grid([study.loop.outer_loop.own, study.loop.inner_loop.L], marks)
    return frequency_response(study.loop.outer_loop, omega), frequency_response(study.loop.inner_loop, omega)


def of_row(row: PairRow) -> Cascade:
    """A design of the paper as the user's own; b as printed, else 1."""
    asked = {f"Ms_{loop}": Ms for loop, Ms in (("inner", row.Ms_inner), ("outer", row.Ms_outer)) if Ms != USUAL_MS}
    primary, secondary = row.blocks
    return Cascade(
        primary,
        secondary,
        row.method,
        row.inner,
        row.outer,
        **(asked if row.method == "synthesis" else {}),
        b=row.published.b if row.published else 1.0,
        N_outer=row.N_outer or Cascade().N_outer,
        filter_outer="zero" if row.N_outer is None else "N",
    )


def verdict(study: CascadeStudy) -> CascadeVerdict | None:
    """Whether the cascade pays; None where it or the single loop has no IAE."""
    if study.performance is None or study.single is None or study.single.performance is None:
        return None
    single = study.single
    return cascade_verdict(study.performance, study.outer.Ms, study.inner.Ms, single.performance, single.Ms)


def speed_symbol(cascade: Cascade) -> str:
    """tau_c of SIMC, lambda of the direct synthesis, as LaTeX."""
    return r"\tau_c" if cascade.method == "simc" else r"\lambda"


def scale(cascade: Cascade, loop: str) -> float:
    """A time to measure the speed of a loop by: dead times and time constants of its blocks together."""
    blocks = [cascade.secondary] if loop == "inner" else [cascade.primary, cascade.secondary]
    return sum(block.total_time for block in blocks) or 1.0


def _performance(loop: CascadeLoop) -> tuple[NestedPerformance | None, str]:
    try:
        return performance(loop), ""
    except SimcError as error:
        return None, str(error)


def _single(cascade: Cascade) -> tuple[SingleLoop | None, str]:
    """With the same set-point weight; where SIMC has no rule, with the Ms asked of the outer loop."""
    try:
        loop = single_loop(cascade.primary, cascade.secondary, Ms=cascade.Ms_outer or USUAL_MS)
    except SimcError as error:
        return None, str(error)
    loop = replace(loop, outer=loop.outer.with_weight(cascade.b))
    judged = margins(loop.outer_loop)
    if not judged.stable:
        return SingleLoop(loop, None, math.nan), said("it is not stable")
    found, why = _performance(loop)
    return SingleLoop(loop, found, judged.Ms), why
