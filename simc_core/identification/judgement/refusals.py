"""Trends from which no model may be given: every fit would be of something else than the process."""

import numpy as np

from simc_core.errors import NotIdentifiable
from simc_core.identification.estimator.records import OFTEN
from simc_core.identification.judgement.estimate import Estimate
from simc_core.identification.trend import Trend
from simc_core.wording import said

EXPLAINED = 0.9  # share of the moves of OP that PV explains, from which a controller made them
EXPLAINED_AT_REST = 0.5  # the same where the set point is known to be constant
WEAK = 3.0  # standard errors below which a gain is none


def refuse_before(trend: Trend) -> None:
    """Raises NotIdentifiable where the trend cannot tell, whatever the structure."""
    moved = np.flatnonzero(np.diff(trend.u))
    at = trend.instants_of_u[moved + 1] if moved.size else np.empty(0)
    if not np.any(at < trend.t[-1]):
        raise NotIdentifiable(
            said(
                "OP never moves: it is {OP:g} throughout, so that PV moves for another reason. Record a trend in which "
                "OP is moved by hand, or the set point of the closed loop.",
                OP=float(trend.u[0]),
            )
        )
    if float(np.ptp(trend.y)) == 0:
        raise NotIdentifiable(
            said("PV never moves: it is {PV:g} throughout. Is it the right column?", PV=float(trend.y[0]))
        )
    values = np.unique(trend.y)
    if values.size == 2:
        raise NotIdentifiable(
            said(
                "PV takes two values only, {low:g} and {high:g}: it is written as coarsely as it moves, so that "
                "neither dead time nor lag shows. Record PV with more digits.",
                low=float(values[0]),
                high=float(values[1]),
            )
        )
    if trend.t_u is None and trend.r is not None and np.array_equal(trend.r, trend.u) and np.ptp(trend.u) > 0:
        raise NotIdentifiable(said("OP and SP are the same series. Take the output of the controller for OP."))
    _refuse_unexcited(trend)


def refuse_weak(estimate: Estimate) -> None:
    """Raises NotIdentifiable where a gain is not told from zero, nor gain/lag where the lag is long."""
    count = estimate.fit.point.x.size
    gain, error = float(estimate.values[count]), estimate.gain_error
    ratio = abs(gain) / max(error, 1e-300)
    if count > 1:
        spread = estimate.spread
        relative = spread[count, count] / gain**2 + spread[1, 1] - 2 * spread[count, 1] / gain
        ratio = max(ratio, float(max(relative, 1e-300)) ** -0.5)
    if ratio < WEAK:
        raise NotIdentifiable(
            said(
                "PV does not answer the moves of OP beyond its noise: the gain is {gain:.2g} with a standard error of "
                "{error:.2g}. Repeat the test with steps about {times:.0f} times as large.",
                gain=gain,
                error=error,
                times=min(8 / max(ratio, 0.1), 50.0),
            )
        )


def _refuse_unexcited(trend: Trend) -> None:
    constant = trend.r is not None and float(np.ptp(trend.r)) == 0
    share = made_by_controller(trend)
    if share > (EXPLAINED_AT_REST if constant else EXPLAINED):
        raise NotIdentifiable(
            said(
                "The loop was closed at a constant set point: PV explains {share:.0f} % of the moves of OP. A fit "
                "would return the controller, -1/Kc, not the process. Move the set point, or OP by hand.",
                share=100 * share,
            )
            if constant
            else said(
                "The loop was closed and nothing else moved OP: PV explains {share:.0f} % of the moves of OP. A fit "
                "would return the controller, -1/Kc, not the process. Move the set point, or OP by hand.",
                share=100 * share,
            )
        )


def made_by_controller(trend: Trend) -> float:
    """Share of the moves of OP that a linear controller would make of PV and SP as they are, 0 to 1.

    The moves are explained by PV, its change, the change before, SP and its change, and the move before, as a PID
    controller with a filter would make them; 0 where OP moves too seldom for a controller in automatic.
    """
    u = trend.u if trend.t_u is None else trend.u[np.maximum(np.searchsorted(trend.t_u, trend.t, "right") - 1, 0)]
    du = np.diff(u)
    if du.size < 20 or np.mean(du != 0) < OFTEN:
        return 0.0
    dy = np.diff(trend.y)
    known = [np.ones(du.size - 1), dy[1:], dy[:-1], trend.y[2:], du[:-1]]
    aim = du[1:] - du[1:].mean()
    plain = _unexplained(known, aim)
    whole = float(aim @ aim)
    if whole == 0:
        return 0.0
    if trend.r is not None and np.ptp(trend.r) > 0:
        return 0.0  # a set point that moves excites the loop
    return 1 - plain / whole


def _unexplained(columns: list[np.ndarray], aim: np.ndarray) -> float:
    basis = np.linalg.qr(np.stack([column - column.mean() for column in columns[1:]], axis=1))[0]
    left = aim - basis @ (basis.T @ aim)
    return float(left @ left)
