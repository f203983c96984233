"""Step metrics from the Taylor pieces of high_precision.py: integrals exact, zeros and extrema to rounding."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.polynomial.polynomial import polyder, polyint, polyvander
from scipy.optimize import brentq

from simc_core import Loop
from tests.oracles.high_precision import ONE, course, to_float

PLACES = np.linspace(0, 1, 33)
ROUNDING = 1e-15


@dataclass(frozen=True, slots=True)
class Metrics:
    """As StepMetrics in simc_core/performance.py, whose definitions these are."""

    IAE: float
    ISE: float
    ITAE: float
    TV: float
    overshoot: float
    peak: float
    peak_time: float
    rise_time: float
    settling_time: float


def horner(x: float, series: list[float]) -> float:
    """A polynomial at one place: what numpy does for one is ten times as long on its way."""
    total = 0.0
    for c in reversed(series):
        total = c + total * x
    return total


@dataclass(frozen=True, slots=True, eq=False)
class Signal:
    """Polynomials in x = t/h - i on [i, i + 1], ascending coefficients as doubles, (m, n)."""

    h: float
    series: np.ndarray

    def roots(self, level: float = 0.0) -> list[list[float]]:
        """x at which each piece crosses the level."""
        values = self.series @ polyvander(PLACES, self.series.shape[1] - 1).T - level
        values[np.abs(values) < ROUNDING * np.abs(self.series).sum(axis=1, keepdims=True)] = 0.0
        found: list[list[float]] = [[] for _ in self.series]
        for i, j in np.argwhere(values[:, :-1] * values[:, 1:] < 0):
            ends, series = PLACES[j : j + 2], self.series[i].tolist()
            found[i].append(brentq(lambda x, c=series: horner(x, c) - level, *ends, xtol=1e-16, rtol=1e-15))
        return found

    def crossings(self, level: float) -> list[float]:
        """Instants at which the level is crossed, jumps included."""
        left, right = self.series.sum(axis=1) - level, self.series[:, 0] - level
        jumps = [i * self.h for i in range(1, len(left)) if left[i - 1] * right[i] < 0]
        return sorted(jumps + [(i + x) * self.h for i, places in enumerate(self.roots(level)) for x in places])

    def extrema(self) -> tuple[np.ndarray, np.ndarray]:
        """Times and values of local extrema and of both limits at all edges."""
        slope = Signal(self.h, polyder(self.series, axis=1))
        at = [(i, x) for i, places in enumerate(slope.roots()) for x in (0.0, *places, 1.0)]
        series = self.series.tolist()
        return np.array([(i + x) * self.h for i, x in at]), np.array([horner(x, series[i]) for i, x in at])

    def integrals(self) -> tuple[float, float, float]:
        """int |.|, int t |.|, int of the square."""
        begin = self.h * np.arange(len(self.series))[:, np.newaxis]
        times_t = begin * np.pad(self.series, ((0, 0), (0, 1))) + self.h * np.pad(self.series, ((0, 0), (1, 0)))
        zeros, found = self.roots(), []
        for signal in (self.series, times_t):
            total = []
            for series, places in zip(polyint(signal, axis=1).tolist(), zeros, strict=True):
                ends = [horner(x, series) for x in (0.0, *places, 1.0)]
                total += [abs(after - before) for before, after in pairwise(ends)]
            found.append(self.h * math.fsum(total))
        return found[0], found[1], self.h * math.fsum(self.squares())

    def squares(self) -> np.ndarray:
        """Integral of the square over each piece: Gauss's rule, exact for its degree.

        Not the series of the square: where coefficients are large and the signal is small, it leaves their rounding.
        """
        n = self.series.shape[1]
        x, weights = leggauss(n)
        return (self.series @ polyvander((x + 1) / 2, n - 1).T) ** 2 @ (weights / 2)


def metrics(loop: Loop, load: bool, until: float) -> Metrics:
    """Of a unit step; `until`: e and the change of u are nothing from here on. theta > 0."""
    found, target = course(loop, load, until, reach=2), 0 if load else ONE
    y, u, e = (
        Signal(float(found.h), np.array([[to_float(c) for c in piece] for piece in pieces]))
        for pieces in (found.y, found.u, [[target - piece[0], *(-c for c in piece[1:])] for piece in found.y])
    )
    assert max(np.abs(e.series[-1])) < 1e-11
    IAE, ITAE, ISE = e.integrals()
    times, values = y.extrema()
    at = int(np.argmax(np.abs(values) if load else values))
    peak, TV = values[at], np.sum(np.abs(np.diff(u.extrema()[1], prepend=0.0)))
    band = 0.02 * (abs(peak) if load else 1.0)
    beyond = np.max(-np.sign(peak) * values) / abs(peak) if load else peak - 1
    rise = math.nan if load else y.crossings(0.9)[0] - y.crossings(0.1)[0]
    settling = max(e.crossings(band) + e.crossings(-band))
    return Metrics(IAE, ISE, ITAE, TV, max(beyond, 0.0), peak, times[at], rise, settling)
