"""Functions of K = h A, A the collocation matrix, in coordinates in which they are triangular.

A = Q T Q', Q orthogonal, T upper triangular but for 2 x 2 blocks on its diagonal. Values at the nodes are Q times these
coordinates, in which K is h T, and polynomials in K and their inverses are triangular but for their blocks, too. An
inverse is put together from those of the blocks, two and two: as exact as elimination, and cheaper for many.
"""

from collections.abc import Sequence

import numpy as np
from scipy.linalg import schur

from simc_core.simulation.collocation.elements import COLLOCATION
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P

T, Q = schur(COLLOCATION, output="real")
T, BACK = np.triu(T, -1), np.ascontiguousarray(Q.T)  # BACK: from the values at the nodes to these coordinates
POWERS = (np.eye(P), T, T @ T)
FIRST = np.arange(0, P, 2)  # of each block
assert not np.diag(T, -1)[FIRST[1:] - 1].any()


def _joints() -> list[tuple[int, int, int]]:
    """Ranges [start, middle) and [middle, stop) whose inverses are known when they are joined."""
    found, size = [], 2
    while size < P:
        found += [(start, start + size, min(start + 2 * size, P)) for start in range(0, P - size, 2 * size)]
        size *= 2
    return found


JOINTS = _joints()


def polynomial(coefficients: Sequence[np.ndarray], length: np.ndarray) -> np.ndarray:
    """c_0 + c_1 K + c_2 K^2, (m, L, P, P), in ascending order, not all 0.

    coefficients: (m, 1, 1, 1) each, two or three.   length: h, (L, 1, 1).
    """
    terms = [(c * length**power) * POWERS[power] for power, c in enumerate(coefficients) if c.any()]
    found = terms[0]
    for term in terms[1:]:
        found += term
    return found


def inverse(matrix: np.ndarray) -> np.ndarray:
    """Of (..., P, P), triangular but for its blocks."""
    found, second = np.zeros_like(matrix), FIRST + 1
    p, q, r, s = (matrix[..., i, j] for i in (FIRST, second) for j in (FIRST, second))
    scale = 1 / (p * s - q * r)
    found[..., FIRST, FIRST], found[..., second, second] = s * scale, p * scale
    found[..., FIRST, second], found[..., second, FIRST] = -q * scale, -r * scale
    for start, middle, stop in JOINTS:
        above, below = slice(start, middle), slice(middle, stop)
        joined = found[..., above, above] @ (matrix[..., above, below] @ found[..., below, below])
        np.negative(joined, out=found[..., above, below])
    return found
