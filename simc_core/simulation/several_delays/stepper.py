"""Unit step responses with several dead times: collocation elements on a nonuniform mesh.

Elements (delay_maps.py) end at every instant where the response is not smooth (breakpoints.py). What the delays return
on an element is, node by node, the polynomial of an earlier one, or of the element itself where that is longer than
a dead time. So a dead time 4000 times shorter than the other costs a few more elements, not 4000 times as many.
Lengths are unit 2^k, halved where the last Chebyshev coefficients are too large and doubled where they allow it; the
map of one length is made once. The shortest dead time is such a length, and so is most of what is left in front of a
breakpoint.
"""

import math
from bisect import bisect_left, bisect_right
from functools import lru_cache
from threading import Lock

import numpy as np

from simc_core.errors import InvalidParameter
from simc_core.loops.nested import NestedLoops
from simc_core.simulation.collocation.elements import NODES
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.collocation.pieces import Pieces
from simc_core.simulation.several_delays.breakpoints import SMOOTH, Breakpoints
from simc_core.simulation.several_delays.delay_maps import LEFT, DelayMap, delay_map
from simc_core.simulation.several_delays.network import Network, network
from simc_core.wording import said

TAIL = 3e-10  # last two coefficients of an element, relative to the largest value so far
ROOM = 2.0**-10  # the tail must be below ROOM TAIL for the length to be doubled at once
MOST_PATIENCE = 4
ROUGH = 2  # behind a jump of a derivative up to this order elements start short; four times as long for each more
START = 4.0  # first length after a jump, in time constants of the fastest mode
FEWEST_BITS = 30  # lengths below 2^-FEWEST_BITS of the first are rounding
FLOOR = 1e-4  # a signal is judged by this part of the largest one at least: zero is zero within rounding
SHARE = 1e-2  # and by this part of its largest response to any of the inputs
VALUE_ROUNDING = 1e-14  # of what is added up to a value
MOST_ELEMENTS = 15_000  # 80 us each
MOST_VALUES = 5_000_000  # numbers in all elements of a loop: 40 MB, of each of the RECENT ones
MOST_MAPS = 200  # remembered; 0.1 MB each, 0.4 MB of six loops
CUT_OFF = 1e150  # an unstable response ends here
GROWTH = 1.02  # of a signal before its size is taken anew
DIGITS = 11  # behind the point: lengths and places that agree to so many are the same
ROOM_AT_FIRST = 128  # elements
DEGREES = np.arange(P)
NODE_LIST = NODES.tolist()
MOST_BASES = 500  # remembered; about 1 MB
largest = np.maximum.reduce  # along an axis; the method of arrays takes three times as long
RECENT = 8  # loops whose steps are remembered


class NestedStepper:
    """Responses of a Network to unit steps of all its inputs at t = 0, from rest; `run` goes on where it stopped."""

    def __init__(self, system: Network):
        self.system = system
        n, self.m = system.B.shape
        self.inputs, self.signals = system.E.shape[1], self.m + len(system.Co)
        self.t, self.x, self.steps = 0.0, np.zeros((n, self.inputs)), np.eye(self.inputs)
        self.edges, self.thetas = [0.0], system.theta.tolist()
        self.most = min(MOST_ELEMENTS, MOST_VALUES // (self.signals * P * self.inputs))
        self.coefficients = np.zeros((ROOM_AT_FIRST, self.signals, P, self.inputs))  # of (z, o), Chebyshev
        self.count = 0
        self.summands = np.abs(np.concatenate([system.C, system.Co]))  # a large kick leaves few digits of u
        self.breakpoints = Breakpoints(system)
        self.upcoming = self.breakpoints.next()
        self.h = unit = _unit(system)
        self.first = [unit * 4.0 ** max(order - ROUGH, 0) for order in range(SMOOTH)]  # length behind a breakpoint
        self.behind = SMOOTH  # order of the breakpoint at t; SMOOTH for none
        self.good, self.patience = 0, 1  # elements accepted in a row, and how many before a longer one is tried
        self.maps: dict[float, DelayMap] = {}
        self.bases: dict[tuple[float, float], np.ndarray] = {}
        self.largest = np.full((self.signals, self.inputs), 1e-300)
        self.allowed, self.bounded = TAIL * self.largest, True
        self.lock = Lock()  # one NestedStepper may serve several sessions

    def run(self, t_end: float) -> Pieces:
        """On to t_end, or until an unstable response is beyond all bounds.

        All there is so far, which may be more: values [y_1 .. y_N, u_1 .. u_N] x [r, d_1 .. d_N].
        """
        with self.lock, np.errstate(over="ignore", invalid="ignore"):
            while self.t < t_end * (1 - 1e-12) and self.bounded:
                self._pass_breakpoints()
                self._step()
            outputs = self.coefficients[: self.count, self.m :]
            return Pieces(np.array(self.edges), np.moveaxis(outputs, 2, 1))

    def _pass_breakpoints(self) -> None:
        while self.upcoming is not None and self.upcoming[0] <= self.t:
            self.behind = min(self.behind, self.upcoming[1])
            self.upcoming = self.breakpoints.next()
        if self.behind < SMOOTH:
            self.h, self.good, self.patience = min(self.h, self.first[self.behind]), 0, 1

    def _step(self) -> None:
        upcoming = math.inf if self.upcoming is None else self.upcoming[0]
        left = upcoming - self.t
        for _ in range(FEWEST_BITS):
            last = left <= self.h * (1 + 1e-9)
            length = left if last else self.h
            values, x, tail = self._try(length)
            if tail <= 1:
                break
            self.good, self.patience = 0, min(2 * self.patience, MOST_PATIENCE)
            while self.h >= length * (1 - 1e-9):
                self.h /= 2
        if self.behind < SMOOTH:  # the next breakpoint like this one begins where this one did, or bolder
            self.first[self.behind] = 2 * self.h if tail < ROOM else self.h
            for order in range(self.behind + 1, SMOOTH):
                self.first[order] = min(self.first[order], 2 * self.first[order - 1])
            self.behind, self.patience = SMOOTH, 1
        self._keep(values, x, upcoming if last else self.t + length)
        self.good += 1
        if not last and (tail < ROOM or self.good >= self.patience):
            self.h *= 2
            self.good = 0

    def _try(self, length: float) -> tuple[np.ndarray, np.ndarray, float]:
        """One element: coefficients, state at its end, size of the tail relative to what is allowed."""
        key = float(f"{length:.{DIGITS}e}")
        made = self.maps.get(key)
        if made is None:
            if len(self.maps) >= MOST_MAPS:
                self.maps.clear()
            made = self.maps[key] = delay_map(self.system, key)
        known = np.concatenate([self.x, self._history(length), self.steps])
        values = (made.coefficients @ known).reshape(self.signals, P, self.inputs)
        last = largest(np.abs(values[:, -2:]), 1)
        tail = float(largest(last / self.allowed, None))
        if tail > ROOM:  # if at all, for what is rounding, or because the signals have grown
            noise = VALUE_ROUNDING * (made.weight @ np.abs(known) + self.summands @ np.abs(self.x))
            allowed = self._sizes(values)[1] if tail > 1 else self.allowed
            tail = float(largest(np.maximum(last - noise, 0.0) / allowed, None))
        return values, made.end @ known, tail

    def _sizes(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Largest values so far and with this element, and what may remain in a tail, (signals, inputs) both."""
        size = np.maximum(self.largest, largest(np.abs(values), 1))
        own = largest(size, 1)
        return size, TAIL * np.maximum(size, np.maximum(SHARE * own, FLOOR * largest(own))[:, None])

    def _history(self, length: float) -> np.ndarray:
        """w at the nodes as far as it lies before this element, (m P, inputs)."""
        found = np.zeros((self.m, P, self.inputs))
        if not self.count:
            return found.reshape(-1, self.inputs)
        near = LEFT * length
        for i, theta in enumerate(self.thetas):
            begin = self.t - theta
            known = bisect_right(NODE_LIST, theta / length * (1 + LEFT))  # what is later belongs to this element
            node = bisect_left(NODE_LIST, near - begin, 0, known, key=length.__mul__) if begin < 0 else 0
            while node < known:
                piece = bisect_right(self.edges, begin + length * NODE_LIST[node] - near, 1, self.count) - 1
                start, end = self.edges[piece], self.edges[piece + 1]
                to = max(bisect_right(NODE_LIST, (end + near - begin) / length, node, known), node + 1)
                basis = self._basis(2 * (begin - start) / (end - start) - 1, 2 * length / (end - start))
                found[i, node:to] = basis[node:to] @ self.coefficients[piece, i]
                node = to
        return found.reshape(-1, self.inputs)

    def _basis(self, first: float, slope: float) -> np.ndarray:
        """Chebyshev polynomials at x = first + slope c_j, (P, P). The mesh is regular: most are asked for again."""
        key = round(first, DIGITS), round(slope, DIGITS)
        found = self.bases.get(key)
        if found is None:
            if len(self.bases) >= MOST_BASES:
                self.bases.clear()
            x = np.minimum(np.maximum(first + slope * NODES, -1.0), 1.0)
            found = self.bases[key] = np.cos(DEGREES * np.arccos(x)[:, None])
        return found

    def _keep(self, values: np.ndarray, x: np.ndarray, end: float) -> None:
        if self.count >= self.most:
            raise InvalidParameter(
                said(
                    "the horizon must need at most {most} elements, found more by t = {t:.3g}: the loop "
                    "oscillates too fast for it",
                    most=self.most,
                    t=self.t,
                )
            )
        if self.count == len(self.coefficients):
            self.coefficients = np.concatenate([self.coefficients, np.zeros_like(self.coefficients)])
        self.coefficients[self.count] = values
        self.edges.append(end)
        self.count += 1
        if (largest(np.abs(values), 1) > GROWTH * self.largest).any():
            self.largest, self.allowed = self._sizes(values)
            self.bounded = bool(largest(self.largest, None) < CUT_OFF)
        self.t, self.x = end, x


@lru_cache(maxsize=RECENT)
def steps_of(loops: NestedLoops) -> NestedStepper:
    """The NestedStepper of these loops, the same object for all who ask: what one has run, the others need not."""
    return NestedStepper(network(loops))


def _unit(system: Network) -> float:
    """First length: short against the fastest mode, and the shortest dead time a power of two of it."""
    modes = np.abs(np.linalg.eigvals(system.A)) if len(system.A) else np.zeros(0)
    fast = START / float(np.max(modes, initial=0.0) or 1.0 / START)
    if not system.theta.size:
        return fast
    theta = float(np.min(system.theta))
    return theta * 2.0 ** -max(math.ceil(math.log2(theta / fast)), 0)
