"""Step metrics from the polynomials of the engine: many responses at once, nothing sampled that can be integrated.

    IAE = int |e|    ISE = int e^2    ITAE = int t |e|    TV = sum |change of u|, jumps included    e = r - y

With s the sign of e, |e| = s e, and its integral over a piece is the sum of s (E at its end - E at its begin) over the
parts between zeros of e, E = int e. So E counts with s at the end of the piece, with -s at its begin, and at each zero
with 2 s, s the sign in front of it. For ITAE E is int t e; for TV it is u, and s the sign of u'.

Two searches: where y and u turn, then where y passes through its end (e = 0) and the levels of the times, for which the
peak must be known.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.metrics.piece_zeros import SLOPE, LevelCrossings, Turns, crossings
from simc_core.metrics.step_records import StepMetrics
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.collocation.pieces import ENDS
from simc_core.simulation.one_delay.unit_responses import UnitResponses

NOISE = 1e-11  # of the largest value; what changes less in a piece has come to rest, its signs are rounding
LEVELS = np.array(  # the end, 10 % and 90 %, the band of 2 %; of a load step in units of its peak
    [[1.0, 0.1, 0.9, 0.98, 1.02], [0.0, np.nan, np.nan, -0.02, 0.02]]
)[:, :, None]
LEAST_OVERSHOOT = 1e-10  # less than that is rounding
AT_PEAK = 1e-13  # relative; y this near its peak is there: of a flat top the first instant counts
TINY = 1e-300


def _integrals() -> np.ndarray:
    """int_{-1}^x f and int_{-1}^x x f: column of coefficients -> two columns of P + 2, one below the other."""
    times_x = np.array([np.pad(chebyshev.chebmulx(row), (0, P + 1))[: P + 1] for row in np.eye(P)])
    whole = chebyshev.chebint(np.eye(P, P + 1), lbnd=-1, axis=1)
    return np.concatenate([whole, chebyshev.chebint(times_x, lbnd=-1, axis=1)], axis=1).T


def _products() -> np.ndarray:
    """int T_j T_k over [-1, 1]."""
    x, weights = np.polynomial.legendre.leggauss(P + 1)
    values = chebyshev.chebvander(x, P - 1)
    return values.T @ (weights[:, None] * values)


INTEGRALS, SQUARE = _integrals(), _products()
WHOLE = INTEGRALS.reshape(2, P + 2, P).sum(axis=1)  # up to x = 1


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """n unit step responses as pieces, in order of owner and time; each has at least one.

    owner: (m,).   begin, length: (m,).   y_and_u: (2, m, P), Chebyshev.   first: (n,), the first piece of each.
    target: (n,), 1 for a step of the set point, 0 for one of the load.
    """

    owner: np.ndarray
    begin: np.ndarray
    length: np.ndarray
    y_and_u: np.ndarray
    first: np.ndarray
    target: np.ndarray

    def time(self, piece: np.ndarray, x: np.ndarray) -> np.ndarray:
        """Instants at the places x in [-1, 1] of pieces."""
        return self.begin[piece] + self.length[piece] / 2 * (x + 1)

    def before(self, right: np.ndarray) -> np.ndarray:
        """Values at the end of the piece before, from those at the right ends (..., m); 0 before t = 0."""
        found = np.empty_like(right)
        found[..., 1:], found[..., self.first] = right[..., :-1], 0.0
        return found

    def alive(self, change: np.ndarray, size: np.ndarray) -> np.ndarray:
        """Whether what changes in a piece is more than rounding of the largest value of the response, (..., m) all."""
        return change > NOISE * np.maximum.reduceat(size, self.first, axis=-1)[..., self.owner]


@dataclass(frozen=True, slots=True, eq=False)
class Measures:
    """Of n responses, (n,) each; see StepMetrics, which has them in this order."""

    IAE: np.ndarray
    ISE: np.ndarray
    ITAE: np.ndarray
    TV: np.ndarray
    overshoot: np.ndarray
    peak: np.ndarray
    peak_time: np.ndarray
    rise_time: np.ndarray
    settling_time: np.ndarray


def metrics_of(steps: Steps) -> tuple[StepMetrics, ...]:
    """All metrics of each response."""
    found = measures(steps)
    columns = (getattr(found, name).tolist() for name in StepMetrics.__slots__)
    return tuple(StepMetrics(*row) for row in zip(*columns, strict=True))


def measures(steps: Steps, with_times: bool = True) -> Measures:
    """All metrics of all responses; with_times: False leaves rise and settling times at nan."""
    m, rows = len(steps.owner), steps.y_and_u.reshape(-1, P)  # those of y, then those of u
    left, right = ENDS @ rows.T
    size = np.abs(steps.y_and_u)
    change = np.add.reduce(size[:, :, 1:], axis=2)
    turning = np.where(steps.alive(change, change + size[:, :, 0]), 0.0, -np.inf)
    turns = crossings(rows @ SLOPE, turning.reshape(1, -1))
    values, k = turns.of(rows), turns.row.searchsorted(m)
    TV = turns.integral(left, right, values)[m:]
    turns_of_y = Turns(turns.row[:k], turns.interval[:k], turns.x[:k], values[:k])
    peak, peak_time, overshoot = _extremes(steps, left[:m], right[:m], turns_of_y)

    y, minus_e = rows[:m], rows[:m].copy()
    minus_e[:, 0] -= steps.target[steps.owner]
    size = change[0] + np.abs(minus_e[:, 0])
    levels = _levels(steps, peak)[: None if with_times else 1, steps.owner]
    levels[0, ~steps.alive(size, size)] = -np.inf
    found = crossings(y, levels, turns_of_y)
    IAE, ITAE = _absolute_integrals(steps, minus_e, found.of_first_level())
    ISE = steps.length / 2 * np.add.reduce((minus_e @ SQUARE) * minus_e, axis=1)
    rise, settling = _times(steps, found, levels, right[:m]) if with_times else np.full((2, len(peak)), np.nan)
    integrals = np.abs([IAE, ISE, ITAE, TV])  # what is not alive has no sign of its own
    integrals[3] += np.abs(left[m:] - steps.before(right[m:]))
    IAE, ISE, ITAE, TV = np.add.reduceat(integrals, steps.first, axis=1)
    return Measures(IAE, ISE, ITAE, TV, overshoot, peak, peak_time, rise, settling)


def _extremes(
    steps: Steps, left: np.ndarray, right: np.ndarray, turns: Turns
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """peak: largest y of a set-point step, y of largest size of a load step; the first time it is reached, nan where
    a set-point step has no overshoot; and the overshoot. left, right: y at the ends.
    """
    owner = np.concatenate([steps.owner, steps.owner, steps.owner[turns.row]])
    values = np.concatenate([left, right, turns.value])
    times = np.concatenate([steps.begin, steps.begin + steps.length, steps.time(turns.row, turns.x)])
    step, high = steps.target != 0, np.full(len(steps.first), -np.inf)
    low, time = -high, -high
    np.maximum.at(high, owner, values)
    np.minimum.at(low, owner, values)
    peak = np.where(step | (high >= -low), high, low)
    at_peak = np.abs(values - peak[owner]) <= AT_PEAK * np.abs(peak[owner])
    np.minimum.at(time, owner[at_peak], times[at_peak])
    beyond = np.where(step, peak - 1, np.where(peak > 0, -low, high) / np.maximum(np.abs(peak), TINY))
    passed = beyond > LEAST_OVERSHOOT
    return peak, np.where(passed | ~step, time, np.nan), np.where(passed, beyond, 0.0)


def _levels(steps: Steps, peak: np.ndarray) -> np.ndarray:
    """LEVELS in the units of y, (5, n)."""
    return np.where(steps.target, LEVELS[0], LEVELS[1] * np.abs(peak))


def _absolute_integrals(steps: Steps, e: np.ndarray, zeros: LevelCrossings) -> tuple[np.ndarray, np.ndarray]:
    """int |e| and int t |e| of each piece; e: (m, P), either sign."""
    half = steps.length / 2
    inner = np.add.reduce((INTEGRALS @ e[zeros.row].T).reshape(2, P + 2, -1) * zeros.basis, axis=1)
    plain, moment = map(zeros.integral, (0.0, 0.0), WHOLE @ e.T, inner)  # over x
    return half * plain, half * ((steps.begin + half) * plain + half * moment)


def _times(steps: Steps, found: LevelCrossings, levels: np.ndarray, right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rise time, nan for a load step, and settling time, from the passages through `levels`."""
    first, last = passages(steps, found, levels, right)
    first[first == np.inf] = 0.0
    return np.where(steps.target, first[2] - first[1], np.nan), np.maximum(last[3], last[4])


def passages(
    steps: Steps, found: LevelCrossings, levels: np.ndarray, right: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """First and last time that each response passes each of `levels` (k, m): (k, n) both, inf and 0 for never.

    right: y at the right ends; where the next piece begins it may jump through a level.
    """
    level, piece = np.nonzero((steps.before(right) < levels) != found.begin)
    x = np.concatenate([found.x, np.full(len(level), -1.0)])
    level, piece = np.concatenate([found.level, level]), np.concatenate([found.row, piece])
    times, which = steps.time(piece, x), (level, steps.owner[piece])
    shape = len(levels), len(steps.first)
    first, last = np.full(shape, np.inf), np.zeros(shape)
    np.minimum.at(first, which, times)
    np.maximum.at(last, which, times)
    return first, last


def both_steps(course: UnitResponses) -> Steps:
    """Set-point steps of all tunings, then their load steps."""
    n, m = len(course.first) - 1, len(course.owner)
    return Steps(
        np.concatenate([course.owner, course.owner + n]),
        np.concatenate([course.begin, course.begin]),
        np.concatenate([course.length, course.length]),
        course.coefficients.reshape(2, 2 * m, -1),
        np.concatenate([course.first[:-1], course.first[:-1] + m]),
        np.array([1.0, 0.0]).repeat(n),
    )
