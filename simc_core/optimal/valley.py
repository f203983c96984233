"""The minimum of a function of one variable that is asked for at several places at a time: smooth, with a kink, or at
the edge of a cliff.

The function comes as a walk: a generator that yields places and is sent the values there. So several walks go on
together, and whoever computes the values computes those of all at once.

About the best place b, between its neighbours a < b < c, three places are tried: where a parabola through the three has
its vertex, and on either side of b where the secant from the left meets the secant from the right, which is where a
kink would be. Of a convex function no value lies below these two meetings: the walk ends where they are no lower than
what was found. Towards a neighbour that is much higher there is a cliff, and its edge is looked for.
"""

import math
from bisect import insort
from collections.abc import Generator

import numpy as np

Walk = Generator[np.ndarray, np.ndarray, tuple[float, float]]

GOOD_ENOUGH = 2e-7  # relative: by how much a convex function may still fall
ROUNDS = 12
APART = 1e-6  # of the bracket: places nearer to one another tell nothing new
CLIFF = 1.5  # times the best value: a neighbour that is higher stands on another branch
SHRUNK = 0.5  # a bracket that is longer than this, of what it was, is halved


def lowest(known: list[tuple[float, float]]) -> Walk:
    """From places and values, ascending, the smallest not at an end; returns place and value."""
    before = math.inf
    for _ in range(ROUNDS):
        i = _smallest(known)
        if not 0 < i < len(known) - 1:
            break
        (a, _), (b, best), (c, _) = known[i - 1 : i + 2]
        sides = [_cliff(known, i, side) or [_meeting(known, min(i, i + side))] for side in (-1, 1)]
        promising = [x for side in sides for x, value in side if value < best * (1 - GOOD_ENOUGH)]
        if not promising:
            break
        tried = [*promising, _vertex(known[i - 1 : i + 2])]
        if c - a > SHRUNK * before:
            tried.append((a + b) / 2 if b - a > c - b else (b + c) / 2)
        before = c - a
        apart = APART * (c - a)
        places: list[float] = []
        for x in sorted(x for x in tried if a < x < c):
            if min(abs(x - other) for other in (a, b, c, *places)) > apart:
                places.append(x)
        if not places:
            break
        values = yield np.array(places)
        for pair in zip(places, values.tolist(), strict=True):
            insort(known, pair)
    return known[_smallest(known)]


def _smallest(known: list[tuple[float, float]]) -> int:
    return min(range(len(known)), key=lambda i: known[i][1])


def _cliff(known: list[tuple[float, float]], i: int, side: int) -> list[tuple[float, float]]:
    """Places between i and its neighbour where that is much higher, and what the function may come to at its edge."""
    (x, best), (edge, high), (other, value) = known[i], known[i + side], known[i - side]
    if not high > CLIFF * best:
        return []
    at_edge = best - (value - best) * abs((edge - x) / (other - x))
    return [(x + part * (edge - x), at_edge) for part in (0.25, 0.5, 0.75)]


def _vertex(three: list[tuple[float, float]]) -> float:
    """Of the parabola through three points; the middle one where there is none."""
    (a, fa), (b, fb), (c, fc) = three
    left, right = (fb - fa) / (b - a), (fc - fb) / (c - b)
    bend = (right - left) / (c - a)
    return (a + b) / 2 - left / (2 * bend) if 0 < bend < math.inf else b


def _meeting(known: list[tuple[float, float]], i: int) -> tuple[float, float]:
    """Place and value where the secants from both sides meet between places i and i + 1; the middle, and no value that
    means anything, where a secant is missing.
    """
    (x, f), (y, g) = known[i : i + 2]
    if i == 0 or i + 2 == len(known) or not math.isfinite(known[i - 1][1] + known[i + 2][1]):
        return (x + y) / 2, -math.inf
    left = (f - known[i - 1][1]) / (x - known[i - 1][0])
    right = (known[i + 2][1] - g) / (known[i + 2][0] - y)
    if right <= left:
        return (x + y) / 2, min(f, g)
    at = (g - f + left * x - right * y) / (left - right)
    return (at, f + left * (at - x)) if x <= at <= y else ((x + y) / 2, min(f, g))
