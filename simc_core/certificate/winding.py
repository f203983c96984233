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

from simc_core.algebra.factors import roots_of
from simc_core.certificate.argument_bounds import BatchedSum
from simc_core.certificate.characteristic import Characteristic
from simc_core.certificate.segments import Nodes, geometric_rows, split
from simc_core.errors import InvalidParameter
from simc_core.wording import said

MOST_SEGMENTS = 60_000  # of one loop, about 0.1 s; a usual one needs 30 to 100
TOGETHER = 40  # loops; more do not fit the cache
GRID_PER_DECADE = 24
SHORTEST = 16 * np.finfo(float).eps  # relative length of a segment that no double lies inside


@dataclass(frozen=True, slots=True)
class Winding:
    """zeros: number in the open right half plane; None where f vanishes on the axis, at omega = `touches`.

    work: segments that were looked at.
    """

    zeros: int | None
    touches: float | None
    work: int


def winding(f: Characteristic) -> Winding:
    """Zeros of f, neutral < 1, in the right half plane. Raises InvalidParameter: work beyond MOST_SEGMENTS."""
    return windings([f])[0]


def windings(functions: Sequence[Characteristic]) -> list[Winding]:
    """The same of many, those with equal tables of exponents together. One that is refused refuses all."""
    alike: dict[tuple, list[int]] = {}
    for i, f in enumerate(functions):
        alike.setdefault((f.exponents, tuple([row[0] != 0 for row in f.rows])), []).append(i)
    found: dict[int, Winding] = {}
    for members in alike.values():
        for start in range(0, len(members), TOGETHER):
            some = members[start : start + TOGETHER]
            found |= zip(some, _together([functions[i] for i in some]), strict=True)
    return [found[i] for i in range(len(functions))]


def _together(functions: Sequence[Characteristic]) -> list[Winding]:
    """Those with the same table of exponents."""
    n, batch = len(functions), BatchedSum(functions)
    grid, ends = _first_grid([_range(f) for f in functions])
    turned, work, touches = np.zeros(n), np.zeros(n), np.array([math.nan] * n)
    waiting = [grid]
    with np.errstate(over="ignore", invalid="ignore"):  # between two loops
        while waiting:
            nodes = waiting.pop()
            owner = nodes.owner[1:]
            work += np.bincount(owner, nodes.live, n)
            if work.max() > MOST_SEGMENTS:
                _refuse(functions, work)
            found = batch.at(nodes)
            if nodes is grid:
                last = found.angle[ends].tolist()
            counts = nodes.live & found.certain
            turned += np.bincount(owner, found.change * counts, n)
            going = nodes.live ^ counts
            if nodes is not grid:
                found.zeros[1:] |= going & (nodes.omega[1:] - nodes.omega[:-1] <= SHORTEST * nodes.omega[1:])
            if found.zeros.any():
                _note(nodes, found.zeros, touches)
                going &= np.isnan(touches)[owner]
            if going.any():
                waiting += split(nodes, going, found.excess)
    results = zip(functions, turned.tolist(), last, touches.tolist(), work.tolist(), strict=True)
    return [_verdict(*each) for each in results]


def _verdict(f: Characteristic, turned: float, last: float, touch: float, work: float) -> Winding:
    """turned: change of arg f up to the last frequency, where it is `last`; its limit is 0 or pi."""
    if not math.isnan(touch):
        return Winding(None, touch, int(work))
    ahead = 0.0 if f.limit > 0 else math.pi
    return Winding(round((turned + math.remainder(ahead - last, math.tau)) / -math.pi), None, int(work))


def _refuse(functions: Sequence[Characteristic], work: np.ndarray) -> None:
    most = int(work.argmax())
    raise InvalidParameter(
        said(
            "the stability certificate must need <= {most_segments} segments, found {work:.0f}: the loop is too "
            "close to |L(inf)| = 1 (here {neutral:g}) or its time constants are too far apart",
            most_segments=MOST_SEGMENTS,
            work=work[most],
            neutral=functions[most].neutral,
        )
    )


def _note(nodes: Nodes, zeros: np.ndarray, touches: np.ndarray) -> None:
    """The smallest zero of each loop, 0 only if there is no other."""
    for i in np.flatnonzero(zeros)[::-1]:
        if nodes.omega[i] or np.isnan(touches[nodes.owner[i]]):
            touches[nodes.owner[i]] = nodes.omega[i]


def _first_grid(ranges: Sequence[tuple[float, float]]) -> tuple[Nodes, np.ndarray]:
    """0 and a geometric grid for every loop; and the index of its last frequency."""
    first, last = np.array(ranges).T
    omega, owner, ends = geometric_rows(first, last, GRID_PER_DECADE)
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
