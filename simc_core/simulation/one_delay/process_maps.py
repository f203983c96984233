"""What a stretch of time does to plants and to what their controllers measure: the same for all tunings of a plant.

    w --> [ g ] --> y --> [ 1/(tau_F s + 1) ] --> p        w: input of the plant behind its dead time, y = g w

The controller sees p (y itself for tau_F = 0), its slope p' if it has derivative action, and its integral. On an
element of length h all signals are polynomials given at the P Radau nodes (elements.py), and integration from the
start of the element is the matrix K = h a. Each section (b2 s^2 + b1 s + b0)/(a s^2 + b s + c) of the chain
(state_space.py) turns v into x and its output, b0 x + b1 x' + b2 x'', by

    a x'' + b x' + c x = v     with W = x'':   (a + b K + c K^2) W = v - b x'_0 - c (x_0 + K x'_0)
           b x' + c x = v      with W = x':    (b + c K) W = v - c x_0

which is the collocation method of the whole chain. Columns of every map: (w at the nodes, x_0). On the way through the
chain rows are kept in coordinates in which all functions of K are triangular but for blocks (schur_form.py). What the
states at the start do of themselves, x_0 + x'_0 t, is added last, to values at the nodes: there it is exact, so that
a loop at rest stays there.

Plants of one structure, whose sections have the same coefficients other than 0, are done together, each in a time unit
of its own: then all of them have the same elements.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from simc_core.algebra.factors import Factored
from simc_core.algebra.state_space import Row, sections
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import factored_plant
from simc_core.plants.plant import Plant
from simc_core.simulation.collocation.elements import NODES
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.collocation.schur_form import BACK, Q, T, inverse, polynomial
from simc_core.wording import said

SIGNALS = 4  # y, p, p', integral of p
Rows = tuple[np.ndarray, np.ndarray, np.ndarray]
Chosen = slice | np.ndarray  # some of the plants, or all of them, along the first axis of an array
EVERY = slice(None)
INTEGRAL = Q @ T  # from the coordinates of schur_form.py to the integral at the nodes, over h
AT_END = Q[-1], INTEGRAL[-1], INTEGRAL[-1] @ T  # to the value at the end, to its integral, over h, and to that of it


class Ramps(NamedTuple):
    """The signals 1 and t/h, or their integrals over h, at the nodes or in the coordinates of schur_form.py."""

    constant: np.ndarray
    ramp: np.ndarray


AT_NODES, INTEGRATED = Ramps(np.ones(P), NODES), Ramps(NODES, NODES**2 / 2)
IN_SCHUR_FORM = Ramps(BACK @ np.ones(P), BACK @ NODES)


class ProcessMaps:
    """The chains of m plants and their measurement filters, all of one structure, and their maps for any length.

    units: of time, one a plant.   tau_F: filters, one a plant, all 0 or none.
    Raises InvalidParameter: derivative action without filter on a plant whose response starts with a jump.
    """

    def __init__(self, plants: Sequence[Plant], tau_F: Sequence[float], derivative: bool, units: Sequence[float]):
        chains = [chain_of(plant, unit) for plant, unit in zip(plants, units, strict=True)]
        self.gain = np.array([plant.k for plant in plants])[:, None, None, None]
        self.theta = plants[0].theta / units[0]
        self.filtered = tau_F[0] > 0
        self.tau_F = np.array(tau_F) / np.array(units)  # (m,)
        self.sections = [
            (_rows(num), _rows(den)) for num, den in (zip(*each, strict=True) for each in zip(*chains, strict=True))
        ]
        self.count = len(plants)
        self.derivative = derivative
        self.n = sum(2 if den[0] else 1 for _, den in chains[0]) + self.filtered
        if derivative and not self.filtered and not _strictly_proper(chains[0]):
            raise InvalidParameter(
                said("tau_F must be > 0 for derivative action on a plant whose response starts with a jump, found 0")
            )
        self.modes = modes(factored_plant(plants[0]), tau_F[0]) * units[0]
        self.relative_degree = factored_plant(plants[0]).relative_degree

    def elements(self, lengths: np.ndarray, which: Chosen = EVERY) -> tuple[np.ndarray, np.ndarray]:
        """Of single elements: signals (4, m, lengths, P, P + n) and states at the end (m, lengths, n, P + n).

        which: of the plants, m of them. Without derivative action p' is left at 0.
        """
        gain, tau_F, length = self.gain[which], self.tau_F[which, None, None, None], lengths[:, None, None]
        shape = len(gain), len(lengths)
        signals, ends = np.zeros((SIGNALS, *shape, P, P + self.n)), np.zeros((*shape, self.n, P + self.n))
        v = np.zeros((*shape, P, P + self.n))
        v[..., :P] = gain * BACK
        last, W, y = None, v, v
        for num, den in self.sections:
            last = _Section(_of(num, which), _of(den, which), length, last)
            W, y = last.through(y, ends)
        _to_nodes(Q, y, last, AT_NODES, signals[0])
        p = y
        if self.filtered:
            one = np.ones_like(tau_F)
            last = _Section((0 * one, 0 * one, one), (0 * one, tau_F, one), length, last)
            W, p = last.through(y, ends)
            _to_nodes(Q, p, last, AT_NODES, signals[1])
        else:
            signals[1] = signals[0]
        if self.derivative and last:
            last.slope(W, signals[2])
        _to_nodes(length * INTEGRAL, p, last, Ramps(*(length[..., 0] * each for each in INTEGRATED)), signals[3])
        return signals, ends


class _Section:
    """One section of the chain on elements of `length`; before: the one that drives it, None for the first."""

    def __init__(self, num: Rows, den: Rows, length: np.ndarray, before: "_Section | None"):
        self.num, self.den, self.length, self.before = num, den, length, before
        self.order = 2 if den[0].any() else 1
        self.x_0: int = before.x_0 + before.order if before else P  # column of its first state

    def through(self, v: np.ndarray, ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """W and the output, from the input v, both without `add_free`; the states at the end go into `ends`."""
        (b2, b1, b0), (a, b, c) = self.num, self.den
        h, x_0, right = self.length, self.x_0, v.copy()
        if self.before:
            self.before.add_free(right, IN_SCHUR_FORM)
        right[..., x_0] -= c[..., 0] * IN_SCHUR_FORM.constant
        if self.order == 2:
            right[..., x_0 + 1] -= b[..., 0] * IN_SCHUR_FORM.constant + (c * h)[..., 0] * IN_SCHUR_FORM.ramp
            W, out = inverse(polynomial((a, b, c), h)) @ right, polynomial((b2, b1, b0), h)
        else:
            W, out = inverse(polynomial((b, c), h)) @ right if c.any() else right / b, polynomial((b1, b0), h)
        for state, times in enumerate(range(self.order, 0, -1)):  # x, and x' of a section of second order
            end = ends[:, :, x_0 - P + state]
            end[:] = h[..., 0] ** times * (AT_END[times] @ W)
            end[..., x_0 + state] += 1.0
            if times == 2:
                end[..., x_0 + 1] += h[..., 0, 0]
        return W, out @ W

    def add_free(self, out: np.ndarray, of: Ramps) -> None:
        """To an output, or to what was made of it, what the states at the start do of themselves."""
        _, b1, b0 = (each[..., 0] for each in self.num)
        out[..., self.x_0] += b0 * of.constant
        if self.order == 2:
            out[..., self.x_0 + 1] += b1 * of.constant + b0 * self.length[..., 0] * of.ramp

    def slope(self, W: np.ndarray, out: np.ndarray) -> None:
        """That of the output at the nodes, right where the section is strictly proper, into `out`."""
        _, b1, b0 = self.num
        np.matmul(Q, b0 * W if self.order == 1 else polynomial((b1, b0), self.length) @ W, out=out)
        if self.order == 2:
            out[..., self.x_0 + 1] += b0[..., 0]


def _to_nodes(matrix: np.ndarray, of: np.ndarray, section: _Section | None, free: Ramps, out: np.ndarray) -> None:
    """matrix times an output of `section`, with what its states at the start do, into `out`."""
    np.matmul(matrix, of, out=out)
    if section:
        section.add_free(out, free)


@lru_cache(maxsize=1024)  # for many plants it is asked twice: which are alike, and what they do
def chain_of(plant: Plant, unit: float) -> list[tuple[Row, Row]]:
    """Sections of a plant, time in `unit`."""
    return sections(factored_plant(plant), unit)


def modes(factored: Factored, tau_F: float) -> np.ndarray:
    """Poles of a plant and of its filter, complex, rad per time."""
    return np.array([*factored.poles, *([-1 / tau_F] if tau_F else [])])


def _strictly_proper(chain: list[tuple[Row, Row]]) -> bool:
    if not chain:
        return False
    (b2, b1, _), (a, _, _) = chain[-1]
    return (b2 if a else b1) == 0


def _rows(rows: Sequence[Row]) -> Rows:
    """A coefficient of each plant, (m, 1, 1, 1), three times."""
    a, b, c = np.array(rows).T[..., None, None, None]
    return a, b, c


def _of(rows: Rows, which: Chosen) -> Rows:
    a, b, c = rows
    return a[which], b[which], c[which]
