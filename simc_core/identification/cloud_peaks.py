"""Ms of one controller on every plant of a cloud, stability counted by the turning of 1 + L."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from simc_core.controllers.forms import Controller, IController
from simc_core.identification.cloud import Cloud, Uncertain, clouds
from simc_core.identification.estimator.held_input import Array

LOW, CLOSE = 60, 300  # frequencies below and around the crossover


def ms_of_plants(uncertain: Uncertain, controller: Controller) -> Array:
    """Ms of a controller on the plants that a trend does not tell apart.

    Parameters
    ----------
    uncertain : Identified or Uncertainty, or several
        See `uncertainty_of`.
    controller : controller
        In any form.

    Returns
    -------
    array, shape (n,)
        The estimate first, then 200 plants around it, then those of other structures; inf where the loop is not stable.

    Examples
    --------
    SIMC with tau_c = theta has Ms = 1.59 on the estimated plant [SK03]:

    >>> import numpy as np
    >>> from simc_core import Trend, identify, ms_of_plants, simc
    >>> t = np.arange(0.0, 60.0)
    >>> y = 10 * np.where(t > 13.5, 1 - np.exp(-(t - 13.5).clip(0) / 8), 0)
    >>> found = identify(Trend(t, y, np.where(t >= 10, 55, 50)))
    >>> round(float(ms_of_plants(found, simc(found.model))[0]), 2)
    1.59
    """
    drawn = clouds(uncertain)
    omega = grid(drawn)
    return peaks(drawn, [cloud.response(omega) for cloud in drawn], omega, controller)


def grid(drawn: Sequence[Cloud]) -> Array:
    """Frequencies at which the peaks of all of them are looked for."""
    scale, slowest = scales(drawn)
    low = min(1e-5 / scale, 1e-3 / slowest)
    return np.concatenate([np.geomspace(low, 1e-2 / scale, LOW), np.geomspace(1e-2 / scale, 60 / scale, CLOSE)[1:]])


def scales(drawn: Sequence[Cloud]) -> tuple[float, float]:
    """The dead time to count in, which is what it may be where it is not resolved, and the slowest time."""
    slowest = max(_slowest(cloud) for cloud in drawn)
    delays = drawn[0].values[:, 0]  # theta is the first
    scale = max(float(delays[0]), float(np.std(delays)), 1e-3 * slowest, 1e-9)
    return scale, max(slowest, scale)


def peaks(drawn: Sequence[Cloud], responses: Sequence[np.ndarray], omega: Array, controller: Controller) -> Array:
    """Ms on every plant, one cloud after the other; responses: G at omega, (n, number of omega) of each cloud."""
    C = controller.response(1j * omega)
    integral = int(isinstance(controller, IController) or not np.isinf(getattr(controller, "tau_I", 1.0)))
    if getattr(controller, "Ki", 1.0) == 0:
        integral = 0
    return np.concatenate([_peaks(cloud, G * C, integral) for cloud, G in zip(drawn, responses, strict=True)])


def _slowest(cloud: Cloud) -> float:
    times = [float(cloud.values[0, i]) for i, name in enumerate(cloud.names) if name.startswith("tau")]
    if "a" in cloud.names:
        times.append(1 / float(cloud.values[0, cloud.names.index("a")]))
    return max(times, default=0.0)


def _peaks(cloud: Cloud, L: NDArray[np.complex128], integral: int) -> Array:
    """Ms of each row; inf where the turning of 1 + L shows poles in the right half plane."""
    difference = 1 + L
    steps = np.angle(difference[:, 1:] / difference[:, :-1])
    turned = steps.sum(axis=1) - np.angle(difference[:, -1])  # at the end 1 + L has gone to 1
    poles = cloud.unstable_poles + (cloud.integrators + integral) / 2 - turned / np.pi
    return np.where(poles < 0.5, 1 / np.abs(difference).min(axis=1), np.inf)
