"""How often f = sum_k P_k winds around the origin along the imaginary axis, certified segment by segment.

A segment [a, b] of the axis counts only when one of two closed-form tests holds, else it is split:

    short       K (b - a) < |f(a)| + |f(b)|, K a bound of |f'| on the segment: a curve that short cannot go round the
                origin between its ends, so arg f(b)/f(a) in (-pi, pi] is its change of argument;
    dominated   |P_k| > sum of the other |P_i| on all of the segment: f/P_k stays in the right half plane around 1,
                and the argument of P_k is a sum of arctangents minus theta omega.

The bounds need no more than the ends. With x = omega^2, |a s^2 + b s + c|^2 is a parabola in x that opens upwards:
its largest value is at an end, its smallest at an end or at x = (2 a c - b^2)/(2 a^2). |2 a s + b| grows with omega.

Beyond the last frequency, f differs from its limit by less than the limit: closed form again, from the largest root.
Zeros in the right half plane: -1/pi times the change of arg f over 0..inf. A point where f is zero within
rounding is a zero on the axis.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.characteristic import Characteristic, limit_at_infinity, log_leading
from simc_core.errors import InvalidParameter
from simc_core.factors import Factored

MOST_SEGMENTS = 60_000  # about 0.2 s; a usual loop needs 100 to 300
MOST_PIECES = 16  # of one segment in one pass
GRID_PER_DECADE = 6
ROUNDING = 4 * np.finfo(float).eps  # of one factor, generously
SHORTEST = 16 * np.finfo(float).eps  # relative length of a segment that no double lies inside


@dataclass(frozen=True, slots=True)
class Winding:
    """zeros: number in the open right half plane; None where f vanishes on the axis, at omega = `touches`."""

    zeros: int | None
    touches: float | None = None


def winding(f: Characteristic) -> Winding:
    """Zeros of f in the right half plane. Raises InvalidParameter where the work would exceed MOST_SEGMENTS."""
    last = _last_frequency(f)
    a = np.concatenate([[0.0], _grid(f.terms, last)])
    a, b = a[:-1], a[1:]
    turned, work = 0.0, 0
    while a.size:
        work += a.size
        if work > MOST_SEGMENTS:
            raise InvalidParameter(
                f"the stability certificate must need <= {MOST_SEGMENTS} segments, got {work}: "
                f"the loop is too close to |L(inf)| = 1 (here {f.neutral:g}) or its time constants are too far apart"
            )
        segments = _Segments(f.terms, a, b)
        zero = segments.zero()
        if zero is not None:
            return Winding(None, zero)
        change, certain = segments.change()
        turned += math.fsum(change[certain])
        a, b = _split(a[~certain], b[~certain], segments.excess[~certain])
    end = sum(term(1j * last) for term in f.terms)
    turned -= float(np.angle(end / f.limit))
    return Winding(round(-turned / math.pi))


class _Segments:
    """f and its bounds on segments [a, b] of the positive imaginary axis."""

    def __init__(self, terms: Sequence[Factored], a: np.ndarray, b: np.ndarray):
        self.a, self.b = a, b
        parts = [_Term(term, a, b) for term in terms]
        self.parts = parts
        self.fa = sum(part.at_a for part in parts)
        self.fb = sum(part.at_b for part in parts)
        self.noise = sum(part.noise for part in parts)
        slope = sum(part.slope for part in parts)
        room = np.abs(self.fa) + np.abs(self.fb) - 2 * self.noise
        with np.errstate(over="ignore"):  # no room: infinite, and split into MOST_PIECES
            self.excess = slope * (b - a) / np.maximum(room, np.finfo(float).tiny)

    def zero(self) -> float | None:
        """A frequency where f is zero within rounding."""
        at_end = np.abs(self.fb) <= self.noise
        if at_end.any():
            return float(self.b[at_end][0])
        if self.a[0] == 0 and abs(self.fa[0]) <= self.noise[0]:
            return 0.0
        cramped = (self.excess >= 1) & (self.b - self.a <= SHORTEST * self.b)
        return float(self.b[cramped][0]) if cramped.any() else None

    def change(self) -> tuple[np.ndarray, np.ndarray]:
        """Change of arg f on each segment, and where it is certain."""
        certain = self.excess < 1
        change = np.angle(self.fb * np.conj(self.fa))
        for part in self.parts:
            others = sum(other.largest for other in self.parts if other is not part)
            dominated = (part.smallest > others * (1 + 1e-9)) & ~certain
            if dominated.any():
                change[dominated] = part.turn(dominated, self.fa, self.fb)
                certain |= dominated
        return change, certain


class _Term:
    """One P_k at the ends of the segments, and its bounds on them."""

    def __init__(self, term: Factored, a: np.ndarray, b: np.ndarray):
        self.term, self.a, self.b = term, a, b
        n = a.size
        omega = np.concatenate([a, b])
        top, bottom = _values(term.num, omega), _values(term.den, omega)
        values = term.gain * _quotient(top, bottom) * np.exp(-1j * term.theta * omega)
        self.at_a, self.at_b = values[:n], values[n:]
        size_top, size_bottom = np.abs(top), np.abs(bottom)
        top_high = np.maximum(size_top[:, :n], size_top[:, n:])
        bottom_low, bottom_high = size_bottom[:, :n], size_bottom[:, n:]
        gain = math.log(abs(term.gain))
        with np.errstate(divide="ignore"):
            self.largest = np.exp(gain + np.log(top_high).sum(0) - np.log(bottom_low).sum(0))
            top_low = np.minimum(np.minimum(size_top[:, :n], size_top[:, n:]), _inner_minimum(term.num, a, b))
            self.smallest = np.exp(gain + np.log(top_low).sum(0) - np.log(bottom_high).sum(0))
        rate = (_slopes(term.num, b) / top_high).sum(0) + (_slopes(term.den, b) / bottom_low).sum(0)
        self.slope = self.largest * (rate + term.theta)
        roundings = len(top) + len(bottom) + 1 + term.theta * b
        sizes = np.exp(gain + np.log(_sizes(term.num, b)).sum(0) - np.log(bottom_low).sum(0))
        self.noise = ROUNDING * roundings * np.minimum(sizes, np.finfo(float).max)

    def turn(self, where: np.ndarray, fa: np.ndarray, fb: np.ndarray) -> np.ndarray:
        """Change of arg f on the segments `where` this term dominates."""
        a, b = self.a[where], self.b[where]
        own = _argument(self.term, b) - _argument(self.term, a)
        return own + np.angle(fb[where] / self.at_b[where]) - np.angle(fa[where] / self.at_a[where])


def _values(rows: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """a s^2 + b s + c at s = j omega, shape (factors, frequencies).

    At omega = 0 the imaginary part keeps the sign of b, so that the argument there is the limit from above.
    """
    a, b, c = rows.T[:, :, None]
    value = np.empty((len(rows), omega.size), dtype=complex)
    value.real, value.imag = c - a * omega**2, b * omega
    return value


def _quotient(top: np.ndarray, bottom: np.ndarray) -> np.ndarray:
    """Product of `top` over product of `bottom`; powers of two are kept apart, so nothing overflows."""
    value, exponent = _mantissas(top)
    under, less = _mantissas(bottom)
    value, power = value / under, np.clip(exponent - less, -1000, 1000)
    return np.ldexp(value.real, power) + 1j * np.ldexp(value.imag, power)


def _mantissas(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    _, exponents = np.frexp(np.maximum(np.abs(values.real), np.abs(values.imag)))
    scaled = np.ldexp(values.real, -exponents) + 1j * np.ldexp(values.imag, -exponents)
    return np.prod(scaled, axis=0), exponents.sum(0)


def _slopes(rows: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """|d/ds| of each factor, a growing function of omega."""
    a, b, _ = rows.T[:, :, None]
    return np.hypot(2 * a * omega, b)


def _sizes(rows: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """What the rounding error of each factor is relative to: its size without the cancellation in c - a omega^2."""
    a, b, c = np.abs(rows).T[:, :, None]
    return np.hypot(c + a * omega**2, b * omega)


def _inner_minimum(rows: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Smallest |factor| strictly inside [low, high]; inf where it is at an end."""
    a, b, c = rows.T[:, :, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        x = np.where(a != 0, (2 * a * c - b * b) / (2 * a * a), -1.0)
        inside = (x > low**2) & (x < high**2)
        return np.where(inside, np.abs(b) * np.sqrt(np.abs(c / a - (b / (2 * a)) ** 2)), np.inf)


def _argument(term: Factored, omega: np.ndarray) -> np.ndarray:
    """Continuous argument of P_k along a piece of the axis without zeros or poles."""
    top, bottom = _values(term.num, omega), _values(term.den, omega)
    return np.angle(top).sum(0) - np.angle(bottom).sum(0) - term.theta * omega


def _split(a: np.ndarray, b: np.ndarray, excess: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Each segment in 2 to MOST_PIECES parts; geometric where it spans more than a factor 2."""
    pieces = np.clip(np.ceil(excess), 2, MOST_PIECES).astype(int)
    index = np.arange(pieces.sum()) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    a, b, pieces = np.repeat(a, pieces), np.repeat(b, pieces), np.repeat(pieces, pieces)

    def at(part):
        wide = (a > 0) & (b > 2 * a)
        ratio = np.divide(b, a, out=np.ones_like(b), where=wide)
        inner = np.where(wide, a * ratio ** (part / pieces), a + (b - a) * (part / pieces))
        return np.where(part == 0, a, np.where(part == pieces, b, inner))

    return at(index), at(index + 1)


def _grid(terms: Sequence[Factored], last: float) -> np.ndarray:
    slowest = min([last, *(1 / term.theta for term in terms if term.theta)])
    roots = np.abs(np.concatenate([np.concatenate([term.poles, term.zeros]) for term in terms]))
    slowest = min([slowest, *roots[roots > 0]]) * 1e-2
    return np.geomspace(slowest, last, 2 + int(GRID_PER_DECADE * math.log10(last / slowest)))


def _last_frequency(f: Characteristic) -> float:
    """Beyond it |f - limit| < |limit|."""
    roots = [np.max(np.abs([*term.poles, *term.zeros]), initial=0.0) for term in f.terms]
    largest = max(roots) or 1 / (max(term.theta for term in f.terms) or 1.0)
    allowed = abs(f.limit) * (1 + f.neutral) / 2
    last = 2 * largest
    while sum(_tail(term, root, last) for term, root in zip(f.terms, roots, strict=True)) >= allowed:
        last *= 2
    return last


def _tail(term: Factored, root: float, omega: float) -> float:
    """Bound of |P_k - its limit| beyond omega; of |P_k| where it is delayed and has none."""
    growth = len(term.zeros) * math.log1p(root / omega) - len(term.poles) * math.log1p(-root / omega)
    spread = math.expm1(min(growth, 700.0))
    if term.theta == 0 and term.relative_degree == 0:
        return abs(limit_at_infinity(term)) * spread
    return math.exp(log_leading(term) - term.relative_degree * math.log(omega)) * (1 + spread)
