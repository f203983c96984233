"""What one element of a loop with several dead times does, as constant matrices (Radau collocation, elements.py).

    X_i = x_0 + sum_j h a_ij (A X_j + B w_j + E v)        z = C X + D w + F v,   o = Co X + Do w + Fo v

Where the element is longer than a dead time, part of w is the element itself, and is solved for at once:

    w = H + M z,    z = Zx x_0 + Zw w + Zv v    =>    w = (1 - M Zw)^-1 (H + M (Zx x_0 + Zv v))

with H the part from earlier elements and M the interpolation within the element.

The states are in such an order that few need later ones: blocks are solved one after the other, mostly of one state
or two. What a small block or M comes to is kept: loops that differ in their controllers have it in common. The rows
of fast states are large; divided by their size, elimination keeps three digits more.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.simulation.collocation.elements import COLLOCATION, NODES, TO_CHEBYSHEV
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.several_delays.network import Network

SMALL = 2  # states of a block whose solution is kept
KEPT = 512
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
    within = _within(tuple(system.theta.tolist()), length)
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
    found = np.zeros((n, P, n + m * P + system.E.shape[1]))  # what is known, and then the states
    found[:, :, :n] = np.eye(n)[:, None]
    found[:, :, n : n + m * P] = (system.B[:, None, :, None] * h[:, None, :]).reshape(n, P, m * P)
    found[:, :, n + m * P :] = length * NODES[:, None] * system.E[:, None]
    for begin, end in system.blocks:
        A, own = system.A[begin:end], found[begin:end]
        if A[:, :begin].any():
            own += h @ np.tensordot(A[:, :begin], found[:begin], 1)
        matrix = A[:, begin:end]
        if end - begin <= SMALL:
            own[:] = (_inverse(matrix.tobytes(), length) @ own.reshape(-1, own.shape[2])).reshape(own.shape)
        else:
            own[:] = _solved(matrix, length, own.reshape(-1, own.shape[2])).reshape(own.shape)
    return found


@lru_cache(maxsize=KEPT)
def _inverse(block: bytes, length: float) -> np.ndarray:
    """What a block of states, alone, makes of a right-hand side."""
    A = np.frombuffer(block)
    n = round(len(A) ** 0.5)
    return _solved(A.reshape(n, n), length, np.eye(n * P))


def _solved(A: np.ndarray, length: float, known: np.ndarray) -> np.ndarray:
    n = len(A)
    matrix = -(A[:, None, :, None] * (length * COLLOCATION)[:, None, :]).reshape(n * P, n * P)
    matrix.flat[:: n * P + 1] += 1.0
    size = np.repeat(1 + length * np.abs(A).sum(axis=1), P)[:, None]
    return np.linalg.solve(matrix / size, known / size)


@lru_cache(maxsize=KEPT)
def _within(theta: tuple[float, ...], length: float) -> np.ndarray:
    """Interpolation of w within the element: (m P, m P), of z at the nodes onto w at the nodes."""
    m = len(theta)
    found = np.zeros((m, P, m, P))
    for i in range(m):
        own = length * NODES > theta[i] * (1 + LEFT)
        if own.any():
            place = 2 * (NODES[own] - theta[i] / length) - 1
            found[i, own, i, :] = chebyshev.chebvander(place, P - 1) @ TO_CHEBYSHEV
    return found.reshape(m * P, m * P)
