"""Where to begin: the sum of squares on a grid of dead times and lags, for means of neighbours.

Along theta it often has several minima, and it is smooth only between samples [YIG07]: one start is not enough.
"""

import numpy as np

from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.problem import Problem
from simc_core.identification.estimator.records import Record

RATIOS = (1.0, 0.4, 0.12)  # of two lags
ZETAS = (0.03, 0.15, 0.4, 0.8)
LAGS = 18
DEAD_TIMES = 28
DELAYED = 0.6  # of the longest stretch without a gap, up to which dead times are tried densely
HALF = 0.5  # of the whole, below which a stretch is looked at by itself


def starts(problem: Problem, count: int) -> list[Array]:
    """The best points of the grid that are not neighbours, best first, at most `count`."""
    theta = dead_times(problem)
    grid = _lags(problem)
    cost = np.array([costs(problem, theta, lags) for lags in grid])
    found: list[tuple[int, int]] = []
    for flat in np.argsort(cost, axis=None):
        i, j = divmod(int(flat), theta.size)
        near = (abs(j - b) <= 2 and float(np.max(np.abs(grid[i] - grid[a]), initial=0.0)) < 0.7 for a, b in found)
        if not any(near):
            found.append((i, j))
            if len(found) == count:
                break
    return [np.concatenate([[theta[j]], grid[i]]) for i, j in found]


def dead_times(problem: Problem) -> Array:
    """Dead times to try: 0, some in proportion, the rest evenly; around a gap also those of a record without it."""
    longest = float(problem.high[0])
    whole = _dead_times(problem, longest)
    stretch = DELAYED * max(record.stretch for record in problem.records)
    return whole if stretch > HALF * longest else np.union1d(whole, _dead_times(problem, stretch))


def _dead_times(problem: Problem, longest: float) -> Array:
    shortest = min(max(0.3 * problem.records[0].interval, 1e-3 * longest), longest / 20)
    third = DEAD_TIMES // 2
    rising = np.geomspace(shortest, longest / 5, third, endpoint=False)
    return np.concatenate([[0.0], rising, np.linspace(longest / 5, longest, DEAD_TIMES - third)])


def costs(problem: Problem, theta: Array, x: Array) -> Array:
    """Sum of squares for each of the dead times, shape of theta, at the lags x = (ln lags...)."""
    lags = problem.lags(np.concatenate([[0.0], x]))
    structure = problem.structure
    root = problem.root_weight
    target = problem.columns(np.concatenate([[0.0], x]))[0] * root if structure.key == "unstable" else problem.y * root
    fixed = [problem.fixed]
    if problem.start:
        for i, record in enumerate(problem.records):
            fixed.append(problem.spread(structure.free(record.t, lags), i))
    basis = np.linalg.qr(np.concatenate(fixed, axis=1) * root[:, None])[0]
    left = target - basis @ (basis.T @ target)
    responses = [_responses(problem, record, theta, lags) for record in problem.records]
    cost = np.full(theta.size, float(left @ left))
    done: list[Array] = []
    rest = np.broadcast_to(left, (theta.size, left.size))
    for parts in zip(*responses, strict=True):
        column = np.concatenate(parts, axis=1) * root
        column = column - (column @ basis) @ basis.T
        for other in done:
            column = column - np.sum(column * other, axis=1, keepdims=True) * other
        length = np.sqrt(np.sum(column**2, axis=1, keepdims=True))
        column = column / np.where(length > 0, length, np.inf)
        inner = np.sum(column * rest, axis=1)
        cost = cost - inner**2
        done.append(column)
    return cost


def _responses(problem: Problem, record: Record, theta: Array, lags: Array) -> list[Array]:
    at = record.held.locate(record.t[None, :] - theta[:, None])
    return problem.structure.columns(record.held, at, lags)


def _lags(problem: Problem) -> list[Array]:
    """Lags to try, as (ln lags...)."""
    names = problem.structure.lags
    if not names:
        return [np.empty(0)]
    record = min(problem.records, key=lambda one: one.interval)
    span, stretch = (max(values) for values in zip(*((one.span, one.stretch) for one in problem.records), strict=True))
    # finer where the samples are finer, but never finer than the means that the grid is worked on
    shortest = 0.3 * max(record.interval, float(np.median(np.diff(record.t))))
    times = np.log(np.geomspace(shortest, 3 * stretch, LAGS))
    if stretch < HALF * span:
        times = np.append(times, np.log(np.geomspace(3 * stretch, 3 * span, LAGS // 3 + 1)[1:]))
    if len(names) == 1:
        return [np.array([time]) for time in times]
    if names[1] == "zeta":
        return [np.array([time, zeta]) for time in times for zeta in ZETAS]
    return [np.array([time, time + np.log(ratio)]) for time in times for ratio in RATIOS]
