"""Time responses with exact dead time."""

from simc_core.simulation.actuator.actuation import Actuation
from simc_core.simulation.scenario import Scenario, TimeResponse
from simc_core.simulation.simulate import simulate
from simc_core.simulation.simulate_nested import NestedResponse

__all__ = ["Actuation", "NestedResponse", "Scenario", "TimeResponse", "simulate"]
