"""What a reduced model is worth: the load error of its SIMC loop round the FULL plant at one and the same peak Ms.

Two models of a plant are not compared at tau_c = theta, where their loops differ in robustness, but each at the tau_c
that gives Ms = 1.6. After a unit load step at the plant input the integral of the error is then tau_I/Kc = 1/|Ki|
[Åström and Hägglund 2006]: the smaller, the better the model serves.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

from simc_core.controllers.forms import Controller
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.loops.nested import NestedLoops
from simc_core.optimal.speed_for_peak import FASTEST, smallest_speed_with_peak
from simc_core.plants.models import Model, UnstableDelay
from simc_core.plants.plant import Plant
from simc_core.reduction.records import Orders
from simc_core.rules.simc import default_tau_c, simc
from simc_core.sensitivity.margins import margins

EQUAL_MS = 1.6  # what tau_c = theta gives on a first-order model [SG12 Table 5.3: 1.59]
KEPT = 256  # a page asks again at every click


@dataclass(frozen=True, slots=True)
class EqualPeak:
    """tau_c with which the peak is reached, and the integral of the error after a unit load step, tau_I/Kc."""

    tau_c: float
    load_error: float


@lru_cache(maxsize=KEPT)
def at_equal_peak(plant: Plant, model: Model, Ms: float = EQUAL_MS) -> EqualPeak | None:
    """The fastest SIMC loop of `model` round `plant` with the peak Ms.

    Parameters
    ----------
    plant : Plant
        The full plant.
    model : Model
        A reduced model of it.
    Ms : float
        Peak of the sensitivity, the same for all models that are compared.

    Returns
    -------
    EqualPeak or None
        None where no tau_c does it: an unstable model, whose rule knows one tau_c, or Ms above `Ms` throughout.
        Where Ms is smaller even for the smallest tau_c that is tried, 0.01 theta, that one is taken.
    """
    if isinstance(model, UnstableDelay):
        return None
    scale = default_tau_c(model)

    def closed(tau_c: float) -> NestedLoops:
        return NestedLoops((plant,), (simc(model, tau_c),))

    try:
        tau_c = smallest_speed_with_peak(closed, Ms, scale, "tau_c", "Ms")
    except InvalidParameter:
        tau_c = FASTEST * scale
        if not _peak(plant, model, tau_c) <= Ms:
            return None
    return EqualPeak(tau_c, load_error(simc(model, tau_c)))


def compare_orders(plant: Plant, first: Model, second: Model) -> Orders:
    """Load errors of the models of order 1 and 2 at the same peak."""
    found = [at_equal_peak(plant, model) for model in (first, second)]
    return Orders(*(math.inf if each is None else each.load_error for each in found))


def load_error(controller: Controller) -> float:
    """Integral of the error after a unit load step at the plant input, 1/|Ki|: tau_I/Kc of a PI or PID."""
    return 1 / abs(controller.to_parallel().Ki)


def _peak(plant: Plant, model: Model, tau_c: float) -> float:
    try:
        return margins(Loop(plant, simc(model, tau_c))).Ms
    except InvalidParameter:  # no such controller, or the loop is ill-posed
        return math.nan
