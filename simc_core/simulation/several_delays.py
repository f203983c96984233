"""Unit step responses with several dead times: collocation elements on a nonuniform mesh.

Elements (elements.py: Radau nodes) end at every instant where the response is not smooth (breakpoints.py). What the
delays return on an element is, node by node, the polynomial of an earlier one; where the element is longer
than a dead time part of it is the element itself, and the equations are solved for both at once:

    w = H + P z,    z = Zx x_0 + Zw w + Zv v    =>    w = (1 - P Zw)^-1 (H + P (Zx x_0 + Zv v))

with H the part from earlier elements and P the interpolation within the element. So a dead time 4000 times
shorter than the other costs a few more elements, not 4000 times as many. Lengths are unit 2^k, halved where the last
Chebyshev coefficients are too large and doubled where they allow it; the map of one length is made once.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.errors import InvalidParameter
from simc_core.simulation.breakpoints import Breakpoints
from simc_core.simulation.elements import NODES, TO_CHEBYSHEV, P, element
from simc_core.simulation.network import Network
from simc_core.simulation.pieces import Pieces

TAIL = 1e-10  # last two coefficients of an element, relative to the largest value so far
ROOM = 2.0**-10  # the tail must be below ROOM TAIL for the length to be doubled
PATIENCE, MOST_PATIENCE = 2, 16
ROUGH = 2  # a jump of a derivative up to this order: elements start short again
START = 2.0  # first length after a jump, in time constants of the fastest mode
FEWEST_BITS = 30  # lengths below 2^-FEWEST_BITS of the first are rounding
FLOOR = 1e-4  # a signal is judged by this part of the largest one at least: zero is zero within rounding
SHARE = 1e-2  # and by this part of its largest response to any of the inputs
ROUNDING = 1e-14
LEFT = 1e-9  # of an element: closer than this to an edge from the right is the edge, seen from the left
MOST_ELEMENTS = 40_000
LARGEST = 1e150


@dataclass(frozen=True, slots=True, eq=False)
class _Map:
    """(x_0, H, v) -> Chebyshev coefficients of (z, o), shape (P, m + o, ...), and -> x at the end.

    weight: largest entries of the coefficients, (m + o, ...).
    """

    coefficients: np.ndarray
    end: np.ndarray
    weight: np.ndarray


class Steps:
    """Responses of a Network to unit steps of all its inputs at t = 0, from rest; `run` goes on where it stopped."""

    def __init__(self, system: Network):
        self.system = system
        n, self.m = system.B.shape
        self.inputs, self.outputs = system.E.shape[1], len(system.Co)
        self.t, self.x = 0.0, np.zeros((n, self.inputs))
        self.edges, self.coefficients = np.zeros(1024), np.zeros((1024, P, self.m + self.outputs, self.inputs))
        self.count = 0
        self.breakpoints = Breakpoints(system)
        self.upcoming = self.breakpoints.next()
        modes = np.abs(np.linalg.eigvals(system.A)) if n else np.zeros(0)
        times = [*(START / modes[modes > 0]), *system.theta]
        self.unit = min(times, default=1.0)
        self.h = self.restart = self.unit
        self.good, self.patience = 0, PATIENCE  # elements accepted in a row, and how many before a longer one is tried
        self.maps: dict[float, _Map] = {}
        self.largest = np.full((self.m + self.outputs, self.inputs), 1e-300)

    def run(self, t_end: float) -> None:
        """On to t_end, or until an unstable response is beyond all bounds."""
        with np.errstate(over="ignore", invalid="ignore"):
            while self.t < t_end * (1 - 1e-12) and not self.overflowed:
                self._pass_breakpoints()
                self._step()

    @property
    def overflowed(self) -> bool:
        """Whether the response has left the range of numbers worth showing."""
        return not np.all(self.largest < LARGEST)

    def pieces(self) -> Pieces:
        """What there is so far: values [y_1 .. y_N, u_1 .. u_N] x [r, d_1 .. d_N]."""
        edges = np.append(self.edges[: self.count], self.t)
        return Pieces(edges, self.coefficients[: self.count, :, self.m :])

    def _pass_breakpoints(self) -> None:
        while self.upcoming is not None and self.upcoming[0] <= self.t:
            if self.upcoming[1] <= ROUGH:
                self.h, self.good, self.patience = min(self.h, self.restart), 0, PATIENCE
            self.upcoming = self.breakpoints.next()

    def _step(self) -> None:
        left = math.inf if self.upcoming is None else self.upcoming[0] - self.t
        rough = self.h == self.restart
        for _ in range(FEWEST_BITS):
            last = left <= self.h * (1 + 1e-9)
            length = left if last else self.h
            values, x, tail = self._try(length)
            if tail <= 1:
                break
            self.good, self.patience = 0, min(2 * self.patience, MOST_PATIENCE)
            while self.h >= length * (1 - 1e-9):
                self.h /= 2
        if rough:
            self.restart = min(self.restart, self.h)
        self._keep(values, x, self.upcoming[0] if last else self.t + length)
        self.good += 1
        if not last and (tail < ROOM or self.good >= self.patience):
            self.h *= 2
            self.good = 0

    def _try(self, length: float) -> tuple[np.ndarray, np.ndarray, float]:
        """One element: coefficients, state at its end, size of the tail relative to what is allowed."""
        key = float(f"{length:.13e}")
        made = self.maps.get(key)
        if made is None:
            made = self.maps[key] = _map(self.system, key)
        known = np.concatenate([self.x, self._history(length), np.eye(self.inputs)])
        values = made.coefficients @ known
        size = np.maximum(self.largest, np.max(np.abs(values), axis=0))
        floor = np.maximum(FLOOR * np.max(size), SHARE * np.max(size, axis=1, keepdims=True))
        noise = ROUNDING * (made.weight @ np.abs(known))  # what cannot be seen in the tail for rounding
        tail = np.maximum(np.abs(values[-1]), np.abs(values[-2]))
        tail = np.maximum(tail - noise, 0.0) / (TAIL * np.maximum(size, floor))
        return values, made.end @ known, float(np.max(tail))

    def _history(self, length: float) -> np.ndarray:
        """H: w at the nodes as far as it lies before this element, (m P, inputs)."""
        found = np.zeros((self.m, P, self.inputs))
        if not self.count:
            return found.reshape(-1, self.inputs)
        edges = self.edges[: self.count]
        for i, theta in enumerate(self.system.theta.tolist()):
            at = self.t - theta + length * NODES
            inside = length * NODES <= theta * (1 + LEFT)  # what is later belongs to this element
            piece = np.searchsorted(edges, at - LEFT * length, side="right") - 1
            known = inside & (piece >= 0)
            if not known.any():
                continue
            piece = piece[known]
            start = edges[piece]
            end = np.append(edges[1:], self.t)[piece]
            x = np.clip(2 * (at[known] - start) / (end - start) - 1, -1.0, 1.0)
            found[i, known] = np.einsum("jk,jkv->jv", chebyshev.chebvander(x, P - 1), self.coefficients[piece, :, i, :])
        return found.reshape(-1, self.inputs)

    def _keep(self, values: np.ndarray, x: np.ndarray, end: float) -> None:
        if self.count >= MOST_ELEMENTS:
            raise InvalidParameter(
                f"the horizon must need at most {MOST_ELEMENTS} elements, got more by t = {self.t:.3g}: "
                "the loop oscillates too fast for it"
            )
        if self.count == len(self.edges):
            self.edges = np.concatenate([self.edges, np.zeros_like(self.edges)])
            self.coefficients = np.concatenate([self.coefficients, np.zeros_like(self.coefficients)])
        self.edges[self.count], self.coefficients[self.count] = self.t, values
        self.count += 1
        self.largest = np.maximum(self.largest, np.max(np.abs(values), axis=0))
        self.t, self.x = end, x


def _map(system: Network, length: float) -> _Map:
    """The element of this length, with what of the delays lies within it."""
    n, m = system.B.shape
    states = element(system, length).states  # (P, n, n + m P + v)
    width = states.shape[2]
    w = np.zeros((P, m, width))
    for i in range(m):
        w[np.arange(P), i, n + i * P + np.arange(P)] = 1.0
    z, o = system.C @ states + system.D @ w, system.Co @ states + system.Do @ w
    z[:, :, n + m * P :] += system.F
    o[:, :, n + m * P :] += system.Fo
    within = np.zeros((m, P, m, P))
    for i, theta in enumerate(system.theta.tolist()):
        own = length * NODES > theta * (1 + LEFT)
        place = 2 * (NODES[own] - theta / length) - 1
        within[i, own, i, :] = chebyshev.chebvander(place, P - 1) @ TO_CHEBYSHEV
    solved = np.eye(width)
    if within.any():
        within = within.reshape(m * P, m * P)
        z_flat = z.transpose(1, 0, 2).reshape(m * P, width)  # same order as the w in the columns
        right = np.zeros((m * P, width))
        right[:, n : n + m * P] = np.eye(m * P)
        right[:, :n] += within @ z_flat[:, :n]
        right[:, n + m * P :] += within @ z_flat[:, n + m * P :]
        at = slice(n, n + m * P)
        solved[at] = np.linalg.solve(np.eye(m * P) - within @ z_flat[:, at], right)
    both = np.concatenate([z, o], axis=1) @ solved
    coefficients = np.tensordot(TO_CHEBYSHEV, both, (1, 0))
    return _Map(coefficients, states[-1] @ solved, np.max(np.abs(coefficients), axis=0))
