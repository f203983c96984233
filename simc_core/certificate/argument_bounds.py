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

from simc_core.certificate.bound_tables import table
from simc_core.certificate.characteristic import Characteristic
from simc_core.certificate.segments import Nodes

FACTOR_ROUNDING = 4 * np.finfo(float).eps  # of one factor, generously
SMALLEST = 1e-150  # |q| below it is taken for it: log 0 is kept out
NOTHING = 1e-120  # |f| below it is 0
TINY = np.finfo(float).tiny
CLEARLY = 1 - 1e-12  # dominated by no less


@dataclass(frozen=True, slots=True, eq=False)
class ArgumentChange:
    """angle of f, and whether f is zero within rounding, at the nodes, (N,); the others on the segments, (N-1,).

    change: of the angle, where it is certain.   excess: K (b - a)/(|f(a)| + |f(b)|), below 1 on short ones.
    """

    angle: np.ndarray
    zeros: np.ndarray
    change: np.ndarray
    certain: np.ndarray
    excess: np.ndarray


class _Values(NamedTuple):
    """At N nodes. parts: logarithms as in term_table, (V, N).   slopes: bounds of |q_m'|, (M, N).   thetas: (K, N).

    phase: arg P_k, continuous in omega, (K, N).   f: its values, and noise: their rounding errors, (N,).
    """

    parts: np.ndarray
    slopes: np.ndarray
    thetas: np.ndarray
    phase: np.ndarray
    f: np.ndarray
    noise: np.ndarray


class BatchedSum:
    """Functions with the same table of exponents: n of them, of K terms with M factors."""

    def __init__(self, functions: Sequence[Characteristic]):
        rows = np.array([f.rows for f in functions], dtype=float).reshape(len(functions), -1, 3)
        self.a, self.b, self.c = np.ascontiguousarray(rows.T)  # (M, n) each
        quadratic = [row[0] != 0 for row in functions[0].rows]
        self.table = table(functions[0].exponents, tuple([not each for each in quadratic]))
        gains = np.array([f.gains for f in functions]).T  # (K, n), as those below
        self.gains, self.turns = np.log(np.abs(gains)), math.pi * (gains < 0)
        self.thetas = np.array([f.thetas for f in functions]).T
        self.steepness = np.abs(self.b)
        self.bends = any(quadratic)
        if self.bends:
            self.quadratic = np.flatnonzero(quadratic)
            a, b, c = self.a[self.quadratic], self.b[self.quadratic], self.c[self.quadratic]
            self.lowest = (2 * a * c - b * b) / (2 * a * a)  # omega^2 of the smallest |q|
            smallest = np.abs(b) * np.sqrt(np.abs(c / a - (b / (2 * a)) ** 2))
            self.smallest = np.log(np.maximum(smallest, SMALLEST))

    def at(self, nodes: Nodes) -> ArgumentChange:
        """The tests of the module docstring. Between two loops there may be anything."""
        v, t = self._values(nodes.omega, nodes.owner), self.table
        (K, M), width = t.exponents.shape, nodes.omega[1:] - nodes.omega[:-1]
        n = width.size
        left, right = v.parts[:, :-1], v.parts[:, 1:]
        ends = np.empty((2, *left.shape))
        np.minimum(left, right, out=ends[0])
        np.maximum(left, right, out=ends[1])
        if self.bends:
            self._put_inner_minimum(ends[0], nodes)
        bounds = np.exp(t.bounds @ ends.reshape(-1, n))
        ratios, sizes, inverses = bounds[: K * (K - 1)], bounds[K * (K - 1) : K * K], bounds[K * K :]
        rates = inverses.reshape(2, M, n) * _on_segments(v.slopes, n)  # |q'/q|
        slope = sizes * (t.rates @ rates.reshape(2 * M, n) + _on_segments(v.thetas, n))
        size = np.abs(v.f)
        room = size - v.noise
        excess = slope.sum(0) * width / np.maximum(room[1:] + room[:-1], TINY)
        dominated = ratios.reshape(K, K - 1, n).sum(1) < CLEARLY
        angle = np.arctan2(v.f.imag, v.f.real)
        turn = angle[1:] - angle[:-1]
        followed = (dominated * (v.phase[:, 1:] - v.phase[:, :-1])).sum(0)  # half a turn from it at most
        return ArgumentChange(
            angle,
            room <= 0,
            turn - math.tau * np.rint((turn - followed) / math.tau),
            (excess < 1) | dominated.any(0),
            excess,
        )

    def _values(self, omega: np.ndarray, owner: np.ndarray) -> _Values:
        t, b, real, thetas = self.table, _of(self.b, owner), _of(self.c, owner), _of(self.thetas, owner)
        (K, M), slopes = t.exponents.shape, _of(self.steepness, owner)
        imag = b * omega
        if self.bends:
            a = _of(self.a, owner)
            bent = a * (omega * omega)
            full = (np.abs(real) + np.abs(bent)) ** 2 + imag * imag
            real, slopes = real - bent, slopes + 2 * np.abs(a) * omega
        parts = np.empty((t.terms.shape[1], omega.size))
        parts[:M] = 0.5 * np.log(np.maximum(real * real + imag * imag, SMALLEST**2))
        parts[M : M + K] = _of(self.gains, owner)
        parts[M + K :] = t.pairs @ parts[:M]
        delays = thetas * omega
        terms = np.empty((K, omega.size), dtype=complex)  # log P_k
        terms.real = t.terms @ parts
        terms.imag = phase = t.exponents @ np.arctan2(imag, real) + (_of(self.turns, owner) - delays)
        terms = np.exp(terms)  # imag keeps its sign at 0
        noise = np.abs(terms) * (t.sizes @ np.abs(parts) + (delays + t.counts))
        if self.bends:  # |q| without the cancellation in c - a omega^2, over |q|: rounding errors grow by that
            noise *= np.exp(t.above @ (0.5 * np.log(full + SMALLEST**2) - parts[:M]))
        return _Values(parts, slopes, thetas, phase, terms.sum(0), FACTOR_ROUNDING * noise.sum(0) + NOTHING)

    def _put_inner_minimum(self, low: np.ndarray, nodes: Nodes) -> None:
        """low of the quadratic factors, smaller where |q| has its minimum inside the segment."""
        x, owner = nodes.omega**2, nodes.owner[1:]
        lowest, smallest = _of(self.lowest, owner), _of(self.smallest, owner)
        inside = (lowest > x[:-1]) & (lowest < x[1:])
        low[self.quadratic] = np.where(inside, smallest, low[self.quadratic])


def _of(values: np.ndarray, owner: np.ndarray) -> np.ndarray:
    """Columns of `values` by loop, one for each node; a single loop has one column for all."""
    return values if values.shape[1] == 1 else values[:, owner]


def _on_segments(values: np.ndarray, n: int) -> np.ndarray:
    """`values` at the upper ends of n segments, unless one column stands for all."""
    return values[:, -n:]
