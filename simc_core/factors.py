"""Rational functions with dead time as products of real factors a s^2 + b s + c.

    F(s) = gain prod_i (a_i s^2 + b_i s + c_i) / prod_j (a_j s^2 + b_j s + c_j) e^{-theta s}

Plants, controllers and loops all take this shape on their way into the engine. Products are never
multiplied out: an order-8 polynomial has lost its small time constants to rounding, its factors have not.
"""

from dataclasses import dataclass

import numpy as np


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

    def __call__(self, s) -> np.ndarray:
        """F(s), complex, shape of s. On a pole the value is infinite, without a warning."""
        s = np.asarray(s, dtype=complex)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            value = np.full(s.shape, complex(self.gain))
            # a numerator and a denominator factor in turn, so that no partial product overflows
            for i in range(max(len(self.num), len(self.den))):
                if i < len(self.num):
                    value = value * _factor(self.num[i], s)
                if i < len(self.den):
                    value = value / _factor(self.den[i], s)
            return value * np.exp(-self.theta * s) if self.theta else value

    @property
    def poles(self) -> np.ndarray:
        """Poles, complex, with multiplicity."""
        return _roots(self.den)

    @property
    def zeros(self) -> np.ndarray:
        """Zeros, complex, with multiplicity."""
        return _roots(self.num)

    @property
    def relative_degree(self) -> int:
        """Degree of the denominator minus degree of the numerator."""
        return _degree(self.den) - _degree(self.num)


def factors(*rows: tuple[float, float, float]) -> np.ndarray:
    """Rows (a, b, c) as an array of shape (m, 3); factors equal to 1 are left out."""
    kept = [row for row in rows if row != (0.0, 0.0, 1.0)]
    return np.array(kept, dtype=float).reshape(-1, 3)


def _factor(row: np.ndarray, s: np.ndarray) -> np.ndarray:
    a, b, c = row
    return (a * s + b) * s + c if a else b * s + c


def _degree(rows: np.ndarray) -> int:
    return int(sum(2 if a else 1 if b else 0 for a, b, _ in rows))


def _roots(rows: np.ndarray) -> np.ndarray:
    found: list[complex] = []
    for a, b, c in rows:
        if a:
            found.extend(quadratic_roots(a, b, c))
        elif b:
            found.append(complex(-c / b))
    return np.array(found, dtype=complex)


def quadratic_roots(a: float, b: float, c: float) -> tuple[complex, complex]:
    """Roots of a s^2 + b s + c without cancellation (Goldberg 1991)."""
    scaled = b * b - 4 * a * c
    if scaled < 0:
        half = complex(-b / (2 * a), np.sqrt(-scaled) / (2 * a))
        return half, half.conjugate()
    q = -0.5 * (b + np.copysign(np.sqrt(scaled), b))
    return (complex(q / a), complex(c / q)) if q else (0j, 0j)
