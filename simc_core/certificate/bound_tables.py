"""Tables for bounding sums of products P_k = g_k prod_m |q_m|^{e_km} from their factors on a segment of the axis.

On a segment each |q_m| lies between two bounds, which gives bounds of P_k that are as loose as there are factors.
Ratios |P_i/P_k| matter more: where |L| tends to a limit near 1 only close bounds tell on which side it is. With
x = omega^2 a ratio of two real factors,

    (b^2 x + c^2)/(b'^2 x + c'^2),

is monotone in x: its extremes are at the ends. So factors of degree 1 above and below are taken in pairs, and what
is left over, and pairs of complex roots, by their own bounds.

All of it is linear in the logarithms. Parts, V of them, are log|q_m|, log|g_k| and log|q_m/q_n| of the pairs; with the
lower bounds of the parts on a segment above their upper ones, (2 V,), one matrix gives every bound that is wanted.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import permutations

import numpy as np


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """For K products of M factors; see the module docstring.

    exponents (K, M), above: their positive part.   counts (K, 1): number of factors, g_k one of them.
    pairs (U, M): +1 and -1 of the two factors of each.
    terms, sizes (K, V): log|P_k| from the parts, and the same with |exponents|.
    bounds (K K + 2 M, 2 V): upper bounds of log|P_i/P_k| for i != k, k after k, then of log|P_k|, then of log 1/|q_m|
    where |q_m| is largest, and where it is smallest.
    rates (K, 2 M): bound of |P_k'/P_k| from |q_m'/q_m| in that order.
    """

    exponents: np.ndarray
    above: np.ndarray
    counts: np.ndarray
    pairs: np.ndarray
    terms: np.ndarray
    sizes: np.ndarray
    bounds: np.ndarray
    rates: np.ndarray


@lru_cache(maxsize=64)
def table(exponents: tuple[tuple[int, ...], ...], first_order: tuple[bool, ...]) -> Table:
    """exponents: K rows of M.   first_order: which of the M factors are of degree 1. No number of the loop is in it."""
    K, M = len(exponents), len(first_order)
    e = np.array(exponents, dtype=float).reshape(K, M)
    found: dict[tuple[int, int], int] = {}  # pairs, and their numbers
    ratios = [_ratio(e[i] - e[k], first_order, found) for k, i in permutations(range(K), 2)]
    U = len(found)
    pairs = np.zeros((U, M))
    for (m, n), u in found.items():
        pairs[u, m], pairs[u, n] = 1.0, -1.0
    unit, none = np.eye(K), np.zeros((K, U))
    terms, sizes = np.hstack([e, unit, none]), np.hstack([np.abs(e), unit, none])
    rows = np.zeros((len(ratios), M + K + U))
    for row, (k, i), (left, members) in zip(rows, permutations(range(K), 2), ratios, strict=True):
        row[:M], row[M : M + K] = left, unit[i] - unit[k]
        for u, sign in members:
            row[M + K + u] += sign
    inverse = np.hstack([np.eye(M), np.zeros((M, K + U))])
    wanted = np.vstack([rows, terms])
    nothing = np.zeros_like(inverse)
    bounds = np.vstack(
        [
            np.hstack([np.minimum(wanted, 0), np.maximum(wanted, 0)]),
            np.hstack([nothing, -inverse]),
            np.hstack([-inverse, nothing]),
        ]
    )
    above, below = np.maximum(e, 0), np.maximum(-e, 0)
    return Table(e, above, np.abs(e).sum(1, keepdims=True) + 1, pairs, terms, sizes, bounds, np.hstack([above, below]))


def _ratio(
    rest: np.ndarray, first_order: tuple[bool, ...], found: dict[tuple[int, int], int]
) -> tuple[np.ndarray, list[tuple[int, float]]]:
    """Exponents of |P_i/P_k| without its monotone pairs, and the pairs: number in `found`, and sign."""
    top = [m for m, first in enumerate(first_order) if first for _ in range(int(rest[m]))]
    bottom = [m for m, first in enumerate(first_order) if first for _ in range(int(-rest[m]))]
    left, members = rest.copy(), []
    for m, n in zip(top, bottom, strict=False):
        left[m] -= 1
        left[n] += 1
        sign = 1.0 if m < n else -1.0
        members.append((found.setdefault((min(m, n), max(m, n)), len(found)), sign))
    return left, members
