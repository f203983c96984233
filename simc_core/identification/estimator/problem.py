"""Separable least squares: what a structure predicts for given dead time and lags, the linear part solved [GP73].

y(t) = b + d t + c e^{-t/tau} + sum g_m x_m(t - theta): all but theta and the lags is linear, and is projected out.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.linalg import solve_triangular

from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.records import Record
from simc_core.identification.estimator.structures import Structure
from simc_core.identification.estimator.sums import decaying_sums

SMALL = 1e-6  # relative step of the differences
HIGHEST_ZETA = 0.98


@dataclass(frozen=True, slots=True, eq=False)
class Point:
    """The model at x = (theta, ln lags...): linear part, weighted residuals, their sum of squares."""

    x: Array
    beta: Array
    residual: Array
    cost: float
    basis: Array


class Problem:
    """A structure against one or several records.

    Parameters
    ----------
    structure : Structure
        What is fitted.
    records : list of Record
        Together they have the gains and lags in common; bias, drift and start are each record's own.
    drift, start : bool
        Whether a drift, and an unsettled start, go along.
    """

    def __init__(self, structure: Structure, records: list[Record], drift: bool, start: bool):
        self.structure = structure
        self.records = records
        self.degree = max(structure.ramp, 1 if drift else 0)
        self.start = start or structure.always_free
        self.size = sum(record.t.size for record in records)
        self.root_weight = np.sqrt(np.concatenate([record.weight for record in records]))
        self.y = np.concatenate([record.y for record in records])
        self.parts = self._parts()
        self.fixed = self._fixed()
        self.low, self.high = _bounds(structure, records)

    def lags(self, x: Array) -> Array:
        """Lags, and zeta, as they are."""
        found = np.exp(x[1:])
        if self.structure.key == "oscillating":
            found[1] = x[2]
        return found

    def columns(self, x: Array) -> tuple[Array, Array]:
        """Target z, shape (n,), and columns, shape (n, q): gains first, then bias, drift and start; not weighted."""
        lags = self.lags(x)
        gains = []
        target = self.y
        for record in self.records:
            gains.append(self.structure.columns(record.held, record.held.locate(record.t - x[0]), lags))
        blocks = [np.concatenate(parts) for parts in zip(*gains, strict=True)]
        if self.start:
            blocks.extend(self.spread(self.structure.free(record.t, lags), i) for i, record in enumerate(self.records))
        if self.structure.key == "unstable":
            target = np.concatenate([all_passed(record, 1 / lags[0]) for record in self.records])
        own = [block if block.ndim == 2 else block[:, None] for block in blocks]
        count = len(self.structure.gains)
        return target, np.concatenate([*own[:count], self.fixed, *own[count:]], axis=1)

    def at(self, x: Array) -> Point:
        """The linear part solved at x."""
        target, columns = self.columns(x)
        weighted = columns * self.root_weight[:, None]
        aim = target * self.root_weight
        scale = np.sqrt(np.einsum("ij,ij->j", weighted, weighted))
        scale = np.where(scale > 0, scale, 1.0)
        basis, triangle = np.linalg.qr(weighted / scale)
        rank = np.abs(np.diag(triangle)) > 1e-9
        if not rank.all():  # a column that the others make up already says nothing
            basis, triangle = np.linalg.qr(weighted[:, rank] / scale[rank])
        inner = basis.T @ aim
        beta = np.zeros(columns.shape[1])
        beta[rank] = solve_triangular(triangle, inner) / scale[rank]
        residual = aim - basis @ inner
        return Point(x, beta, residual, float(residual @ residual), basis)

    def derivatives(self, point: Point) -> Array:
        """d model/d x at fixed linear part, weighted, shape (n, number of x)."""
        found = np.empty((self.size, point.x.size))
        target, columns = self.columns(point.x)
        here = columns @ point.beta - target
        for i in range(point.x.size):
            step = SMALL * (max(self.records[0].interval, 1e-3 * point.x[0]) if i == 0 else 1.0)
            moved = point.x.copy()
            moved[i] += step
            if moved[i] > self.high[i]:
                step = -step
                moved[i] = point.x[i] + step
            target, columns = self.columns(moved)
            found[:, i] = (columns @ point.beta - target - here) / step * self.root_weight
        return found

    def _parts(self) -> list[slice]:
        ends = np.cumsum([0, *(record.t.size for record in self.records)])
        return [slice(int(a), int(b)) for a, b in pairwise(ends)]

    def spread(self, columns: list[Array], i: int) -> Array:
        """Columns of record i among the samples of all."""
        found = np.zeros((self.size, len(columns)))
        for j, column in enumerate(columns):
            found[self.parts[i], j] = column
        return found

    def _fixed(self) -> Array:
        blocks = []
        for i, record in enumerate(self.records):
            s = record.t / record.span
            blocks.append(self.spread([s**power for power in range(self.degree + 1)], i))
        return np.concatenate(blocks, axis=1)


def _bounds(structure: Structure, records: list[Record]) -> tuple[Array, Array]:
    """Lowest and highest theta, ln lags (zeta as it is)."""
    interval = min(record.interval for record in records)
    span = max(record.span for record in records)
    longest = max(0.6 * max(record.span - record.first_move, record.interval) for record in records)
    low, high = [0.0], [longest]
    for lag in structure.lags:
        low.append(0.0 if lag == "zeta" else float(np.log(0.05 * interval)))
        high.append(HIGHEST_ZETA if lag == "zeta" else float(np.log(20 * span)))
    return np.array(low), np.array(high)


def all_passed(record: Record, a: float) -> Array:
    """(s - a)/(s + a) y for y straight between its samples, at rest before.

    The all-pass turns k'/(s - a) into k'/(s + a), which can be fitted without growth, and leaves white noise white
    [FL00].
    """
    h = np.diff(record.t)
    gone = -np.expm1(-a * h) / a
    slope = np.diff(record.y) / np.maximum(h, 1e-300)
    fed = record.y[:-1] * gone + slope * (h - gone) / a
    inside = decaying_sums(np.concatenate([[0.0], fed]), h, a, record.even)
    return record.y - 2 * a * inside
