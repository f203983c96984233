"""What to think of a fit, in words."""

from typing import Any

import numpy as np

from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.records import Record
from simc_core.identification.judgement.estimate import Estimate
from simc_core.identification.judgement.gain_per_move import MOST, GainOfMove, disagreement
from simc_core.wording import Text, counted, said

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
    return [
        said(
            "The model explains little: PV differs from it by {share:.0f} % of PV's own movement.",
            share=100 * (1 - fit),
        )
    ]


def _size(estimate: Estimate) -> list[str]:
    gain, error = float(estimate.values[estimate.fit.point.x.size]), estimate.gain_error
    ratio = abs(gain) / error if error > 0 else np.inf
    if ratio >= SURE:
        return []
    return [
        said(
            "The step is small for the noise: repeat the test with about {times:.1f} times the step.",
            times=SURE / ratio,
        )
    ]


def _disturbed(estimate: Estimate) -> list[str]:
    problem = estimate.fit.problem
    found: list[str] = []
    for record, part in zip(problem.records, problem.parts, strict=True):
        residual = estimate.fit.residual[part] * (problem.root_weight[part] > 0)
        spread = float(np.std(residual))
        if spread <= VISIBLE * _response(record):
            continue
        course = np.cumsum(residual - residual.mean())
        if np.max(np.abs(course)) > ELSEWHERE * spread * np.sqrt(residual.size):
            found.append(
                said(
                    "Something else than OP seems to have moved PV near {t:.4g} after the first sample: cut the trend "
                    "there and fit again, or fit a higher order.",
                    t=float(record.t[int(np.argmax(np.abs(course)))]),
                )
            )
    return found


def disagree(moves: tuple[GainOfMove, ...]) -> list[str]:
    """What to think of moves whose gains differ."""
    found = disagreement(moves)
    if found is None:
        return []
    several = len({move.record for move in moves}) > 1
    low, high = (_gain(move, several) for move in (found.low, found.high))
    if found.kind == "stuck":
        at: dict[str, Any] = {
            "before": found.low.before,
            "after": found.low.after,
            "gain": found.low.gain,
            "high": high,
        }
        if several:
            return [
                said(
                    "PV hardly answers the move of OP from {before:g} to {after:g} in record {record} (gain {gain:.3g} "
                    "instead of {high}): the valve sticks, or the actuator did not follow. Do not tune on this trend.",
                    record=found.low.record + 1,
                    **at,
                )
            ]
        return [
            said(
                "PV hardly answers the move of OP from {before:g} to {after:g} (gain {gain:.3g} instead of {high}): "
                "the valve sticks, or the actuator did not follow. Do not tune on this trend.",
                **at,
            )
        ]
    if found.kind == "sign":
        return [
            said(
                "The gain changes its sign, {low} and {high}: no controller with integral action serves both. Do not "
                "tune on this model, fit one of them alone.",
                low=low,
                high=high,
            )
        ]
    if found.low.record != found.high.record:
        return [
            said(
                "The gain differs from record to record, {low} and {high}: the process is not linear, and one model is "
                "right for neither. Fit each operating point by itself and make a gain schedule, or tune for the "
                "larger gain.",
                low=low,
                high=high,
            )
        ]
    return [
        said(
            "The gain differs from move to move, {low} and {high}: the process is not linear, or the valve sticks. "
            "Tune for the larger gain, or fit each operating point by itself.",
            low=low,
            high=high,
        )
    ]


def _gain(move: GainOfMove, several: bool) -> Text:
    """The gain of a move, and which move it is."""
    at: dict[str, Any] = {"gain": move.gain, "before": move.before, "after": move.after}
    if several:
        return said("{gain:.3g} from {before:g} to {after:g} in record {record}", record=move.record + 1, **at)
    return said("{gain:.3g} from {before:g} to {after:g}", **at)


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
            said(
                "PV looks integrating: within this trend it does not level off. Gain and lag are not known, only their "
                "ratio; compare with an integrating model."
            )
        ]
    few = all(record.held.s.size <= MOST for record in estimate.fit.problem.records)
    if error <= 0.1 and few and lag > after:
        return [
            said(
                "PV had not settled when OP moved again or the trend ended: gain and lag rest on the shape of the "
                "curve."
            )
        ]
    if error > 0.3 or (few and lag > after):
        return [
            said(
                "PV has not settled: gain and lag are uncertain, but k/tau1 and theta are known better, and SIMC needs "
                "only these where tau1 > 4 (tau_c + theta)."
            )
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
        return [said("The dead time is at the longest that this trend can tell: PV may answer something else than OP.")]
    if low > 0 and interval <= theta:
        return []
    low = max(low, 0.0)
    if interval > theta:
        return [
            said(
                "The dead time is not resolved by this sampling: it lies between {low:.3g} and {high:.3g}.",
                low=low,
                high=max(high, interval),
            )
        ]
    return [said("The dead time is not resolved: it lies between {low:.3g} and {high:.3g}.", low=low, high=high)]


def _lags(estimate: Estimate) -> list[str]:
    problem = estimate.fit.problem
    interval = problem.records[0].interval
    lags = problem.lags(estimate.fit.point.x)
    if problem.structure.key == "FOPDT" and lags[0] < 0.5 * interval and estimate.values[0] < 2 * interval:
        return [said("PV answers within two samples: only the gain is known. Sample faster.")]
    return []


def _along(estimate: Estimate) -> list[str]:
    found: list[str] = []
    if estimate.drift and not estimate.fit.problem.structure.integrating:
        found.append(said("PV drifts by itself; the drift was fitted along."))
    if estimate.start:
        found.append(said("PV was not at rest when the trend begins; what was left of earlier moves was fitted along."))
    zero = sum(int(np.count_nonzero(record.weight == 0)) for record in estimate.fit.problem.records)
    if zero:
        found.append(
            counted(
                "{n} single sample far from its neighbours was left out.",
                "{n} single samples far from their neighbours were left out.",
                zero,
            )
        )
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
