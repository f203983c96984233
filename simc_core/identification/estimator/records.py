"""A trend made ready for fitting: relative times, moves of OP, weights; and the same in fewer points."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simc_core.identification.estimator.held_input import Array, HeldInput
from simc_core.identification.estimator.outliers import spikes
from simc_core.identification.trend import Trend

OFTEN = 0.3  # moves of OP for each sample, from where it moves all the time
MANY_MOVES = 100  # more than these, and means are all of one size, and may take in a move of OP
GAP = 20  # intervals, and
LONG = 0.1  # share of the whole time, without a sample: a gap


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """Samples y at t, counted from the first, with their weights and the moves of OP."""

    t: Array
    y: Array
    weight: Array
    held: HeldInput
    span: float
    interval: float  # median distance of samples
    even: bool

    @property
    def first_move(self) -> float:
        """Instant of the first move of OP, not before the first sample."""
        return max(float(self.held.s[0]), 0.0)

    @property
    def gaps(self) -> NDArray[np.bool_]:
        """Which steps from sample to sample are gaps of the record, shape (n - 1,)."""
        return np.diff(self.t) > max(GAP * self.interval, LONG * self.span)

    @property
    def stretch(self) -> float:
        """Longest time without a gap."""
        ends = np.concatenate([[-1], np.flatnonzero(self.gaps), [self.t.size - 1]])
        return float(np.max(self.t[ends[1:]] - self.t[ends[:-1] + 1]))

    def _rising(self, points: int) -> NDArray[np.intp]:
        """A label for each sample: of those that share one, the longer ago the last move of OP, the more.

        A process answers a move soon and settles late: so its dead time is told as well, as a share of itself, where a
        record is far longer than the answers in it as where it is not.
        """
        begins = np.concatenate([[0], np.searchsorted(self.t, self.held.s, "left")])
        begins = np.unique(np.clip(begins, 0, self.t.size))
        since = np.arange(self.t.size) - begins[np.searchsorted(begins, np.arange(self.t.size), "right") - 1]
        counts = np.diff(np.append(begins, self.t.size))
        growth = _growth(counts[counts > 0], points)
        own = np.floor(np.log1p(growth * since) / np.log1p(growth)).astype(np.intp)
        return np.cumsum(np.concatenate([[0], (np.diff(own) != 0) | (np.diff(since) <= 0)])).astype(np.intp)

    def weighted(self, weight: Array) -> "Record":
        """The same samples with other weights."""
        return Record(self.t, self.y, weight, self.held, self.span, self.interval, self.even)

    def reduced(self, points: int) -> "Record":
        """At most about `points` weighted means of neighbours; a mean takes in no gap, and no
        move of OP where these are few."""
        if self.t.size <= points:
            return self
        label = (
            self._rising(points) if self.held.s.size <= MANY_MOVES else np.arange(self.t.size) * points // self.t.size
        )
        label = label + np.concatenate([[0], np.cumsum(self.gaps)])
        label = np.unique(label, return_inverse=True)[1]
        weight = np.bincount(label, self.weight).astype(float)
        kept = weight > 0
        t = np.bincount(label, self.weight * self.t)[kept] / weight[kept]
        y = np.bincount(label, self.weight * self.y)[kept] / weight[kept]
        return Record(t, y, weight[kept], self.held, self.span, self.interval, False)


def _growth(counts: NDArray[np.intp], points: int) -> float:
    """What a mean grows by from one to the next, so that stretches of `counts` samples have `points` of them."""
    low, high = 1e-9, 10.0
    for _ in range(40):
        middle = (low * high) ** 0.5
        many = float(np.sum(np.log1p(middle * counts) / np.log1p(middle)))
        low, high = (middle, high) if many > points else (low, middle)
    return high


def as_record(trend: Trend, between_samples: bool) -> Record:
    """The record of a trend.

    Parameters
    ----------
    trend : Trend
        What was measured.
    between_samples : bool
        OP was written down from time to time only: its moves are put in the middle of the interval they were found in.
    """
    t_u = trend.instants_of_u - trend.t[0]
    if between_samples:
        t_u = np.concatenate([t_u[:1], (t_u[1:] + t_u[:-1]) / 2])
    t = trend.t - trend.t[0]
    steps = np.diff(t)
    even = bool(np.ptp(steps) <= 1e-6 * steps.mean())
    own = steps[steps > 0]
    return Record(
        t, trend.y, (~spikes(trend.y)).astype(float), HeldInput(t_u, trend.u), trend.span, float(np.median(own)), even
    )
