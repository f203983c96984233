"""Time responses with exact dead time."""

from simc_core.simulation.nested import NestedResponse
from simc_core.simulation.scenario import Scenario, TimeResponse
from simc_core.simulation.simulate import simulate

__all__ = ["NestedResponse", "Scenario", "TimeResponse", "simulate"]
