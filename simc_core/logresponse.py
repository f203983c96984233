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
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Protocol

import numpy as np

from simc_core.factors import Factored, degree, product, roots_of, rows_of, without_common

Logs = tuple[np.ndarray, np.ndarray, np.ndarray]  # log L, first and second derivative in omega

ONE = (0.0, 0.0, 1.0)
LEAST = 1e-20  # 2 zeta of an undamped pair, less than rounding, so that no frequency is exactly its own
LARGEST = 600.0  # of log|L| where S and T are wanted


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
    roots: list[complex]
    at_zero: Asymptote
    at_infinity: Asymptote

    def log_derivatives(self, omega: np.ndarray) -> Logs: ...


class FactoredResponse:
    """A Factored as a Response."""

    def __init__(self, L: Factored):
        num, den, _ = without_common(rows_of(L.num), rows_of(L.den))
        self.theta = L.theta
        self.roots = [root for root in roots_of(num + den) if root]
        origin = [c for _, _, c in num].count(0.0) - [c for _, _, c in den].count(0.0)
        self.at_zero = Asymptote(product(L.gain, [c or b for _, b, c in num], [c or b for _, b, c in den]), origin)
        leading = product(L.gain, [a or b or c for a, b, c in num], [a or b or c for a, b, c in den])
        self.at_infinity = Asymptote(leading, degree(num) - degree(den))
        self.gain, self.num, self.den = L.gain, num, den

    @cached_property
    def _alone(self) -> "Together":
        return Together([self])

    def log_derivatives(self, omega: np.ndarray) -> Logs:
        """See Response."""
        return self._alone.log_derivatives(omega)


class Together:
    """Several FactoredResponses, evaluated together. Lists of different length are filled up with factors 1."""

    def __init__(self, responses: Sequence[FactoredResponse]):
        top = max(len(response.num) for response in responses)
        bottom = max(len(response.den) for response in responses)
        rows = [[*r.num, *[ONE] * (top - len(r.num)), *r.den, *[ONE] * (bottom - len(r.den))] for r in responses]
        self.a, self.b, self.c = np.ascontiguousarray(np.array(rows).reshape(len(rows), -1, 3).T)  # (M, n) each
        self.signs = np.array([1.0] * top + [-1.0] * bottom, dtype=complex)
        self.bends = any(a for row in rows for a, _, _ in row)
        if self.bends:
            undamped = (self.a != 0) & (self.b == 0)
            self.b[undamped] = LEAST * np.sqrt(np.abs(self.a * self.c))[undamped]
        self.delays = np.array([1j * response.theta for response in responses])
        self.sizes = np.array([complex(math.log(abs(r.gain)), -math.pi if r.gain < 0 else 0.0) for r in responses])

    def log_derivatives(self, omega: np.ndarray, owner: np.ndarray | None = None) -> Logs:
        """As in Response, of the response owner[i] at omega[i]; with one response owner does not matter."""
        a, b, c, size, delay = self.a, self.b, self.c, self.sizes, self.delays
        if size.size > 1:
            b, c, size, delay = b[:, owner], c[:, owner], size[owner], delay[owner]
            a = a[:, owner] if self.bends else a
        q, parts = np.empty((len(a), omega.size), dtype=complex), np.empty((3, len(a), omega.size), dtype=complex)
        q.real, q.imag = c - a * (omega * omega) if self.bends else c, b * omega
        inverse = 1 / q
        parts[0].real, parts[0].imag = np.log(np.abs(q)), np.arctan2(q.imag, q.real)
        np.multiply(1j * b - 2 * a * omega if self.bends else 1j * b, inverse, out=parts[1])
        np.multiply(parts[1], parts[1], out=parts[2])
        if self.bends:
            parts[2] += 2 * a * inverse
        logs = self.signs @ parts
        logs[0] += size - delay * omega
        logs[1] -= delay
        return logs[0], logs[1], -logs[2]


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
    def roots(self) -> list[complex]:
        """Roots of L and the poles of T."""
        return [*self.inner.roots, *self.poles.tolist()]

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

    def log_derivatives(self, omega: np.ndarray) -> Logs:
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
    def roots(self) -> list[complex]:
        """Those of both."""
        return [*self.one.roots, *self.other.roots]

    @property
    def at_zero(self) -> Asymptote:
        """Product of both."""
        return _product(self.one.at_zero, self.other.at_zero)

    @property
    def at_infinity(self) -> Asymptote:
        """Product of both."""
        return _product(self.one.at_infinity, self.other.at_infinity)

    def log_derivatives(self, omega: np.ndarray) -> Logs:
        """See Response."""
        one, other = self.one.log_derivatives(omega), self.other.log_derivatives(omega)
        return one[0] + other[0], one[1] + other[1], one[2] + other[2]


def sensitivities(log: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """S and T from log L, also where L overflows."""
    if np.maximum.reduce(log.real, initial=0.0) > LARGEST:
        log = np.minimum(log.real, LARGEST) + 1j * log.imag
    L = np.exp(log)
    S = 1 / (1 + L)
    return S, L * S


def _product(one: Asymptote, other: Asymptote) -> Asymptote:
    return Asymptote(one.gain * other.gain, one.power + other.power)
