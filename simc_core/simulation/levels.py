"""Elements of theta 2^level and the mesh of one interval, with the interpolations that a dead time needs; all cached.

What a plant does on an element does not depend on the tuning (measured.py), and where the nodes of one element meet
those of another depends on their levels alone. Without dead time the unit is the plant's fastest time constant.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.plant import Plant
from simc_core.simulation.elements import NODES, TO_CHEBYSHEV, P, mesh
from simc_core.simulation.measured import SIGNALS, Maps, Measured

AHEAD = 6  # levels made at once


@dataclass(frozen=True, slots=True, eq=False)
class Level:
    """Maps of one element. B: (P, P), its own z at t - theta.   loops: B times the parts w -> p, p', int p, (3, P, P)."""

    maps: Maps
    B: np.ndarray
    loops: np.ndarray


class Levels:
    """Of one plant behind one filter. mesh: one interval theta, fine at its start; None without dead time."""

    def __init__(self, chain: Measured):
        self.chain, self.theta = chain, chain.theta
        size = np.abs(chain.modes)
        self.unit = chain.theta or float(1 / np.max(size, initial=0.0) if size.any() else 1.0)
        self.mesh = chain.row(mesh(chain.modes, chain.theta)) if chain.theta else None
        self.shape = tuple(h / self.theta for h in self.mesh.lengths) if self.mesh else ()
        self._made: dict[int, Level] = {}

    def __getitem__(self, level: int) -> Level:
        if level not in self._made:
            wanted = [each for each in range(level, level + AHEAD) if each not in self._made]
            made = self.chain.elements(self.unit * 2.0 ** np.array(wanted))
            self._made |= {each: self._level(each, maps) for each, maps in zip(wanted, made, strict=True)}
        return self._made[level]

    def _level(self, level: int, maps: Maps) -> Level:
        B = _within(level) if self.theta else np.eye(P)
        parts = maps.signals[P : SIGNALS * P, self.chain.n :].reshape(SIGNALS - 1, P, P)
        return Level(maps, B, B @ parts)

    def history(self, before: int, level: int) -> np.ndarray:
        """From z at the nodes of the element before to z(t - theta) at those of the next, as far as it lies there.

        Level 0 is the mesh, on either side.
        """
        if before:
            return _from_element(before, level, () if level else self.shape)
        return _from_mesh(self.shape, level)


@lru_cache(maxsize=64)
def levels(plant: Plant, tau_F: float, derivative: bool) -> Levels:
    """Raises InvalidParameter as Measured does."""
    return Levels(Measured(plant, tau_F, derivative))


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
