"""How often f = sum_k P_k winds around the origin along the imaginary axis, certified segment by segment.

A segment of the axis counts only when one of two closed-form tests holds (segment_bounds), else it is split.

Beyond the last frequency, f differs from its limit by less than the limit: closed form again, from the largest root.
Zeros in the right half plane: -1/pi times the change of arg f over 0..inf. A point where f is zero within
rounding is a zero on the axis.

Loops whose P_k have the same table of exponents are worked on together: their segments stand in one row, with the
number of the loop beside each node (module segments).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.characteristic import Characteristic
from simc_core.errors import InvalidParameter
from simc_core.factors import roots_of
from simc_core.segment_bounds import Family, wrapped
from simc_core.segments import Nodes, geometric, split

MOST_SEGMENTS = 60_000  # of one loop, about 0.1 s; a usual one needs 30 to 100
TOGETHER = 64  # loops; more do not fit the cache
GRID_PER_DECADE = 16


@dataclass(frozen=True, slots=True)
class Winding:
    """zeros: number in the open right half plane; None where f vanishes on the axis, at omega = `touches`.

    work: segments that were looked at.
    """

    zeros: int | None
    touches: float | None
    work: int


def winding(f: Characteristic) -> Winding:
    """Zeros of f in the right half plane. Raises InvalidParameter where the work would exceed MOST_SEGMENTS."""
    return windings([f])[0]


def windings(functions: Sequence[Characteristic]) -> list[Winding]:
    """The same of many, those with equal tables of exponents together. One that is refused refuses all."""
    alike: dict[tuple, list[int]] = {}
    for i, f in enumerate(functions):
        alike.setdefault((f.exponents, tuple(row[0] != 0 for row in f.rows)), []).append(i)
    found: dict[int, Winding] = {}
    for members in alike.values():
        for start in range(0, len(members), TOGETHER):
            some = members[start : start + TOGETHER]
            found |= zip(some, _together([functions[i] for i in some]), strict=True)
    return [found[i] for i in range(len(functions))]


def _together(functions: Sequence[Characteristic]) -> list[Winding]:
    """Those with the same table of exponents."""
    n, family = len(functions), Family(functions)
    ranges = np.array([_range(f) for f in functions])
    grid, ends = _first_grid(ranges[:, 0], ranges[:, 1])
    ahead = np.array([0.0 if f.limit > 0 else math.pi for f in functions])
    turned, work, touches = np.zeros(n), np.zeros(n), np.full(n, np.nan)
    waiting = [grid]
    while waiting:
        nodes = waiting.pop()
        owner = nodes.owner[1:]
        work += np.bincount(owner, nodes.live, n)
        _refuse(functions, work)
        with np.errstate(over="ignore", invalid="ignore"):  # between two loops
            found = family.at(nodes)
        if nodes is grid:  # from the last frequency to infinity
            turned += wrapped(ahead - found.angle[ends])
        counts = nodes.live & found.certain
        turned += np.bincount(owner, found.change * counts, n)
        going = nodes.live ^ counts
        if found.zeros.any():
            _note(nodes, found.zeros, touches)
            going &= np.isnan(touches)[owner]
        if going.any():
            waiting += split(nodes, going, found.excess)
    zeros = np.rint(turned / -math.pi).astype(int).tolist()
    return [
        Winding(count, None, done) if math.isnan(touch) else Winding(None, touch, done)
        for count, touch, done in zip(zeros, touches.tolist(), work.astype(int).tolist(), strict=True)
    ]


def _refuse(functions: Sequence[Characteristic], work: np.ndarray) -> None:
    most = int(work.argmax())
    if work[most] > MOST_SEGMENTS:
        raise InvalidParameter(
            f"the stability certificate must need <= {MOST_SEGMENTS} segments, got {work[most]:.0f}: the loop is too "
            f"close to |L(inf)| = 1 (here {functions[most].neutral:g}) or its time constants are too far apart"
        )


def _note(nodes: Nodes, zeros: np.ndarray, touches: np.ndarray) -> None:
    """The smallest zero of each loop, 0 only if there is no other."""
    for i in np.flatnonzero(zeros)[::-1]:
        if nodes.omega[i] or np.isnan(touches[nodes.owner[i]]):
            touches[nodes.owner[i]] = nodes.omega[i]


def _first_grid(first: np.ndarray, last: np.ndarray) -> tuple[Nodes, np.ndarray]:
    """0 and a geometric grid for every loop; and the index of its last frequency."""
    omega, owner, ends = geometric(first, last, GRID_PER_DECADE, before=1)
    omega[0] = omega[ends[:-1] + 1] = 0.0
    return Nodes(omega, owner, omega[1:] > 0), ends


def _range(f: Characteristic) -> tuple[float, float]:
    """A frequency below all corners, and one beyond which |f - limit| < |limit|."""
    corners = [abs(root) for root in roots_of(f.rows) if root]
    delays = [1 / theta for theta in f.thetas if theta]
    largest = max(corners, default=0.0) or max(delays, default=1.0)
    allowed = abs(f.limit) * (1 + f.neutral) / 2
    last = 2 * largest
    while _tails(f, largest, last) >= allowed:
        last *= 2
    return 1e-2 * min([last, *delays, *corners]), last


def _tails(f: Characteristic, largest: float, omega: float) -> float:
    """Sum of the bounds of |P_k - its limit| beyond omega; of |P_k| where it is delayed or has none."""
    up, down, total = math.log1p(largest / omega), -math.log1p(-largest / omega), 0.0
    for leading, theta, (zeros, poles) in zip(f.leading, f.thetas, f.degrees, strict=True):
        spread = math.expm1(min(zeros * up + poles * down, 700.0))
        flat = theta == 0 and zeros == poles
        total += abs(leading) * (spread if flat else omega ** (zeros - poles) * (1 + spread))
    return total
