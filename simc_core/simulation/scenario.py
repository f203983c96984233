"""What is asked of a simulation, and what comes back."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simc_core import checks
from simc_core.errors import InvalidParameter, WrongType
from simc_core.simulation.actuator.actuation import Actuation

MOST_POINTS = 100_000
LINEAR = Actuation()


@dataclass(frozen=True, slots=True, eq=False)
class Scenario:
    """A step or ramp of r at t = 0, and one of d at the plant input at disturbance_time.

    disturbance2, disturbance2_time: the same at the input of the innermost block of nested loops; others have none.
    setpoint, disturbance: heights.   setpoint_ramp, disturbance_ramp: times in which these are reached, 0 for a step;
    nested loops have steps only.
    disturbance_time, t_end: None for half the horizon, and a horizon in which the
    slowest mode of the loop settles to 1 %.   points: instants on the grid; at a jump both limits are added.
    t: explicit increasing instants, returned exactly as given, right-hand limits at jumps.
    actuation: limits, noise and sampling between controller and plant; by default the loop is linear.
    """

    setpoint: float = 1.0
    disturbance: float = 1.0
    disturbance_time: float | None = None
    t_end: float | None = None
    points: int = 600
    t: np.ndarray | None = None
    disturbance2: float = 1.0
    disturbance2_time: float | None = None
    setpoint_ramp: float = 0.0
    disturbance_ramp: float = 0.0
    actuation: Actuation = LINEAR

    def __post_init__(self) -> None:
        put = object.__setattr__
        for name in ("setpoint", "disturbance", "disturbance2"):
            put(self, name, checks.real(name, getattr(self, name), -checks.LARGEST_GAIN, checks.LARGEST_GAIN))
        for name in ("setpoint_ramp", "disturbance_ramp"):
            put(self, name, checks.optional_time(name, getattr(self, name)))
        for name in ("disturbance_time", "disturbance2_time"):
            if getattr(self, name) is not None:
                put(self, name, checks.optional_time(name, getattr(self, name)))
        if self.t_end is not None:
            put(self, "t_end", checks.positive_time("t_end", self.t_end))
        put(self, "points", checks.whole("points", self.points, 2, MOST_POINTS))
        if self.t is not None:
            put(self, "t", instants(self.t))
        if not isinstance(self.actuation, Actuation):
            raise WrongType(f"actuation must be an Actuation, got {type(self.actuation).__name__}")


@dataclass(frozen=True, slots=True, eq=False)
class TimeResponse:
    """Arrays of shape (n,): time, set point, input disturbance, output, plant input without the disturbance."""

    t: np.ndarray
    r: np.ndarray
    d: np.ndarray
    y: np.ndarray
    u: np.ndarray


def instants(given: ArrayLike) -> np.ndarray:
    """`given` as increasing instants >= 0, shape (n,). Raises InvalidParameter."""
    t = checks.array("t", given, MOST_POINTS)
    if not np.all(np.isfinite(t)) or t[0] < 0 or np.any(np.diff(t) < 0):
        raise InvalidParameter(f"t must be finite, >= 0 and increasing, got {t[0]:g} ... {t[-1]:g}")
    if t[-1] > checks.LONGEST_TIME:
        raise InvalidParameter(f"t must be <= {checks.LONGEST_TIME:g}, got {t[-1]:g}")
    return t
