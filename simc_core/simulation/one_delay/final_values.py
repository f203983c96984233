"""Where a response comes to rest, by the gains of plant and controller at s = 0."""

import math

import numpy as np

from simc_core.controllers.forms import ParallelPid
from simc_core.plants.plant import Plant


def final_values(plant: Plant, form: ParallelPid) -> np.ndarray:
    """Where y and u (rows) end after unit steps of r and of d (columns), if the loop is stable."""
    if form.Ki:
        return np.array([[1.0, 0.0], [0.0 if plant.integrators else 1 / plant.k, -1.0]])
    if plant.integrators:
        return np.array([[form.b, 1 / form.Kp if form.Kp else math.inf], [0.0, -1.0]])
    S = 1 / (1 + plant.k * form.Kp)
    return np.array([[form.b * (1 - S), plant.k * S], [form.b * form.Kp * S, S - 1]])
