"""f = sum_k P_k of many loops on segments [a, b] of the imaginary axis: the change of its argument, where certain.

    short       K (b - a) < |f(a)| + |f(b)|, K a bound of |f'| on the segment: a curve that short cannot go round the
                origin between its ends, so arg f(b)/f(a) in (-pi, pi] is its change of argument;
    dominated   |P_k| > sum of the other |P_i| on all of the segment: f/P_k stays in the right half plane around 1,
                and the argument of P_k is a sum of arctangents minus theta omega.

The bounds need no more than the ends. With x = omega^2, |a s^2 + b s + c|^2 is a parabola in x that opens upwards:
its largest value is at an end, its smallest at an end or at x = (2 a c - b^2)/(2 a^2). |2 a s + b| grows with omega.
Ratios of the P_k have closer bounds, see term_table. Products are sums of logarithms, so nothing overflows.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from simc_core.characteristic import Characteristic
from simc_core.segments import Nodes
from simc_core.term_table import table

ROUNDING = 4 * np.finfo(float).eps  # of one factor, generously
SHORTEST = 16 * np.finfo(float).eps  # relative length of a segment that no double lies inside
SMALLEST = 1e-150  # |q| below it is taken for it: log 0 is kept out
NOTHING = 1e-120  # |f| below it is 0
CLEARLY = 1 - 1e-12  # dominated by no less


@dataclass(frozen=True, slots=True, eq=False)
class Segments:
    """angle of f, and whether f is zero within rounding, at the nodes, (N,); the others on the segments, (N-1,).

    change: of the angle, where it is certain.   excess: K (b - a)/(|f(a)| + |f(b)|), below 1 on short ones.
    """

    angle: np.ndarray
    zeros: np.ndarray
    change: np.ndarray
    certain: np.ndarray
    excess: np.ndarray


class _Values(NamedTuple):
    """At N nodes. logs, slopes: log|q_m| and a bound of |q_m'|, (M, N).   gains, thetas: log|g_k|, theta_k, (K, N).

    phase: arg P_k, continuous in omega, (K, N).   angle, size, noise: arg f, |f|, rounding error of f, (N,).
    """

    logs: np.ndarray
    slopes: np.ndarray
    gains: np.ndarray
    thetas: np.ndarray
    phase: np.ndarray
    angle: np.ndarray
    size: np.ndarray
    noise: np.ndarray


class Family:
    """Functions with the same table of exponents: n of them, of K terms with M factors."""

    def __init__(self, functions: Sequence[Characteristic]):
        rows = np.array([f.rows for f in functions], dtype=float).reshape(len(functions), -1, 3)
        self.a, self.b, self.c = np.ascontiguousarray(rows.T)  # (M, n) each
        self.quadratic = self.a.any(axis=1)
        self.table = table(functions[0].exponents, tuple((~self.quadratic).tolist()))
        gains = np.array([f.gains for f in functions]).T  # (K, n), as those below
        self.gains, self.turns = np.log(np.abs(gains)), np.where(gains < 0, math.pi, 0.0)
        self.thetas = np.array([f.thetas for f in functions]).T
        self.bends = self.quadratic.any()
        if self.bends:
            a, b, c = self.a[self.quadratic], self.b[self.quadratic], self.c[self.quadratic]
            self.lowest = (2 * a * c - b * b) / (2 * a * a)  # omega^2 of the smallest |q|
            smallest = np.abs(b) * np.sqrt(np.abs(c / a - (b / (2 * a)) ** 2))
            self.smallest = np.log(np.maximum(smallest, SMALLEST))

    def at(self, nodes: Nodes) -> Segments:
        """The tests of the module docstring."""
        v, e = self._values(nodes.omega, nodes.owner), self.table
        left, right = v.logs[:, :-1], v.logs[:, 1:]
        low, high = np.minimum(left, right), np.maximum(left, right)
        if self.bends:
            self._put_inner_minimum(low, nodes)
        excess = self._slope(v, low, high) * (width := nodes.omega[1:] - nodes.omega[:-1])
        excess /= np.maximum(v.size[1:] + v.size[:-1] - v.noise[1:] - v.noise[:-1], np.finfo(float).tiny)
        zeros = v.size <= v.noise
        zeros[1:] |= nodes.live & (excess >= 1) & (width <= SHORTEST * nodes.omega[1:])
        change, certain = wrapped(v.angle[1:] - v.angle[:-1]), excess < 1
        dominated = e.ratios.largest(v.logs, low, high, _on_segments(v.gains, width.size)) < CLEARLY
        own = v.phase + wrapped(v.angle - v.phase)  # arg f, followed along P_k
        for by, of in zip(dominated, own, strict=True):
            change, certain = np.where(by, of[1:] - of[:-1], change), certain | by
        return Segments(v.angle, zeros, change, certain, excess)

    def _values(self, omega: np.ndarray, owner: np.ndarray) -> _Values:
        e, (a, b, c) = self.table, (_of(x, owner) for x in (self.a, self.b, self.c))
        gains, thetas = _of(self.gains, owner), _of(self.thetas, owner)
        x = omega * omega
        real, imag = c - a * x, b * omega
        logs = 0.5 * np.log(np.maximum(real * real + imag * imag, SMALLEST**2))
        delays = thetas * omega
        phase = e.exponents @ np.arctan2(imag, real) - delays + _of(self.turns, owner)  # imag keeps its sign at 0
        sizes = np.exp(e.exponents @ logs + gains)
        re, im = (sizes * np.cos(phase)).sum(0), (sizes * np.sin(phase)).sum(0)
        noise = sizes * (e.counts + 1 + e.sizes @ np.abs(logs) + np.abs(gains) + delays)
        if self.bends:  # |q| without the cancellation in c - a omega^2, over |q|: rounding errors grow by that
            full = (np.abs(c) + np.abs(a) * x) ** 2 + imag * imag
            noise *= np.exp(e.above @ (0.5 * np.log(full + SMALLEST**2) - logs))
        slopes = np.abs(b) + 2 * np.abs(a) * omega
        return _Values(
            logs, slopes, gains, thetas, phase, np.arctan2(im, re), np.hypot(re, im), ROUNDING * noise.sum(0) + NOTHING
        )

    def _slope(self, v: _Values, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """K, from bounds of |P_k| and of |q'/q|."""
        e, n = self.table, low.shape[1]
        at_end = _on_segments(v.slopes, n)
        rates = e.above @ (at_end * np.exp(-high)) + e.below @ (at_end * np.exp(-low)) + _on_segments(v.thetas, n)
        return (np.exp(e.above @ high - e.below @ low + _on_segments(v.gains, n)) * rates).sum(0)

    def _put_inner_minimum(self, low: np.ndarray, nodes: Nodes) -> None:
        """low of the quadratic factors, smaller where |q| has its minimum inside the segment."""
        x, owner = nodes.omega**2, nodes.owner[1:]
        lowest, smallest = _of(self.lowest, owner), _of(self.smallest, owner)
        inside = (lowest > x[:-1]) & (lowest < x[1:])
        low[self.quadratic] = np.where(inside, smallest, low[self.quadratic])


def wrapped(angle: np.ndarray) -> np.ndarray:
    """angle in [-pi, pi]."""
    return angle - 2 * math.pi * np.rint(angle / (2 * math.pi))


def _of(values: np.ndarray, owner: np.ndarray) -> np.ndarray:
    """Columns of `values` by loop, one for each node; a single loop has one column for all."""
    return values if values.shape[1] == 1 else values[:, owner]


def _on_segments(values: np.ndarray, n: int) -> np.ndarray:
    """`values` at the upper ends of n segments, unless one column stands for all."""
    return values[:, -n:]
