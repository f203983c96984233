"""Tables for bounding sums of products P_k = prod_m |q_m|^{e_km} from their factors on a segment of the axis.

On a segment each |q_m| lies between lo_m and hi_m, which gives bounds of P_k that are as loose as there are factors.
Ratios |P_i/P_k| matter more: where |L| tends to a limit near 1 only close bounds tell on which side it is. With
x = omega^2 a ratio of two real factors,

    (b^2 x + c^2)/(b'^2 x + c'^2),

is monotone in x: its extremes are at the ends. So factors of degree 1 above and below are taken in pairs, and what
is left over, and pairs of complex roots, by lo and hi.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np


@dataclass(frozen=True, slots=True, eq=False)
class Ratios:
    """Bounds of log|P_i/P_k| for the R ordered pairs i != k of K products of M factors.

    pairs (U, M): +1 and -1 of the two factors of each monotone pair.   members (R, U): pairs in each ratio, signed.
    above, below (R, M): exponents of what is left over, positive and negative part.
    difference (R, K): +1 at i, -1 at k.   by_lower (K, R): 1 where k is the P_k of the ratio.
    """

    pairs: np.ndarray
    members: np.ndarray
    above: np.ndarray
    below: np.ndarray
    difference: np.ndarray
    by_lower: np.ndarray

    def largest(self, logs: np.ndarray, low: np.ndarray, high: np.ndarray, gains: np.ndarray) -> np.ndarray:
        """Bound of sum_{i != k} |P_i/P_k| for each k, shape (K, segments); gains: log|g_k|, low, high: of log|q_m|."""
        bound = self.above @ high - self.below @ low + self.difference @ gains
        if self.pairs.size:
            at = self.pairs @ logs
            left, right = at[:, :-1], at[:, 1:]
            half = len(bound) // 2
            bound[:half] += self.members @ np.maximum(left, right)
            bound[half:] -= self.members @ np.minimum(left, right)
        return self.by_lower @ np.exp(np.minimum(bound, 99.0))


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """exponents (K, M), their positive and negative parts, |exponents|, and counts (K, 1): number of factors."""

    exponents: np.ndarray
    above: np.ndarray
    below: np.ndarray
    sizes: np.ndarray
    counts: np.ndarray
    ratios: Ratios


@lru_cache(maxsize=64)
def table(exponents: tuple[tuple[int, ...], ...], first_order: tuple[bool, ...]) -> Table:
    """exponents: K rows of M.   first_order: which of the M factors are of degree 1. No number of the loop is in it."""
    e = np.array(exponents, dtype=float).reshape(len(exponents), len(first_order))
    size = np.abs(e)
    return Table(e, np.maximum(e, 0), np.maximum(-e, 0), size, size.sum(1, keepdims=True), _ratios(e, first_order))


def _ratios(e: np.ndarray, first_order: tuple[bool, ...]) -> Ratios:
    K, M = e.shape
    couples = list(combinations(range(K), 2))
    pairs, owners, left = [], [], []
    for number, (k, i) in enumerate(couples):
        rest = e[i] - e[k]
        top = [m for m in range(M) if first_order[m] for _ in range(int(rest[m]))]
        bottom = [m for m in range(M) if first_order[m] for _ in range(int(-rest[m]))]
        for m, n in zip(top, bottom, strict=False):
            row = np.zeros(M)
            row[m], row[n] = 1.0, -1.0
            rest = rest - row
            pairs.append(row)
            owners.append(number)
        left.append(rest)
    members = np.zeros((len(couples), len(pairs)))
    members[owners, range(len(pairs))] = 1.0
    left = np.array(left).reshape(len(couples), M)
    left = np.concatenate([left, -left])
    upper = np.array([*((i, k) for k, i in couples), *couples]).reshape(-1, 2)
    unit = np.eye(K)
    return Ratios(
        np.array(pairs).reshape(len(pairs), M),
        members,
        np.maximum(left, 0),
        np.maximum(-left, 0),
        unit[upper[:, 0]] - unit[upper[:, 1]],
        unit[:, upper[:, 1]],
    )
