"""One gain for each move of OP, dead time and lags in common: a linear process has the same for all [D07]."""

from dataclasses import dataclass

import numpy as np

from simc_core.identification.estimator.fit import Fit
from simc_core.identification.estimator.held_input import Array
from simc_core.identification.judgement.covariance import degrees_of_freedom, spread_of
from simc_core.identification.judgement.noise import Noise
from simc_core.identification.moves import Move

MOST = 12  # moves for which this is asked


@dataclass(frozen=True, slots=True)
class GainOfMove:
    """The gain that one move of OP shows.

    Parameters
    ----------
    t : float
        Its instant.
    before, after : float
        OP.
    gain, standard_error : float
        In the unit of the gain of the structure.
    """

    t: float
    before: float
    after: float
    gain: float
    standard_error: float


def gains_per_move(fit: Fit, noise: Noise, moves: tuple[Move, ...], floor: float) -> tuple[GainOfMove, ...]:
    """The gain of each of 2 to 12 moves that are all moves of one record; else ().

    Parameters
    ----------
    fit : Fit
        Of one record.
    noise : Noise
    moves : tuple of Move
        Those of the record.
    floor : float
        Standard deviation below which the noise is not believed.
    """
    problem, record = fit.problem, fit.problem.records[0]
    inside = _covering(moves, record.held.s.size)
    if len(problem.records) > 1 or not 2 <= len(inside) <= MOST:
        return ()
    at = record.t - fit.point.x[0]
    lags = problem.lags(fit.point.x)
    count = len(problem.structure.gains)
    columns: list[Array] = []
    for move in inside:
        held = record.held.one_move(move.first, move.last)
        parts = problem.structure.columns(held, held.locate(at), lags)
        columns.append(np.asarray(np.stack(parts, axis=1) @ fit.point.beta[:count] / fit.point.beta[0]))
    whole = fit.jacobian
    unlinear = fit.point.x.size
    own = np.stack(columns, axis=1) * problem.root_weight[:, None]
    jacobian = np.concatenate([own, whole[:, :unlinear], whole[:, unlinear + count :]], axis=1)
    spread, inverse = spread_of(jacobian, problem.parts, noise, floor)
    step = inverse @ (jacobian.T @ fit.point.residual)
    freedom = degrees_of_freedom(fit, noise)
    errors = np.sqrt(np.diag(spread) * (freedom + fit.free) / freedom)
    return tuple(
        GainOfMove(move.t, move.before, move.after, float(fit.point.beta[0] + step[i]), float(errors[i]))
        for i, move in enumerate(inside)
    )


def _covering(moves: tuple[Move, ...], changes: int) -> tuple[Move, ...]:
    """The moves, widened so that every change of OP belongs to one of them."""
    if not moves:
        return ()
    ends = [move.first for move in moves[1:]] + [changes]
    begins = [0, *ends[:-1]]
    return tuple(
        Move(move.t, move.before, move.after, begin, end) for move, begin, end in zip(moves, begins, ends, strict=True)
    )
