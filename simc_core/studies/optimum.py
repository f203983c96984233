"""The optimum of a plant, and the whole trade-off between performance and robustness."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from simc_core import checks
from simc_core.controllers.forms import IController
from simc_core.errors import NotReducible, SimcError
from simc_core.optimal.robust_gains import peak_bound
from simc_core.optimal.under_ms import Optimum, Search, criterion_of
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.reduction.half_rule import reduced_model
from simc_core.rules.simc import default_tau_c, simc

FILTER = 0.1  # tau_F of a PID controller, in units of the effective dead time
MOST_BOUNDS = 200  # of a front
COMPARED = tuple(np.geomspace(1.15, 5, 14).tolist())  # bounds of the front that rules are compared with
BOUNDS = tuple(np.round(np.geomspace(1.2, 2.5, 20), 4).tolist())


def optimal(
    plant: Plant,
    kind: str = "PI",
    Ms: float = 1.59,
    criterion: str = "load",
    tau_F: float | None = None,
    series: bool = False,
) -> Optimum:
    """The PI or PID controller with the smallest error among those with max(Ms, Mt) <= Ms.

    Parameters
    ----------
    plant : Plant
        The plant, dead time exact.
    kind : str
        "PI" or "PID", in ideal form.
    Ms : float
        Bound of both peaks, > 1.
    criterion : str
        "load": IAE of a unit step at the plant input. "setpoint": IAE of a unit step at the output, which is one of
        the set point with b = c = 1. "J": the mean of both, each over its IAE with the PI controller that is best for
        it at Ms = 1.59 [SG12].
    tau_F : float, optional
        Filter of the whole controller, in the user's time unit. None: 0 for PI; for PID 0.1 theta of the half-rule
        model.
    series : bool
        Only controllers that have a series form.

    Returns
    -------
    Optimum
        The controller in ideal form, in series form where that is asked for; the criterion; Ms and Mt; whether the
        bound holds it back.

    Raises
    ------
    NoOptimum
        No controller meets the bound, or ever better ones do.
    InvalidParameter
        A number out of its bounds, or no filter where the derivative needs one.

    References
    ----------
    [SG12], [GS18]

    Examples
    --------
    [SG12] print 3.33, 3.65 and 1.135 for e^{-s}/(8s+1):

    >>> from simc_core import Plant, optimal
    >>> found = optimal(Plant(1, 1, (8,)))
    >>> round(found.controller.Kc, 2), round(found.controller.tau_I, 2), round(found.value, 3)
    (3.33, 3.68, 1.134)
    """
    M = peak_bound("Ms", Ms)
    return search_for(plant, kind, criterion, tau_F, series).best(M)


def trade_off(
    plant: Plant,
    kind: str = "PI",
    criterion: str = "load",
    Ms: Sequence[float] = BOUNDS,
    tau_F: float | None = None,
    series: bool = False,
) -> tuple[Optimum, ...]:
    """The optimum for each of many bounds: no controller of this kind lies below this front.

    Parameters
    ----------
    plant : Plant
        The plant, dead time exact.
    kind, criterion, tau_F, series : str, str, float, bool
        As in `optimal`.
    Ms : sequence of float
        Bounds of both peaks, > 1 each.

    Returns
    -------
    tuple of Optimum
        In ascending order of the bounds; those that no controller meets are left out.

    Raises
    ------
    NoOptimum
        No bound can be met, or ever better controllers meet it.
    InvalidParameter
        As `optimal` does.

    Examples
    --------
    A load response that does not change its sign has IAE = tau_I/Kc; the best of them gets less with every bound:

    >>> from simc_core import Plant, trade_off
    >>> [round(each.value, 2) for each in trade_off(Plant(1, 1, (8,)), Ms=[1.59, 2.0])]
    [1.13, 0.69]
    """
    bounds = sorted({peak_bound("Ms", each) for each in checks.array("Ms", Ms, MOST_BOUNDS).tolist()}, reverse=True)
    return tuple(reversed(search_for(plant, kind, criterion, tau_F, series).front(bounds)))


@lru_cache(maxsize=32)
def front(plant: Plant, kind: str, criterion: str, tau_F: float | None) -> tuple[tuple[float, Optimum], ...]:
    """The front that rules are compared with: bound and optimum, ascending; empty where there is none."""
    try:
        found = trade_off(plant, kind, criterion, COMPARED, tau_F)
    except SimcError:
        return ()
    return tuple(zip(COMPARED[len(COMPARED) - len(found) :], found, strict=True))


def search_for(plant: Plant, kind: str, criterion: str, tau_F: float | None, series: bool) -> Search:
    """What `optimal` and `trade_off` are asked for, with scale and first guess from the half rule."""
    model = model_of(plant)
    scale = scale_of(plant)
    if tau_F is None:
        tau_F = FILTER * scale if kind == "PID" else 0.0
    tau_F = checks.optional_time("tau_F", tau_F)
    return Search(plant, kind, criterion_of(plant, criterion, scale), scale, tau_F, series, _guess(model))


def model_of(plant: Plant) -> Model | None:
    """The half rule's model of second order, None where there is none."""
    try:
        return reduced_model(plant, 2)
    except NotReducible:
        return None


def scale_of(plant: Plant) -> float:
    """Effective dead time of the half rule's first-order model; where it is 0, 1/omega_n, or a tenth of all lags."""
    try:
        theta = reduced_model(plant, 1).theta
    except NotReducible:
        theta = plant.theta
    if theta:
        return theta
    pairs, lags = sum(tau for tau, _ in plant.lag_pairs), sum(map(abs, plant.lags))
    return pairs or lags / 10 or 1.0


def _guess(model: Model | None) -> tuple[float, float] | None:
    """tau_I and tau_D of SIMC in ideal form."""
    if model is None:
        return None
    try:
        controller = simc(model, default_tau_c(model) if not model.theta else None)
        form = controller.to_ideal()
    except SimcError:
        return None
    if isinstance(controller, IController) or not form.tau_D:
        return None
    return form.tau_I, form.tau_D
