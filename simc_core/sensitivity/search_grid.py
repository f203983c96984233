"""The frequencies at which loop transfer functions are looked at for crossings and peaks.

GRID_PER_DECADE nodes per decade, clusters at lightly damped roots, and steps of theta omega <= PHASE_STEP wherever
|L| is large enough to matter: up to theta omega = USUAL for a start, which is enough for most loops. Where |L| is not:
|S| <= 1/(1 - |L|) and |T| <= |L|/(1 - |L|), so that a peak seen on the grid excludes all frequencies with |L| below a
level.

A loop with |L(inf)| near 1 never gets below the level: the grid ends at MOST_NODES, and beyond it 1/(1 - |L|)
itself is the peak, up to (theta omega)^-2.

The grids of several loops stand in one row, with the number of the loop beside each node (segments.py).
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.certificate.segments import geometric, ragged, side_by_side
from simc_core.sensitivity.log_response import Logs, Response, sensitivities

GRID_PER_DECADE = 24
PHASE_STEP = 0.3
USUAL = 14.0  # a gain crossing at theta omega = 0.5 or 1, and two turns
EQUAL = PHASE_STEP * np.arange(round(GRID_PER_DECADE / math.log(10)), round(USUAL / PHASE_STEP))  # theta omega
MOST_NODES = 12_000  # of one loop
LIGHT = 0.35  # damping below which a root gets a cluster
CLUSTER = 1.5 ** np.arange(-4, 40)  # offsets from a resonance, in units of its half width
NARROWEST = 1e-7  # half width of an undamped root, relative

Evaluate = Callable[[np.ndarray, np.ndarray], Logs]  # log L and its derivatives from omega and the number of the loop


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """omega, owner: shape (N,), omega ascending for each loop.   samples: log L, its two derivatives, S, T, (5, N).

    resolved: shape (N-1,), False where the phase of the dead time may turn unseen, or between two loops.
    inside: False only between two loops.   envelopes: by loop, bounds of |S| and |T| beyond the grid, 0 if it
    reaches far enough.
    """

    omega: np.ndarray
    owner: np.ndarray
    samples: np.ndarray
    resolved: np.ndarray
    inside: np.ndarray
    envelopes: list[tuple[float, float]]


def search_grid(responses: Sequence[Response], evaluate: Evaluate) -> Grid:
    """The grid of the module docstring for one or several loops."""
    omega, owner, ends = _base_grid(responses)
    samples = sampled(evaluate, omega, owner)
    thetas = np.array([response.theta for response in responses])
    envelopes, of = [(0.0, 0.0)] * len(responses), owner[1:]
    turns = (omega[1:] - omega[:-1]) * thetas[of]
    coarse = turns > 1.01 * PHASE_STEP
    if coarse.any():
        starts = [0, *(ends[:-1] + 1).tolist()]
        loops = [(slice(i, j + 1), r.theta) for i, j, r in zip(starts, ends.tolist(), responses, strict=True)]
        level, last = np.array([_level(theta, omega[at], samples[:, at]) for at, theta in loops]).T
        size = samples[0].real
        coarse &= (np.maximum(size[:-1], size[1:]) >= level[of]) | (omega[1:] <= last[of])
    if coarse.any():
        pieces = np.where(coarse, np.ceil(turns / PHASE_STEP), 1)
        total = pieces.cumsum()
        within = total <= MOST_NODES + np.concatenate([[0], total[ends[:-1]]])[of]
        if not within.all():
            envelopes = _envelopes(len(responses), of, size[1:], coarse & ~within)
            pieces[~within] = 1
        omega, owner, samples = _refined(evaluate, omega, owner, samples, pieces.astype(int))
        turns = thetas[owner[1:]] * (omega[1:] - omega[:-1])
    inside = owner[1:] == owner[:-1]
    return Grid(omega, owner, samples, inside & (turns <= 1.01 * PHASE_STEP), inside, envelopes)


def sampled(evaluate: Evaluate, omega: np.ndarray, owner: np.ndarray) -> np.ndarray:
    """Rows log L, its first and second derivative, S, T."""
    logs = evaluate(omega, owner)
    return np.array([*logs, *sensitivities(logs[0])])


def _level(theta: float, omega: np.ndarray, samples: np.ndarray) -> tuple[float, float]:
    """For one loop: log|L| below which nothing matters, and the frequency up to which everything does.

    Beyond the last gain crossing the phase falls by 2 pi within two turns of the dead time: there is a phase crossing.
    """
    if theta == 0:
        return math.inf, 0.0
    size, (Ms, Mt) = samples[0].real, np.abs(samples[3:]).max(1).tolist()
    above = np.flatnonzero(size >= 0)
    last = (omega[above[-1]] if above.size else 0.0) + 4 * math.pi / theta
    beyond = size[min(omega.searchsorted(last), omega.size - 1)]
    return min(math.log1p(-1 / max(Ms, 1 + 1e-6)), -math.log1p(1 / max(Mt, 1e-300)), beyond), last


def _envelopes(n: int, owner: np.ndarray, size: np.ndarray, beyond: np.ndarray) -> list[tuple[float, float]]:
    """1/(1 - x) and x/(1 - x), x the largest |L| of each loop where the grid is too coarse; size: log|L|."""
    largest = np.full(n, -np.inf)
    np.maximum.at(largest, owner[beyond], size[beyond])
    x = np.exp(np.minimum(largest, -1e-15))
    return list(zip((1 / (1 - x) * (x > 0)).tolist(), (x / (1 - x)).tolist(), strict=True))


def _refined(
    evaluate: Evaluate, omega: np.ndarray, owner: np.ndarray, samples: np.ndarray, pieces: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Interval i in pieces[i] equal parts; omega, owner and samples of all nodes."""
    at = np.flatnonzero(pieces > 1)
    interval, place = ragged(pieces[at] - 1)
    interval = at[interval]
    fine = omega[interval] + (omega[interval + 1] - omega[interval]) * ((place + 1) / pieces[interval])
    begins = np.concatenate([[0], pieces.cumsum()])  # the places of the old nodes
    order = np.empty(omega.size + fine.size, dtype=int)
    order[begins] = np.arange(omega.size)
    order[begins[interval] + place + 1] = np.arange(omega.size, order.size)
    new = sampled(evaluate, fine, owner[interval])
    return (
        np.concatenate([omega, fine])[order],
        np.concatenate([owner, owner[interval]])[order],
        np.concatenate([samples, new], axis=1).take(order, axis=1),
    )


def _base_grid(responses: Sequence[Response]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Two decades beyond all corners at either end; omega, owner, last indices."""
    return side_by_side([_own_grid(response) for response in responses])


def _own_grid(response: Response) -> np.ndarray:
    corners = [abs(root) for root in response.roots]
    corners += [abs(gain) ** (-1 / power) for gain, power in (response.at_zero, response.at_infinity) if power]
    if response.theta:
        corners += [1 / response.theta, 4 * math.pi / response.theta]
    first, last = 1e-2 * min(corners, default=1.0), 1e2 * max(corners, default=1.0)
    clusters = [cluster(root) for root in response.roots if root.imag > 0 and abs(root.real) < LIGHT * abs(root)]
    if not response.theta:
        omega = geometric(first, last, GRID_PER_DECADE)
    else:  # equal steps from where those of the geometric grid are as long
        begin, end = EQUAL[0] / response.theta, EQUAL[-1] / response.theta
        below, above = geometric(first, begin, GRID_PER_DECADE), geometric(end, last, GRID_PER_DECADE)
        omega = np.concatenate([below, EQUAL[1:-1] / response.theta, above])
    return np.sort(np.concatenate([omega, *clusters])) if clusters else omega


def cluster(root: complex) -> np.ndarray:
    """Nodes about a resonance, close together at its top."""
    offsets = max(abs(root.real), NARROWEST * abs(root)) * CLUSTER
    near = offsets[offsets < 0.5 * root.imag]
    return np.concatenate([root.imag - near, root.imag + near])
