"""The reduction told line by line, its budget, and advice; made from the outcome, so that they cannot disagree."""

import math

from simc_core.notation import latex, latex_number, number, times_s
from simc_core.plants.models import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    Model,
    OscillatingDelay,
    SecondOrderDelay,
    UnstableDelay,
)
from simc_core.reduction.dynamics import Dynamics
from simc_core.reduction.records import LARGEST_MS, BudgetEntry, Candidate, Orders, Step
from simc_core.reduction.split import TrialReduction
from simc_core.reduction.zeros import RuleApplied

NAMES = {"tau1": r"\tau_1", "tau2": r"\tau_2"}
WHERE = {
    "T1": "T0 >= tau0 >= theta",
    "T1a": "T0 >= theta >= tau0",
    "T1b": "theta >= T0 >= tau0",
    "T2": "tau0 >= T0 >= 5 theta",
    "T3": "min(tau0, 5 theta) >= T0",
}


HALVED = (("h/2", "sampling", "half the sampling period"), ("tau_F/2", "filter", "half the filter time"))


def steps(
    parts: Dynamics, trial: TrialReduction, late: tuple[float, float], candidates: tuple[Candidate, ...]
) -> tuple[Step, ...]:
    """What was done, in order. late: h and tau_F."""
    chosen = next(candidate for candidate in candidates if candidate.chosen)
    told = [*parts.steps]
    told += [_match_step(match, chosen.theta) for match in trial.removal.matches]
    told += _half_rule_steps(trial)
    told.append(_delay_step(parts, trial, late, chosen.theta))
    if isinstance(chosen.model, SecondOrderDelay) and _swapped(trial):
        larger, smaller = chosen.model.tau1, chosen.model.tau2
        text = f"tau2 = {number(larger)} came out larger than tau1 = {number(smaller)}: the two change places."
        told.append(Step("swap", text, r"\tau_1 \leftrightarrow \tau_2", {"tau1": larger, "tau2": smaller}))
    if not trial.consistent:
        text = "No dead time is consistent with the rules T1-T3 here (they jump across it); the nearest is taken."
        told.append(Step("choice", text, rf"\theta \approx {latex_number(chosen.theta)}", {"theta": chosen.theta}))
    if len(candidates) > 1:
        told.append(_choice_step(candidates, chosen))
    told.append(Step("model", "The reduced model.", rf"G_r(s) = {latex(chosen.model)}", _fields(chosen.model)))
    return tuple(told)


def budget(parts: Dynamics, trial: TrialReduction, late: tuple[float, float]) -> tuple[BudgetEntry, ...]:
    """What became of every lag, zero and delay of the plant, and of `late`, h and tau_F."""
    pieces: dict[int, list[tuple[str, float]]] = {i: [] for i in range(len(parts.lags))}
    origin: list[list[tuple[str, float]]] = [[] for _ in range(parts.integrators)]
    for match in trial.removal.matches:
        if match.lag >= 0:
            pieces[match.lag].append((match.rule, match.tau0 - match.rest))
        elif match.lag == -1 and math.isinf(match.tau0):
            next(parts_ for parts_ in origin if not parts_).append((match.rule, math.inf))
    for index, where, amount in _allocation(trial):
        if index >= 0:
            pieces[index].append((where, amount))
    entries = [BudgetEntry(f"lag {number(tau)}", "lag", tau, tuple(pieces[i])) for i, tau in enumerate(parts.lags)]
    entries += [
        BudgetEntry("integrator", "integrator", math.inf, tuple(done or [("slope", math.inf)])) for done in origin
    ]
    if parts.unstable:
        entries.append(
            BudgetEntry(f"unstable pole {number(parts.unstable)}", "unstable", parts.unstable, (("a", parts.unstable),))
        )
    if parts.pair:
        tau0 = parts.pair[0]
        entries.append(BudgetEntry(f"pair {number(tau0)}", "pair", tau0, (("tau0", tau0),)))
    rule_of = {match.lead: match.rule for match in trial.removal.matches}
    entries += [BudgetEntry(f"zero {number(T)}", "lead", T, ((rule_of[i], T),)) for i, T in enumerate(parts.leads)]
    entries += [BudgetEntry(f"inverse zero {number(T)}", "inverse", T, (("theta", T),)) for T in parts.inverse]
    if parts.theta:
        entries.append(
            BudgetEntry(f"dead time {number(parts.theta)}", "dead time", parts.theta, (("theta", parts.theta),))
        )
    for time, (symbol, kind, _) in zip(late, HALVED, strict=True):
        if time:
            entries.append(BudgetEntry(f"{kind} {symbol} = {number(time / 2)}", kind, time / 2, (("theta", time / 2),)))
    return (*entries, *parts.cancelled)


def notes(parts: Dynamics, model: Model, order: int, orders: Orders | None) -> tuple[str, ...]:
    """Advice in sentences."""
    said = []
    if orders is not None and not math.isnan(orders.ratio):
        said.append(of_orders(orders))
    match model:
        case DoubleIntegratingDelay():
            said.append("Two integrators need derivative action: the model is the same for order 1 and 2.")
        case OscillatingDelay():
            said.append(
                "The oscillating pair is kept whatever the order; its rule is a PID in ideal form. "
                "The controller cancels the pair and does not damp it: with D on the measurement, set-point steps and "
                "input disturbances both ring with the damping of the open plant."
            )
        case UnstableDelay() if order == 1 and parts.lags:
            said.append(
                "With an unstable pole, order 1 adds every lag in full to the dead time; order 2 keeps the largest."
            )
        case FirstOrderDelay(tau1=0.0):
            said.append("No lag is left: pure dead time, whose SIMC controller is a pure integrator.")
    if isinstance(model, SecondOrderDelay) and model.tau2 == 0:
        said.append("There is no second lag: the model is of first order and its controller a PI.")
    if model.theta == 0:
        said.append(
            "The effective dead time is 0: tau_c = theta is no choice here, choose tau_c yourself. "
            "Nothing in this model limits the speed."
        )
    return tuple(said)


def of_orders(orders: Orders) -> str:
    """Whether order 2 pays, in numbers."""
    measured = "Load error tau_I/Kc of the tuning with Ms = 1.6 around the full plant"
    if math.isinf(orders.first):
        return "Derivative action (order 2) pays: order 1 does not reach Ms = 1.6 around the full plant, order 2 does."
    if math.isinf(orders.second):
        return "Derivative action (order 2) does not pay: it never has Ms = 1.6 around the full plant, order 1 has."
    verdict = "pays" if orders.second_pays else "does not pay" if orders.ratio <= 1 else "brings little"
    numbers = f"{number(orders.first, 3)} with order 1, {number(orders.second, 3)} with order 2"
    return f"Derivative action (order 2) {verdict}. {measured}: {numbers}."


def _match_step(match: RuleApplied, theta: float) -> Step:
    T0, tau0, rest = (times_s(latex_number(value)) for value in (match.T0, match.tau0, match.rest))
    amounts = {"T0": match.T0, "tau0": match.tau0, "theta": theta, "rest": match.rest, "gain": match.gain}
    if match.rule == "1998 small":
        text = (
            f"1998 rule: the zero {number(match.T0)} is small (not above theta) and is subtracted from the dead time."
        )
        return Step(match.rule, text, rf"{T0} + 1 \approx e^{{{T0}}}", amounts)
    integrator = math.isinf(match.tau0)
    below = "s" if integrator else f"{tau0} + 1"
    gain = latex_number(match.gain)
    becomes = rf"\frac{{{gain}}}{{{rest} + 1}}" if match.rest else gain
    equation = rf"\frac{{{T0} + 1}}{{{below}}} \approx {becomes}"
    against = "the integrator" if integrator else f"the lag {number(match.tau0)}"
    outcome = f"a lag of {number(match.rest)} is left" if match.rest else "both vanish"
    if match.rule.startswith("1998"):
        text = f"1998 rule: the zero {number(match.T0)} meets {against}; {outcome}."
    else:
        where = f"{WHERE[match.rule]} with theta = {number(theta)}"
        text = f"Rule {match.rule} ({where}): the zero {number(match.T0)} meets {against}; {outcome}"
        text += "." if match.gain == 1 else f", gain times {number(match.gain)}."
    return Step(match.rule, text, equation, amounts)


def _allocation(trial: TrialReduction) -> list[tuple[int, str, float]]:
    """(index of the lag, where, time) for every lag that the zeros have left."""
    names, absorber = trial.shape.kept, trial.shape.absorber
    if _swapped(trial):
        names = names[::-1]
        absorber = "tau1"
    placed = []
    for i, lag in enumerate(trial.removal.lags):
        tau = lag.tau.at
        if i < len(names):
            placed.append((lag.index, names[i], tau))
        elif i == len(names) and absorber:
            placed += [(lag.index, absorber, tau / 2), (lag.index, "theta", tau / 2)]
        else:
            placed.append((lag.index, "theta", tau))
    return placed


def _swapped(trial: TrialReduction) -> bool:
    lags = [lag.tau.at for lag in trial.removal.lags]
    return trial.shape.kept == ("tau1", "tau2") and len(lags) > 2 and lags[1] + lags[2] / 2 > lags[0]


def _half_rule_steps(trial: TrialReduction) -> list[Step]:
    """Which lags are kept, and which one is split."""
    names, absorber = trial.shape.kept, trial.shape.absorber
    lags = [lag.tau.at for lag in trial.removal.lags]
    told = []
    for name, tau in zip(names, lags, strict=False):
        text = f"The lag {number(tau)} is kept as {name}."
        told.append(Step("keep", text, rf"{NAMES[name]} = {latex_number(tau)}", {name: tau}))
    if absorber and len(lags) > len(names):
        tau = lags[len(names)]
        half = latex_number(tau / 2)
        if absorber == "integrator":
            text = f"Half rule: the lag {number(tau)} is split; the integrator absorbs half, half goes to theta."
            equation = rf"\frac{{{latex_number(tau)}}}{{2}} = {half}"
        else:
            kept = lags[len(names) - 1]
            text = f"Half rule: the lag {number(tau)} is split; one half goes to {absorber}, the other to theta."
            total = latex_number(kept + tau / 2)
            equation = rf"{NAMES[absorber]} = {latex_number(kept)} + \frac{{{latex_number(tau)}}}{{2}} = {total}"
        told.append(Step("half rule", text, equation, {"tau": tau, "half": tau / 2}))
    return told


def _delay_step(parts: Dynamics, trial: TrialReduction, late: tuple[float, float], theta: float) -> Step:
    """The sum that makes the effective delay."""
    terms = [("dead time", parts.theta)] if parts.theta else []
    terms += [("lag", amount) for _, where, amount in _allocation(trial) if where == "theta"]
    terms += [("inverse response zero", T) for T in parts.inverse]
    halved = [(time / 2, *words) for time, words in zip(late, HALVED, strict=True) if time]
    terms += [(symbol, half) for half, symbol, *_ in halved]
    subtracted = [match.T0 for match in trial.removal.matches if match.rule == "1998 small"]
    total = " + ".join(latex_number(amount) for _, amount in terms) or "0"
    total += "".join(f" - {latex_number(T)}" for T in subtracted)
    if len(terms) + len(subtracted) > 1:
        total += f" = {latex_number(theta)}"
    sources = [
        *(["the dead time"] if parts.theta else []),
        *(["the rest of the lags"] if any(kind == "lag" for kind, _ in terms) else []),
        *(["the right-half-plane zeros"] if parts.inverse else []),
        *(said for *_, said in halved),
    ]
    text = f"Effective dead time: {', '.join(sources) or 'nothing adds to it'}"
    text += ", less the small zeros." if subtracted else "."
    return Step("delay", text, rf"\theta = {total}", {"theta": theta})


def _choice_step(candidates: tuple[Candidate, ...], chosen: Candidate) -> Step:
    others = ", ".join(_described(candidate) for candidate in candidates if not candidate.chosen)
    if math.isfinite(chosen.load_error):
        why = "at Ms = 1.6 around the full plant its SIMC loop has the smallest load error"
    elif chosen.Ms <= LARGEST_MS:
        why = "it is the smallest dead time > 0 whose SIMC loop (tau_c = theta) around the full plant has Ms <= 2"
    elif math.isfinite(chosen.Ms):
        why = "no dead time gives a SIMC loop with Ms <= 2 around the full plant; this one has the smallest Ms"
    else:
        why = "no dead time gives a stable SIMC loop around the full plant; this is the most cautious one"
    text = f"The rules T1-T3 hold for more than one effective dead time: also for {others}. "
    text += f"Chosen is theta = {_described(chosen)}: {why}."
    equation = r"\theta \in \{" + ",\\ ".join(latex_number(candidate.theta) for candidate in candidates) + r"\}"
    return Step("choice", text, equation, {"theta": chosen.theta, "Ms": chosen.Ms})


def _described(candidate: Candidate) -> str:
    peak = f"tight Ms {number(candidate.Ms, 3)}" if math.isfinite(candidate.Ms) else "no stable SIMC loop"
    if math.isfinite(candidate.load_error):
        peak += f", load error at Ms 1.6 {number(candidate.load_error, 3)}"
    if candidate.theta == 0:
        peak = "no tau_c = theta"
    return f"{number(candidate.theta)} ({peak})"


def _fields(model: Model) -> dict[str, float]:
    return {name: getattr(model, name) for name in model.__dataclass_fields__}
