"""(a + b K + c K^2)^-1 for K = h A, A the collocation matrix, and for many a, b, c and h at once.

A = Q T Q', Q orthogonal, T upper triangular but for 2 x 2 blocks on its diagonal. So is a + b h T + c h^2 T^2, whose
inverse is put together from the inverses of these blocks, two and two: as exact as elimination, and half its time.
"""

import numpy as np
from scipy.linalg import schur

from simc_core.simulation.collocation.elements import COLLOCATION
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P

T, Q = schur(COLLOCATION, output="real")
T, BACK = np.triu(T, -1), np.ascontiguousarray(Q.T)
SQUARE = T @ T
EYE = np.eye(P)
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


def solved(a: np.ndarray, b: np.ndarray, c: np.ndarray, length: np.ndarray, right: np.ndarray) -> np.ndarray:
    """(a + b K + c K^2)^-1 right.

    a, b, c: (m, 1, 1, 1).   length: h, (L, 1, 1).   right: (m, L, P, n), and so is what is returned.
    """
    matrix = a * EYE + (b * length) * T + (c * length**2) * SQUARE
    return Q @ (_inverse(matrix) @ (BACK @ right))


def _inverse(matrix: np.ndarray) -> np.ndarray:
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
