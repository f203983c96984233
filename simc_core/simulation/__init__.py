"""Time responses with exact dead time."""

from simc_core.simulation.scenario import Scenario, TimeResponse
from simc_core.simulation.simulate import simulate
from simc_core.simulation.simulate_nested import NestedResponse

__all__ = ["NestedResponse", "Scenario", "TimeResponse", "simulate"]
