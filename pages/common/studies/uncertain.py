"""What the plants that a record leaves open make of a controller. Pure: no streamlit."""

from dataclasses import asdict, dataclass, replace
from functools import lru_cache

import numpy as np

from pages.common.session.excitation import Excitation
from pages.common.session.tuning import Tuning
from simc_core import Plant, TimeResponse, Uncertainty, ms_of_plants, simulate
from simc_core.controllers.forms import Controller
from simc_core.errors import SimcError
from simc_core.identification.cloud import clouds
from simc_core.identification.cloud_peaks import grid, scales
from simc_core.identification.robust_tau_c import smallest_tau_c
from simc_core.loops.loop import Loop
from simc_core.simulation.horizon import times
from simc_core.studies.tuned import tuned

MEMBERS = 40  # that are simulated, of all structures together
POINTS = 300
LONGEST, STEPS = 10.0, 20  # times theta, up to which tau_c is tried
LOWEST = 55  # point of the grid, from which |S| is drawn
FEWEST = 5  # plants, from which there is a band
Array = np.ndarray


@dataclass(frozen=True, slots=True)
class Bands:
    """Responses of the model, and of plants that a record does not tell from it; `lost`: those that are not stable."""

    nominal: TimeResponse
    family: tuple[TimeResponse, ...]
    lost: int


@lru_cache(maxsize=16)
def peaks_of(uncertainty: tuple[Uncertainty, ...], controller: Controller) -> Array:
    """Ms on all of them, the model first; inf where the loop is not stable."""
    return ms_of_plants(uncertainty, controller)


def sensitivity(uncertainty: tuple[Uncertainty, ...], controller: Controller) -> tuple[Array, Array]:
    """omega, and |S| of all of them, the model first."""
    drawn = clouds(uncertainty)
    omega = grid(drawn)[LOWEST::2]
    C = controller.response(1j * omega)
    return omega, np.concatenate([1 / np.abs(1 + cloud.response(omega) * C) for cloud in drawn])


def bands(loop: Loop, uncertainty: tuple[Uncertainty, ...], excitation: Excitation) -> Bands:
    """y and u of the loop, and of the loops around plants that the record leaves open. Raises SimcError."""
    begins, t_end = times(loop, excitation.scenario())
    asked = excitation.scenario(disturbance_time=begins, t_end=t_end, t=np.linspace(0.0, t_end, POINTS))
    nominal = simulate(loop, asked)
    peaks = peaks_of(uncertainty, loop.controller)
    lost = int(np.sum(~np.isfinite(peaks)))
    family: list[TimeResponse] = []
    drawn = clouds(uncertainty)
    for cloud in drawn:
        for plant in cloud.plants(1 + MEMBERS // len(drawn))[1:]:
            try:
                family.append(simulate(Loop(plant, loop.controller), asked))
            except SimcError:
                continue
    return Bands(nominal, tuple(family), lost)


def fastest(plant: Plant, tuning: Tuning, uncertainty: tuple[Uncertainty, ...], Ms: float, probability: float) -> float:
    """The smallest tau_c whose settings keep Ms within the limit on nearly all plants. Raises SimcError."""
    scale, _ = scales(clouds(uncertainty))
    begin = max(tuned(plant, **asdict(replace(tuning, tau_c=None, speed=""))).model.theta, scale)

    def controller(tau_c: float) -> Controller:
        return tuned(plant, **asdict(replace(tuning, tau_c=tau_c, speed=""))).controller

    return smallest_tau_c(uncertainty, controller, np.geomspace(begin, LONGEST * begin, STEPS), Ms, probability)
