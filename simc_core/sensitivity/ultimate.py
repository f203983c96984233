"""The ultimate point of a plant, dead time exact: where a loop with a P controller alone leaves stability.

L = Kc G crosses the negative real axis at omega_i with |G| = g_i. Between the gains 1/g_i the number of unstable poles
of the closed loop does not change, so that one test of stability for each interval tells which are sound.
"""

import math

from simc_core.certificate.verdict import stability
from simc_core.controllers.forms import IdealPid
from simc_core.errors import NotReducible
from simc_core.loops.loop import Loop
from simc_core.plants.plant import Plant
from simc_core.plants.ultimate_point import Ultimate
from simc_core.sensitivity.crossings import search
from simc_core.sensitivity.log_response import FactoredResponse
from simc_core.wording import said

MOST_LIMITS = 40  # that are tried
APART = 1e-9  # relative; two crossings with gains this close are one limit


def ultimate(plant: Plant) -> Ultimate:
    """Ultimate gain and period: the limit of the lowest range of gains in which a P controller keeps the loop stable.

    Parameters
    ----------
    plant : Plant
        Any plant.

    Returns
    -------
    Ultimate
        Ku with the sign of the plant's gain; Pu = 2 pi/omega_180.

    Raises
    ------
    NotReducible
        There is none: any gain, or none, keeps the loop stable.

    References
    ----------
    [ZN42]

    Examples
    --------
    Four equal lags oscillate at omega = 1, where each turns by 45 degrees, with Ku = 4:

    >>> from simc_core import Plant, ultimate
    >>> point = ultimate(Plant(1, 0, (1, 1, 1, 1)))
    >>> round(point.Ku, 9), round(point.Pu, 9)
    (4.0, 6.283185307)
    """
    sign = math.copysign(1.0, plant.k) * (-1) ** sum(tau < 0 for tau in plant.lags)  # of a Kc that can stabilise
    below = 0.0
    for gain, omega in _limits(plant, sign):
        if gain > below * (1 + APART):
            if _stable(plant, sign * (math.sqrt(below * gain) if below else gain / 2)):
                if omega in (0.0, math.inf):
                    break
                return Ultimate(sign * gain, 2 * math.pi / omega)
            below = gain
    raise NotReducible(
        said(
            "an ultimate gain must exist for this rule, found a plant whose loop with a P controller does not "
            "oscillate at any gain: take a rule that starts from a model"
        )
    )


def _limits(plant: Plant, sign: float) -> list[tuple[float, float]]:
    """Gains > 0 at which a closed-loop pole reaches the imaginary axis, ascending, and its omega, perhaps 0 or inf."""
    G = FactoredResponse(Loop(plant, IdealPid(sign, math.inf)).L)
    found = search(G)
    limits = list(zip((1 / found.phase_gain).tolist(), found.phase_omega.tolist(), strict=True))
    for (value, power), omega in ((G.at_zero, 0.0), (G.at_infinity, math.inf)):
        if power == 0 and (value < 0 or (omega and plant.theta)):  # a neutral loop reaches |L(inf)| at every phase
            limits.append((1 / abs(value), omega))
    return sorted(limits)[:MOST_LIMITS]


def _stable(plant: Plant, Kc: float) -> bool:
    return stability(Loop(plant, IdealPid(Kc, math.inf))).verdict == "stable"
