"""log L(j omega) with its derivatives in closed form: what the search for margins and peaks lives on.

For a product of factors q(s) = a s^2 + b s + c, with s = j omega,

    log L = log|gain| + sum log|q| + j (sum atan2(Im q, Re q) - theta omega) ...     numerator +, denominator -
    d/d omega log q = j q'/q,       d^2/d omega^2 log q = (q'/q)^2 - 2 a/q.

The argument is continuous in omega as it stands: Im q = b omega never changes sign. Nothing is unwrapped.
A closed inner loop T = L/(1 + L) has log T = -log(1 + 1/L), and with S = 1 - T

    (log T)' = S (log L)',          (log T)'' = S (log L)'' - T S (log L)'^2.

`Response` is all that the search asks of a loop transfer function; `Series` and `Closed` build the outer
loop of a cascade, Ca Ga Tb, or of more nested loops: Series(FactoredResponse(Ca Ga), Closed(FactoredResponse(Lb))).
"""

import math
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from simc_core.factors import Factored, degree, product, roots_of, rows_of, without_common


class Asymptote(NamedTuple):
    """gain s^power, the end of a transfer function (times e^{-theta s} at infinity)."""

    gain: float
    power: int


class Response(Protocol):
    """A loop transfer function as the search sees it.

    log_derivatives(omega): log L, and its first and second derivative in omega, complex, shape of omega.
    The imaginary part of log L may be on any branch.   theta: dead time, what turns the phase at high frequency.
    roots: poles and zeros other than 0, and whatever else makes |L| or arg L bend; a rough value is enough.
    """

    theta: float
    roots: np.ndarray
    at_zero: Asymptote
    at_infinity: Asymptote

    def log_derivatives(self, omega: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]: ...


class FactoredResponse:
    """A Factored as a Response."""

    def __init__(self, L: Factored):
        num, den, _ = without_common(rows_of(L.num), rows_of(L.den))
        self.theta = L.theta
        self.roots = np.array([root for root in roots_of(num + den) if root], dtype=complex)
        origin = sum(c == 0 for *_, c in num) - sum(c == 0 for *_, c in den)
        self.at_zero = Asymptote(product(L.gain, [c or b for _, b, c in num], [c or b for _, b, c in den]), origin)
        leading = product(L.gain, [a or b or c for a, b, c in num], [a or b or c for a, b, c in den])
        self.at_infinity = Asymptote(leading, degree(num) - degree(den))
        self._rows = np.array([*num, *den]).reshape(-1, 3)
        self._signs = np.array([1.0] * len(num) + [-1.0] * len(den))
        self._gain = complex(math.log(abs(L.gain)), -math.pi if L.gain < 0 else 0.0)

    def log_derivatives(self, omega: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """See Response."""
        a, b, c = self._rows.T[:, :, None]
        q = (c - a * omega**2) + 1j * (b * omega)
        slope = (b + 2j * a * omega) / q
        log = self._signs @ np.log(q) + self._gain - 1j * self.theta * omega
        return log, 1j * (self._signs @ slope) - 1j * self.theta, self._signs @ (slope**2 - 2 * a / q)


@dataclass(frozen=True, slots=True, eq=False)
class Closed:
    """T = L/(1 + L) of a stable inner loop. poles: its dominant closed-loop poles, where resonances sit."""

    inner: Response
    poles: np.ndarray

    @property
    def theta(self) -> float:
        """Dead time of T."""
        return self.inner.theta

    @property
    def roots(self) -> np.ndarray:
        """Roots of L and the poles of T."""
        return np.concatenate([self.inner.roots, self.poles])

    @property
    def at_zero(self) -> Asymptote:
        """T ~ L where L is small at s = 0, 1 where it is infinite."""
        gain, power = self.inner.at_zero
        if power:
            return Asymptote(1.0, 0) if power < 0 else self.inner.at_zero
        return Asymptote(gain / (1 + gain), 0)

    @property
    def at_infinity(self) -> Asymptote:
        """T ~ L at infinity (for a neutral inner loop, what it swings about)."""
        gain, power = self.inner.at_infinity
        return Asymptote(gain / (1 + gain), 0) if power == 0 and self.theta == 0 else self.inner.at_infinity

    def log_derivatives(self, omega: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """See Response; the argument is a principal value."""
        log, first, second = self.inner.log_derivatives(omega)
        S, T = sensitivities(log)
        return np.log(T), S * first, S * (second - T * first**2)


@dataclass(frozen=True, slots=True, eq=False)
class Series:
    """The product of two responses."""

    one: Response
    other: Response

    @property
    def theta(self) -> float:
        """Dead times add."""
        return self.one.theta + self.other.theta

    @property
    def roots(self) -> np.ndarray:
        """Those of both."""
        return np.concatenate([self.one.roots, self.other.roots])

    @property
    def at_zero(self) -> Asymptote:
        """Product of both."""
        return _product(self.one.at_zero, self.other.at_zero)

    @property
    def at_infinity(self) -> Asymptote:
        """Product of both."""
        return _product(self.one.at_infinity, self.other.at_infinity)

    def log_derivatives(self, omega: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """See Response."""
        one, other = self.one.log_derivatives(omega), self.other.log_derivatives(omega)
        return one[0] + other[0], one[1] + other[1], one[2] + other[2]


def sensitivities(log: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """S and T from log L, without overflow and without cancellation for large or small |L|."""
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        big = log.real > 0
        x = np.exp(np.where(big, -log, log))
        inverse = 1 / (1 + x)
        return np.where(big, x * inverse, inverse), np.where(big, inverse, x * inverse)


def _product(one: Asymptote, other: Asymptote) -> Asymptote:
    return Asymptote(one.gain * other.gain, one.power + other.power)
