"""How often f = sum_k P_k winds around the origin along the imaginary axis, certified segment by segment.

A segment [a, b] of the axis counts only when one of two closed-form tests holds, else it is split:

    short       K (b - a) < |f(a)| + |f(b)|, K a bound of |f'| on the segment: a curve that short cannot go round the
                origin between its ends, so arg f(b)/f(a) in (-pi, pi] is its change of argument;
    dominated   |P_k| > sum of the other |P_i| on all of the segment: f/P_k stays in the right half plane around 1,
                and the argument of P_k is a sum of arctangents minus theta omega.

The bounds need no more than the ends. With x = omega^2, |a s^2 + b s + c|^2 is a parabola in x that opens upwards:
its largest value is at an end, its smallest at an end or at x = (2 a c - b^2)/(2 a^2). |2 a s + b| grows with omega.
Ratios of the P_k have closer bounds, see term_table.

Beyond the last frequency, f differs from its limit by less than the limit: closed form again, from the largest root.
Zeros in the right half plane: -1/pi times the change of arg f over 0..inf. A point where f is zero within
rounding is a zero on the axis.

Loops whose P_k have the same table of exponents are worked on together: their segments stand in one row, with the
number of the loop beside each node (module segments). Products are sums of logarithms, so nothing overflows.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.characteristic import Characteristic
from simc_core.errors import InvalidParameter
from simc_core.segments import Nodes, geometric, split
from simc_core.term_table import table

MOST_SEGMENTS = 60_000  # of one loop, about 0.1 s; a usual one needs 30 to 100
TOGETHER = 256  # loops
GRID_PER_DECADE = 10
ROUNDING = 4 * np.finfo(float).eps  # of one factor, generously
SHORTEST = 16 * np.finfo(float).eps  # relative length of a segment that no double lies inside
SMALLEST = 1e-150  # |q| below it is taken for it: log 0 is kept out
NOTHING = 1e-120  # |f| below it is 0
CLEARLY = 1 - 1e-12  # dominated by no less


@dataclass(frozen=True, slots=True)
class Winding:
    """zeros: number in the open right half plane; None where f vanishes on the axis, at omega = `touches`.

    work: segments that were looked at.
    """

    zeros: int | None
    touches: float | None
    work: int


def winding(f: Characteristic) -> Winding:
    """Zeros of f in the right half plane. Raises InvalidParameter where the work would exceed MOST_SEGMENTS."""
    return windings([f])[0]


def windings(functions: Sequence[Characteristic]) -> list[Winding]:
    """The same of many, those with equal tables of exponents together. One that is refused refuses all."""
    alike: dict[tuple, list[int]] = {}
    for i, f in enumerate(functions):
        alike.setdefault((f.exponents, tuple(row[0] != 0 for row in f.rows)), []).append(i)
    found: dict[int, Winding] = {}
    for members in alike.values():
        for start in range(0, len(members), TOGETHER):
            some = members[start : start + TOGETHER]
            found |= zip(some, _together([functions[i] for i in some]), strict=True)
    return [found[i] for i in range(len(functions))]


def _together(functions: Sequence[Characteristic]) -> list[Winding]:
    """Those with the same table of exponents."""
    n, family = len(functions), _Family(functions)
    first, last = np.array([_range(f) for f in functions]).T
    work, touches = np.zeros(n, dtype=int), np.full(n, np.nan)
    grid, ends = _first_grid(first, last)
    ahead = np.array([0.0 if f.limit > 0 else math.pi for f in functions])
    waiting, turned = [grid], np.zeros(n)
    while waiting:
        nodes = waiting.pop()
        work += np.bincount(nodes.owner[1:], nodes.live, n).astype(int)
        _refuse(functions, work)
        with np.errstate(over="ignore"):
            found = family.at(nodes)
        if nodes is grid:  # from the last frequency to infinity
            turned += _wrapped(ahead - found.angle[ends])
        _note(nodes, found.zeros, touches)
        owner = nodes.owner[1:]
        turned += np.bincount(owner, np.where(found.certain & nodes.live, found.change, 0.0), n)
        waiting += split(nodes, nodes.live & ~found.certain & np.isnan(touches[owner]), found.excess)
    zeros = np.rint(turned / -math.pi).astype(int).tolist()
    return [
        Winding(count, None, done) if math.isnan(touch) else Winding(None, touch, done)
        for count, touch, done in zip(zeros, touches.tolist(), work.tolist(), strict=True)
    ]


def _refuse(functions: Sequence[Characteristic], work: np.ndarray) -> None:
    most = int(work.argmax())
    if work[most] > MOST_SEGMENTS:
        raise InvalidParameter(
            f"the stability certificate must need <= {MOST_SEGMENTS} segments, got {work[most]}: the loop is too "
            f"close to |L(inf)| = 1 (here {functions[most].neutral:g}) or its time constants are too far apart"
        )


def _note(nodes: Nodes, zeros: np.ndarray, touches: np.ndarray) -> None:
    """The smallest zero of each loop, 0 only if there is no other."""
    for i in np.flatnonzero(zeros)[::-1]:
        if nodes.omega[i] or np.isnan(touches[nodes.owner[i]]):
            touches[nodes.owner[i]] = nodes.omega[i]


@dataclass(frozen=True, slots=True, eq=False)
class _Found:
    """angle of f and whether f is zero, at the nodes; change of the angle, certain or not, and excess, on the segments.

    excess: K (b - a)/(|f(a)| + |f(b)|), below 1 where the segment is short.
    """

    angle: np.ndarray
    zeros: np.ndarray
    change: np.ndarray
    certain: np.ndarray
    excess: np.ndarray


class _Family:
    """Functions with the same table of exponents: n of them, of K terms with M factors."""

    def __init__(self, functions: Sequence[Characteristic]):
        n = len(functions)
        rows = np.array([f.rows for f in functions], dtype=float).reshape(n, -1, 3)
        self.a, self.b, self.c = np.ascontiguousarray(rows.T)  # (M, n) each
        self.quadratic = self.a.any(axis=1)
        self.table = table(functions[0].exponents, tuple((~self.quadratic).tolist()))
        gains = np.array([f.gains for f in functions]).T
        self.gains, self.turns = np.log(np.abs(gains)), np.where(gains < 0, math.pi, 0.0)
        self.thetas = np.array([f.thetas for f in functions]).T
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b, c = self.a[self.quadratic], self.b[self.quadratic], self.c[self.quadratic]
            self.lowest = (2 * a * c - b * b) / (2 * a * a)  # omega^2 of the smallest |q|
            smallest = np.abs(b) * np.sqrt(np.abs(c / a - (b / (2 * a)) ** 2))
        self.smallest = np.log(np.maximum(smallest, SMALLEST))

    def at(self, nodes: Nodes) -> _Found:
        """f and its bounds on nodes and segments."""
        omega, owner, e = nodes.omega, nodes.owner, self.table
        one = self.gains.shape[1] == 1
        a, b, c, gains, turns, thetas = (
            x if one else x[:, owner] for x in (self.a, self.b, self.c, self.gains, self.turns, self.thetas)
        )
        x = omega * omega
        real, imag = c - a * x, b * omega
        logs = 0.5 * np.log(np.maximum(real * real + imag * imag, SMALLEST**2))
        delays = thetas * omega
        phase = e.exponents @ np.arctan2(imag, real) - delays + turns  # imag keeps its sign at omega = 0
        sizes = np.exp(e.exponents @ logs + gains)
        re, im = (sizes * np.cos(phase)).sum(0), (sizes * np.sin(phase)).sum(0)
        angle, size = np.arctan2(im, re), np.sqrt(re * re + im * im)
        noise = sizes * (e.counts + e.sizes @ np.abs(logs) + delays)
        low, high = np.minimum(logs[:, :-1], logs[:, 1:]), np.maximum(logs[:, :-1], logs[:, 1:])
        if self.quadratic.any():
            low = self._with_inner_minimum(low, x, owner)
            noise = noise * np.exp(e.above @ (0.5 * np.log((np.abs(c) + np.abs(a) * x) ** 2 + imag * imag + SMALLEST**2) - logs))
        noise = ROUNDING * noise.sum(0) + NOTHING
        if not one:
            gains, a, b, thetas = gains[:, 1:], a[:, 1:], b[:, 1:], thetas[:, 1:]
        slopes = np.abs(b) + 2 * np.abs(a) * omega[1:]
        rates = e.above @ (slopes * np.exp(-high)) + e.below @ (slopes * np.exp(-low)) + thetas
        slope = (np.exp(e.above @ high - e.below @ low + gains) * rates).sum(0)
        width = np.diff(omega)
        room = size[1:] + size[:-1] - noise[1:] - noise[:-1]
        excess = slope * width / np.maximum(room, np.finfo(float).tiny)
        zeros = size <= noise
        zeros[1:] |= nodes.live & (excess >= 1) & (width <= SHORTEST * omega[1:])
        change = _wrapped(np.diff(angle))
        certain = excess < 1
        dominated = e.ratios.largest(logs, low, high, gains) < CLEARLY
        own = np.diff(phase + _wrapped(angle - phase))
        for k in range(len(own)):
            change = np.where(dominated[k], own[k], change)
            certain |= dominated[k]
        return _Found(angle, zeros, change, certain, excess)

    def _with_inner_minimum(self, low: np.ndarray, x: np.ndarray, owner: np.ndarray) -> np.ndarray:
        """low of the quadratic factors, smaller where |q| has its minimum inside the segment; x = omega^2."""
        lowest, smallest = self.lowest, self.smallest
        if lowest.shape[1] > 1:
            lowest, smallest = lowest[:, owner[1:]], smallest[:, owner[1:]]
        inside = (lowest > x[:-1]) & (lowest < x[1:])
        low[self.quadratic] = np.where(inside, smallest, low[self.quadratic])
        return low


def _wrapped(angle: np.ndarray) -> np.ndarray:
    """angle in [-pi, pi]."""
    return angle - 2 * math.pi * np.rint(angle / (2 * math.pi))


def _first_grid(first: np.ndarray, last: np.ndarray) -> tuple[Nodes, np.ndarray]:
    """0 and a geometric grid for every loop; and the index of its last frequency."""
    omega, owner, ends = geometric(first, last, GRID_PER_DECADE)
    n = first.size
    starts = np.concatenate([[0], ends[:-1] + 1])
    omega, owner = np.insert(omega, starts, 0.0), np.insert(owner, starts, np.arange(n))
    return Nodes(omega, owner, omega[1:] > 0), ends + np.arange(1, n + 1)


def _range(f: Characteristic) -> tuple[float, float]:
    """A frequency below all corners, and one beyond which |f - limit| < |limit|."""
    corners = f.corners
    everything = [corner for some in corners for corner in some]
    delays = [1 / theta for theta in f.thetas if theta]
    largest = max(everything, default=0.0) or max(delays, default=1.0)
    allowed = abs(f.limit) * (1 + f.neutral) / 2
    last = 2 * largest
    while sum(_tail(f, k, largest, last) for k in range(len(f.gains))) >= allowed:
        last *= 2
    return 1e-2 * min([last, *delays, *everything]), last


def _tail(f: Characteristic, k: int, largest: float, omega: float) -> float:
    """Bound of |P_k - its limit| beyond omega; of |P_k| where it is delayed or has none."""
    zeros, poles = f.degrees[k]
    growth = zeros * math.log1p(largest / omega) - poles * math.log1p(-largest / omega)
    spread = math.expm1(min(growth, 700.0))
    if f.thetas[k] == 0 and zeros == poles:
        return abs(f.leading[k]) * spread
    return abs(f.leading[k]) * omega ** (zeros - poles) * (1 + spread)
