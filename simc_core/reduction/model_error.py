"""How well a reduced model stands for the plant: over time, and over frequency against what the loop can bear.

With Gr the model, C designed on it, and T = Gr C/(1 + Gr C) of the loop round the MODEL, the loop round the
plant G is stable if that round the model is, G and Gr have the same number of unstable poles, and

    |G(jw) - Gr(jw)|/|Gr(jw)| < 1/|T(jw)|   for all w          [RMS86 eq. 10]

which is sufficient, not necessary: where it fails, the loop round the full plant decides, and it is computed.
"""

import math
from dataclasses import dataclass

import numpy as np

from simc_core.certificate.verdict import stability
from simc_core.controllers.forms import Controller
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.frequency_response import frequency_response
from simc_core.loops.loop import Loop
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.plants.step_response import PlantStep, plant_step, step_horizon

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
    difference, latest = _largest_difference(plant, model.plant, step, model_step)
    rests = plant.integrators == 0 and plant.unstable_poles == 0
    fraction = difference / abs(plant.k) if rests else math.nan
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
    return ModelError(step, model_step, difference, latest, fraction, omega, error, bound, used, omega_used)


def _largest_difference(plant: Plant, model: Plant, step: PlantStep, model_step: PlantStep) -> tuple[float, float]:
    """Largest |y - yr| and its time.

    It sits at a dead time, where the difference has a kink or a jump, and is computed there; or between them,
    where a parabola through three points of the grid finds it.
    """
    found = []
    kinks = [theta for theta in {plant.theta, model.theta} if theta > 0]
    for theta in kinks:
        y, yr = plant_step(plant, theta).y[-1], plant_step(model, theta).y[-1]
        found.append((abs(float(y - yr)), theta))
    t, difference = step.t, np.abs(step.y - model_step.y)
    i = int(np.argmax(difference))
    if 0 < i < len(t) - 1 and not any(t[i - 1] <= theta <= t[i + 1] for theta in kinks):
        before, at, after = difference[i - 1 : i + 2]
        bend = before - 2 * at + after
        shift = 0.5 * (before - after) / bend if bend else 0.0
        found.append((float(at - 0.25 * (before - after) * shift), float(t[i] + shift * (t[1] - t[0]))))
    else:
        found.append((float(difference[i]), float(t[i])))
    return max(found)
