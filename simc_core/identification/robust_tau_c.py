"""The tau_c for which a whole cloud of plants stays robust: SIMC settings of the estimate, Ms of every plant."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simc_core import checks
from simc_core.controllers.forms import Controller
from simc_core.errors import NotIdentifiable, WrongType
from simc_core.identification.cloud import Cloud, Uncertain, clouds
from simc_core.identification.cloud_peaks import grid, peaks
from simc_core.identification.estimator.held_input import Array
from simc_core.identification.identified import Identified
from simc_core.rules.simc import simc
from simc_core.wording import said

LONGEST = 10.0  # times theta, up to which tau_c is tried
STEPS = 20
MOST_TAU_C = 100


@dataclass(frozen=True, slots=True, eq=False)
class MsOfCloud:
    """Ms of every plant of a cloud against tau_c.

    Parameters
    ----------
    tau_c : array, shape (m,)
    Ms : array, shape (m, n)
        Of the plants, the estimate first; inf where the loop is not stable.
    """

    tau_c: Array
    Ms: Array

    def quantile(self, probability: float) -> Array:
        """The Ms that is not passed with this probability, shape (m,)."""
        return np.quantile(self.Ms, probability, axis=1, method="higher")

    def within(self, Ms: float) -> Array:
        """Probability that Ms stays within a limit, shape (m,)."""
        return np.mean(self.Ms <= Ms, axis=1)


def ms_of_cloud(identified: Identified | Sequence[Identified], tau_c: ArrayLike | None = None) -> MsOfCloud:
    """Ms against tau_c for all plants that the trend does not tell apart, with the SIMC settings of the estimate.

    Parameters
    ----------
    identified : Identified, or several as `identify_all` ranks them
        Of several, those within 6 of the best criterion count, and the settings are those of the first.
    tau_c : array, optional
        Positive times, 1 to 100 of them. None: 20 from theta to 10 theta.

    Returns
    -------
    MsOfCloud

    Raises
    ------
    InvalidParameter
        A tau_c that is not a positive time, or a model without a SIMC setting.

    Examples
    --------
    SIMC with tau_c = theta has Ms = 1.59 on the estimated plant [SK03]:

    >>> import numpy as np
    >>> from simc_core import Trend, identify, ms_of_cloud
    >>> t = np.arange(0.0, 60.0)
    >>> y = 10 * np.where(t > 13.5, 1 - np.exp(-(t - 13.5).clip(0) / 8), 0)
    >>> found = identify(Trend(t, y, np.where(t >= 10, 55, 50)))
    >>> round(float(ms_of_cloud(found, [3.5]).Ms[0, 0]), 2)
    1.59
    """
    best = _best(identified)
    return _measured(clouds(identified), best, _times(tau_c, best))


def robust_tau_c(identified: Identified | Sequence[Identified], Ms: float = 1.7, probability: float = 0.95) -> float:
    """The smallest tau_c >= theta with which Ms stays within the limit for nearly all plants of the cloud.

    Parameters
    ----------
    identified : Identified, or several as `identify_all` ranks them
        Of several, all structures that fit nearly as well are in the cloud.
    Ms : float
        Limit, 1.05 to 10.
    probability : float
        0.5 to 0.999.

    Returns
    -------
    float
        In the time unit of the trend.

    Raises
    ------
    NotIdentifiable
        No tau_c up to 10 theta: the trend says too little to tune on.
    InvalidParameter
        A limit outside its bounds.

    Examples
    --------
    A trend without noise: the tight tau_c = theta with its Ms of 1.59 is within 1.7.

    >>> import numpy as np
    >>> from simc_core import Trend, identify, robust_tau_c
    >>> t = np.arange(0.0, 60.0)
    >>> y = 10 * np.where(t > 13.5, 1 - np.exp(-(t - 13.5).clip(0) / 8), 0)
    >>> round(robust_tau_c(identify(Trend(t, y, np.where(t >= 10, 55, 50)))), 3)
    3.5
    """
    Ms = checks.real("Ms", Ms, 1.05, 10.0)
    probability = checks.real("probability", probability, 0.5, 0.999)
    best = _best(identified)
    return smallest_tau_c(identified, lambda tau_c: simc(best.model, tau_c), _times(None, best), Ms, probability)


def _best(identified: Identified | Sequence[Identified]) -> Identified:
    """The one whose settings are taken. Raises WrongType."""
    if isinstance(identified, Identified):
        return identified
    first = identified[0] if isinstance(identified, Sequence) and identified else None
    if not isinstance(first, Identified):
        raise WrongType(said("identified must be what identify or identify_all returns"))
    return first


def _times(tau_c: ArrayLike | None, best: Identified) -> Array:
    if tau_c is not None:
        found = checks.array("tau_c", tau_c, MOST_TAU_C)
        for each in found.tolist():
            checks.positive_time("tau_c", each)
        return found
    theta = best.model.theta
    if theta < best.standard_errors["theta"]:  # not resolved: what it may be
        theta = best.standard_errors["theta"]
    theta = max(theta, 1e-3 * best.plant.slowest, 1e-9)
    return np.geomspace(theta, LONGEST * theta, STEPS)


def smallest_tau_c(
    uncertain: Uncertain,
    controller: Callable[[float], Controller],
    times: Array,
    Ms: float,
    probability: float,
) -> float:
    """The smallest of the rising `times`, and then between them, whose controller keeps Ms within the limit.

    controller: gives the settings of a tau_c.   Raises NotIdentifiable where none does.
    """
    drawn = clouds(uncertain)
    omega = grid(drawn)
    responses = [cloud.response(omega) for cloud in drawn]

    def passed(tau_c: float) -> bool:
        found = peaks(drawn, responses, omega, controller(tau_c))
        return bool(np.quantile(found, probability, method="higher") <= Ms)

    tried = times.tolist()
    first = next((i for i, tau_c in enumerate(tried) if passed(tau_c)), None)
    if first is None:
        raise NotIdentifiable(
            said(
                "No tau_c up to {tau_c:.3g} keeps Ms <= {Ms:g} with {probability:g} %: the trend says too little to "
                "tune on. Repeat the test with a larger step, or two.",
                tau_c=tried[-1],
                Ms=Ms,
                probability=100 * probability,
            )
        )
    if first == 0:
        return float(tried[0])
    low, high = tried[first - 1], tried[first]
    for _ in range(8):
        middle = (low * high) ** 0.5
        if passed(middle):
            high = middle
        else:
            low = middle
    return high


def _measured(found: list[Cloud], best: Identified, times: Array) -> MsOfCloud:
    omega = grid(found)
    responses = [cloud.response(omega) for cloud in found]
    rows = [peaks(found, responses, omega, simc(best.model, tau_c)) for tau_c in times.tolist()]
    return MsOfCloud(times, np.array(rows))
