"""Unit step responses of a loop by the spectral method of steps.

One interval [0, theta] is filled with elements (elements.py); collapsed, they are one constant matrix

    (x_k, w_k, v) -> (x_{k+1}, w_{k+1}, v)        w_k: z on the interval before, at all nodes

because what the delay returns on an interval is z on the one before, at the same nodes. Jumps at k theta are edges of
elements and cost no accuracy. Without dead time the elements follow one another over the whole horizon.

Where theta is tiny against the horizon the matrix is squared instead: once the response is smooth, long pieces are
interpolated at instants k theta, and each is checked by the decay of its Chebyshev coefficients.
"""

import math

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.errors import InvalidParameter
from simc_core.simulation.elements import TO_CHEBYSHEV, P, element, mesh
from simc_core.simulation.pieces import Pieces
from simc_core.simulation.system import DelaySystem

FEW = 4  # intervals per row of the matrix that are simply stepped; more are doubled
MOST_INTERVALS = 20_000  # kept one by one
EXACT_START = 512  # intervals kept one by one before long pieces are tried
SMOOTH = 1e-12  # last coefficients of a long piece, relative to its largest
LARGEST = 1e200  # an unstable response is cut off here


def unit_steps(system: DelaySystem, t_end: float) -> Pieces:
    """y and u for a unit step of r and of d at t = 0, from rest: pieces with values [y, u] x [r, d] to t_end or beyond.

    Raises InvalidParameter where the work would exceed the bounds of this module and of elements.py.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        return _free(system, t_end) if not system.theta else _delayed(system, t_end)


def _free(system: DelaySystem, t_end: float) -> Pieces:
    """No dead time: one element after the other."""
    lengths = mesh(system.A, t_end)
    made = {h: element(system, h).states for h in set(lengths.tolist())}
    n = len(system.A)
    x, nodes = np.zeros((n, 2)), np.empty((len(lengths), P, 2, 2))
    for i, h in enumerate(lengths.tolist()):
        states = made[h][:, :, :n] @ x + made[h][:, :, n:]
        nodes[i] = system.Co @ states + system.Fo
        x = states[-1]
    return _pieces(np.concatenate([[0.0], np.cumsum(lengths)]), nodes)


def _delayed(system: DelaySystem, t_end: float) -> Pieces:
    lengths = mesh(system.A, system.theta)
    onwards, outputs = _interval(system, lengths)
    intervals = math.ceil(t_end / system.theta * (1 - 1e-12))
    start = np.zeros((len(onwards), 2))
    start[-2:] = np.eye(2)
    if intervals <= MOST_INTERVALS:
        states = _all(onwards, start, max(intervals, 1))
        return _expanded(outputs, states, lengths, system.theta)
    near = _expanded(outputs, _all(onwards, start, EXACT_START), lengths, system.theta)
    return _long(onwards, outputs, start, near, intervals, system.theta)


def _interval(system: DelaySystem, lengths: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The constant matrix (N, N) of one interval, and y, u at its nodes, (elements p, 2, N); N = n + elements p + 2."""
    n, total = len(system.A), len(lengths) * P
    N = n + total + 2
    made = {h: element(system, h).states for h in set(lengths.tolist())}
    x = np.zeros((n, N))
    x[:, :n] = np.eye(n)
    onwards, outputs = np.zeros((N, N)), np.empty((total, 2, N))
    onwards[-2:, -2:] = np.eye(2)
    for i, h in enumerate(lengths.tolist()):
        at = slice(n + i * P, n + (i + 1) * P)
        states = made[h][:, :, :n] @ x
        states[:, :, at] += made[h][:, :, n : n + P]
        states[:, :, -2:] += made[h][:, :, n + P :]
        rows = slice(i * P, (i + 1) * P)
        w = np.zeros((P, 1, N))
        w[np.arange(P), 0, n + i * P + np.arange(P)] = 1.0
        onwards[at] = (system.C @ states + system.D @ w)[:, 0]
        onwards[at, -2:] += system.F
        outputs[rows] = system.Co @ states + system.Do @ w
        outputs[rows, :, -2:] += system.Fo
        x = states[-1]
    onwards[:n] = x
    return onwards, outputs


def _all(onwards: np.ndarray, start: np.ndarray, count: int) -> np.ndarray:
    """start, M start, M^2 start, ...: (count, N, 2)."""
    states = np.empty((count, *start.shape))
    states[0] = start
    done = 1
    while done < min(count, FEW * len(onwards)):
        states[done] = onwards @ states[done - 1]
        done += 1
    power = np.linalg.matrix_power(onwards, done) if done < count else onwards
    while done < count:
        more = min(done, count - done)
        flat = states[:more].transpose(1, 0, 2).reshape(len(onwards), -1)
        states[done : done + more] = (power @ flat).reshape(len(onwards), more, 2).transpose(1, 0, 2)
        done += more
        power = power @ power if done < count else power
    return states


def _expanded(outputs: np.ndarray, states: np.ndarray, lengths: np.ndarray, theta: float) -> Pieces:
    """Pieces of all intervals, element by element."""
    count = len(states)
    flat = states.transpose(1, 0, 2).reshape(states.shape[1], -1)
    nodes = (outputs.reshape(-1, outputs.shape[2]) @ flat).reshape(len(lengths), P, 2, count, 2)
    nodes = nodes.transpose(3, 0, 1, 2, 4).reshape(count * len(lengths), P, 2, 2)
    within = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    edges = (theta * np.arange(count)[:, None] + within).ravel()
    return _pieces(np.append(edges, theta * count), nodes)


def _long(onwards, outputs, start, near: Pieces, intervals: int, theta: float) -> Pieces:
    """Long pieces behind the exact start, doubled where the coefficients allow it."""
    places = (1 - np.cos(np.pi * np.arange(P) / (P - 1))) / 2  # Chebyshev points of [0, 1], in whole intervals below
    offsets = np.round(EXACT_START / 2 * places).astype(int)
    begin = outputs[0]  # just after k theta
    back = np.linalg.inv(chebyshev.chebvander(2 * offsets / offsets[-1] - 1, P - 1))
    powers = [np.linalg.matrix_power(onwards, int(k)) for k in offsets]
    state = np.linalg.matrix_power(onwards, EXACT_START) @ start
    now, length = EXACT_START, int(offsets[-1])
    edges, kept, history = [], [], []
    while now < intervals:
        values = np.array([begin @ power @ state for power in powers])
        coefficients = np.tensordot(back, values, (1, 0))
        scale = np.max(np.abs(coefficients)) + 1e-300
        if np.max(np.abs(coefficients[-2:])) > SMOOTH * scale * 1e3:
            if not history:
                raise InvalidParameter(
                    f"t_end must be at most {MOST_INTERVALS} theta = {MOST_INTERVALS * theta:g} for a loop "
                    f"that oscillates this fast, got {intervals * theta:g}"
                )
            powers, length = history.pop()
            continue
        edges.append(now * theta)
        kept.append(coefficients)
        state, now = powers[-1] @ state, now + length
        if np.max(np.abs(coefficients[-4:])) < SMOOTH * scale:
            history.append((powers, length))
            powers, length = [power @ power for power in powers], 2 * length
    return Pieces(np.concatenate([near.edges[:-1], edges, [now * theta]]), np.concatenate([near.coefficients, kept]))


def _pieces(edges: np.ndarray, nodes: np.ndarray) -> Pieces:
    """Nodal values (m, p, 2, 2) as pieces, without those behind an overflow."""
    good = np.all(np.abs(nodes) < LARGEST, axis=(1, 2, 3))
    count = len(nodes) if good.all() else max(int(np.argmin(good)), 1)
    coefficients = np.tensordot(nodes[:count], TO_CHEBYSHEV, (1, 1)).transpose(0, 3, 1, 2)
    return Pieces(edges[: count + 1], coefficients)
