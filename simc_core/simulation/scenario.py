"""What is asked of a simulation, and what comes back."""

import math
from dataclasses import dataclass

import numpy as np

from simc_core import checks
from simc_core.errors import InvalidParameter

MOST_POINTS = 100_000


@dataclass(frozen=True, slots=True, eq=False)
class Scenario:
    """A step of r at t = 0 and a step of d at the plant input at disturbance_time.

    disturbance2, disturbance2_time: the same at the input of the innermost block of nested loops; others have none.
    setpoint, disturbance: heights.   disturbance_time, t_end: None for half the horizon, and a horizon in which the
    slowest mode of the loop settles to 1 %.   points: instants on the grid; at a jump both limits are added.
    t: explicit increasing instants, returned exactly as given, right-hand limits at jumps.
    u_min, u_max, tracking_time, noise, seed, h: see simulation/saturation.py; by default the loop is linear.
    """

    setpoint: float = 1.0
    disturbance: float = 1.0
    disturbance_time: float | None = None
    t_end: float | None = None
    points: int = 600
    t: np.ndarray | None = None
    u_min: float = -math.inf
    u_max: float = math.inf
    tracking_time: float | None = None
    noise: float = 0.0
    seed: int = 0
    h: float = 0.0
    disturbance2: float = 1.0
    disturbance2_time: float | None = None

    def __post_init__(self):
        put = object.__setattr__
        for name in ("setpoint", "disturbance", "disturbance2"):
            put(self, name, checks.real(name, getattr(self, name), -checks.LARGEST_GAIN, checks.LARGEST_GAIN))
        for name in ("disturbance_time", "disturbance2_time"):
            if getattr(self, name) is not None:
                put(self, name, checks.optional_time(name, getattr(self, name)))
        if self.t_end is not None:
            put(self, "t_end", checks.positive_time("t_end", self.t_end))
        put(self, "points", checks.whole("points", self.points, 2, MOST_POINTS))
        if self.t is not None:
            put(self, "t", instants(self.t))
        if not self.u_min < self.u_max:
            raise InvalidParameter(f"u_min must be < u_max = {self.u_max:g}, got {self.u_min:g}")
        if self.tracking_time is not None:
            put(self, "tracking_time", checks.positive_time("tracking_time", self.tracking_time))
        put(self, "noise", checks.real("noise", self.noise, 0.0, checks.LARGEST_GAIN))
        put(self, "seed", checks.whole("seed", self.seed, 0, 2**32 - 1))
        put(self, "h", checks.optional_time("h", self.h))


@dataclass(frozen=True, slots=True, eq=False)
class TimeResponse:
    """Arrays of shape (n,): time, set point, input disturbance, output, plant input without the disturbance."""

    t: np.ndarray
    r: np.ndarray
    d: np.ndarray
    y: np.ndarray
    u: np.ndarray


def instants(given) -> np.ndarray:
    """`given` as increasing instants >= 0, shape (n,). Raises InvalidParameter."""
    t = np.asarray(given, dtype=float)
    if t.ndim != 1 or not 1 <= t.size <= MOST_POINTS:
        raise InvalidParameter(f"t must be a list of 1 to {MOST_POINTS} instants, got shape {t.shape}")
    if not np.all(np.isfinite(t)) or t[0] < 0 or np.any(np.diff(t) < 0):
        raise InvalidParameter(f"t must be finite, >= 0 and increasing, got {t[0]:g} ... {t[-1]:g}")
    return t
