"""Rational functions with dead time as products of real factors a s^2 + b s + c.

    F(s) = gain prod_i (a_i s^2 + b_i s + c_i) / prod_j (a_j s^2 + b_j s + c_j) e^{-theta s}

Plants, controllers and loops all take this shape on their way into the engine. Products are never
multiplied out: an order-8 polynomial has lost its small time constants to rounding, its factors have not.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import zip_longest

import numpy as np
from numpy.typing import ArrayLike

Row = tuple[float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Factored:
    """F(s) of the module docstring. num, den: arrays of shape (m, 3), rows (a, b, c)."""

    gain: float
    num: np.ndarray
    den: np.ndarray
    theta: float = 0.0

    def __mul__(self, other: "Factored") -> "Factored":
        """Series connection; the dead times add."""
        return Factored(
            self.gain * other.gain,
            np.concatenate([self.num, other.num]),
            np.concatenate([self.den, other.den]),
            self.theta + other.theta,
        )

    def __call__(self, s: ArrayLike) -> np.ndarray:
        """F(s), complex, shape of s. On a pole the value is infinite, without a warning."""
        s = np.asarray(s, dtype=complex)
        value = np.full(s.shape, complex(self.gain))
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            # a numerator and a denominator factor in turn, so that no partial product overflows
            for above, below in zip_longest(self.num.tolist(), self.den.tolist()):
                if above:
                    value *= _factor(above, s)
                if below:
                    value /= _factor(below, s)
            if self.theta:
                value *= np.exp(-self.theta * s)
        return value[()]

    @property
    def poles(self) -> np.ndarray:
        """Poles, complex, with multiplicity."""
        return np.array(roots_of(self.den.tolist()), dtype=complex)

    @property
    def zeros(self) -> np.ndarray:
        """Zeros, complex, with multiplicity."""
        return np.array(roots_of(self.num.tolist()), dtype=complex)

    @property
    def relative_degree(self) -> int:
        """Degree of the denominator minus degree of the numerator."""
        return degree(self.den.tolist()) - degree(self.num.tolist())


def factors(*rows: tuple[float, float, float]) -> np.ndarray:
    """Rows (a, b, c) as an array of shape (m, 3); factors equal to 1 are left out."""
    kept = [row for row in rows if row != (0.0, 0.0, 1.0)]
    return np.array(kept, dtype=float).reshape(-1, 3)


def _factor(row: Sequence[float], s: np.ndarray) -> np.ndarray:
    a, b, c = row
    if a:
        return (a * s + b) * s + c
    return b * s + c if c else b * s


def rows_of(array: np.ndarray) -> list[Row]:
    """Rows as tuples; s (a s + b) is taken apart, so that every zero at the origin is a factor of its own."""
    rows: list[Row] = []
    for a, b, c in array.tolist():
        if a and c == 0:
            rows += [(0.0, 1.0, 0.0), (0.0, a, b)]
        else:
            rows.append((a, b, c))
    return rows


def without_common(one: Sequence[Row], other: Sequence[Row]) -> tuple[list[Row], list[Row], list[Row]]:
    """Both without the rows they share, and these."""
    kept, left, common = [], list(other), []
    for row in one:
        if row in left:
            left.remove(row)
            common.append(row)
        else:
            kept.append(row)
    return kept, left, common


def degree(rows: Iterable[Row]) -> int:
    """Degree of the product."""
    return sum([2 if a else 1 if b else 0 for a, b, _ in rows])


def roots_of(rows: Iterable[Row]) -> list[complex]:
    """Roots of the product, with multiplicity."""
    found: list[complex] = []
    for a, b, c in rows:
        if a:
            found += quadratic_roots(a, b, c)
        elif b:
            found.append(complex(-c / b))
    return found


def product(gain: float, top: Sequence[float], bottom: Sequence[float]) -> float:
    """gain prod(top)/prod(bottom) of nonzero numbers; 1e304 or 1e-304 where it would be beyond these."""
    above, below = math.prod(top, start=gain), math.prod(bottom)
    if 1e-150 < abs(above) < 1e150 and 1e-150 < abs(below) < 1e150:
        return above / below
    log = log_product(gain, top, bottom)
    negative = sum(x < 0 for x in (gain, *top, *bottom)) % 2
    return math.exp(min(max(log, -700.0), 700.0)) * (-1.0 if negative else 1.0)


def log_product(gain: float, top: Sequence[float], bottom: Sequence[float]) -> float:
    """log|gain prod(top)/prod(bottom)|."""
    logs = [math.log(abs(x)) for x in (gain, *top)] + [-math.log(abs(x)) for x in bottom]
    return math.fsum(logs)


def quadratic_roots(a: float, b: float, c: float) -> tuple[complex, complex]:
    """Roots of a s^2 + b s + c without cancellation (Goldberg 1991)."""
    scaled = b * b - 4 * a * c
    if scaled < 0:
        half = complex(-b / (2 * a), math.sqrt(-scaled) / (2 * a))
        return half, half.conjugate()
    q = -0.5 * (b + math.copysign(math.sqrt(scaled), b))
    return (complex(q / a), complex(c / q)) if q else (0j, 0j)
