"""One optimisation: which plant, which controllers, what is to be small, and how robust the loop must be."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from simc_core.controllers.forms import ParallelPid
from simc_core.optimal.criterion import Criterion
from simc_core.optimal.robust_gains import RobustGains, Shapes, robust_gains, sign_of_gain
from simc_core.plants.plant import Plant

SLOWEST = 100.0  # integral time that the grid of frequencies is made for, in units of all times of the plant


@dataclass(frozen=True)
class Problem:
    """scale: the time that settings are measured in, the effective dead time where there is one."""

    plant: Plant
    criterion: Criterion
    M: float
    scale: float
    tau_F: float = 0.0

    @property
    def times(self) -> float:
        """All times of the plant together."""
        plant = self.plant
        return plant.theta + sum(map(abs, plant.lags)) + sum(tau for tau, _ in plant.lag_pairs) or self.scale

    @cached_property
    def sign(self) -> float:
        """Of a gain that can stabilise."""
        return sign_of_gain(self.plant)

    @cached_property
    def gains(self) -> RobustGains:
        """Robust gains round the plant."""
        return robust_gains(self.plant, SLOWEST * max(self.times, self.scale))

    def shapes(self, tau_I: ArrayLike, tau_D: ArrayLike = 0.0) -> Shapes:
        """Ideal controllers of gain 1, or -1."""
        return Shapes.ideal(self.sign, tau_I, tau_D, self.tau_F)

    def edges(self, tau_I: ArrayLike, tau_D: ArrayLike = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """Smallest and largest |Kc| of each shape; nan where there is none."""
        return self.gains.highest(self.shapes(tau_I, tau_D), self.M)

    def values(self, Kc: ArrayLike, tau_I: ArrayLike, tau_D: ArrayLike = 0.0) -> np.ndarray:
        """The criterion of each controller; math.inf where Kc is nan."""
        gains, *times = np.broadcast_arrays(np.atleast_1d(Kc), tau_I, tau_D)
        found = np.full(len(gains), math.inf)
        good = np.flatnonzero(np.isfinite(gains))
        if good.size:
            rows = zip(*(each[good].tolist() for each in (gains, *times)), strict=True)
            found[good] = self.criterion(self.forms(rows))
        return found

    def least(self, Kc: ArrayLike, tau_I: ArrayLike) -> np.ndarray:
        """What the criterion of PI controllers is at least: of the integrals of e; math.inf where Kc is nan."""
        IE = np.asarray(tau_I) / np.asarray(Kc)
        return np.where(np.isfinite(IE), self.criterion.least(IE), math.inf)

    def forms(self, rows: Iterable[tuple[float, float, float]]) -> Sequence[ParallelPid]:
        """Controllers of (Kc, tau_I, tau_D)."""
        c = self.criterion.weighs_derivative
        return [
            ParallelPid(self.sign * Kc, self.sign * Kc / tau_I, self.sign * Kc * tau_D, self.tau_F, 1.0, c)
            for Kc, tau_I, tau_D in rows
        ]


@dataclass(frozen=True, slots=True)
class Found:
    """Kc (its size), tau_I, tau_D of the ideal form, and the criterion."""

    Kc: float
    tau_I: float
    tau_D: float
    value: float
