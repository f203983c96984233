"""How well a reduced model stands for the plant: over time, and over frequency against what the loop can bear.

With Gr the model, C designed on it, and T = Gr C/(1 + Gr C) of the loop round the MODEL, the loop round the
plant G is stable if that round the model is, G and Gr have the same number of unstable poles, and

    |G(jw) - Gr(jw)|/|Gr(jw)| < 1/|T(jw)|   for all w          [RMS86 eq. 10]

which is sufficient, not necessary: where it fails, the loop round the full plant decides, and it is computed.
"""

import math
from dataclasses import dataclass

import numpy as np

from simc_core.controllers import Controller
from simc_core.grid import omega_grid
from simc_core.loop import Loop, frequency_response
from simc_core.models import Model
from simc_core.plant import Plant
from simc_core.plant_step import PlantStep, plant_step, step_horizon
from simc_core.stability import stability

GOOD = 0.5  # a model that uses half of what the loop can bear is good; beyond 1 nothing is certain


@dataclass(frozen=True, slots=True, eq=False)
class ModelError:
    """The error over time and over frequency, arrays of shape (n,).

    step, model_step: unit step responses of G and Gr.   step_difference: largest |y - yr|, at step_time.
    step_fraction: the same over |k| of a plant that comes to rest, nan for others.
    omega, error: |G - Gr|/|Gr|.   bound: 1/|T|, all nan where the loop round the model is not stable.
    used: largest error |T|, at omega_used; nan with the bound.
    """

    step: PlantStep
    model_step: PlantStep
    step_difference: float
    step_time: float
    step_fraction: float
    omega: np.ndarray
    error: np.ndarray
    bound: np.ndarray
    used: float
    omega_used: float

    @property
    def verdict(self) -> str:
        """ "good", "usable": stability is certain; "not certain": the bound does not answer."""
        if not self.used < 1:
            return "not certain"
        return "good" if self.used <= GOOD else "usable"


def model_error(plant: Plant, model: Model, controller: Controller) -> ModelError:
    """Compare `model` with `plant`, for the loop `controller` closes; see the module docstring."""
    t_end = max(step_horizon(plant), step_horizon(model.plant))
    step, model_step = plant_step(plant, t_end), plant_step(model.plant, t_end)
    difference = np.abs(step.y - model_step.y)
    latest = int(np.argmax(difference))
    rests = plant.integrators == 0 and plant.unstable_poles == 0
    fraction = float(difference[latest]) / abs(plant.k) if rests else math.nan
    loop = Loop(model.plant, controller)
    omega = omega_grid([plant.factored, model.plant.factored, loop.L])
    Gr = model.plant.response(1j * omega)
    error = np.abs(plant.response(1j * omega) - Gr) / np.abs(Gr)
    bound, used, omega_used = np.full(omega.shape, math.nan), math.nan, math.nan
    if stability(loop).verdict == "stable":
        T = np.abs(frequency_response(loop, omega).T)
        bound, share = 1 / T, error * T
        worst = int(np.argmax(share))
        used, omega_used = float(share[worst]), float(omega[worst])
    return ModelError(
        step, model_step, float(difference[latest]), float(step.t[latest]), fraction, omega, error, bound, used, omega_used
    )
