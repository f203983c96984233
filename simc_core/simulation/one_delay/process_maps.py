"""What a stretch of time does to plants and to what their controllers measure: the same for all tunings of a plant.

    w --> [ g ] --> y --> [ 1/(tau_F s + 1) ] --> p        w: input of the plant behind its dead time, y = g w

The controller sees p (y itself for tau_F = 0), its slope p' if it has derivative action, and its integral. On an
element of length h all signals are polynomials given at the P Radau nodes (elements.py), and integration from the
start of the element is the matrix K = h a. Each section of the chain (realisation.py) turns v into x by

    a x'' + b x' + c x = v     with W = x'':   (a + b K + c K^2) W = v - b x'_0 - c (x_0 + K x'_0)
           b x' + c x = v      with W = x':    (b + c K) W = v - c x_0

which is the collocation method of the whole chain. Columns of every map: (w at the nodes, x_0).

Plants of one structure, whose sections have the same coefficients other than 0, are done together, each in a time unit
of its own: then all of them have the same elements.
"""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from simc_core.algebra.factors import Factored
from simc_core.algebra.state_space import Row, sections
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import factored_plant
from simc_core.plants.plant import Plant
from simc_core.simulation.collocation.elements import COLLOCATION
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.collocation.shifted import solved
from simc_core.wording import said

SIGNALS = 4  # y, p, p', integral of p
Rows = tuple[np.ndarray, np.ndarray, np.ndarray]
Chosen = slice | np.ndarray  # some of the plants, or all of them, along the first axis of an array
EVERY = slice(None)
EYE = np.eye(P)


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

        which: of the plants, m of them.
        """
        gain, tau_F = self.gain[which], self.tau_F[which, None, None, None]
        n, m, count, length = self.n, len(gain), len(lengths), lengths[:, None, None]
        v, ends = np.zeros((m, count, P, P + n)), np.zeros((m, count, n, P + n))
        v[:, :, :, :P] = gain * EYE
        slope, used = np.zeros_like(v), 0
        for num, den in self.sections:
            v, slope, used = _section(_of(num, which), _of(den, which), length, v, ends, used)
        outputs = np.empty((SIGNALS, m, count, P, P + n))
        outputs[0] = v
        if self.filtered:
            one = np.ones((m, 1, 1, 1))
            v, slope, used = _section((0 * one, 0 * one, one), (0 * one, tau_F, one), length, v, ends, used)
        outputs[1], outputs[2] = v, slope
        np.matmul(length * COLLOCATION, v, out=outputs[3])
        return outputs, ends


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


def _section(
    num: Rows, den: Rows, length: np.ndarray, v: np.ndarray, ends: np.ndarray, used: int
) -> tuple[np.ndarray, np.ndarray, int]:
    """One section: its output and the slope of it, and the next free state; the states at the end go into `ends`.

    The slope is right where the section is strictly proper.
    """
    (b2, b1, b0), (a, b, c) = num, den
    K, right, x_0 = length * COLLOCATION, v.copy(), P + used
    right[..., x_0] -= c[..., 0]
    if not a.any():
        W = solved(b, c, a, length, right) if c.any() else right / b
        x = K @ W
        x[..., x_0] += 1.0
        ends[:, :, used] = x[:, :, -1]
        return (b0 * x + b1 * W if b1.any() else b0 * x), b0 * W, used + 1
    ramp = K.sum(axis=2)  # K applied to 1
    right[..., x_0 + 1] -= b[..., 0] + c[..., 0] * ramp
    W = solved(a, b, c, length, right)
    first = K @ W
    first[..., x_0 + 1] += 1.0
    x = K @ first
    x[..., x_0] += 1.0
    ends[:, :, used], ends[:, :, used + 1] = x[:, :, -1], first[:, :, -1]
    out = b0 * x + b1 * first + b2 * W if b1.any() or b2.any() else b0 * x
    return out, b0 * first + b1 * W, used + 2
