"""What an optimal controller makes smallest: integrals of |e| over exact step responses.

load       IAE of a unit step at the plant input
setpoint   IAE of a unit step at the plant output, which is one of the set point with b = c = 1
J          (IAE setpoint/reference + IAE load/reference)/2 [SG12], the references being those of the PI controllers
           that are best for each of the two with Ms = 1.59
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from simc_core import checks
from simc_core.controllers.forms import ParallelPid
from simc_core.metrics.performance import both_steps
from simc_core.metrics.step_metrics import measures
from simc_core.plants.plant import Plant
from simc_core.simulation.one_delay.march import march

CRITERIA = ("load", "setpoint", "J")
MOST_TO_REST = 250  # elements; an optimal loop takes some thirty


@dataclass(frozen=True, slots=True)
class References:
    """The IAE that J counts in: of the set point (output), and of the load (input)."""

    setpoint: float
    load: float


@dataclass(frozen=True, slots=True)
class Criterion:
    """A criterion of one plant. references: for J."""

    plant: Plant
    name: str
    references: References | None = None

    def __post_init__(self) -> None:
        checks.one_of("criterion", self.name, CRITERIA)

    @property
    def weighs_derivative(self) -> float:
        """Weight c of the set point in the derivative."""
        return float(self.name != "load")

    def least(self, IE: np.ndarray) -> np.ndarray:
        """A lower bound of it, from the integral of the error after a load, tau_I/Kc.

        After a step of the output the error has the integral tau_I/(Kc k), and 0 round an integrating plant.
        """
        return self._of(IE / abs(self.plant.k) * (self.plant.integrators == 0), IE)

    def __call__(self, forms: Sequence[ParallelPid]) -> np.ndarray:
        """Of each controller, all with one tau_F; math.inf where the loop does not come to rest."""
        return self._of(*absolute_errors(self.plant, forms))

    def _of(self, setpoint: np.ndarray, load: np.ndarray) -> np.ndarray:
        """The criterion from the integrals of both steps."""
        match self.name:
            case "load":
                return load
            case "setpoint":
                return setpoint
            case _:
                assert self.references is not None  # criterion_of gives them to J
                return J(self.references, setpoint, load)


Error = TypeVar("Error", float, np.ndarray)


def J(references: References, setpoint: Error, load: Error) -> Error:
    """[SG12], of two integrals or of arrays of them."""
    return (setpoint / references.setpoint + load / references.load) / 2


def absolute_errors(plant: Plant, forms: Sequence[ParallelPid]) -> tuple[np.ndarray, np.ndarray]:
    """IAE of set-point and load steps of each controller, (n,) each, all with one tau_F."""
    parts, at = [], 0
    with np.errstate(all="ignore"):  # a search may try loops that are not stable
        while at < len(forms):
            course = march(plant, forms[at:], None, MOST_TO_REST)
            found = measures(both_steps(course), with_times=False).IAE.reshape(2, -1)
            parts.append(np.where(course.at_rest & np.isfinite(found), found, math.inf))
            at += len(course.at_rest)
    setpoint, load = np.concatenate(parts, axis=1)
    return setpoint, load
