"""What is asked of a simulation, and what comes back."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simc_core import checks
from simc_core.errors import InvalidParameter, WrongType
from simc_core.simulation.actuator.actuation import Actuation
from simc_core.wording import said

MOST_POINTS = 100_000
LINEAR = Actuation()


@dataclass(frozen=True, slots=True, eq=False)
class Scenario:
    """A step or ramp of r at t = 0, and one of d at the plant input at disturbance_time.

    Parameters
    ----------
    setpoint, disturbance : float
        Heights, in units of the output and of the input.
    disturbance_time, t_end : float or None
        In the user's time unit. None: half the horizon, and a horizon in which the slowest mode of the loop settles to
        1 %.
    points : int
        Instants on the grid; at a jump both limits are added.
    t : np.ndarray or None, shape (n,)
        Increasing instants >= 0, returned exactly as given, right-hand limits at jumps.
    disturbance2, disturbance2_time : float, float or None
        As disturbance, at the input of the innermost block of nested loops; others have none.
    setpoint_ramp, disturbance_ramp : float
        Times in which the heights are reached, in the user's time unit, 0 for a step; nested loops have steps only.
    actuation : Actuation
        Limits, noise and sampling between controller and plant; by default the loop is linear.

    Raises
    ------
    InvalidParameter
        A number is out of its bounds, or `t` does not increase.

    Examples
    --------
    >>> from simc_core import Loop, Plant, Scenario, SeriesPid, simulate
    >>> found = simulate(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)), Scenario(disturbance=0, t_end=20))
    >>> float(found.t[-1]), float(found.d.max())
    (20.0, 0.0)
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
            raise WrongType(said("actuation must be an Actuation, found {what}", what=type(self.actuation).__name__))


@dataclass(frozen=True, slots=True, eq=False)
class TimeResponse:
    """What a loop does in time.

    Attributes
    ----------
    t : np.ndarray, shape (n,)
        Instants, in the user's time unit.
    r, y : np.ndarray, shape (n,)
        Set point and output.
    d, u : np.ndarray, shape (n,)
        Disturbance at the plant input, and plant input without it.
    """

    t: np.ndarray
    r: np.ndarray
    d: np.ndarray
    y: np.ndarray
    u: np.ndarray


def instants(given: ArrayLike) -> np.ndarray:
    """`given` as increasing instants >= 0, shape (n,). Raises InvalidParameter."""
    t = checks.array("t", given, MOST_POINTS)
    if not np.all(np.isfinite(t)) or t[0] < 0 or np.any(np.diff(t) < 0):
        raise InvalidParameter(
            said("t must be finite, >= 0 and increasing, found {t:g} ... {last:g}", t=t[0], last=t[-1])
        )
    if t[-1] > checks.LONGEST_TIME:
        raise InvalidParameter(
            said("t must be <= {longest_time:g}, found {t:g}", longest_time=checks.LONGEST_TIME, t=t[-1])
        )
    return t
