"""Piecewise polynomials: what the engine knows of a response, exact between the instants on a grid."""

from dataclasses import dataclass

import numpy as np

NEAR = 1e-12  # relative to t: an instant this close below an edge is the edge, where the right-hand limit holds


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """edges: (m + 1,) increasing from 0.   coefficients: (m, p, ...), Chebyshev, on each [edges[i], edges[i + 1]]."""

    edges: np.ndarray
    coefficients: np.ndarray

    def __call__(self, t) -> np.ndarray:
        """Values at t (n,), shape (n, ...); zero before 0, right-hand limits at edges, the last value after the end."""
        t = np.asarray(t, dtype=float)
        at = np.searchsorted(self.edges, t * (1 + NEAR), side="right") - 1
        piece = np.clip(at, 0, len(self.coefficients) - 1)
        left, right = self.edges[piece], self.edges[piece + 1]
        x = np.clip(2 * (t - left) / (right - left) - 1, -1.0, 1.0)
        values = clenshaw(self.coefficients[piece], x)
        values[at < 0] = 0.0
        return values

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
