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
from simc_core.wording import Text, joined, said

NAMES = {"tau1": r"\tau_1", "tau2": r"\tau_2"}
WHERE = {
    "T1": "T0 >= tau0 >= theta",
    "T1a": "T0 >= theta >= tau0",
    "T1b": "theta >= T0 >= tau0",
    "T2": "tau0 >= T0 >= 5 theta",
    "T3": "min(tau0, 5 theta) >= T0",
}


HALVED = (
    ("sampling", said("half the sampling period"), said("sampling h/2 = {half}", half="")),
    ("filter", said("half the filter time"), said("filter tau_F/2 = {half}", half="")),
)
PAYS = said("Derivative action (order 2) pays.")
PAYS_NOT = said("Derivative action (order 2) does not pay.")
PAYS_LITTLE = said("Derivative action (order 2) brings little.")


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
        text = said(
            "tau2 = {larger} came out larger than tau1 = {smaller}: the two change places.",
            larger=number(larger),
            smaller=number(smaller),
        )
        told.append(Step("swap", text, r"\tau_1 \leftrightarrow \tau_2", {"tau1": larger, "tau2": smaller}))
    if not trial.consistent:
        text = said("No dead time is consistent with the rules T1-T3 here (they jump across it); the nearest is taken.")
        told.append(Step("choice", text, rf"\theta \approx {latex_number(chosen.theta)}", {"theta": chosen.theta}))
    if len(candidates) > 1:
        told.append(_choice_step(candidates, chosen))
    told.append(Step("model", said("The reduced model."), rf"G_r(s) = {latex(chosen.model)}", _fields(chosen.model)))
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
    entries = [
        BudgetEntry(said("lag {tau}", tau=number(tau)), "lag", tau, tuple(pieces[i]))
        for i, tau in enumerate(parts.lags)
    ]
    entries += [
        BudgetEntry(said("integrator"), "integrator", math.inf, tuple(done or [("slope", math.inf)])) for done in origin
    ]
    if parts.unstable:
        entries.append(
            BudgetEntry(
                said("unstable pole {tau}", tau=number(parts.unstable)),
                "unstable",
                parts.unstable,
                (("a", parts.unstable),),
            )
        )
    if parts.pair:
        tau0 = parts.pair[0]
        entries.append(BudgetEntry(said("pair {tau}", tau=number(tau0)), "pair", tau0, (("tau0", tau0),)))
    rule_of = {match.lead: match.rule for match in trial.removal.matches}
    entries += [
        BudgetEntry(said("zero {T}", T=number(T)), "lead", T, ((rule_of[i], T),)) for i, T in enumerate(parts.leads)
    ]
    entries += [
        BudgetEntry(said("inverse zero {T}", T=number(T)), "inverse", T, (("theta", T),)) for T in parts.inverse
    ]
    if parts.theta:
        entries.append(
            BudgetEntry(
                said("dead time {theta}", theta=number(parts.theta)),
                "dead time",
                parts.theta,
                (("theta", parts.theta),),
            )
        )
    for time, (kind, _, label) in zip(late, HALVED, strict=True):
        if time:
            half = time / 2
            entries.append(BudgetEntry(label.put(half=number(half)), kind, half, (("theta", half),)))
    return (*entries, *parts.cancelled)


def notes(parts: Dynamics, model: Model, order: int, orders: Orders | None) -> tuple[Text, ...]:
    """Advice in sentences."""
    advice: list[Text] = []
    if orders is not None and not math.isnan(orders.ratio):
        advice.append(of_orders(orders))
    match model:
        case DoubleIntegratingDelay():
            advice.append(said("Two integrators need derivative action: the model is the same for order 1 and 2."))
        case OscillatingDelay():
            advice.append(
                said(
                    "The oscillating pair is kept whatever the order; its rule is a PID in ideal form. The controller "
                    "cancels the pair and does not damp it: with D on the measurement, set-point steps and input "
                    "disturbances both ring with the damping of the open plant."
                )
            )
        case UnstableDelay() if order == 1 and parts.lags:
            advice.append(
                said(
                    "With an unstable pole, order 1 adds every lag in full to the dead time; order 2 keeps the largest."
                )
            )
        case FirstOrderDelay(tau1=0.0):
            advice.append(said("No lag is left: pure dead time, whose SIMC controller is a pure integrator."))
    if isinstance(model, SecondOrderDelay) and model.tau2 == 0:
        advice.append(said("There is no second lag: the model is of first order and its controller a PI."))
    if model.theta == 0:
        advice.append(
            said(
                "The effective dead time is 0: tau_c = theta is no choice here, choose tau_c yourself. "
                "Nothing in this model limits the speed."
            )
        )
    return tuple(advice)


def of_orders(orders: Orders) -> Text:
    """Whether order 2 pays, in numbers."""
    if math.isinf(orders.first):
        return said(
            "Derivative action (order 2) pays: order 1 does not reach Ms = 1.6 around the full plant, order 2 does."
        )
    if math.isinf(orders.second):
        return said(
            "Derivative action (order 2) does not pay: it never has Ms = 1.6 around the full plant, order 1 has."
        )
    verdict = PAYS if orders.second_pays else PAYS_NOT if orders.ratio <= 1 else PAYS_LITTLE
    return said(
        "{verdict} Load error tau_I/Kc of the tuning with Ms = 1.6 around the full plant: {first} with order 1, "
        "{second} with order 2.",
        verdict=verdict,
        first=number(orders.first, 3),
        second=number(orders.second, 3),
    )


def _match_step(match: RuleApplied, theta: float) -> Step:
    T0, tau0, rest = (times_s(latex_number(value)) for value in (match.T0, match.tau0, match.rest))
    amounts = {"T0": match.T0, "tau0": match.tau0, "theta": theta, "rest": match.rest, "gain": match.gain}
    if match.rule == "1998 small":
        text = said(
            "1998 rule: the zero {T0} is small (not above theta) and is subtracted from the dead time.",
            T0=number(match.T0),
        )
        return Step(match.rule, text, rf"{T0} + 1 \approx e^{{{T0}}}", amounts)
    integrator = math.isinf(match.tau0)
    below = "s" if integrator else f"{tau0} + 1"
    gain = latex_number(match.gain)
    becomes = rf"\frac{{{gain}}}{{{rest} + 1}}" if match.rest else gain
    equation = rf"\frac{{{T0} + 1}}{{{below}}} \approx {becomes}"
    return Step(match.rule, _match_text(match, theta), equation, amounts)


def _match_text(match: RuleApplied, theta: float) -> Text:
    """By which rule the zero meets what, and what is left."""
    zero = number(match.T0)
    if match.rule.startswith("1998"):
        head = said("1998 rule: the zero {zero}", zero=zero)
    else:
        head = said(
            "Rule {rule} ({where} with theta = {theta}): the zero {zero}",
            rule=match.rule,
            where=WHERE[match.rule],
            theta=number(theta),
            zero=zero,
        )
    values = {"head": head, "lag": number(match.tau0), "rest": number(match.rest)}
    if math.isinf(match.tau0):
        left = said("{head} meets the integrator; a lag of {rest} is left", **values)
        none = said("{head} meets the integrator; both vanish", **values)
    else:
        left = said("{head} meets the lag {lag}; a lag of {rest} is left", **values)
        none = said("{head} meets the lag {lag}; both vanish", **values)
    what = left if match.rest else none
    if match.gain == 1 or match.rule.startswith("1998"):
        return joined((what, "."), "")
    return said("{what}, gain times {gain}.", what=what, gain=number(match.gain))


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
        text = said("The lag {tau} is kept as {name}.", tau=number(tau), name=name)
        told.append(Step("keep", text, rf"{NAMES[name]} = {latex_number(tau)}", {name: tau}))
    if absorber and len(lags) > len(names):
        tau = lags[len(names)]
        half = latex_number(tau / 2)
        if absorber == "integrator":
            text = said(
                "Half rule: the lag {tau} is split; the integrator absorbs half, half goes to theta.", tau=number(tau)
            )
            equation = rf"\frac{{{latex_number(tau)}}}{{2}} = {half}"
        else:
            kept = lags[len(names) - 1]
            text = said(
                "Half rule: the lag {tau} is split; one half goes to {absorber}, the other to theta.",
                tau=number(tau),
                absorber=absorber,
            )
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
    terms += [(kind, half) for half, kind, *_ in halved]
    subtracted = [match.T0 for match in trial.removal.matches if match.rule == "1998 small"]
    total = " + ".join(latex_number(amount) for _, amount in terms) or "0"
    total += "".join(f" - {latex_number(T)}" for T in subtracted)
    if len(terms) + len(subtracted) > 1:
        total += f" = {latex_number(theta)}"
    sources = [
        *([said("the dead time")] if parts.theta else []),
        *([said("the rest of the lags")] if any(kind == "lag" for kind, _ in terms) else []),
        *([said("the right-half-plane zeros")] if parts.inverse else []),
        *(called for _, _, called, _ in halved),
    ]
    terms_said = joined(sources) if sources else said("nothing adds to it")
    if subtracted:
        text = said("Effective dead time: {terms}, less the small zeros.", terms=terms_said)
    else:
        text = said("Effective dead time: {terms}.", terms=terms_said)
    return Step("delay", text, rf"\theta = {total}", {"theta": theta})


def _choice_step(candidates: tuple[Candidate, ...], chosen: Candidate) -> Step:
    others = joined(_described(candidate) for candidate in candidates if not candidate.chosen)
    if math.isfinite(chosen.load_error):
        why = said("at Ms = 1.6 around the full plant its SIMC loop has the smallest load error")
    elif chosen.Ms <= LARGEST_MS:
        why = said("it is the smallest dead time > 0 whose SIMC loop (tau_c = theta) around the full plant has Ms <= 2")
    elif math.isfinite(chosen.Ms):
        why = said("no dead time gives a SIMC loop with Ms <= 2 around the full plant; this one has the smallest Ms")
    else:
        why = said("no dead time gives a stable SIMC loop around the full plant; this is the most cautious one")
    text = said(
        "The rules T1-T3 hold for more than one effective dead time: also for {others}. Chosen is theta = {chosen}: "
        "{why}.",
        others=others,
        chosen=_described(chosen),
        why=why,
    )
    equation = r"\theta \in \{" + ",\\ ".join(latex_number(candidate.theta) for candidate in candidates) + r"\}"
    return Step("choice", text, equation, {"theta": chosen.theta, "Ms": chosen.Ms})


def _described(candidate: Candidate) -> Text:
    peak = said("tight Ms {Ms}", Ms=number(candidate.Ms, 3))
    if not math.isfinite(candidate.Ms):
        peak = said("no stable SIMC loop")
    if math.isfinite(candidate.load_error):
        peak = said("{peak}, load error at Ms 1.6 {error}", peak=peak, error=number(candidate.load_error, 3))
    if candidate.theta == 0:
        peak = said("no tau_c = theta")
    return said("{theta} ({peak})", theta=number(candidate.theta), peak=peak)


def _fields(model: Model) -> dict[str, float]:
    return {name: getattr(model, name) for name in model.__dataclass_fields__}
