"""Piecewise polynomials: what the engine knows of a response, exact between the instants on a grid."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial import chebyshev

TINY = 1e-300  # to the left of 0
NEAR = 1e-12  # relative to t: an instant this close below an edge is the edge, where the right-hand limit holds


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """edges: (m + 1,) increasing from 0.   coefficients: (m, p, ...), Chebyshev, on each [edges[i], edges[i + 1]]."""

    edges: np.ndarray
    coefficients: np.ndarray

    def __call__(self, t, left=()) -> np.ndarray:
        """Values at t (n,), shape (n, ...); zero before 0, the last value after the end.

        Right-hand limits at edges; left-hand ones where the indices `left` say so, for t in increasing order.
        """
        t = np.asarray(t, dtype=float)
        if t.size > 1 and np.any(np.diff(t) < 0):
            order = np.argsort(t)
            values = np.empty((len(t), *self.coefficients.shape[2:]))
            values[order] = self(t[order])
            return values
        degree, shape = self.coefficients.shape[1], self.coefficients.shape[2:]
        seen = t * (1 + NEAR)
        if len(left):
            seen[left] = t[left] * (1 - NEAR) - TINY
        at = np.searchsorted(self.edges, seen, side="right") - 1
        piece = np.clip(at, 0, len(self.coefficients) - 1)
        begin = self.edges[piece]
        x = np.clip(2 * (t - begin) / (self.edges[piece + 1] - begin) - 1, -1.0, 1.0)
        basis, flat = chebyshev.chebvander(x, degree - 1), self.coefficients.reshape(-1, degree, math.prod(shape))
        values = np.empty((len(t), math.prod(shape)))
        cuts = [0, *(np.flatnonzero(np.diff(piece)) + 1).tolist(), len(t)]
        for low, high in pairwise(cuts) if len(t) else ():
            np.matmul(basis[low:high], flat[piece[low]], out=values[low:high])
        values[at < 0] = 0.0
        return values.reshape(len(t), *shape)

    def of_source(self, i: int) -> "Pieces":
        """Where values are signals x sources: the responses to one of the sources."""
        return Pieces(self.edges, self.coefficients[..., i])

    def ends(self) -> tuple[np.ndarray, np.ndarray]:
        """Values at the left and at the right end of each piece, (m, ...) both."""
        signs = (-1.0) ** np.arange(self.coefficients.shape[1])
        return np.tensordot(self.coefficients, signs, (1, 0)), self.coefficients.sum(axis=1)
