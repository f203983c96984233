"""What is said of an Ms, and where the bands end: one set for strips, figures, advice and hover texts.

[SK03] recommends the tight setting, whose Ms is 1.59 to 1.70, so up to 1.7 nothing is wrong; about 2 is its limit.
"""

import math
from dataclasses import dataclass

from simc_core.reduction.records import LARGEST_MS
from simc_core.wording import Text, said

ROBUST = 1.7  # Ms of the tight setting for an integrating process [SK03]
SOLVED = 1e-6  # relative: a loop designed for Ms = 2 has it to this, and is not above 2
CIRCLES = (1.4, ROBUST, LARGEST_MS)  # Ms drawn round -1 for orientation


@dataclass(frozen=True, slots=True)
class Band:
    """Ms up to `upto` is called `words`; tone: "calm", "attention" or "alarm", see figures.palette."""

    upto: float
    tone: str
    words: Text


BANDS = (
    Band(ROBUST, "calm", said("robust (up to {robust:g})", robust=ROBUST)),
    Band(LARGEST_MS, "attention", said("fair ({robust:g} to {largest:g})", robust=ROBUST, largest=LARGEST_MS)),
    Band(math.inf, "alarm", said("fragile (above {largest:g}): L passes too close to −1", largest=LARGEST_MS)),
)


def band_of(Ms: float) -> Band:
    """The band of an Ms.

    Parameters
    ----------
    Ms : float
        Peak of |S| of a stable loop, at least 1; infinite or nan counts as fragile.

    Returns
    -------
    Band
        The first band that reaches this far.
    """
    return next((band for band in BANDS if not exceeds(Ms, band.upto)), BANDS[-1])


def exceeds(Ms: float, limit: float) -> bool:
    """Whether Ms is above the limit by more than a design for this very Ms leaves; nan exceeds every limit.

    Parameters
    ----------
    Ms : float
        Peak of |S|.
    limit : float
        The Ms it is held against.
    """
    return not Ms <= limit * (1 + SOLVED)
