"""Weights against single bad samples.

Only samples that stand alone, or two or three together, are weighted down, by Huber's function [H64]: a longer run far
from the model is no bad sample but a model that does not fit, and must be seen.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from simc_core.identification.estimator.held_input import Array

LONGEST_RUN = 3
WINDOW = 2 * LONGEST_RUN + 1
DOUBTFUL = 3.0  # robust deviations from where a sample is looked at
BAD = 8.0  # and from where it is left out
VISIBLE = 0.15  # share of the range that a spike must have to be one before a model is known
BEND = 1.8  # of Huber's function


def spikes(y: Array) -> NDArray[np.bool_]:
    """Which samples stand alone, far from the median of their neighbours: for the search, without a model."""
    if y.size < 2 * WINDOW:
        return np.zeros(y.size, dtype=bool)
    low, high = np.quantile(y, [0.02, 0.98])
    return _alone(y, VISIBLE * float(high - low))


def weights(residual: Array, floor: float) -> Array:
    """Weight of each sample by its residual; `floor` is the smallest deviation that is believed."""
    centre = float(np.median(residual))
    off = np.abs(residual - centre)
    scale = max(1.4826 * float(np.median(off)), floor)
    far = off > DOUBTFUL * scale
    if not far.any():
        return np.ones(residual.size)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], far, [False]])))
    begins, ends = edges[::2], edges[1::2]
    alone = ends - begins <= LONGEST_RUN
    found = np.where(_alone(residual, BAD * scale), 0.0, 1.0)  # those on top of a longer run
    for begin, end in zip(begins[alone], ends[alone], strict=True):
        run = slice(int(begin), int(end))
        found[run] = np.where(off[run] > BAD * scale, 0.0, BEND * scale / off[run])
    return found


def _alone(values: Array, least: float) -> NDArray[np.bool_]:
    """Samples farther from the median of seven than `least`, and than is usual."""
    if values.size < 2 * WINDOW:
        return np.zeros(values.size, dtype=bool)
    off = np.abs(values - median_filter(values, WINDOW, mode="nearest"))
    return off > max(BAD * 1.4826 * float(np.median(off)), least)
