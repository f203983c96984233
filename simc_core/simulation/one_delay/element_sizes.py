"""Elements of theta 2^level and the mesh of one interval, with the interpolations that a dead time needs; all cached.

What a plant does on an element does not depend on the tuning (process_maps.py), and where the nodes of one element meet
those of another depends on their levels alone. Without dead time the unit is the plant's fastest time constant.
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.plants.plant import Plant
from simc_core.simulation.collocation.elements import NODES, TO_CHEBYSHEV, mesh
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.one_delay.process_maps import EVERY, Chosen, ProcessMaps

AHEAD, MORE = 8, 4  # levels made at once of one plant: at first, and when these do not reach; of several as needed
EYE = np.eye(P)


class Elements(NamedTuple):
    """L levels made together. length (L,), nodes (L, P): from the start of the element.

    B: (L, P, P), its own z at t - theta.   signals: (4, m, L, P, P + n), w and the states at the start -> y, p, p',
    int p at the nodes, of each plant.   ends: (m, L, n, P + n), -> states at the end.
    """

    levels: tuple[int, ...]
    length: np.ndarray
    nodes: np.ndarray
    B: np.ndarray
    signals: np.ndarray
    ends: np.ndarray


class ElementSizes:
    """Of plants of one structure, each behind its filter. mesh: levels of the elements of one interval.

    parts: lengths of these in units of theta, short at its start.   finer: how often they are halved.
    """

    def __init__(self, chain: ProcessMaps, parts: tuple[float, ...], finer: int = 0):
        self.chain, self.theta = chain, chain.theta
        size = np.abs(chain.modes)
        self.unit = chain.theta or float(1 / np.max(size) if size.any() else 1.0)
        self._made: dict[int, Elements] = {}
        self._known: dict[tuple[int, int], np.ndarray] = {}
        self.shape = tuple(part / 2**finer for part in parts for _ in range(2**finer))
        self.mesh = tuple(round(math.log2(part)) for part in self.shape)
        self.alone = chain.count == 1
        self._make(sorted({*self.mesh, *(range(1, 1 + AHEAD) if self.alone or not self.mesh else ())}))

    def __getitem__(self, level: int) -> Elements:
        """The elements that hold this level."""
        if level not in self._made:
            more = range(level, level + (MORE if self.alone else 1))
            self._make([each for each in more if each not in self._made])
        return self._made[level]

    def length(self, level: int) -> float:
        """Of an element."""
        return self.unit * 2.0**level

    def _make(self, wanted: list[int]) -> None:
        self._made |= dict.fromkeys(wanted, self.of(wanted, EVERY))

    def of(self, wanted: list[int], which: Chosen) -> Elements:
        """Elements of these levels for some of the plants, made anew."""
        length = self.unit * 2.0 ** np.array(wanted)
        B = np.array([_within(each) for each in wanted]) if self.theta else EYE[None]
        return Elements(tuple(wanted), length, length[:, None] * NODES, B, *self.chain.elements(length, which))

    def history(self, before: int, level: int) -> np.ndarray:
        """From z at the nodes of the element before to z(t - theta) at those of the next, as far as it lies there.

        Level 0 is the whole mesh, on either side.
        """
        found = self._known.get((before, level))
        if found is None:
            made = (
                _from_element(before, level, () if level else self.shape) if before else _from_mesh(self.shape, level)
            )
            found = self._known[before, level] = made
        return found


@lru_cache(maxsize=64)
def levels(plant: Plant, tau_F: float, derivative: bool, finer: int = 0) -> ElementSizes:
    """Raises InvalidParameter as ProcessMaps does."""
    chain = ProcessMaps([plant], [tau_F], derivative, [1.0])
    return ElementSizes(chain, shape(chain.modes, chain.theta), finer)


def shape(modes: np.ndarray, theta: float) -> tuple[float, ...]:
    """Lengths of the elements of one interval in units of theta; none without dead time."""
    return tuple((mesh(modes, theta) / theta).tolist()) if theta else ()


@lru_cache(maxsize=128)
def _within(level: int) -> np.ndarray:
    own = NODES * 2.0**level > 1
    B = np.zeros((P, P))
    B[own] = _reading(2 * (NODES[own] - 2.0**-level) - 1)
    return B


@lru_cache(maxsize=256)
def _from_element(before: int, level: int, shape: tuple[float, ...]) -> np.ndarray:
    s = _places(shape) if shape else NODES * 2.0**level  # in theta, from the start of the next element
    known = s <= 1
    H = np.zeros((len(s), P))
    H[known] = _reading(1 - 2 * (1 - s[known]) * 2.0**-before)
    return H


@lru_cache(maxsize=64)
def _from_mesh(shape: tuple[float, ...], level: int) -> np.ndarray:
    s = NODES * 2.0**level
    ends = np.cumsum(shape)
    H = np.zeros((P, len(shape) * P))
    for i in np.flatnonzero(s <= 1).tolist():
        e = min(int(np.searchsorted(ends, s[i])), len(shape) - 1)
        x = 2 * (s[i] - ends[e] + shape[e]) / shape[e] - 1
        H[i, e * P : (e + 1) * P] = _reading(np.array([min(x, 1.0)]))[0]
    return H


def _places(shape: tuple[float, ...]) -> np.ndarray:
    """Nodes of the mesh in units of theta."""
    lengths = np.array(shape)
    return ((np.cumsum(lengths) - lengths)[:, None] + lengths[:, None] * NODES).ravel()


def _reading(x: np.ndarray) -> np.ndarray:
    """Values at x in [-1, 1] from those at the nodes."""
    return chebyshev.chebvander(x, P - 1) @ TO_CHEBYSHEV
