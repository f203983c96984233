"""SIMC over tau_c, from very fast to very slow: what the speed costs and brings on one plant."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from simc_core.controllers.forms import Controller
from simc_core.errors import SimcError
from simc_core.loops.loop import Loop
from simc_core.optimal.under_ms import criterion_of
from simc_core.plants.models import UnstableDelay
from simc_core.plants.plant import Plant
from simc_core.reduction.half_rule import reduced_model
from simc_core.rules.simc import default_tau_c, simc
from simc_core.sensitivity.margins import margins_many
from simc_core.studies.equal_robustness import filtered
from simc_core.studies.optimum import FILTER, scale_of

FACTORS = np.geomspace(0.1, 10, 33)  # tau_c over its usual value


@dataclass(frozen=True, slots=True, eq=False)
class SimcPath:
    """Stable SIMC designs, n of them, by rising tau_c. peak: max(Ms, Mt).   value: the criterion.   (n,) each."""

    tau_c: np.ndarray
    controllers: tuple[Controller, ...]
    peak: np.ndarray
    value: np.ndarray


@lru_cache(maxsize=32)
def simc_path(plant: Plant, kind: str, criterion: str = "load", tau_F: float | None = None) -> SimcPath:
    """SIMC of one kind over tau_c, from 0.1 to 10 times its usual value.

    Parameters
    ----------
    plant : Plant
        The plant, dead time exact.
    kind : str
        "PI" or "PID".
    criterion : str
        "load", "setpoint" or "J", as in `optimal`.
    tau_F : float, optional
        Filter of a PID controller, in the user's time unit. None: 0.1 theta.

    Returns
    -------
    SimcPath
        Empty where SIMC has no controller of this kind, or knows one tau_c only.
    """
    scale = scale_of(plant)
    try:
        model = reduced_model(plant, 2 if kind == "PID" else 1)
        if isinstance(model, UnstableDelay):
            return _EMPTY
        judge = criterion_of(plant, criterion, scale)
        tau_c = FACTORS * default_tau_c(model)
        made = [filtered(simc(model, each), FILTER * scale if tau_F is None else tau_F) for each in tau_c.tolist()]
    except SimcError:
        return _EMPTY
    if made[0].derivative != (kind == "PID"):
        return _EMPTY
    found = margins_many([Loop(plant, each) for each in made])
    stable = np.flatnonzero([each.stable for each in found])
    if not stable.size:
        return _EMPTY
    controllers = tuple(made[i] for i in stable)
    peak = np.array([max(found[i].Ms, found[i].Mt) for i in stable])
    return SimcPath(tau_c[stable], controllers, peak, judge([each.to_parallel() for each in controllers]))


_EMPTY = SimcPath(np.zeros(0), (), np.zeros(0), np.zeros(0))
