"""One gain for each move of OP, dead time and lags in common: a linear process has the same for all [D07]."""

from dataclasses import dataclass, replace

import numpy as np

from simc_core.identification.estimator.fit import SOME, Fit, fitted
from simc_core.identification.estimator.held_input import Array, HeldInput, Located
from simc_core.identification.estimator.levenberg import refined
from simc_core.identification.estimator.problem import Problem
from simc_core.identification.estimator.structures import Structure
from simc_core.identification.judgement.covariance import covariance
from simc_core.identification.judgement.noise import noise_of
from simc_core.identification.moves import Move

POOR = 0.9  # share below which a fit is no place to begin from
MAINLY = 0.5  # share of all that OP moves
AFTER = 5  # samples of a response, without which it shows nothing
UNLIKE = 0.1  # share of the gain by which moves must differ
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


def gains_per_move(fit: Fit, share: float, moves: tuple[Move, ...], floor: float) -> tuple[GainOfMove, ...]:
    """The gain of each of 2 to 12 moves that are all moves of one record, dead time and lags fitted anew; else ().

    Parameters
    ----------
    fit : Fit
        Of one record, of a structure with one gain.
    share : float
        1 - |residuals|/|PV - mean| of it.
    moves : tuple of Move
        Those of the record.
    floor : float
        Standard deviation below which the noise is not believed.
    """
    problem, record = fit.problem, fit.problem.records[0]
    changes = record.held.s
    seen = record.span - fit.point.x[0] - AFTER * record.interval
    inside = _covering(tuple(move for move in moves if changes[move.first] < seen), changes.size)
    if len(problem.records) > 1 or len(problem.structure.gains) > 1 or not 2 <= len(inside) <= MOST:
        return ()
    if sum(abs(move.size) for move in inside) < MAINLY * float(np.abs(record.held.d).sum()):
        return ()  # OP moves all the time
    shape = _split(problem.structure, record.held, inside)
    records = [record.reduced(SOME)]
    if share < POOR:  # one gain for all did not fit: dead time and lags may be anywhere
        apart = fitted(shape, records, False, False, floor)
    else:
        split = Problem(shape, records, problem.degree > 0, problem.start)
        apart = Fit(split, refined(split, fit.point.x, 8))
    own = noise_of(apart)
    first = apart.point.x.size
    errors = np.sqrt(np.diag(covariance(apart, own, floor)))[first:]
    gains = apart.point.beta[: len(inside)].tolist()
    return tuple(
        GainOfMove(move.t, move.before, move.after, gain, error)
        for move, gain, error in zip(inside, gains, errors[: len(inside)].tolist(), strict=True)
    )


def extremes(moves: tuple[GainOfMove, ...]) -> tuple[GainOfMove, GainOfMove]:
    """Those of the smallest and of the largest gain."""
    return min(moves, key=lambda one: abs(one.gain)), max(moves, key=lambda one: abs(one.gain))


def differ(moves: tuple[GainOfMove, ...]) -> bool:
    """Whether two of them are farther apart than their errors, and than a tenth."""
    if len(moves) < 2:
        return False
    low, high = extremes(moves)
    error = float(np.hypot(low.standard_error, high.standard_error))
    return abs(high.gain - low.gain) > max(3 * error, UNLIKE * abs(high.gain))


def _split(structure: Structure, held: HeldInput, moves: tuple[Move, ...]) -> Structure:
    """The structure with a column for each move."""
    alone = [held.one_move(move.first, move.last) for move in moves]

    def columns(whole: HeldInput, at: Located, lags: Array) -> list[Array]:
        t = np.where(at.last > 0, whole.s[np.maximum(at.last - 1, 0)] + at.since, -np.inf)
        return [column for one in alone for column in structure.columns(one, one.locate(t), lags)]

    return replace(structure, gains=tuple(f"{structure.gains[0]} {i}" for i in range(len(moves))), columns=columns)


def _covering(moves: tuple[Move, ...], changes: int) -> tuple[Move, ...]:
    """The moves, widened so that every change of OP belongs to one of them."""
    if not moves:
        return ()
    ends = [move.first for move in moves[1:]] + [changes]
    begins = [0, *ends[:-1]]
    return tuple(
        Move(move.t, move.before, move.after, begin, end) for move, begin, end in zip(moves, begins, ends, strict=True)
    )
