"""Laurent series at s = 0, cut off after TERMS terms: c_0 s^v + c_1 s^(v+1) + ...

The first coefficients of a controller, of a closed loop, of whatever is made of plants, exactly: quotients of series,
no differences.
"""

import math
from dataclasses import dataclass

import numpy as np

from simc_core.algebra.factors import Factored

TERMS = 16


@dataclass(frozen=True, slots=True, eq=False)
class Laurent:
    """s^valuation (c[0] + c[1] s + ...), c of shape (TERMS,), c[0] != 0."""

    valuation: int
    c: np.ndarray

    def __mul__(self, other: "Laurent") -> "Laurent":
        return Laurent(self.valuation + other.valuation, np.convolve(self.c, other.c)[:TERMS])

    def inverse(self) -> "Laurent":
        """1/self, term by term."""
        found = np.zeros(TERMS)
        found[0] = 1 / self.c[0]
        for i in range(1, TERMS):
            found[i] = -found[0] * (self.c[1 : i + 1] @ found[i - 1 :: -1])
        return Laurent(-self.valuation, found)

    def closed(self) -> "Laurent":
        """L/(1 + L) for L with integral action or a finite gain at s = 0."""
        inverse = self.inverse()
        sum_ = np.zeros(TERMS)
        sum_[inverse.valuation :] = inverse.c[: TERMS - inverse.valuation]
        sum_[0] += 1.0
        return Laurent(0, sum_).inverse()


def polynomial(coefficients: np.ndarray) -> Laurent:
    """Ascending powers of s, not all zero."""
    valuation = int(np.flatnonzero(coefficients)[0])
    c = np.zeros(TERMS)
    kept = np.asarray(coefficients, dtype=float)[valuation : valuation + TERMS]
    c[: len(kept)] = kept
    return Laurent(valuation, c)


def exponential(tau: float) -> Laurent:
    """e^{tau s}."""
    return Laurent(0, np.array([tau**i / math.factorial(i) for i in range(TERMS)]))


def expansion(F: Factored) -> Laurent:
    """F with its dead time."""
    top, bottom = polynomial(np.array([F.gain])) * exponential(-F.theta), polynomial(np.ones(1))
    for row in F.num:
        top = top * polynomial(row[::-1])
    for row in F.den:
        bottom = bottom * polynomial(row[::-1])
    return top * bottom.inverse()
