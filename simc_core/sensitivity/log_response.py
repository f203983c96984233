"""log L(j omega) with its derivatives in closed form: what the search for margins and peaks lives on.

With zeros and poles r, L = c prod(s - r)/prod(s - r) e^{-theta s}; for each of them, with s = j omega,

    log(s - r) = log|omega + j r| + j atan2(omega - Im r, -Re r)
    d/d omega log(s - r) = 1/(omega + j r),       d^2/d omega^2 log(s - r) = -1/(omega + j r)^2

and log L is their sum, zeros +, poles -, with log c - j theta omega. Where a root in the right half plane is passed its
argument jumps by 2 pi, which is no change; otherwise it is continuous.

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

from simc_core.algebra.factors import Factored, log_product, product, roots_of, rows_of, without_common

Logs = tuple[np.ndarray, np.ndarray, np.ndarray]  # log L, first and second derivative in omega

LEAST = 1e-20  # zeta of an undamped pair, less than rounding, so that no frequency is exactly its own
LARGEST_LOG_L = 600.0  # of log|L| where S and T are wanted


class Asymptote(NamedTuple):
    """gain s^power, the end of a transfer function (times e^{-theta s} at infinity)."""

    gain: float
    power: int


class Ends(Protocol):
    """The ends of a loop transfer function, at s = 0 and at infinity.   theta: its dead time."""

    @property
    def theta(self) -> float: ...
    @property
    def at_zero(self) -> Asymptote: ...
    @property
    def at_infinity(self) -> Asymptote: ...


class Response(Ends, Protocol):
    """A loop transfer function as the search sees it.

    log_derivatives(omega): log L, and its first and second derivative in omega, complex, shape of omega.
    The imaginary part of log L may be on any branch.   theta: dead time, what turns the phase at high frequency.
    roots: poles and zeros other than 0, and whatever else makes |L| or arg L bend; a rough value is enough.
    """

    @property
    def roots(self) -> list[complex]: ...

    def log_derivatives(self, omega: np.ndarray) -> Logs: ...


class FactoredResponse:
    """A Factored as a Response."""

    def __init__(self, L: Factored):
        num, den, _ = without_common(rows_of(L.num), rows_of(L.den))
        self.theta = L.theta
        self.zeros, self.poles = roots_of(num), roots_of(den)
        self.roots = [root for root in self.zeros + self.poles if root]
        origin = self.zeros.count(0) - self.poles.count(0)
        self.at_zero = Asymptote(product(L.gain, [c or b for _, b, c in num], [c or b for _, b, c in den]), origin)
        top, bottom = [a or b or c for a, b, c in num], [a or b or c for a, b, c in den]
        leading = product(L.gain, top, bottom)
        self.at_infinity = Asymptote(leading, len(self.zeros) - len(self.poles))
        size = math.log(abs(leading)) if 1e-300 < abs(leading) < 1e300 else log_product(L.gain, top, bottom)
        self.log_leading = complex(size, -math.pi if leading < 0 else 0.0)

    @cached_property
    def _alone(self) -> "ResponseBatch":
        return ResponseBatch([self])

    def log_derivatives(self, omega: np.ndarray) -> Logs:
        """See Response."""
        return self._alone.log_derivatives(omega)


class ResponseBatch:
    """Several FactoredResponses with as many zeros and as many poles each, evaluated together."""

    def __init__(self, responses: Sequence[FactoredResponse]):
        self.signs = np.array([1] * len(responses[0].zeros) + [-1] * len(responses[0].poles), dtype=complex)
        roots = [[root if root.real or not root else damped(root) for root in r.zeros + r.poles] for r in responses]
        self.roots = np.array(roots, dtype=complex).T  # (M, n)
        self.delays = np.array([1j * response.theta for response in responses])
        self.constants = np.array([response.log_leading for response in responses])

    def log_derivatives(self, omega: np.ndarray, owner: np.ndarray | None = None) -> Logs:
        """As in Response, of the response owner[i] at omega[i]; with one response owner does not matter."""
        roots, constant, delay = self.roots, self.constants, self.delays
        if delay.size > 1:
            roots, constant, delay = roots[:, owner], constant[owner], delay[owner]
        from_root = omega + 1j * roots
        parts = np.empty((3, *from_root.shape), dtype=complex)
        parts[0].real = np.log(np.abs(from_root))
        parts[0].imag = np.arctan2(from_root.real, -roots.real)
        np.divide(1, from_root, out=parts[1])
        np.multiply(parts[1], parts[1], out=parts[2])
        log, first, second = self.signs @ parts
        return log + (constant - delay * omega), first - delay, -second


def damped(root: complex) -> complex:
    """An undamped root, next to the imaginary axis on the left."""
    return complex(-LEAST * abs(root), root.imag)


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
    if np.maximum.reduce(log.real, initial=0.0) > LARGEST_LOG_L:
        log = np.minimum(log.real, LARGEST_LOG_L) + 1j * log.imag
    L = np.exp(log)
    S = 1 / (1 + L)
    return S, L * S


def _product(one: Asymptote, other: Asymptote) -> Asymptote:
    return Asymptote(one.gain * other.gain, one.power + other.power)
