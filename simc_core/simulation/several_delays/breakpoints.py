"""Where a response of a loop with several dead times is not smooth, and how rough it is there.

A step at t = 0 reaches signal z_k as a jump of its derivative of order d. It arrives behind the dead time of k at
theta_k, and goes on to every z_i with the order raised by the relative degree from w_k to z_i: at the instants
sum i_k theta_k the response loses its smoothness, less and less of it. Orders from SMOOTH on are left to the
step control of the engine. Where w_k reaches z_i at once (degree 0) it is the size that may fall, by |D_ik|.
"""

import heapq

import numpy as np

from simc_core.errors import InvalidParameter
from simc_core.simulation.several_delays.network import Network
from simc_core.wording import said

SMOOTH = 8  # order of derivative from which a jump is left to step control
NO_JUMP = 1e-13  # jumps of the size of the step times this are none
ZERO = 1e-13  # relative; smaller Markov parameters are rounding
SAME_INSTANT = 1e-11  # instants closer than this, relative, are one
MOST = 20_000


class Breakpoints:
    """Iterates over (t, order), t increasing from 0."""

    def __init__(self, system: Network):
        self.theta = system.theta
        m = len(system.theta)
        self.degree, self.gain = _degrees(system, system.B, system.D)
        first, size = _degrees(system, system.E, system.F)
        self.heap: list[tuple[float, int, int, float]] = [(0.0, 0, -1, 1.0)]
        for k in range(m):
            self._push(0.0, k, int(first[k].min()), float(size[k].max()))
        self.count = 0

    def _push(self, t: float, k: int, order: int, size: float) -> None:
        if order < SMOOTH and size > NO_JUMP:
            heapq.heappush(self.heap, (t + float(self.theta[k]), order, k, size))

    def next(self) -> tuple[float, int] | None:
        """The next breakpoint, None when there are no more."""
        if not self.heap:
            return None
        self.count += 1
        if self.count > MOST:
            raise InvalidParameter(
                said(
                    "a response may have at most {most} jumps before it is smooth, found more: the loop is "
                    "neutral, and its dead time too short for this horizon",
                    most=MOST,
                )
            )
        t, lowest, _, _ = self.heap[0]
        arrived: dict[int, tuple[int, float]] = {}
        while self.heap and self.heap[0][0] <= t + SAME_INSTANT * max(t, float(np.min(self.theta, initial=np.inf))):
            _, order, k, size = heapq.heappop(self.heap)
            before = arrived.get(k, (order, 0.0))
            arrived[k] = (min(order, before[0]), size + before[1])
            lowest = min(lowest, order)
        for k, (order, size) in arrived.items():
            for i in range(len(self.theta)) if k >= 0 else ():
                degree = int(self.degree[i, k])
                self._push(t, i, order + degree, size * float(self.gain[i, k]) if degree == 0 else size)
        return t, lowest


def _degrees(system: Network, B: np.ndarray, D: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Relative degree from each column of (B, D) to each z, at most SMOOTH, and |D|."""
    degree = np.where(np.abs(D) > 0, 0, SMOOTH)
    scale = np.abs(system.C) @ np.abs(B)
    power = B
    for k in range(1, SMOOTH):
        markov = system.C @ power
        found = (np.abs(markov) > ZERO * scale) & (degree > k)
        degree[found] = k
        power, scale = system.A @ power, np.abs(system.C) @ (np.abs(system.A) @ np.abs(power))
    return degree, np.abs(D)
