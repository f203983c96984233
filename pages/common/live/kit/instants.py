"""Instants of a time axis at which curves may jump: each with the instant just before it. Pure: no streamlit."""

from collections.abc import Iterable

import numpy as np

BEFORE = 1e-9  # relative: the left-hand side of a jump


def instants(even: np.ndarray, breaks: Iterable[float], end: float) -> np.ndarray:
    """`even` and `end`, and every break within the axis from both sides; increasing, shape (n,)."""
    inside = np.array([at for at in breaks if 0 < at < end])
    return np.unique(np.concatenate([even, inside, inside * (1 - BEFORE), [end]]))
