"""Weights against single bad samples.

Only samples that stand alone, or two or three together, are weighted down, by Huber's function [H64]: a longer run far
from the model is no bad sample but a model that does not fit, and must be seen.
"""

import numpy as np

from simc_core.identification.estimator.held_input import Array

LONGEST_RUN = 3
DOUBTFUL = 3.0  # robust deviations from where a sample is looked at
BAD = 8.0  # and from where it is left out
BEND = 1.8  # of Huber's function


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
    found = np.ones(residual.size)
    for begin, end in zip(begins[alone], ends[alone], strict=True):
        run = slice(int(begin), int(end))
        found[run] = np.where(off[run] > BAD * scale, 0.0, BEND * scale / off[run])
    return found
