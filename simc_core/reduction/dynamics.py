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
            lags += _split_pair("poles", tau, zeta, steps)
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
        cancelled.append(BudgetEntry(f"pair {number(tau)}", "pair", tau, (("=", tau),)))
        text = f"The complex zeros with tau = {number(tau)} cancel the complex poles with the same values."
        steps.append(Step("cancel", text, "", {"tau": tau, "zeta": zeta}))
    return pairs, left, cancelled


def _split_pair(what: str, tau: float, zeta: float, steps: list[Step]) -> list[float]:
    """Two real time constants for a well damped pair, with a line about it."""
    square, middle = latex_number(tau * tau), times_s(latex_number(2 * zeta * tau))
    left = ("" if square == "1" else f"{square} ") + rf"s^2 + {middle} + 1"
    if zeta >= 1:
        large = tau * (zeta + math.sqrt(zeta * zeta - 1))
        times = [large, tau * tau / large]
        both = f"{number(times[0])} and {number(times[1])}"
        text = f"The {what} with zeta = {number(zeta)} >= 1 are real: time constants {both}."
        equation = rf"{left} = ({times_s(latex_number(times[0]))} + 1)({times_s(latex_number(times[1]))} + 1)"
    else:
        times = [tau, tau]
        text = (
            f"The complex {what} with zeta = {number(zeta)} are damped enough (zeta >= {OSCILLATING:g}) "
            f"to be taken as two equal time constants {number(tau)}; this is an approximation."
        )
        equation = rf"{left} \approx ({times_s(latex_number(tau))} + 1)^2"
    steps.append(Step("pair", text, equation, {"tau": tau, "zeta": zeta}))
    return times


def _split_lead_pair(T: float, zeta: float, steps: list[Step]) -> list[float]:
    if abs(zeta) < OSCILLATING:
        raise NotReducible(
            f"complex zeros with |zeta| < {OSCILLATING:g} are not covered by the half rule, found zeta = "
            f"{number(zeta)} with T = {number(T)}: fit a model without them to the step response, or tune by the "
            "margins"
        )
    sign = math.copysign(1.0, zeta)
    return [sign * time for time in _split_pair("zeros", T, abs(zeta), steps)]


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
        cancelled.append(BudgetEntry(f"lag {number(T)}", "lag", T, (("=", T),)))
        cancelled.append(BudgetEntry(f"zero {number(T)}", "lead", T, (("=", T),)))
        text = f"The zero {number(T)} and the lag {number(T)} are equal and cancel exactly."
        factor = f"{times_s(latex_number(T))} + 1"
        steps.append(Step("cancel", text, rf"\frac{{{factor}}}{{{factor}}} = 1", {"T0": T, "tau0": T}))
    return lags, left


def _same(a: float, b: float) -> bool:
    return math.isclose(a, b, rel_tol=SAME_FACTOR)


def _refuse(integrators: int, unstable: list[float], pairs: list[tuple[float, float]], lags: list[float]) -> None:
    """What no SIMC model exists for, in words."""
    if integrators > 2:
        raise NotReducible(
            f"integrators must be <= 2 for the half rule, found {integrators}: no SIMC rule exists beyond that; "
            "close an inner loop round one of the integrators first (cascade)"
        )
    growing = [zeta for _, zeta in pairs if zeta < 0]
    if len(unstable) + 2 * len(growing) > 1:
        raise NotReducible(
            f"at most one unstable pole is covered by a SIMC rule, found {len(unstable) + 2 * len(growing)}: "
            "stabilise the plant by an inner loop first (cascade)"
        )
    if unstable and integrators:
        raise NotReducible(
            f"an unstable pole together with integrators is not covered by a SIMC rule, found {integrators} of them: "
            "stabilise the plant by an inner loop first (cascade)"
        )
    if not pairs:
        return
    tau0, zeta = pairs[0]
    if len(pairs) > 1:
        raise NotReducible(
            f"at most one pair of poles with zeta < {OSCILLATING:g} is covered by a SIMC rule, found {len(pairs)}: "
            "enter a model with the dominant pair alone, or damp the others by an inner loop"
        )
    if unstable or integrators:
        raise NotReducible(
            f"a pair of poles with zeta = {number(zeta)} < {OSCILLATING:g} must be the only slow dynamics, "
            "found an integrator or an unstable pole beside it: enter a model without the pair if its oscillation "
            "is fast, or damp it by an inner loop"
        )
    slowest = max(lags, default=0.0)
    if slowest > tau0:
        raise NotReducible(
            f"a pair of poles with zeta = {number(zeta)} < {OSCILLATING:g} must be the slowest dynamics for the rule "
            f"of oscillating models, found tau0 = {number(tau0)} beside a lag of {number(slowest)}: "
            "enter a model without the pair if its oscillation is small, or use tau_c large and check the margins"
        )
