"""Numbers that others printed or that have a closed form, beside the function of this library that gives them.

The Accuracy page computes them while you watch; the tests hold every published number, these are the ones to show.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from simc_core.controllers import IController, SeriesPid
from simc_core.half_rule import half_rule
from simc_core.loop import Loop
from simc_core.margins import margins
from simc_core.performance import performance
from simc_core.plant import Plant
from simc_core.simc import simc
from simc_core.simulation import Scenario, simulate


@dataclass(frozen=True, slots=True)
class Reference:
    """quantity of what: `expected` says the source, `compute` gives ours. tolerance: half a printed digit, or exact."""

    what: str
    quantity: str
    source: str
    expected: float
    tolerance: float
    compute: Callable[[], float]


FIRST_ORDER = Loop(Plant(1, 1, (1,)), SeriesPid(0.5, 1))
INTEGRATING = Loop(Plant(1, 1, integrators=1), SeriesPid(0.5, 8))
DOUBLE_INTEGRATING = Loop(Plant(1, 1, integrators=2), SeriesPid(0.0625, 8, 8))
PURE_DELAY = Loop(Plant(1, 1), IController(0.5))
DELAYED_INTEGRATOR = Loop(Plant(1, 1), IController(2))  # L = 2 e^{-s}/s
V06_1 = Plant(1, 3, (6, 4, 2))
E2 = Plant(1, 0, (2, 1, 0.4, 0.2, 0.05, 0.05, 0.05), (-0.3, 0.08))
E6 = Plant(1, 0, (1, 1, 0.028), (0.17, 0.17), 1)
E12 = Plant(1, 0.3, (10, 8, 1), (6, 3))


def _ideal(plant: Plant):
    return simc(half_rule(plant, 2).model).to_ideal()


def _y(t: float) -> float:
    return float(simulate(DELAYED_INTEGRATOR, Scenario(disturbance=0, t=np.array([t]))).y[0])


REFERENCES = (
    Reference("V06 example 1, PI", "Kc", "[V06]", 0.57, 0.005, lambda: simc(half_rule(V06_1).model).Kc),
    Reference("V06 example 1, ideal PID", "Kc", "[V06]", 1.38, 0.006, lambda: _ideal(V06_1).Kc),
    Reference("V06 example 1, ideal PID", "tau_D", "[V06]", 2.73, 0.005, lambda: _ideal(V06_1).tau_D),
    Reference("E2, first order", "theta", "[SK03 Table 4]", 1.47, 0.005, lambda: half_rule(E2).model.theta),
    Reference("E6, integrating with lag", "theta", "[SK03 Table 4]", 0.358, 5e-4, lambda: half_rule(E6, 2).model.theta),
    Reference("E12, two zeros", "k", "[SK03 Table 4]", 0.225, 5e-4, lambda: half_rule(E12).model.k),
    Reference("First order, tight", "GM", "closed form", math.pi, 1e-12, lambda: margins(FIRST_ORDER).GM),
    Reference("First order, tight", "PM", "closed form", 90 - 90 / math.pi, 1e-10, lambda: margins(FIRST_ORDER).PM_deg),
    Reference("First order, tight", "Ms", "[SK03 Table 2]", 1.59, 0.005, lambda: margins(FIRST_ORDER).Ms),
    Reference("Integrating, tight", "Ms", "[SK03 Table 2]", 1.70, 0.005, lambda: margins(INTEGRATING).Ms),
    Reference("Double integrating, tight", "Ms", "[SK03 Table 3]", 1.96, 0.005, lambda: margins(DOUBLE_INTEGRATING).Ms),
    Reference(
        "Pure dead time, tight",
        "IAE set point",
        "[SK03 Table 3]",
        2.17,
        0.005,
        lambda: performance(PURE_DELAY).setpoint.IAE,
    ),
    Reference(
        "Integrating, tight", "IAE load", "tau_I/Kc", 16.0, 1e-7, lambda: performance(INTEGRATING).disturbance.IAE
    ),
    Reference("L = 2 e^{-s}/s", "y(2.5)", "closed form", 2.5, 1e-12, lambda: _y(2.5)),
    Reference("L = 2 e^{-s}/s", "y(3)", "closed form", 2.0, 1e-12, lambda: _y(3.0)),
)
