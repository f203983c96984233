"""Where polynomials given by Chebyshev coefficients change sign on [-1, 1]: many at once.

A series with |c_0| > sum |c_k| has no zero. The others are sampled; where one is known to turn (a maximum or minimum),
it is looked at as well, so that no narrow lobe between two samples is lost. Brackets are polished by bracketed Newton.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.simulation.elements import P

SAMPLES = np.cos(np.pi * np.arange(32, -1, -1) / 32)
NEWTON = 8
QUADRATIC = 1e-8  # after a Newton step this small the next would be below rounding

DEGREES = np.arange(P)
VANDERMONDE = chebyshev.chebvander(SAMPLES, P - 1).T
SLOPE = chebyshev.chebder(np.eye(P), axis=1) @ np.eye(P - 1, P)  # coefficients -> those of the derivative


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """row: of the series.   x: in (-1, 1), in order of row and x.   basis: T_k(x), (len(x), P)."""

    row: np.ndarray
    x: np.ndarray
    basis: np.ndarray

    def __getitem__(self, where) -> "Places":
        return Places(self.row[where], self.x[where], self.basis[where])

    def of(self, series: np.ndarray) -> np.ndarray:
        """Values of the series (rows, P) at these places."""
        return (series[self.row] * self.basis).sum(axis=1)


def zeros(series: np.ndarray, wanted: np.ndarray, turning: Places | None = None) -> Places:
    """Sign changes within the series that are `wanted`; turning: where some of them turn."""
    size = np.abs(series)
    able = np.flatnonzero(wanted & (2 * size[:, 0] <= size.sum(axis=1)))
    values = series[able] @ VANDERMONDE
    below = values < 0
    position, at = np.nonzero(below[:, 1:] != below[:, :-1])
    found = able[position], SAMPLES[at], SAMPLES[at + 1], values[position, at], values[position, at + 1]
    if turning is not None and len(turning.x) and len(able):
        found = _with_lobes(series, able, values, turning, found)
    row, low, high, first, last = found
    return _polished(series[row], row, low, high, first, last)


def _with_lobes(series, able, values, turning: Places, brackets):
    """Brackets on both sides of a turning point whose sign is not that of the samples around it."""
    position = np.minimum(np.searchsorted(able, turning.row), len(able) - 1)
    known = able[position] == turning.row
    turning, position = turning[known], position[known]
    middle, x = turning.of(series), turning.x
    at = np.clip(np.searchsorted(SAMPLES, x), 1, len(SAMPLES) - 1)
    before, after = values[position, at - 1], values[position, at]
    lobe = ((before < 0) == (after < 0)) & ((middle < 0) != (before < 0))
    if not lobe.any():
        return brackets
    row, x, middle, before, after, at = (each[lobe] for each in (turning.row, x, middle, before, after, at))
    lefts, rights = (row, SAMPLES[at - 1], x, before, middle), (row, x, SAMPLES[at], middle, after)
    joined = [np.concatenate(each) for each in zip(brackets, lefts, rights, strict=True)]
    order = np.lexsort((joined[1], joined[0]))
    return [each[order] for each in joined]


def _polished(own: np.ndarray, row: np.ndarray, low, high, first, last) -> Places:
    """Zeros of the series `own` between low and high, where their values are first and last."""
    slope, below = own @ SLOPE, first < 0
    x = low - first * (high - low) / (last - first)
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(NEWTON if len(x) else 0):
            basis = _basis(x)
            f = (own * basis).sum(axis=1)
            same = (f < 0) == below
            low, high = np.where(same, x, low), np.where(same, high, x)
            newton = x - f / (slope * basis).sum(axis=1)
            inside = (newton >= low) & (newton <= high)
            following = np.where(inside, newton, np.where(f == 0, x, (low + high) / 2))
            moved, x = np.abs(following - x), following
            if moved.max() <= QUADRATIC:
                break
    return Places(row, x, _basis(x))


def _basis(x: np.ndarray) -> np.ndarray:
    """T_k(x) = Re (x + j sqrt(1 - x^2))^k."""
    powers = np.empty((len(x), P), dtype=complex)
    powers[:, 0], powers[:, 1:] = 1.0, (x + 1j * np.sqrt(1 - x * x))[:, None]
    return np.multiply.accumulate(powers, axis=1).real
