"""What to think of a fit, in words."""

import numpy as np

from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.records import Record
from simc_core.identification.judgement.estimate import Estimate
from simc_core.identification.judgement.gain_per_move import MOST, GainOfMove, disagreement

SURE = 8.0  # standard errors of a gain from which a step was large enough
ELSEWHERE = 5.0  # of the largest sum of residuals; correlated noise alone stays below 4.6
VISIBLE = 0.03  # share of the response that a disturbance must have to be spoken of


def verdicts(estimate: Estimate, half_width: float, moves: tuple[GainOfMove, ...], fit: float) -> tuple[str, ...]:
    """Sentences, the most serious first.

    Parameters
    ----------
    estimate : Estimate
    half_width : float
        Of the 95 % interval in standard errors.
    moves : tuple of GainOfMove
    fit : float
        1 - |residuals|/|PV - mean|.
    """
    differing = disagree(moves)
    found = [*differing, *_poor(fit), *([] if differing else _size(estimate)), *_disturbed(estimate)]
    return (*found, *_settled(estimate), *_dead_time(estimate, half_width), *_lags(estimate), *_along(estimate))


def _poor(fit: float) -> list[str]:
    if fit >= 0.5:
        return []
    return [f"The model explains little: PV differs from it by {100 * (1 - fit):.0f} % of PV's own movement."]


def _size(estimate: Estimate) -> list[str]:
    gain, error = float(estimate.values[estimate.fit.point.x.size]), estimate.gain_error
    ratio = abs(gain) / error if error > 0 else np.inf
    if ratio >= SURE:
        return []
    times = SURE / ratio
    return [f"The step is small for the noise: repeat the test with about {times:.1f} times the step."]


def _disturbed(estimate: Estimate) -> list[str]:
    problem = estimate.fit.problem
    found = []
    for record, part in zip(problem.records, problem.parts, strict=True):
        residual = estimate.fit.residual[part] * (problem.root_weight[part] > 0)
        spread = float(np.std(residual))
        if spread <= VISIBLE * _response(record):
            continue
        course = np.cumsum(residual - residual.mean())
        if np.max(np.abs(course)) > ELSEWHERE * spread * np.sqrt(residual.size):
            where = record.t[int(np.argmax(np.abs(course)))]
            found.append(
                f"Something else than OP seems to have moved PV near {where:.4g} after the first sample: cut the trend "
                "there and fit again, or fit a higher order."
            )
    return found


def disagree(moves: tuple[GainOfMove, ...]) -> list[str]:
    """What to think of moves whose gains differ."""
    found = disagreement(moves)
    if found is None:
        return []
    several = len({move.record for move in moves}) > 1
    low, high = (f"{move.gain:.3g}{_where(move, several)}" for move in (found.low, found.high))
    if found.kind == "stuck":
        return [
            f"PV hardly answers the move of OP{_where(found.low, several)} (gain {found.low.gain:.3g} instead of "
            f"{high}): the valve sticks, or the actuator did not follow. Do not tune on this trend."
        ]
    if found.kind == "sign":
        return [
            f"The gain changes its sign, {low} and {high}: no controller with integral action serves both. Do not "
            "tune on this model, fit one of them alone."
        ]
    if found.low.record != found.high.record:
        return [
            f"The gain differs from record to record, {low} and {high}: the process is not linear, and one model is "
            "right for neither. Fit each operating point by itself and make a gain schedule, or tune for the larger "
            "gain."
        ]
    return [
        f"The gain differs from move to move, {low} and {high}: the process is not linear, or the valve sticks. Tune "
        "for the larger gain, or fit each operating point by itself."
    ]


def _where(move: GainOfMove, several: bool) -> str:
    return f" from {move.before:g} to {move.after:g}{f' in record {move.record + 1}' if several else ''}"


def _settled(estimate: Estimate) -> list[str]:
    structure = estimate.fit.problem.structure
    if structure.integrating or structure.key in ("oscillating", "unstable"):
        return []
    error = float(np.sqrt(estimate.spread[1, 1]))
    lag = float(estimate.fit.problem.lags(estimate.fit.point.x).max())
    after = max(_longest_rest(record) for record in estimate.fit.problem.records)
    long = max(record.span for record in estimate.fit.problem.records)
    if lag > 10 * long:
        return [
            "PV looks integrating: within this trend it does not level off. Gain and lag are not known, only their "
            "ratio; compare with an integrating model."
        ]
    few = all(record.held.s.size <= MOST for record in estimate.fit.problem.records)
    if error <= 0.1 and few and lag > after:
        return [
            "PV had not settled when OP moved again or the trend ended: gain and lag rest on the shape of the curve."
        ]
    if error > 0.3 or (few and lag > after):
        return [
            "PV has not settled: gain and lag are uncertain, but k/tau1 and theta are known better, and SIMC needs "
            "only these where tau1 > 4 (tau_c + theta)."
        ]
    return []


def _longest_rest(record: Record) -> float:
    """Longest time between moves of OP, or from the last to the end."""
    s = record.held.s
    return float(np.max(np.diff(np.concatenate([s[s < record.span], [record.span]])), initial=0.0))


def _dead_time(estimate: Estimate, half_width: float) -> list[str]:
    theta = float(estimate.values[0])
    high = theta + half_width * float(np.sqrt(estimate.spread[0, 0]))
    low = theta - half_width * float(np.sqrt(estimate.spread[0, 0]))
    interval = estimate.fit.problem.records[0].interval
    longest = float(estimate.fit.problem.high[0])
    if theta > 0.98 * longest:
        return ["The dead time is at the longest that this trend can tell: PV may answer something else than OP."]
    if low > 0 and interval <= theta:
        return []
    return [
        f"The dead time is not resolved{' by this sampling' if interval > theta else ''}: it lies between "
        f"{max(low, 0.0):.3g} and {max(high, interval if interval > theta else high):.3g}."
    ]


def _lags(estimate: Estimate) -> list[str]:
    problem = estimate.fit.problem
    interval = problem.records[0].interval
    lags = problem.lags(estimate.fit.point.x)
    if problem.structure.key == "FOPDT" and lags[0] < 0.5 * interval and estimate.values[0] < 2 * interval:
        return ["PV answers within two samples: only the gain is known. Sample faster."]
    return []


def _along(estimate: Estimate) -> list[str]:
    found = []
    if estimate.drift and not estimate.fit.problem.structure.integrating:
        found.append("PV drifts by itself; the drift was fitted along.")
    if estimate.start:
        found.append("PV was not at rest when the trend begins; what was left of earlier moves was fitted along.")
    zero = sum(int(np.count_nonzero(record.weight == 0)) for record in estimate.fit.problem.records)
    if zero:
        found.append(f"{zero} single samples far from their neighbours were left out.")
    return found


def _response(record: Record) -> float:
    low, high = np.quantile(record.y, [0.02, 0.98])
    return max(float(high - low), 1e-300)


def along(estimate: Estimate) -> tuple[Array, Array]:
    """Bias and drift per time unit of each record."""
    problem = estimate.fit.problem
    gains = len(problem.structure.gains)
    width = problem.degree + 1
    beta = estimate.fit.point.beta[gains : gains + width * len(problem.records)].reshape(-1, width)
    spans = np.array([record.span for record in problem.records])
    return beta[:, 0], (beta[:, 1] / spans if width > 1 else np.zeros(len(spans)))
