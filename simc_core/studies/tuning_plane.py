"""PI control in the plane of Kc and tau_I: where the loop is stable, and how robust it is there."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from simc_core.errors import NotReducible, NotStable
from simc_core.optimal.robust_gains import sign_of_gain
from simc_core.optimal.robust_region import robust_region
from simc_core.optimal.stability_limit import stability_limit
from simc_core.plants.plant import Plant
from simc_core.sensitivity.ultimate import ultimate
from simc_core.studies.optimum import scale_of

LEVELS = (1.4, 1.59, 2.0, 3.0)  # of max(Ms, Mt)
TIMES, GAINS = 120, 36
SHORTEST, LONGEST = 0.2, 20.0  # tau_I over the scale of the plant, or up to all of its times
LOWEST, BEYOND = 0.02, 1.3  # gains over the largest that is of interest

Contour = tuple[float, np.ndarray, np.ndarray]  # level, lower and upper edge


@dataclass(frozen=True, slots=True, eq=False)
class TuningPlane:
    """The plane of a plant. Gains are sizes: |Kc|.

    tau_I: (m,).   contours: level, and the edges of |Kc| at each tau_I, (m,); nan where no gain meets the level, 0 for
    a lower edge that is none.   Kc: (n,).   limit: the smallest stable tau_I at each of them, inf where none is.
    """

    tau_I: np.ndarray
    contours: tuple[Contour, ...]
    Kc: np.ndarray
    limit: np.ndarray


@lru_cache(maxsize=32)
def tuning_plane(plant: Plant) -> TuningPlane:
    """Contours of max(Ms, Mt) and the limit of stability of PI control.

    Parameters
    ----------
    plant : Plant
        The plant, dead time exact.

    Returns
    -------
    TuningPlane
        Without contours and with no finite limit where no PI controller was found that keeps the plant stable.
    """
    scale = scale_of(plant)
    tau_I = np.geomspace(SHORTEST * scale, max(LONGEST * scale, 2 * plant.total_time), TIMES)
    found = [_contour(plant, tau_I, level) for level in LEVELS]
    contours = tuple(each for each in found if np.isfinite(each[2]).any())
    largest = _largest(plant, contours)
    Kc = np.geomspace(LOWEST * largest, largest, GAINS)
    limit = np.array([_limit(plant, each) for each in Kc.tolist()])
    return TuningPlane(tau_I, contours, np.append(Kc, BEYOND * largest), np.append(limit, math.inf))


def _contour(plant: Plant, tau_I: np.ndarray, level: float) -> Contour:
    low, high = robust_region(plant, tau_I, level)
    return level, np.abs(low), np.abs(high)


def _largest(plant: Plant, contours: tuple[Contour, ...]) -> float:
    """The ultimate gain; where there is none, some gain beyond all contours."""
    try:
        return abs(ultimate(plant).Ku)
    except NotReducible:
        return max([BEYOND * float(np.nanmax(high)) for _, _, high in contours], default=1.0)


def _limit(plant: Plant, Kc: float) -> float:
    try:
        return stability_limit(plant, sign_of_gain(plant) * Kc)
    except NotStable:
        return math.inf
