"""Piecewise polynomials: what the engine knows of a response, exact between the instants on a grid."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial import chebyshev

NEAR = 1e-12  # relative to t: an instant this close below an edge is the edge, where the right-hand limit holds


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """edges: (m + 1,) increasing from 0.   coefficients: (m, p, ...), Chebyshev, on each [edges[i], edges[i + 1]]."""

    edges: np.ndarray
    coefficients: np.ndarray

    def __call__(self, t) -> np.ndarray:
        """Values at t (n,), shape (n, ...); zero before 0, right-hand limits at edges, the last value after the end."""
        t = np.asarray(t, dtype=float)
        if t.size > 1 and np.any(np.diff(t) < 0):
            order = np.argsort(t)
            values = np.empty((len(t), *self.coefficients.shape[2:]))
            values[order] = self(t[order])
            return values
        degree, shape = self.coefficients.shape[1], self.coefficients.shape[2:]
        at = np.searchsorted(self.edges, t * (1 + NEAR), side="right") - 1
        piece = np.clip(at, 0, len(self.coefficients) - 1)
        left = self.edges[piece]
        x = np.clip(2 * (t - left) / (self.edges[piece + 1] - left) - 1, -1.0, 1.0)
        basis, flat = chebyshev.chebvander(x, degree - 1), self.coefficients.reshape(-1, degree, math.prod(shape))
        values = np.empty((len(t), math.prod(shape)))
        cuts = [0, *(np.flatnonzero(np.diff(piece)) + 1).tolist(), len(t)]
        for low, high in pairwise(cuts) if len(t) else ():
            np.matmul(basis[low:high], flat[piece[low]], out=values[low:high])
        values[at < 0] = 0.0
        return values.reshape(len(t), *shape)

    def ends(self) -> tuple[np.ndarray, np.ndarray]:
        """Values at the left and at the right end of each piece, (m, ...) both."""
        signs = (-1.0) ** np.arange(self.coefficients.shape[1])
        return np.tensordot(self.coefficients, signs, (1, 0)), self.coefficients.sum(axis=1)


def clenshaw(coefficients: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Chebyshev series coefficients (n, p, ...) at x (n,) each: (n, ...)."""
    x = 2 * x.reshape(x.shape + (1,) * (coefficients.ndim - 2))
    series = np.moveaxis(coefficients, 1, 0)
    one, two = series[-1], 0.0
    for term in series[-2:0:-1]:
        one, two = term + x * one - two, one
    return series[0] + x / 2 * one - two if len(series) > 1 else series[0]
