"""A plant from a few facts read off a step test: what was done to OP, what PV did, and when.

The facts of a response that settles describe k e^{-theta s}/(tau1 s + 1), whose step response is at 63.2 % one tau1
after the dead time [SG12]; those of one that goes on rising or falling describe k' e^{-theta s}/s.
"""

from dataclasses import dataclass
from fractions import Fraction

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.plants.models import FirstOrderDelay, IntegratingDelay
from simc_core.plants.plant import Plant, scaled
from simc_core.wording import said


@dataclass(frozen=True, slots=True)
class SettlingFacts:
    """k = dPV/dOP;   tau1 = t63 - theta, or t63 where it counts from the first movement of PV.

    dOP, dPV: changes, with sign, of the controller output and of the measurement, each in its own unit.
    theta: dead time, until PV begins to move.   t63: until 63 % of dPV.   from_movement: t63 counts from there.
    Raises InvalidParameter.
    """

    dOP: float
    dPV: float
    theta: float
    t63: float
    from_movement: bool = False

    def __post_init__(self) -> None:
        put = object.__setattr__
        put(self, "dOP", checks.gain("dOP", self.dOP))
        put(self, "dPV", checks.gain("dPV", self.dPV))
        put(self, "theta", checks.optional_time("theta", self.theta))
        put(self, "t63", checks.optional_time("t63", self.t63))
        if not self.from_movement and self.t63 < self.theta:
            raise InvalidParameter(
                said(
                    "t63 must be >= theta = {theta:g} where it counts from the step, found {t63:g}",
                    theta=self.theta,
                    t63=self.t63,
                )
            )
        _ = self.model  # which has bounds of its own

    @property
    def model(self) -> FirstOrderDelay:
        """The model that behaves so."""
        tau1 = self.t63 if self.from_movement else self.t63 - self.theta
        return FirstOrderDelay(self.dPV / self.dOP, self.theta, tau1)

    @property
    def plant(self) -> Plant:
        """The model as a plant."""
        return self.model.plant

    def rescaled(self, time: Fraction) -> "SettlingFacts":
        """The same facts in another time unit; times are multiplied by `time`."""
        return SettlingFacts(self.dOP, self.dPV, scaled(self.theta, time), scaled(self.t63, time), self.from_movement)


@dataclass(frozen=True, slots=True)
class SlopeFacts:
    """k' = dPV/(duration dOP), from a response that does not settle.

    dOP: change of the controller output, with sign.   dPV: what PV has changed by in `duration` once it moves, beyond
    what it would have changed by without the step; in a duration of 1 that is the change of its slope.
    theta: dead time. Raises InvalidParameter.
    """

    dOP: float
    dPV: float
    theta: float
    duration: float = 1.0

    def __post_init__(self) -> None:
        put = object.__setattr__
        put(self, "dOP", checks.gain("dOP", self.dOP))
        put(self, "dPV", checks.gain("dPV", self.dPV))
        put(self, "theta", checks.optional_time("theta", self.theta))
        put(self, "duration", checks.positive_time("duration", self.duration))
        _ = self.model

    @property
    def model(self) -> IntegratingDelay:
        """The model that behaves so."""
        return IntegratingDelay(self.dPV / self.duration / self.dOP, self.theta)

    @property
    def plant(self) -> Plant:
        """The model as a plant."""
        return self.model.plant

    def rescaled(self, time: Fraction) -> "SlopeFacts":
        """The same facts in another time unit; times are multiplied by `time`."""
        return SlopeFacts(self.dOP, self.dPV, scaled(self.theta, time), scaled(self.duration, time))


StepFacts = SettlingFacts | SlopeFacts
