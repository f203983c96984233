"""What one element of a loop with several dead times does, as constant matrices (Radau collocation, elements.py).

    X_i = x_0 + sum_j h a_ij (A X_j + B w_j + E v)        z = C X + D w + F v,   o = Co X + Do w + Fo v

Where the element is longer than a dead time, part of w is the element itself, and is solved for at once:

    w = H + M z,    z = Zx x_0 + Zw w + Zv v    =>    w = (1 - M Zw)^-1 (H + M (Zx x_0 + Zv v))

with H the part from earlier elements and M the interpolation within the element. The rows of fast states are
large; divided by their size, elimination keeps three digits more.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.simulation.collocation.elements import COLLOCATION, NODES, TO_CHEBYSHEV
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.several_delays.network import Network

LEFT = 1e-9  # of an element: closer than this to an edge from the right is the edge, seen from the left


@dataclass(frozen=True, slots=True, eq=False)
class DelayMap:
    """(x_0, H, v), H at the nodes (m P), onto what an element leaves.

    coefficients: ((m + o) P, n + m P + v), the Chebyshev coefficients of each of (z, o).   end: x at its end.
    weight: (m + o, n + m P + v), the largest entries of the coefficients.
    """

    coefficients: np.ndarray
    end: np.ndarray
    weight: np.ndarray


def delay_map(system: Network, length: float) -> DelayMap:
    """The element of this length."""
    n, m = system.B.shape
    states = _states(system, length)  # (n, P, width)
    width = states.shape[2]
    C, D, F = (np.concatenate(pair) for pair in ((system.C, system.Co), (system.D, system.Do), (system.F, system.Fo)))
    both, end = (C @ states.reshape(n, P * width)).reshape(len(C), P, width), states[:, -1]
    nodes = np.arange(P)
    for j in range(m):
        both[:, nodes, n + j * P + nodes] += D[:, j, None]
    both[:, :, n + m * P :] += F[:, None]
    within = _within(system.theta, length)
    if within.any():
        flat, at = both[:m].reshape(m * P, width), slice(n, n + m * P)
        solved = np.eye(width)
        right = within @ flat
        right[:, at] = np.eye(m * P)
        solved[at] = np.linalg.solve(np.eye(m * P) - within @ flat[:, at], right)
        both, end = both @ solved, end @ solved
    coefficients = TO_CHEBYSHEV @ both
    return DelayMap(coefficients.reshape(-1, width), end, np.max(np.abs(coefficients), axis=1))


def _states(system: Network, length: float) -> np.ndarray:
    """States at the nodes from (x_0, w, v), (n, P, n + m P + v)."""
    n, m = system.B.shape
    h = length * COLLOCATION
    known = np.zeros((n, P, n + m * P + system.E.shape[1]))
    known[:, :, :n] = np.eye(n)[:, None]
    known[:, :, n : n + m * P] = (system.B[:, None, :, None] * h[:, None, :]).reshape(n, P, m * P)
    known[:, :, n + m * P :] = length * NODES[:, None] * system.E[:, None]
    matrix = -(system.A[:, None, :, None] * h[:, None, :]).reshape(n * P, n * P)
    matrix.flat[:: n * P + 1] += 1.0
    size = np.repeat(1 + length * np.abs(system.A).sum(axis=1), P)[:, None]
    return np.linalg.solve(matrix / size, known.reshape(n * P, -1) / size).reshape(known.shape)


def _within(theta: np.ndarray, length: float) -> np.ndarray:
    """Interpolation of w within the element: (m P, m P), of z at the nodes onto w at the nodes."""
    m = len(theta)
    found = np.zeros((m, P, m, P))
    for i in range(m):
        own = length * NODES > theta[i] * (1 + LEFT)
        if own.any():
            place = 2 * (NODES[own] - theta[i] / length) - 1
            found[i, own, i, :] = chebyshev.chebvander(place, P - 1) @ TO_CHEBYSHEV
    return found.reshape(m * P, m * P)
