"""Step metrics from the polynomials of the engine: many responses at once, nothing sampled that can be integrated.

    IAE = int |e|    ISE = int e^2    ITAE = int t |e|    TV = sum |change of u|, jumps included    e = r - y

IAE is the total variation of int e, ITAE that of int t e: both turn where e has a zero, as u turns where u' has one.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.piece_zeros import DEGREES, SLOPE, Places, zeros
from simc_core.simulation.elements import P

NOISE = 1e-11  # of the largest value; a signal this small has come to rest, its signs are rounding
SETTLING, RISE = 0.02, (0.1, 0.9)
LEAST_OVERSHOOT = 1e-10  # less than that is rounding

SIGNS = (-1.0) ** DEGREES  # T_k(-1)
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

    def time(self, piece: np.ndarray, x: np.ndarray) -> np.ndarray:
        """Instants at the places x in [-1, 1] of pieces."""
        return self.begin[piece] + self.length[piece] / 2 * (x + 1)

    def before(self, right: np.ndarray, start) -> np.ndarray:
        """Values at the end of the piece before, from those at the right ends; `start` before t = 0."""
        found = np.concatenate([[0.0], right[:-1]])
        found[self.first] = start
        return found


@dataclass(frozen=True, slots=True, eq=False)
class Measures:
    """Of n responses, (n,) each; see performance.StepMetrics, which has them in this order."""

    IAE: np.ndarray
    ISE: np.ndarray
    ITAE: np.ndarray
    TV: np.ndarray
    overshoot: np.ndarray
    peak: np.ndarray
    peak_time: np.ndarray
    rise_time: np.ndarray
    settling_time: np.ndarray


def measures(steps: Steps, with_times: bool = True) -> Measures:
    """All metrics of all responses; with_times: False leaves rise and settling times at nan."""
    m, half = len(steps.owner), steps.length / 2
    slopes = np.concatenate([steps.y @ SLOPE, steps.u @ SLOPE])
    turns = zeros(slopes, _alive(slopes, steps))
    of_y, of_u = turns[turns.row < m], turns[turns.row >= m]
    of_u = Places(of_u.row - m, of_u.x, of_u.basis)
    peak, peak_time, opposite = _extremes(steps, of_y)
    e = -steps.y
    e[:, 0] += steps.target[steps.owner]
    levels = _levels(steps, peak) if with_times else np.zeros((0, len(peak)))
    series = np.concatenate([e, *[steps.y] * len(levels)])
    series[m:, 0] -= levels[:, steps.owner].ravel()
    wanted = np.concatenate([_alive(e, steps), np.ones(len(series) - m, dtype=bool)])
    found = zeros(series, wanted, of_y)
    of_e, crossed = found[found.row < m], found[found.row >= m]
    rise = settling = np.full(len(peak), np.nan)
    if with_times:
        rise, settling = _times(steps, series[m:], levels, crossed.row - m, crossed.x)
    IAE, ITAE = _absolute_integrals(steps, e, of_e)
    left, right = steps.u @ SIGNS, steps.u.sum(axis=1)
    TV = _variation(of_u.row, of_u.of(steps.u), left, right) + np.abs(left - steps.before(right, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        overshoot = np.where(steps.target, peak - 1, np.where(peak, opposite / np.abs(peak), 0.0))
    return Measures(
        *(np.add.reduceat(each, steps.first) for each in (IAE, half * ((e @ SQUARE) * e).sum(axis=1), ITAE, TV)),
        np.where(overshoot > LEAST_OVERSHOOT, overshoot, 0.0),
        peak,
        peak_time,
        rise,
        settling,
    )


def _alive(series: np.ndarray, steps: Steps) -> np.ndarray:
    """Which rows, one for each piece or several such lists one after the other, are more than rounding."""
    total = np.abs(series).sum(axis=1).reshape(-1, len(steps.owner))
    return (total > NOISE * np.maximum.reduceat(total, steps.first, axis=1)[:, steps.owner]).ravel()


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


def _absolute_integrals(steps: Steps, e: np.ndarray, at: Places) -> tuple[np.ndarray, np.ndarray]:
    """int |e| and int t |e| of each piece; at: zeros of e."""
    half, piece = steps.length / 2, at.row
    middle = steps.begin + half
    once, twice = half * e.dot(INTEGRAL.sum(axis=1)), half**2 * e.dot(MOMENT.sum(axis=1))
    angle = np.arccos(at.x)[:, None]
    first = half[piece] * ((e[piece] @ INTEGRAL) * np.cos(np.arange(P + 1) * angle)).sum(axis=1)
    moment = half[piece] ** 2 * ((e[piece] @ MOMENT) * np.cos(np.arange(P + 2) * angle)).sum(axis=1)
    zero = np.zeros(len(e))
    return (
        _variation(piece, first, zero, once),
        _variation(piece, middle[piece] * first + moment, zero, middle * once + twice),
    )


def _extremes(steps: Steps, at: Places) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """peak: largest y of a set-point step, y of largest size of a load step; the first time it is reached; and how far
    y goes to the other side. at: where y turns.
    """
    left, right = steps.y @ SIGNS, steps.y.sum(axis=1)
    owner = np.concatenate([steps.owner, steps.owner, steps.owner[at.row]])
    values = np.concatenate([left, right, at.of(steps.y)])
    times = np.concatenate([steps.begin, steps.begin + steps.length, steps.time(at.row, at.x)])
    n = len(steps.first)
    high, low, time = np.full(n, -np.inf), np.full(n, np.inf), np.full(n, np.inf)
    np.maximum.at(high, owner, values)
    np.minimum.at(low, owner, values)
    peak = np.where((steps.target != 0) | (high >= -low), high, low)
    at_peak = values == peak[owner]
    np.minimum.at(time, owner[at_peak], times[at_peak])
    return peak, time, np.where(peak > 0, -low, high)


def _levels(steps: Steps, peak: np.ndarray) -> np.ndarray:
    """10 %, 90 %, and the band of 2 % of the step, or of the load's peak, about where the response ends: (4, n)."""
    band = SETTLING * np.where(steps.target, 1.0, np.abs(peak))
    found = np.empty((4, len(peak)))
    found[0], found[1], found[2], found[3] = *RISE, steps.target - band, steps.target + band
    return found


def _times(steps: Steps, shifted: np.ndarray, levels: np.ndarray, row: np.ndarray, x: np.ndarray):
    """Rise time, nan for a load step, and settling time.

    shifted: y less each of `levels`, one list of pieces after the other.   row, x: its zeros.
    """
    m, n = len(steps.owner), len(steps.first)
    left, right = (shifted @ SIGNS).reshape(-1, m), shifted.sum(axis=1).reshape(-1, m)
    before = np.empty_like(right)
    before[:, 1:], before[:, steps.first] = right[:, :-1], -levels
    jumped = np.flatnonzero(left * before < 0)
    kind, piece = np.divmod(np.concatenate([row, jumped]), m)
    times = steps.time(piece, np.concatenate([x, np.full(len(jumped), -1.0)]))
    owner, rising = steps.owner[piece], kind < 2
    first, settling = np.full((2, n), np.inf), np.zeros(n)
    np.minimum.at(first, (kind[rising], owner[rising]), times[rising])
    first = np.where(np.isfinite(first), first, 0.0)
    np.maximum.at(settling, owner[~rising], times[~rising])
    return np.where(steps.target, first[1] - first[0], np.nan), settling
