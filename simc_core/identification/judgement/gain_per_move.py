"""One gain for each move of OP, dead time and lags in common: a linear process has the same for all [D07].

Several records have a gain for each move of each, or, where their OP moves all the time, one for each record.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from scipy.special import ndtri

from simc_core.identification.estimator.fit import SOME, Fit, fitted
from simc_core.identification.estimator.held_input import Array, HeldInput, Located
from simc_core.identification.estimator.levenberg import refined
from simc_core.identification.estimator.problem import Problem
from simc_core.identification.estimator.records import Record
from simc_core.identification.estimator.structures import STRUCTURES, Structure
from simc_core.identification.judgement.covariance import covariance
from simc_core.identification.judgement.noise import noise_of
from simc_core.identification.moves import Move

POOR = 0.9  # share below which a fit is no place to begin from
MAINLY = 0.5  # share of all that OP moves
AFTER = 5  # samples of a response, without which it shows nothing
UNLIKE = 0.1  # share of the gain by which moves must differ
STUCK = 0.2  # share of the larger gain below which a move was hardly answered
MOST = 12  # moves for which this is asked
CHANCE = 1.35e-3  # of equal gains that are called different, all pairs together: 3 standard errors of one pair


@dataclass(frozen=True, slots=True)
class GainOfMove:
    """The gain that one move of OP shows.

    Parameters
    ----------
    t : float
        Its instant, in the time of its record.
    before, after : float
        OP; of a record that is taken as a whole, the lowest and the highest.
    gain, standard_error : float
        In the unit of the gain of the structure.
    record : int
        Its place among the records, from 0.
    """

    t: float
    before: float
    after: float
    gain: float
    standard_error: float
    record: int = 0


@dataclass(frozen=True, slots=True)
class Disagreement:
    """Two moves whose gains are farther apart than their errors, the larger gain second.

    kind: "stuck", one is hardly answered where the other is; "sign", they have opposite signs; "gain", they are of
    different size.
    """

    low: GainOfMove
    high: GainOfMove
    kind: str


def gains_per_move(fit: Fit, share: float, moves: Sequence[tuple[Move, ...]], floor: float) -> tuple[GainOfMove, ...]:
    """The gains of the moves of all records, dead time and lags fitted anew; () where there are not 2 to compare.

    Parameters
    ----------
    fit : Fit
    share : float
        1 - |residuals|/|PV - mean| of it.
    moves : sequence of tuple of Move
        Those of each record.
    floor : float
        Standard deviation below which the noise is not believed.
    """
    problem = fit.problem
    several = len(problem.records) > 1
    parts = [
        part
        for i, (record, own) in enumerate(zip(problem.records, moves, strict=True))
        for part in _parts(i, record, own, float(fit.point.x[0]), several)
    ]
    if several and len(parts) > MOST:
        each_record = enumerate(zip(problem.records, moves, strict=True))
        parts = [part for i, (record, own) in each_record for part in _whole(i, record, own)]
    if not 2 <= len(parts) <= max(MOST, len(problem.records)):
        return ()
    own_zero = len(problem.structure.gains) > 1  # of each part, it would leave its gain open: looked at without
    if own_zero and not several:
        return ()
    shape = _split(STRUCTURES["SOPDT"] if own_zero else problem.structure, problem.records, parts)
    records = [record.reduced(SOME) for record in problem.records]
    if share < POOR or own_zero:  # one gain for all did not fit: dead time and lags may be anywhere
        apart = fitted(shape, records, False, False, floor)
    else:
        split = Problem(shape, records, problem.degree > 0, problem.start)
        apart = Fit(split, refined(split, fit.point.x, 8))
    errors = np.sqrt(np.diag(covariance(apart, noise_of(apart), floor)))[apart.point.x.size :]
    gains = apart.point.beta[: len(parts)].tolist()
    return tuple(
        GainOfMove(part.move.t, part.move.before, part.move.after, gain, error, part.record)
        for part, gain, error in zip(parts, gains, errors[: len(parts)].tolist(), strict=True)
    )


def disagreement(moves: tuple[GainOfMove, ...]) -> Disagreement | None:
    """The two that differ most, of those that are farther apart than their errors, and than a tenth; None for none."""
    pairs = list(combinations(moves, 2))
    errors = float(-ndtri(CHANCE / max(len(pairs), 1)))
    found = [pair for pair in pairs if _apart(*pair, errors)]
    if not found:
        return None
    pair = max(found, key=lambda pair: abs(pair[0].gain - pair[1].gain))
    low, high = sorted(pair, key=lambda one: abs(one.gain))
    answered = low.record != high.record and abs(low.gain) > 3 * low.standard_error
    if abs(low.gain) < STUCK * abs(high.gain) and not answered:
        return Disagreement(low, high, "stuck")
    return Disagreement(low, high, "sign" if low.gain * high.gain < 0 else "gain")


def _apart(one: GainOfMove, other: GainOfMove, errors: float) -> bool:
    error = errors * float(np.hypot(one.standard_error, other.standard_error))
    return abs(one.gain - other.gain) > max(error, UNLIKE * max(abs(one.gain), abs(other.gain)))


@dataclass(frozen=True, slots=True)
class _Part:
    """What has a gain of its own: the changes of OP in a move, widened to its neighbours, of one record."""

    record: int
    move: Move


def _parts(i: int, record: Record, moves: tuple[Move, ...], theta: float, several: bool) -> list[_Part]:
    """The moves of a record that are answered within it; where OP moves all the time, all of it, or nothing."""
    changes = record.held.s
    seen = record.span - theta - AFTER * record.interval
    inside = _covering(tuple(move for move in moves if changes[move.first] < seen), changes.size)
    if sum(abs(move.size) for move in inside) < MAINLY * float(np.abs(record.held.d).sum()):
        return _whole(i, record, moves) if several else []
    return [_Part(i, move) for move in inside]


def _whole(i: int, record: Record, moves: tuple[Move, ...]) -> list[_Part]:
    """All that OP does in a record."""
    if not moves:
        return []
    levels = [level for move in moves for level in (move.before, move.after)]
    return [_Part(i, Move(moves[0].t, min(levels), max(levels), 0, record.held.s.size))]


def _split(structure: Structure, records: Sequence[Record], parts: Sequence[_Part]) -> Structure:
    """The structure, which has one gain, with a column for each part."""
    held = [records[part.record].held for part in parts]
    alone = [one.one_move(part.move.first, part.move.last) for one, part in zip(held, parts, strict=True)]

    def columns(whole: HeldInput, at: Located, lags: Array) -> list[Array]:
        t = np.where(at.last > 0, whole.s[np.maximum(at.last - 1, 0)] + at.since, -np.inf)
        return [
            structure.columns(one, one.locate(t), lags)[0] if of is whole else np.zeros(t.shape)
            for of, one in zip(held, alone, strict=True)
        ]

    return replace(structure, gains=tuple(f"{structure.gains[0]} {i}" for i in range(len(parts))), columns=columns)


def _covering(moves: tuple[Move, ...], changes: int) -> tuple[Move, ...]:
    """The moves, widened so that every change of OP belongs to one of them."""
    if not moves:
        return ()
    ends = [move.first for move in moves[1:]] + [changes]
    begins = [0, *ends[:-1]]
    return tuple(
        Move(move.t, move.before, move.after, begin, end) for move, begin, end in zip(moves, begins, ends, strict=True)
    )
