"""Sums that decay between their terms: the state of a first-order mode from node to node."""

import numpy as np
from numpy.typing import NDArray

from simc_core.algebra.recursion import first_order

GONE = 1e-18  # what is left of a term, relative to it, that is left out


def decaying_sums(b: NDArray, h: NDArray[np.float64], rate: complex, even: bool) -> NDArray:
    """S_j = S_(j-1) exp(-rate h_j) + b_j, S before the first node 0.

    Parameters
    ----------
    b : array, shape (n,)
        The terms.
    h : array, shape (n - 1,)
        Distances of the nodes.
    rate : complex
        1/lag of the mode, or minus its pole; its real part is >= 0.
    even : bool
        All h are equal.
    """
    kept = np.exp(-rate * h)
    if even and h.size:
        return first_order(b, kept[0])
    sums = b.astype(np.result_type(b, kept))
    factor = np.concatenate([[0.0], kept])
    step = 1
    while step < b.size and np.max(np.abs(factor)) > GONE:  # each round doubles how far back a sum reaches
        sums[step:] = sums[step:] + factor[step:] * sums[:-step]
        factor[step:] = factor[step:] * factor[:-step]
        factor[:step] = 0.0
        step *= 2
    return sums
