"""Settings as commercial auto-tuners offer them: for load or set point, damped or fast, each with what it costs.

Each is the optimum of the estimated plant under a bound on Ms and Mt, and the bound is taken down until Ms stays within
its limit on the plants that the trend does not tell apart. 1.4 and 2.0 are the limits of the damped and of the fast
settings of [AH95].
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from simc_core import checks
from simc_core.controllers.forms import IdealPid
from simc_core.errors import NoOptimum, NotIdentifiable, SimcError
from simc_core.identification.cloud import Cloud, Uncertain, clouds
from simc_core.identification.cloud_peaks import grid, peaks, scales
from simc_core.identification.estimator.held_input import Array
from simc_core.loops.loop import Loop
from simc_core.metrics.performance import Performance, performance
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins import margins
from simc_core.studies.optimum import optimal
from simc_core.wording import said

PURPOSES = ("load", "setpoint")
LIMITS = {"damped": 1.4, "fast": 2.0}
KINDS = ("PI", "PID")
TRIES = 8
NEARLY = 0.95  # of limit - 1, at which the bound is let be
LOWEST_BOUND = 1.05


@dataclass(frozen=True, slots=True)
class AutoTuned:
    """One of the settings.

    Attributes
    ----------
    purpose : str
        "load" or "setpoint": whose IAE is smallest.
    character : str
        "damped" or "fast".
    controller : IdealPid
        Its settings.
    limit : float
        Of Ms, which holds with the probability that was asked for.
    Ms, Mt : float
        On the estimated plant.
    Ms_high : float
        The Ms that is not passed with that probability.
    performance : Performance
        Of unit steps on the estimated plant: IAE, TV, overshoot and the rest.
    balanced : bool
        The set point alone would have asked for no integral action: the load counts as much here.
    """

    purpose: str
    character: str
    controller: IdealPid
    limit: float
    Ms: float
    Mt: float
    Ms_high: float
    performance: Performance
    balanced: bool = False


def auto_tune(uncertain: Uncertain, kind: str = "PI", probability: float = 0.95) -> tuple[AutoTuned, ...]:
    """Four settings from what a trend shows: for load and for set point, damped and fast.

    Parameters
    ----------
    uncertain : Identified or Uncertainty, or several
        As `identify_all` ranks them: the settings are those of the first, the limits hold for all that fit nearly as
        well.
    kind : str
        "PI" or "PID".
    probability : float
        With which the limit of Ms holds, 0.5 to 0.999.

    Returns
    -------
    tuple of AutoTuned
        Those that exist; a limit that no settings meet with this probability is left out.

    Raises
    ------
    NotIdentifiable
        No settings meet any of the limits: the trend says too little to tune on.
    InvalidParameter
        Another kind, or a probability outside its bounds.

    References
    ----------
    [AH95] limits 1.4 and 2.0; [SG12] optimal PI and PID.

    Examples
    --------
    Without noise only the limit counts; fast settings have less error than damped ones, and more movement of OP:

    >>> import numpy as np
    >>> from simc_core import Trend, auto_tune, identify
    >>> t = np.arange(0.0, 60.0)
    >>> y = 10 * np.where(t > 13.5, 1 - np.exp(-(t - 13.5).clip(0) / 8), 0)
    >>> damped, fast, *_ = auto_tune(identify(Trend(t, y, np.where(t >= 10, 55, 50))))
    >>> [(each.purpose, each.character, round(each.Ms, 1)) for each in (damped, fast)]
    [('load', 'damped', 1.4), ('load', 'fast', 2.0)]
    >>> damped.performance.disturbance.IAE > fast.performance.disturbance.IAE
    True
    """
    checks.one_of("kind", kind, KINDS)
    probability = checks.real("probability", probability, 0.5, 0.999)
    drawn = clouds(uncertain)
    omega = grid(drawn)
    responses = [cloud.response(omega) for cloud in drawn]
    plant = _estimate(drawn)
    found: list[AutoTuned] = []
    refused: SimcError | None = None
    for purpose in PURPOSES:
        for character, limit in LIMITS.items():
            try:
                found.append(_settings(plant, kind, purpose, character, limit, probability, drawn, responses, omega))
            except (NoOptimum, NotIdentifiable) as error:
                refused = refused or error
    if not found:
        raise NotIdentifiable(
            said(
                "No {kind} settings keep Ms within {limit:g} with {probability:g} %: the trend says too little to tune "
                "on. Repeat the test with a larger step, or two.",
                kind=kind,
                limit=max(LIMITS.values()),
                probability=100 * probability,
            )
        ) from refused
    return tuple(found)


def _estimate(drawn: Sequence[Cloud]) -> Plant:
    """The estimated plant; where its dead time is not resolved, with what it may be: else no gain would be too high."""
    plants = drawn[0].plants(1)
    if not plants:
        raise NotIdentifiable(said("The model is outside the bounds of a plant that can be tuned."))
    scale, _ = scales(drawn)
    return replace(plants[0], theta=max(plants[0].theta, float(np.std(drawn[0].values[:, 0])), 1e-3 * scale))


def _settings(
    plant: Plant,
    kind: str,
    purpose: str,
    character: str,
    limit: float,
    probability: float,
    drawn: Sequence[Cloud],
    responses: Sequence[np.ndarray],
    omega: Array,
) -> AutoTuned:
    criterion, balanced, bound = purpose, False, limit
    best: tuple[float, IdealPid] | None = None
    for _ in range(TRIES):
        controller = _optimum(plant, kind, bound, criterion)
        if np.isinf(controller.tau_I):
            criterion, balanced = "J", True
            continue
        Ms = peaks(drawn, responses, omega, controller)
        high = float(np.quantile(Ms, probability, method="higher"))
        if high <= limit * (1 + 1e-3):
            if best is None or bound > best[0]:
                best = (bound, controller)
            if bound >= limit or high - 1 >= NEARLY * (limit - 1):
                break
            bound = min(limit, (bound * limit) ** 0.5)
            if bound <= best[0] * 1.01:
                break
        else:
            if best is not None:
                break
            share = (limit - 1) / (high - 1) if np.isfinite(high) else 0.5
            bound = 1 + (bound - 1) * min(max(share, 0.5), 0.97)
        if bound < LOWEST_BOUND:
            break
    if best is None:
        raise NotIdentifiable(said("No settings keep Ms within {limit:g}", limit=limit))
    controller = best[1]
    loop = Loop(plant, controller)
    Ms = peaks(drawn, responses, omega, controller)
    high = float(np.quantile(Ms, probability, method="higher"))
    judged = margins(loop)
    return AutoTuned(purpose, character, controller, limit, judged.Ms, judged.Mt, high, performance(loop), balanced)


def _optimum(plant: Plant, kind: str, bound: float, criterion: str) -> IdealPid:
    found = optimal(plant, kind, Ms=bound, criterion=criterion).controller
    return found if isinstance(found, IdealPid) else found.to_ideal()
