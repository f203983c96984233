"""Step metrics from the polynomials of the engine: many responses at once, nothing sampled that can be integrated.

    IAE = int |e|    ISE = int e^2    ITAE = int t |e|    TV = sum |change of u|, jumps included    e = r - y

IAE is the total variation of int e, ITAE that of int t e: both turn where e has a zero, as u turns where u' has one.
Zeros are bracketed on SAMPLES of each piece, and for e where y turns as well, so that no narrow lobe is lost; then they
are polished. A piece with |c_0| > sum |c_k| has none.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.simulation.elements import P

NOISE = 1e-11  # of the largest value; a signal this small has come to rest, its signs are rounding
SAMPLES = np.cos(np.pi * np.arange(32, -1, -1) / 32)  # where sign changes are looked for in a piece
NEWTON = 8
SETTLED = 1e-15  # a Newton step this small was the last
SETTLING, RISE = 0.02, (0.1, 0.9)
LEAST_OVERSHOOT = 1e-10  # less than that is rounding

DEGREES = np.arange(P)
SIGNS = (-1.0) ** DEGREES  # T_k(-1)
VANDERMONDE = chebyshev.chebvander(SAMPLES, P - 1).T
SLOPE = chebyshev.chebder(np.eye(P), axis=1) @ np.eye(P - 1, P)  # coefficients -> those of the derivative
INTEGRAL = chebyshev.chebint(np.eye(P), lbnd=-1, axis=1)  # -> those of int_{-1}^x f
MOMENT = chebyshev.chebint(
    np.array([np.pad(chebyshev.chebmulx(row), (0, P + 1))[: P + 1] for row in np.eye(P)]), lbnd=-1, axis=1
)  # -> those of int_{-1}^x x f


def _products() -> np.ndarray:
    """int T_j T_k over [-1, 1]."""
    x, weights = np.polynomial.legendre.leggauss(P + 1)
    values = chebyshev.chebvander(x, P - 1)
    return values.T @ (weights[:, None] * values)


SQUARE = _products()


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """n unit step responses as pieces, in order of owner and time; each has at least one.

    owner: (m,).   begin, length: (m,).   y, u: (m, P), Chebyshev.   first: (n,), the first piece of each.
    target: (n,), 1 for a step of the set point, 0 for one of the load.
    """

    owner: np.ndarray
    begin: np.ndarray
    length: np.ndarray
    y: np.ndarray
    u: np.ndarray
    first: np.ndarray
    target: np.ndarray

    @property
    def e(self) -> np.ndarray:
        """r - y."""
        error = -self.y
        error[:, 0] += self.target[self.owner]
        return error


@dataclass(frozen=True, slots=True, eq=False)
class Measures:
    """Of n responses, (n,) each; see performance.StepMetrics."""

    IAE: np.ndarray
    ISE: np.ndarray
    ITAE: np.ndarray
    TV: np.ndarray
    overshoot: np.ndarray
    peak: np.ndarray
    peak_time: np.ndarray


def measures(steps: Steps) -> Measures:
    """Integrals, variation and extremes of all responses."""
    e, half, m = steps.e, steps.length / 2, len(steps.owner)
    stack = np.concatenate([steps.y @ SLOPE, steps.u @ SLOPE])
    row, x = _zeros(stack, _alive(stack, steps))
    turns, piece, in_y = _values_at(x), row % m, row < m
    turning = (piece[in_y], x[in_y], turns[in_y])
    row_e, x_e = _zeros(e, _alive(e, steps), turning)
    IAE, ITAE = _absolute_integrals(steps, e, half, row_e, x_e)
    of_u = ~in_y
    at_u = (steps.u[piece[of_u]] * turns[of_u]).sum(axis=1)
    left, right = steps.u @ SIGNS, steps.u.sum(axis=1)
    before = np.concatenate([[0.0], right[:-1]])
    before[steps.first] = 0.0
    TV = _variation(piece[of_u], at_u, left, right) + np.abs(left - before)
    piece = piece[in_y]
    y_times = steps.begin[piece] + half[piece] * (x[in_y] + 1)
    peak, peak_time, opposite = _extremes(steps, piece, (steps.y[piece] * turns[in_y]).sum(axis=1), y_times)
    with np.errstate(divide="ignore", invalid="ignore"):
        overshoot = np.where(steps.target, peak - 1, np.where(peak, opposite / np.abs(peak), 0.0))
    return Measures(
        *(np.add.reduceat(each, steps.first) for each in (IAE, half * ((e @ SQUARE) * e).sum(axis=1), ITAE, TV)),
        np.where(overshoot > LEAST_OVERSHOOT, overshoot, 0.0),
        peak,
        peak_time,
    )


def rise_and_settling(steps: Steps, peak: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """10 % to 90 % of a set-point step, nan for the others; within 2 % of the step, of `peak` for a load step."""
    n, m, target = len(steps.first), len(steps.owner), steps.target
    band = SETTLING * np.where(target, 1.0, np.abs(peak))
    levels = np.stack([np.full(n, RISE[0]), np.full(n, RISE[1]), target - band, target + band])
    shifted = np.tile(steps.y, (4, 1))
    shifted[:, 0] -= levels[:, steps.owner].ravel()
    row, x = _zeros(shifted, np.ones(4 * m, dtype=bool))
    left, right = shifted @ SIGNS, shifted.sum(axis=1)
    before = np.concatenate([[0.0], right[:-1]])
    before[(steps.first + m * np.arange(4)[:, None]).ravel()] = -levels.ravel()
    jumped = np.flatnonzero(left * before < 0)
    kind, piece = np.divmod(np.concatenate([row, jumped]), m)
    times = steps.begin[piece] + steps.length[piece] / 2 * (np.concatenate([x, np.full(len(jumped), -1.0)]) + 1)
    found, owner = np.full((2, n), np.inf), steps.owner[piece]
    np.minimum.at(found, (kind[kind < 2], owner[kind < 2]), times[kind < 2])
    first = np.where(np.isfinite(found), found, 0.0)
    settling = np.zeros(n)
    np.maximum.at(settling, owner[kind >= 2], times[kind >= 2])
    return np.where(target, first[1] - first[0], np.nan), settling


def _alive(series: np.ndarray, steps: Steps) -> np.ndarray:
    """Which rows, one for each piece or several such lists one after the other, are more than rounding."""
    total = np.abs(series).sum(axis=1).reshape(-1, len(steps.owner))
    return (total > NOISE * np.maximum.reduceat(total, steps.first, axis=1)[:, steps.owner]).ravel()


def _values_at(x: np.ndarray) -> np.ndarray:
    """T_k(x), (len(x), P)."""
    return np.cos(DEGREES * np.arccos(x)[:, None])


def _zeros(series: np.ndarray, wanted: np.ndarray, turning=None) -> tuple[np.ndarray, np.ndarray]:
    """Sign changes within the series that are `wanted`: row and place x in (-1, 1), in order.

    turning: rows, places in order and T_k there, where the series may touch zero between two samples.
    """
    size = np.abs(series)
    able = np.flatnonzero(wanted & (2 * size[:, 0] <= size.sum(axis=1)))
    values = series[able] @ VANDERMONDE
    row, at = np.nonzero((values[:, 1:] < 0) != (values[:, :-1] < 0))
    row, low, high = able[row], SAMPLES[at], SAMPLES[at + 1]
    first, last = values[np.searchsorted(able, row), at], values[np.searchsorted(able, row), at + 1]
    if turning is not None:
        row, low, high, first, last = _with_lobes(series, able, values, turning, (row, low, high, first, last))
    return row, _polished(series[row], low, high, first, last)


def _with_lobes(series, able, values, turning, brackets):
    """Brackets on both sides of a turning point whose sign is not that of the samples around it."""
    row, x, basis = turning
    position = np.minimum(np.searchsorted(able, row), max(len(able) - 1, 0))
    known = able[position] == row if len(able) else np.zeros(len(row), dtype=bool)
    row, x, position, basis = row[known], x[known], position[known], basis[known]
    middle = (series[row] * basis).sum(axis=1)
    at = np.clip(np.searchsorted(SAMPLES, x), 1, len(SAMPLES) - 1)
    before, after = values[position, at - 1], values[position, at]
    lobe = ((before < 0) == (after < 0)) & ((middle < 0) != (before < 0))
    row, x, middle, before, after, at = (each[lobe] for each in (row, x, middle, before, after, at))
    more = (
        np.concatenate([row, row]),
        np.concatenate([SAMPLES[at - 1], x]),
        np.concatenate([x, SAMPLES[at]]),
        np.concatenate([before, middle]),
        np.concatenate([middle, after]),
    )
    joined = [np.concatenate(pair) for pair in zip(brackets, more, strict=True)]
    order = np.lexsort((joined[1], joined[0]))
    return [each[order] for each in joined]


def _polished(own: np.ndarray, low: np.ndarray, high: np.ndarray, first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Zeros of the series `own` between low and high, where their values are first and last: Newton inside brackets."""
    slope, below = own @ SLOPE, first < 0
    x = low - first * (high - low) / (last - first)
    for _ in range(NEWTON if len(x) else 0):
        powers = _values_at(x)
        f = (own * powers).sum(axis=1)
        same = (f < 0) == below
        low, high = np.where(same, x, low), np.where(same, high, x)
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = x - f / (slope * powers).sum(axis=1)
        following = np.where(f == 0, x, np.where((newton >= low) & (newton <= high), newton, (low + high) / 2))
        moved, x = np.abs(following - x), following
        if np.all(moved <= SETTLED):
            break
    return x


def _variation(piece: np.ndarray, turning: np.ndarray, left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Total variation in each piece of a function that turns at `turning`, values in order of `piece`."""
    found = np.abs(right - left)
    if not len(piece):
        return found
    found[piece] = 0.0
    new = np.concatenate([[True], piece[1:] != piece[:-1]])
    old = np.concatenate([new[1:], [True]])
    steps = np.abs(turning - np.where(new, left[piece], np.concatenate([[0.0], turning[:-1]])))
    np.add.at(found, piece, steps)
    np.add.at(found, piece[old], np.abs(right[piece[old]] - turning[old]))
    return found


def _absolute_integrals(steps: Steps, e: np.ndarray, half: np.ndarray, piece: np.ndarray, x: np.ndarray):
    """int |e| and int t |e| of each piece."""
    middle = steps.begin + half
    once, twice = half * e.dot(INTEGRAL.sum(axis=1)), half**2 * e.dot(MOMENT.sum(axis=1))
    angle = np.arccos(x)[:, None]
    at = half[piece] * ((e[piece] @ INTEGRAL) * np.cos(np.arange(P + 1) * angle)).sum(axis=1)
    moment = half[piece] ** 2 * ((e[piece] @ MOMENT) * np.cos(np.arange(P + 2) * angle)).sum(axis=1)
    zero = np.zeros(len(e))
    return (
        _variation(piece, at, zero, once),
        _variation(piece, middle[piece] * at + moment, zero, middle * once + twice),
    )


def _extremes(steps: Steps, piece: np.ndarray, turning: np.ndarray, turning_times: np.ndarray):
    """peak: largest y of a set-point step, y of largest size of a load step, the first time it is reached, and how
    far y goes to the other side."""
    left, right = steps.y @ SIGNS, steps.y.sum(axis=1)
    owner = np.concatenate([steps.owner, steps.owner, steps.owner[piece]])
    values = np.concatenate([left, right, turning])
    times = np.concatenate([steps.begin, steps.begin + steps.length, turning_times])
    n = len(steps.first)
    high, low = np.full(n, -np.inf), np.full(n, np.inf)
    np.maximum.at(high, owner, values)
    np.minimum.at(low, owner, values)
    peak = np.where((steps.target != 0) | (high >= -low), high, low)
    time = np.full(n, np.inf)
    at_peak = values == peak[owner]
    np.minimum.at(time, owner[at_peak], times[at_peak])
    return peak, time, np.where(peak > 0, -low, high)
