"""Long records for the eye: what is drawn keeps the least and the largest value of every stretch."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

MOST_DRAWN = 2000  # points of a curve; a screen has fewer columns of pixels, and more make panning slow

Array = NDArray[np.float64]


def thinned(t: Array, y: Array, most: int = MOST_DRAWN) -> tuple[Array, Array]:
    """At most `most` points of a curve that looks the same.

    Parameters
    ----------
    t, y : array, shape (n,)
        t never decreasing.
    most : int
        Of the points that are given, at least 4.

    Returns
    -------
    t, y : array, shape (m,)
        All points where there are no more than `most`; else the ends, and least and largest of each stretch of time.
    """
    if t.size <= most:
        return t, y
    edges = np.linspace(0, t.size, most // 2).astype(np.intp)
    low, high = np.empty_like(edges[:-1]), np.empty_like(edges[:-1])
    for i, (a, b) in enumerate(pairwise(edges.tolist())):
        low[i], high[i] = a + np.argmin(y[a:b]), a + np.argmax(y[a:b])
    kept = np.unique(np.concatenate([[0], low, high, [t.size - 1]]))
    return t[kept], y[kept]


def held(t: Array, u: Array, end: float, most: int = MOST_DRAWN) -> tuple[Array, Array]:
    """The corners of a signal that holds each value until the next, to `end`; at most about `most` points."""
    changed = np.append(True, np.diff(u) != 0)
    at, value = t[changed], u[changed]
    if at.size > most // 2:
        return thinned(t, u, most)
    return np.append(np.repeat(at, 2)[1:], end), np.repeat(value, 2)
