"""The held OP, and what first-order modes, integrators and their combinations make of it at any delayed instant.

Only the moves of OP are kept. Between two of them every response is a sum of exponentials and powers of the time since
the last, so that a dead time, whole or not in samples, only shifts the instant that is looked up [GP73], [YIG07].
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simc_core.identification.estimator.sums import decaying_sums

Array = NDArray[np.float64]
EQUAL = 1e-9  # distances of moves that differ relatively by less are equal


@dataclass(frozen=True, slots=True)
class Located:
    """Instants against the moves: `last` counts the moves made (0: none yet), `since` is the time since the last."""

    last: NDArray[np.intp]
    since: Array


class HeldInput:
    """OP as moves d_j at the instants s_j, from a rest that lasted for ever.

    Parameters
    ----------
    t : array, shape (m,)
        Instants from which the values hold, never decreasing.
    u : array, shape (m,)
        The values.
    """

    def __init__(self, t: Array, u: Array):
        moved = 1 + np.flatnonzero(np.diff(u))
        self.s: Array = t[moved]
        self.d: Array = u[moved] - u[moved - 1]
        self.level: Array = np.concatenate([[0.0], np.cumsum(self.d)])
        self.h: Array = np.diff(self.s)
        self.even = bool(self.h.size) and float(np.ptp(self.h)) <= EQUAL * float(self.h.mean())
        ramp = np.cumsum(self.level[1:-1] * self.h)
        self.area: Array = np.concatenate([[0.0, 0.0], ramp])[: self.level.size]
        bent = np.cumsum(self.area[1:-1] * self.h + self.level[1:-1] * self.h**2 / 2)
        self.area2: Array = np.concatenate([[0.0, 0.0], bent])[: self.level.size]

    def locate(self, t: Array) -> Located:
        """Where the instants `t`, of any shape, lie."""
        last = np.searchsorted(self.s, t, "right")
        since = np.where(last > 0, t - self.s[np.maximum(last - 1, 0)], 0.0)
        return Located(last, since)

    def one_move(self, first: int, last: int) -> "HeldInput":
        """The moves first <= j < last alone."""
        values = np.concatenate([[0.0], np.cumsum(self.d[first:last])])
        return HeldInput(np.concatenate([self.s[first : first + 1], self.s[first:last]]), values)

    def held(self, at: Located) -> Array:
        """OP as its deviation from its first value."""
        return self.level[at.last]

    def integral(self, at: Located) -> Array:
        """1/s."""
        return self.area[at.last] + self.level[at.last] * at.since

    def double_integral(self, at: Located) -> Array:
        """1/s^2."""
        return self.area2[at.last] + at.since * (self.area[at.last] + self.level[at.last] * at.since / 2)

    def remainder(self, at: Located, rate: complex) -> NDArray:
        """e(t) = sum d_j exp(-rate (t - s_j)) over the moves made: what a lag 1/rate still has to go."""
        return self._sums(self.d, rate)[at.last] * np.exp(-rate * at.since)

    def difference(self, at: Located, tau1: float, tau2: float) -> tuple[Array, Array]:
        """e1 and (e1 - e2)/(tau1 - tau2), the remainders of two lags, which may be equal."""
        at_nodes = self._sums(self.d, 1 / tau1)
        fed = np.concatenate([[0.0], at_nodes[1:-1] * _divided(self.h, tau1, tau2)])[: self.d.size]
        w = self._sums(fed, 1 / tau2)[at.last] * np.exp(-at.since / tau2)
        begun = at_nodes[at.last]
        return begun * np.exp(-at.since / tau1), w + begun * _divided(at.since, tau1, tau2)

    def _sums(self, b: Array, rate: complex) -> NDArray:
        """S_j = S_(j-1) exp(-rate h) + b_j just after each move, after a zero for the time before all."""
        if b.size == 0:
            return np.zeros(1)
        return np.concatenate([[0.0], decaying_sums(b, self.h, rate, self.even)])


def _divided(h: Array, tau1: float, tau2: float) -> Array:
    """(exp(-h/tau1) - exp(-h/tau2))/(tau1 - tau2), without loss where the lags are near each other."""
    slow = max(tau1, tau2)
    z = h * abs(1 / tau1 - 1 / tau2)
    share = np.where(z > 1e-12, -np.expm1(-z) / np.maximum(z, 1e-300), 1.0)
    return h / (tau1 * tau2) * np.exp(-h / slow) * share
