"""Where polynomials given by Chebyshev coefficients pass through levels on [-1, 1]: many at once.

All are sampled; where one is known to turn (a maximum or minimum) it is looked at as well, so that no narrow lobe
between two samples is lost. From the secant of its bracket x goes by Halley's steps, of third order,

    x - N/(1 - N f''/(2 f')),   N = f/f'

or halves the bracket where that leads out of it. What a step leaves of its length is about (N f''/(2 f'))^2 and the
square of its share of the bracket; where that is next to nothing the zero is known. Two steps are usual.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.collocation.pieces import chebyshev_basis

INTERVALS = 64
SAMPLES = np.cos(np.pi * np.arange(INTERVALS, -1, -1) / INTERVALS)
MOST_STEPS = 30
OUTSIDE = 1e-13  # of [-1, 1]: rounding of a zero at the end of its bracket
KNOWN = 1e-13  # of [-1, 1]: what the error of the last step may be
AT_LEVEL = 1e-11  # of the size of a series: so near a level it begins on it, often with several derivatives
SERIES_ROUNDING = 1e-15  # of its size

VANDERMONDE = chebyshev.chebvander(SAMPLES, P - 1).T
SLOPE = chebyshev.chebder(np.eye(P), axis=1) @ np.eye(P - 1, P)  # coefficients -> those of the derivative
TAYLOR = np.concatenate([np.eye(P), SLOPE.T, (SLOPE @ SLOPE).T / 2])  # column -> those of f, f', f''/2


@dataclass(frozen=True, slots=True, eq=False)
class Turns:
    """Maxima and minima of series: row, interval between two samples, x, value, (k,) each."""

    row: np.ndarray
    interval: np.ndarray
    x: np.ndarray
    value: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class LevelCrossings:
    """k places where series (R, P) pass through levels (L, R), in order of level.

    level, row: which.   interval: between which samples.   x: place.   sign: of series - level in front of it.
    basis: T_0 .. T_{P+1} next to x, (P + 2, k), for what is flat there.   begin: whether the series begin below the
    levels, (L, R).   ends: signs of series - first level at both ends, (2, R).
    """

    level: np.ndarray
    row: np.ndarray
    interval: np.ndarray
    x: np.ndarray
    sign: np.ndarray
    basis: np.ndarray
    begin: np.ndarray
    ends: np.ndarray

    def of_first_level(self) -> "LevelCrossings":
        """Those through the first level."""
        k = self.level.searchsorted(1)
        return LevelCrossings(
            self.level[:k],
            self.row[:k],
            self.interval[:k],
            self.x[:k],
            self.sign[:k],
            self.basis[:, :k],
            self.begin[:1],
            self.ends,
        )

    def of(self, series: np.ndarray) -> np.ndarray:
        """Values of other series (R, P) there."""
        return np.add.reduce(series[self.row].T * self.basis[:P], axis=0)

    def integral(self, left: float | np.ndarray, right: np.ndarray, at: np.ndarray) -> np.ndarray:
        """int s g' on each row, (R,), s the sign of the series less the first level, all of whose zeros these are.

        g: left and right (R,), at the places (k,).
        """
        found = self.ends[1] * right - self.ends[0] * left
        np.add.at(found, self.row, 2 * self.sign * at)
        return found


def crossings(series: np.ndarray, levels: np.ndarray, turns: Turns | None = None) -> LevelCrossings:
    """Of the series (R, P) through levels (L, R), -inf or nan for none.   turns: of the series."""
    values, size = series @ VANDERMONDE, np.add.reduce(np.abs(series), axis=1)
    below = values < levels[:, :, None]
    flat = np.abs(values[:, 0] - levels) <= AT_LEVEL * size
    np.copyto(below[:, :, 0], below[:, :, 1], where=flat)
    where, interval = np.divmod(np.flatnonzero(below[:, :, 1:] != below[:, :, :-1]), INTERVALS)
    level, row = np.divmod(where, len(series))
    first, last = values[row, interval], values[row, interval + 1]
    found: Sequence[np.ndarray] = (level, row, interval, SAMPLES[interval], SAMPLES[interval + 1], first, last)
    if turns is not None:
        found = _with_lobes(found, turns, values, below, levels)
    level, row, interval, low, high, first, last = found
    own, through = series[row].T, levels[level, row]
    own[0] -= through
    x, basis = _polished(own, SERIES_ROUNDING * size[row], low, high, first - through, last - through)
    sign, ends = 1.0 - 2.0 * (first < through), 1.0 - 2.0 * below[0, :, ::INTERVALS].T
    return LevelCrossings(level, row, interval, x, sign, basis, below[:, :, 0], ends)


def _with_lobes(
    found: Sequence[np.ndarray], turns: Turns, values: np.ndarray, below: np.ndarray, levels: np.ndarray
) -> Sequence[np.ndarray]:
    """Brackets on both sides of a turn that is not on the side of a level where the samples around it are."""
    before = below[:, turns.row, turns.interval]
    lobe = (before == below[:, turns.row, turns.interval + 1]) & (before != (turns.value < levels[:, turns.row]))
    if not lobe.any():
        return found
    level, at = np.nonzero(lobe)
    row, interval, x, value = turns.row[at], turns.interval[at], turns.x[at], turns.value[at]
    there = level, row, interval, SAMPLES[interval], x, values[row, interval], value
    back = level, row, interval, x, SAMPLES[interval + 1], value, values[row, interval + 1]
    joined = [np.concatenate(each) for each in zip(found, there, back, strict=True)]
    order = np.argsort(joined[0], kind="stable")
    return [each[order] for each in joined]


def _polished(
    own: np.ndarray, rounding: np.ndarray, low: np.ndarray, high: np.ndarray, first: np.ndarray, last: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Zeros of columns (P, k) between low and high, where they are first and last: x, and the basis next to it."""
    parts, width, below = (TAYLOR @ own).reshape(3, P, -1), high - low, first < 0
    low, high, basis, going = low.copy(), high.copy(), np.empty((P + 2, low.size)), np.arange(low.size)
    with np.errstate(divide="ignore", invalid="ignore"):
        # values of one sign, which rounding leaves where a series just touches a level, have no secant inside
        x = np.fmin(np.fmax(low - first * width / (last - first), low), high)
        for _ in range(MOST_STEPS):
            some = going if going.size < x.size else slice(None)
            at = x[some]
            basis[:, some] = near_it = chebyshev_basis(at, P + 2)
            f, following, bent = _step(at, parts[:, :, some], near_it[:P])
            same = (f < 0) == below[some]
            low[some] = begin = np.where(same, at, low[some])
            high[some] = end = np.where(same, high[some], at)
            inside = (following >= begin - OUTSIDE) & (following <= end + OUTSIDE)  # else it is another zero
            step = np.abs(following - at)
            known = (inside & (step * (bent**2 + (step / width[some]) ** 2) <= KNOWN)) | (np.abs(f) <= rounding[some])
            x[some] = np.fmin(np.fmax(np.where(known | inside, following, (begin + end) / 2), begin), end)
            going = going[~known]
            if not going.size:
                break
    return x, basis


def _step(x: np.ndarray, parts: np.ndarray, basis: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """f at x, where Halley's step leads, and N f''/(2 f'). parts: (3, P, k), coefficients of f, f', f''/2."""
    f, slope, bend = np.add.reduce(parts * basis, axis=1)
    newton = f / slope
    bent = newton * bend / slope
    return f, x - newton / (1 - bent), bent
