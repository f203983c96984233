"""A plant sorted into what the half rule works with: real lags, zeros by sign, and what it must keep.

Complex pairs: zeta >= 1 is two real time constants tau (zeta +- sqrt(zeta^2 - 1)), exactly; 0.7 <= zeta < 1 is
taken as two equal ones, tau; below that a pair of poles is kept as it is, and has a model of its own.
A zero that equals a lag cancels it, exactly.
"""

import math
from dataclasses import dataclass

from simc_core.errors import NotReducible
from simc_core.notation import latex_number, number, times_s
from simc_core.plants.plant import Plant
from simc_core.reduction.records import BudgetEntry, Step
from simc_core.wording import said

OSCILLATING = 0.7  # damping below which a pair is not two lags any more
SAME_FACTOR = 1e-9  # relative; a zero and a lag this close are one factor typed twice


@dataclass(frozen=True, slots=True)
class Dynamics:
    """Times > 0. inverse: -T of the right-half-plane zeros. unstable: tau > 0 of 1/(tau s - 1), 0 if none.

    pair: (tau0, zeta) of an oscillating pair, None if there is none. cancelled: entries already dealt with.
    """

    k: float
    theta: float
    lags: tuple[float, ...]
    leads: tuple[float, ...]
    inverse: tuple[float, ...]
    integrators: int
    unstable: float
    pair: tuple[float, float] | None
    steps: tuple[Step, ...]
    cancelled: tuple[BudgetEntry, ...]


def dynamics(plant: Plant) -> Dynamics:
    """`plant` sorted for the half rule.

    Raises NotReducible where the rule has no model for it; the message says what can be done instead.
    """
    steps: list[Step] = []
    lags = list(plant.lags)
    pairs, lead_pairs, cancelled = _cancelled_pairs(plant, steps)
    kept = []
    for tau, zeta in pairs:
        if zeta < OSCILLATING:
            kept.append((tau, zeta))
        else:
            lags += _split_pair(False, tau, zeta, steps)
    leads = list(plant.leads) + [T for T0, zeta in lead_pairs for T in _split_lead_pair(T0, zeta, steps)]
    lags, leads = _cancelled_lags(lags, leads, steps, cancelled)
    unstable = [-tau for tau in lags if tau < 0]
    _refuse(plant.integrators, unstable, kept, lags)
    return Dynamics(
        plant.k,
        plant.theta,
        tuple(sorted((tau for tau in lags if tau > 0), reverse=True)),
        tuple(sorted((T for T in leads if T > 0), reverse=True)),
        tuple(sorted((-T for T in leads if T < 0), reverse=True)),
        plant.integrators,
        unstable[0] if unstable else 0.0,
        kept[0] if kept else None,
        tuple(steps),
        tuple(cancelled),
    )


def _cancelled_pairs(
    plant: Plant, steps: list[Step]
) -> tuple[list[tuple[float, float]], list[tuple[float, float]], list[BudgetEntry]]:
    """Pairs of poles and of zeros without those that are equal and damped, and the entries of these."""
    pairs, left, cancelled = list(plant.lag_pairs), [], []
    for tau, zeta in plant.lead_pairs:
        same = [p for p in pairs if _same(p[0], tau) and _same(p[1], zeta) and zeta > 0]
        if not same:
            left.append((tau, zeta))
            continue
        pairs.remove(same[0])
        cancelled.append(BudgetEntry(said("pair {tau}", tau=number(tau)), "pair", tau, (("=", tau),)))
        text = said(
            "The complex zeros with tau = {tau} cancel the complex poles with the same values.", tau=number(tau)
        )
        steps.append(Step("cancel", text, "", {"tau": tau, "zeta": zeta}))
    return pairs, left, cancelled


REAL_POLES = said(
    "The poles with zeta = {zeta} >= 1 are real: time constants {first} and {second}.", zeta="", first="", second=""
)
REAL_ZEROS = said(
    "The zeros with zeta = {zeta} >= 1 are real: time constants {first} and {second}.", zeta="", first="", second=""
)
EQUAL_POLES = said(
    "The complex poles with zeta = {zeta} are damped enough (zeta >= {limit:g}) to be taken as two equal time "
    "constants {tau}; this is an approximation.",
    zeta="",
    limit=OSCILLATING,
    tau="",
)
EQUAL_ZEROS = said(
    "The complex zeros with zeta = {zeta} are damped enough (zeta >= {limit:g}) to be taken as two equal time "
    "constants {tau}; this is an approximation.",
    zeta="",
    limit=OSCILLATING,
    tau="",
)


def _split_pair(of_zeros: bool, tau: float, zeta: float, steps: list[Step]) -> list[float]:
    """Two real time constants for a well damped pair, with a line about it."""
    square, middle = latex_number(tau * tau), times_s(latex_number(2 * zeta * tau))
    left = ("" if square == "1" else f"{square} ") + rf"s^2 + {middle} + 1"
    if zeta >= 1:
        large = tau * (zeta + math.sqrt(zeta * zeta - 1))
        times = [large, tau * tau / large]
        text = (REAL_ZEROS if of_zeros else REAL_POLES).put(
            zeta=number(zeta), first=number(times[0]), second=number(times[1])
        )
        equation = rf"{left} = ({times_s(latex_number(times[0]))} + 1)({times_s(latex_number(times[1]))} + 1)"
    else:
        times = [tau, tau]
        text = (EQUAL_ZEROS if of_zeros else EQUAL_POLES).put(zeta=number(zeta), tau=number(tau))
        equation = rf"{left} \approx ({times_s(latex_number(tau))} + 1)^2"
    steps.append(Step("pair", text, equation, {"tau": tau, "zeta": zeta}))
    return times


def _split_lead_pair(T: float, zeta: float, steps: list[Step]) -> list[float]:
    if abs(zeta) < OSCILLATING:
        raise NotReducible(
            said(
                "complex zeros with |zeta| < {oscillating:g} are not covered by the half rule, found zeta = "
                "{zeta} with T = {T}: fit a model without them to the step response, or tune by the margins",
                oscillating=OSCILLATING,
                zeta=number(zeta),
                T=number(T),
            )
        )
    sign = math.copysign(1.0, zeta)
    return [sign * time for time in _split_pair(True, T, abs(zeta), steps)]


def _cancelled_lags(
    lags: list[float], leads: list[float], steps: list[Step], cancelled: list[BudgetEntry]
) -> tuple[list[float], list[float]]:
    """Lags and leads without the stable ones that are equal."""
    left = []
    for T in leads:
        same = [tau for tau in lags if T > 0 and _same(tau, T)]
        if not same:
            left.append(T)
            continue
        lags.remove(same[0])
        cancelled.append(BudgetEntry(said("lag {T}", T=number(T)), "lag", T, (("=", T),)))
        cancelled.append(BudgetEntry(said("zero {T}", T=number(T)), "lead", T, (("=", T),)))
        text = said("The zero {T} and the lag {T} are equal and cancel exactly.", T=number(T))
        factor = f"{times_s(latex_number(T))} + 1"
        steps.append(Step("cancel", text, rf"\frac{{{factor}}}{{{factor}}} = 1", {"T0": T, "tau0": T}))
    return lags, left


def _same(a: float, b: float) -> bool:
    return math.isclose(a, b, rel_tol=SAME_FACTOR)


def _refuse(integrators: int, unstable: list[float], pairs: list[tuple[float, float]], lags: list[float]) -> None:
    """What no SIMC model exists for, in words."""
    if integrators > 2:
        raise NotReducible(
            said(
                "integrators must be <= 2 for the half rule, found {integrators}: no SIMC rule exists beyond "
                "that; close an inner loop round one of the integrators first (cascade)",
                integrators=integrators,
            )
        )
    growing = [zeta for _, zeta in pairs if zeta < 0]
    if len(unstable) + 2 * len(growing) > 1:
        raise NotReducible(
            said(
                "at most one unstable pole is covered by a SIMC rule, found {unstable}: stabilise the plant by "
                "an inner loop first (cascade)",
                unstable=len(unstable) + 2 * len(growing),
            )
        )
    if unstable and integrators:
        raise NotReducible(
            said(
                "an unstable pole together with integrators is not covered by a SIMC rule, found {integrators} "
                "of them: stabilise the plant by an inner loop first (cascade)",
                integrators=integrators,
            )
        )
    if not pairs:
        return
    tau0, zeta = pairs[0]
    if len(pairs) > 1:
        raise NotReducible(
            said(
                "at most one pair of poles with zeta < {oscillating:g} is covered by a SIMC rule, found {pairs}:"
                " enter a model with the dominant pair alone, or damp the others by an inner loop",
                oscillating=OSCILLATING,
                pairs=len(pairs),
            )
        )
    if unstable or integrators:
        raise NotReducible(
            said(
                "a pair of poles with zeta = {zeta} < {oscillating:g} must be the only slow dynamics, found an "
                "integrator or an unstable pole beside it: enter a model without the pair if its oscillation is "
                "fast, or damp it by an inner loop",
                zeta=number(zeta),
                oscillating=OSCILLATING,
            )
        )
    slowest = max(lags, default=0.0)
    if slowest > tau0:
        raise NotReducible(
            said(
                "a pair of poles with zeta = {zeta} < {oscillating:g} must be the slowest dynamics for the rule "
                "of oscillating models, found tau0 = {tau0} beside a lag of {slowest}: enter a model without the"
                " pair if its oscillation is small, or use tau_c large and check the margins",
                zeta=number(zeta),
                oscillating=OSCILLATING,
                tau0=number(tau0),
                slowest=number(slowest),
            )
        )
