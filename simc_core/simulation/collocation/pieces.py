"""Piecewise polynomials: what the engine knows of a response, exact between the instants on a grid."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike

from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P

TINY = 1e-300  # to the left of 0
NEAR = 1e-12  # relative to t: an instant this close below an edge is the edge, where the right-hand limit holds
FEW = 50  # instants; for more, products take less time than cosines
DEGREES = np.arange(P + 2.0)[:, None]
ENDS = chebyshev.chebvander(np.array([-1.0, 1.0]), P - 1)  # coefficients -> values at the left and the right end


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """edges: (m + 1,) increasing from 0.   coefficients: (m, p, ...), Chebyshev, on each [edges[i], edges[i + 1]].

    p is P for a response, P + 1 for its integral.
    """

    edges: np.ndarray
    coefficients: np.ndarray

    def __call__(self, t: ArrayLike, left: np.ndarray | None = None) -> np.ndarray:
        """Values at t (n,), shape (n, ...); zero before 0, the last value after the end.

        Right-hand limits at edges, left-hand ones where `left` (n,) says so. One matrix product for each run of
        instants in one piece.
        """
        t = np.asarray(t, dtype=float)
        seen = t * (1 + NEAR)
        if left is not None:
            seen[left] = t[left] * (1 - NEAR) - TINY
        at = np.minimum(self.edges.searchsorted(seen, side="right"), len(self.coefficients)) - 1
        piece = np.maximum(at, 0)
        x = (t - self.edges[piece]) * (2 / (self.edges[1:] - self.edges[:-1]))[piece] - 1
        basis = chebyshev_basis(np.minimum(np.maximum(x, -1.0), 1.0), self.coefficients.shape[1])
        rows = self._flat().transpose(0, 2, 1)
        values = np.zeros((rows.shape[1], len(t)))
        new = np.ones(len(t), dtype=bool)
        new[1:] = at[1:] != at[:-1]
        cuts = [*new.nonzero()[0].tolist(), len(t)]
        for (low, high), j in zip(pairwise(cuts), at[new].tolist(), strict=True):
            if j >= 0:
                np.matmul(rows[j], basis[:, low:high], out=values[:, low:high])
        return values.T.reshape(len(t), *self.coefficients.shape[2:])

    def ends(self) -> tuple[np.ndarray, np.ndarray]:
        """Values at the left and at the right end of each piece, (m, ...) both."""
        found, shape = ENDS @ self._flat(), self.coefficients.shape[2:]
        return found[:, 0].reshape(-1, *shape), found[:, 1].reshape(-1, *shape)

    def integral(self, until: float) -> "Pieces":
        """The integral from 0, exact, up to `until`; behind the last piece of a response it goes on straight."""
        edges, coefficients = self.edges, self.coefficients
        if until > edges[-1]:
            rest = np.zeros_like(coefficients[:1])
            rest[0, 0] = coefficients[-1].sum(axis=0)  # T_k(1) = 1
            edges, coefficients = np.append(edges, until), np.concatenate([coefficients, rest])
        half = np.diff(edges).reshape(-1, *[1] * (coefficients.ndim - 2)) / 2
        integrals = half[:, None] * chebyshev.chebint(coefficients, lbnd=-1, axis=1)
        integrals[1:, 0] += np.cumsum(integrals.sum(axis=1), axis=0)[:-1]
        return Pieces(edges, integrals)

    def _flat(self) -> np.ndarray:
        """Coefficients with all signals in one axis, (m, p, signals)."""
        m, p, *shape = self.coefficients.shape
        return self.coefficients.reshape(m, p, math.prod(shape))


def chebyshev_basis(x: np.ndarray, p: int = P) -> np.ndarray:
    """T_0 .. T_{p-1} at x (n,) in [-1, 1], shape (p, n); p <= P + 2.

    T_k = cos(k arccos x);   with D = 2 T, D_{m+k} = D_m D_k - D_{m-k} for k = 1 .. m at once, m = 1, 2, 4 ...
    """
    if len(x) <= FEW:
        return np.cos(DEGREES[:p] * np.arccos(x))
    D, m = np.empty((p, len(x))), 1
    D[0], D[1] = 2.0, 2 * x
    while m < p - 1:
        k = min(m, p - 1 - m)
        following = np.multiply(D[1 : k + 1], D[m], out=D[m + 1 : m + k + 1])
        following -= D[m - k : m][::-1]
        m *= 2
    D *= 0.5
    return D
