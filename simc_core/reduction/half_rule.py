"""The half rule: from a plant to a first- or second-order model with effective delay [SK03 eq. 10-11; SK98; V06].

Lags sorted tau_10 >= tau_20 >= ..., T_j^inv = -T_j of the right-half-plane zeros, h the sampling period,
tau_F a filter:

    order 1   tau1 = tau_10 + tau_20/2
              theta = theta_0 + tau_20/2 + sum_{i>=3} tau_i0 + sum T_j^inv + h/2 + tau_F/2
    order 2   tau1 = tau_10, tau2 = tau_20 + tau_30/2
              theta = theta_0 + tau_30/2 + sum_{i>=4} tau_i0 + sum T_j^inv + h/2 + tau_F/2

An integrator counts as a lag without limit. Behind two integrators, an unstable or an oscillating pole the
small lags go to the delay whole: there is no slow lag that could take half of the largest.

Positive numerator time constants are removed first, by rules that need the theta they lead to (zeros.py). All
fixed points are found: between two changes of any comparison theta_out is a straight line in theta, so each such
interval has at most one, and the intervals are visited one by one. Lines with a slope (2.5 or 5, from the 5 theta
of T3) are left out: their fixed points repel, a delay assumed a little smaller leads to one smaller still, so
that they mark the border between two models and are none themselves. E12: 0.3, [1.3], 0.8.
"""

import math
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.plants.models import IntegratingDelay, Model, SecondOrderDelay
from simc_core.plants.plant import Plant
from simc_core.reduction.dynamics import Dynamics, dynamics
from simc_core.reduction.equal_peak import at_equal_peak, compare_orders
from simc_core.reduction.explanation import budget, notes, steps
from simc_core.reduction.records import LARGEST_MS, Candidate, Reduction
from simc_core.reduction.split import TrialReduction, delay_of, model_of, resolved, shape_of
from simc_core.reduction.zeros import Comparisons, Lag, LineInTheta, Removal, remove_leads
from simc_core.reduction.zeros_1998 import remove_leads_1998
from simc_core.rules.simc import simc
from simc_core.sensitivity.margins import margins

RULES = ("2003", "1998")
MOST_PROBES = 400  # of theta; median 18 for two zeros, 100 for six, 240 for a dozen. Beyond this some may be missed
INSIDE = 0.414  # where an interval is probed; not the middle, where symmetric plants have their changes
SAME_DELAY = 1e-9  # relative; two delays this close are one
_Reduced = tuple[tuple[Candidate, ...], TrialReduction]
_Removed = Callable[[float], tuple[Removal, tuple[float, ...]]]


def half_rule(plant: Plant, order: int = 1, h: float = 0.0, rules: str = "2003", tau_F: float = 0.0) -> Reduction:
    """Reduce `plant` to a first- or second-order model with effective dead time.

    Of several self-consistent delays > 0 the one is taken whose SIMC loop round the ORIGINAL plant has the smallest
    load error tau_I/Kc at Ms = 1.6; where none has that Ms, the smallest with Ms <= 2 at tau_c = theta. All others
    are in `alternatives` and `candidates`.

    Parameters
    ----------
    plant : Plant
        The plant to be reduced.
    order : int
        1 for a PI controller, 2 for a PID.
    h : float
        Sampling period of a digital controller, in the user's time unit; 0 for none. Half of it is added to theta.
    rules : str
        For positive numerator time constants: "2003" (T1-T3), or "1998" (small ones are subtracted from theta).
    tau_F : float
        Time constant of a filter that the controller has and that the rule does not know, such as that of the box it
        is typed into; 0 for none. Half of it is added to theta.

    Returns
    -------
    Reduction
        The model, every step of the way, and the other delays that are possible.

    Raises
    ------
    NotReducible
        The plant has no SIMC model.
    InvalidParameter
        order, h, rules or tau_F out of bounds.

    References
    ----------
    [SK03 eq. 10-11]; [SK98] for the rules of 1998.

    Examples
    --------
    The first example of [V06]:

    >>> from simc_core import half_rule, parse_plant
    >>> half_rule(parse_plant("exp(-3s)/((6s+1)(4s+1)(2s+1))")).model
    FirstOrderDelay(k=1.0, theta=7.0, tau1=8.0)
    """
    order = checks.whole("order", order, 1, 2)
    h, tau_F = checks.optional_time("h", h), checks.optional_time("tau_F", tau_F)
    late = h + tau_F
    checks.one_of("rules", rules, RULES)
    parts = dynamics(plant)
    removed = lru_cache(maxsize=None)(partial(_removed, parts))
    reduce = partial(_reduce, plant, parts, removed, late, rules)
    candidates, trial = reduce(order)
    chosen = next(candidate for candidate in candidates if candidate.chosen)
    other = chosen.model if order == 2 else _chosen(reduce(2))
    orders = None
    if isinstance(other, SecondOrderDelay | IntegratingDelay):
        first = chosen.model if order == 1 else _chosen(reduce(1))
        orders = compare_orders(plant, first, other)
    return Reduction(
        chosen.model,
        steps(parts, trial, (h, tau_F), candidates),
        tuple(candidate.model for candidate in candidates if not candidate.chosen),
        budget(parts, trial, (h, tau_F)),
        candidates,
        notes(parts, chosen.model, order, orders),
        orders,
    )


def reduced_model(plant: Plant, order: int = 1) -> Model:
    """The model of `half_rule` alone, without the steps and without what the other order is worth: many times faster.

    Parameters
    ----------
    plant : Plant
        The plant to be reduced.
    order : int
        1 for a PI controller, 2 for a PID.

    Returns
    -------
    Model
        `half_rule(plant, order).model`.

    Raises
    ------
    NotReducible
        The plant has no SIMC model.

    References
    ----------
    [SK03 eq. 10-11]

    Examples
    --------
    >>> from simc_core import parse_plant
    >>> reduced_model(parse_plant("exp(-3s)/((6s+1)(4s+1)(2s+1))"))
    FirstOrderDelay(k=1.0, theta=7.0, tau1=8.0)
    """
    return _remembered(plant, checks.whole("order", order, 1, 2))


@lru_cache(maxsize=64)  # a cascade asks for the model of its inner block at every speed
def _remembered(plant: Plant, order: int) -> Model:
    parts = dynamics(plant)
    return _chosen(_reduce(plant, parts, partial(_removed, parts), 0.0, "2003", order))


def _chosen(reduced: _Reduced) -> Model:
    return next(candidate.model for candidate in reduced[0] if candidate.chosen)


def _reduce(plant: Plant, parts: Dynamics, removed: _Removed, late: float, rules: str, order: int) -> _Reduced:
    """All candidates, smallest delay first, one of them chosen, and how that one came about."""
    if rules == "1998":
        found = [_at_1998(parts, order, late)]
    elif not parts.leads:  # nothing depends on the theta that is assumed
        trial = _at(parts, removed, order, late, 0.0)
        found = [resolved(trial, trial.theta.at)]
    else:
        found = _self_consistent(lambda theta: _at(parts, removed, order, late, theta), _longest_delay(parts, late))
    models = [model_of(parts, trial) for trial in found]
    candidates = _choose(plant, models)
    chosen = next(i for i, candidate in enumerate(candidates) if candidate.chosen)
    return candidates, found[chosen]


def _longest_delay(parts: Dynamics, late: float) -> float:
    return parts.theta + sum(parts.lags) + sum(parts.inverse) + late / 2


def _removed(parts: Dynamics, theta: float) -> tuple[Removal, tuple[float, ...]]:
    """The rules of 2003 for zeros with `theta` assumed, for either order; and the theta at which they change."""
    comparisons = Comparisons(theta)
    lags = [Lag(i, LineInTheta(tau)) for i, tau in enumerate(parts.lags)]
    removal = remove_leads(list(enumerate(parts.leads)), lags, parts.integrators, comparisons)
    return removal, tuple(set(comparisons.turning_points))


def _at(parts: Dynamics, removed: _Removed, order: int, late: float, theta: float) -> TrialReduction:
    """The rules of 2003 with `theta` assumed; the line `theta` of the outcome is what comes out."""
    removal, turning_points = removed(theta)
    shape = shape_of(parts, order, removal.integrators)
    return TrialReduction(removal, shape, delay_of(parts, removal.lags, shape, late), turning_points)


def _at_1998(parts: Dynamics, order: int, late: float) -> TrialReduction:
    """The rules of 1998; nothing in them depends on theta."""

    def delay(lags: list[Lag], integrators: int) -> float:
        return delay_of(parts, lags, shape_of(parts, order, integrators), late).at

    lags = [Lag(i, LineInTheta(tau)) for i, tau in enumerate(parts.lags)]
    removal = remove_leads_1998(list(enumerate(parts.leads)), lags, parts.integrators, delay)
    shape = shape_of(parts, order, removal.integrators)
    theta = delay_of(parts, removal.lags, shape, late).at - removal.subtracted
    return TrialReduction(removal, shape, LineInTheta(theta), ())


def _self_consistent(at: Callable[[float], TrialReduction], longest: float) -> list[TrialReduction]:
    """Outcomes whose delay is the one assumed, smallest first; where there is none, the nearest."""
    proposed: set[float] = set()
    probed: list[tuple[float, TrialReduction]] = []

    def probe(theta: float) -> TrialReduction:
        trial = at(theta)
        probed.append((theta, trial))
        if not trial.theta.slope:
            proposed.add(trial.theta.at)
        return trial

    intervals = deque([(0.0, longest)])
    probe(0.0)
    while intervals and len(probed) < MOST_PROBES:
        low, high = intervals.popleft()
        if high - low <= SAME_DELAY * longest:
            continue
        theta = low + INSIDE * (high - low)
        turning_points = probe(theta).turning_points
        below = max((b for b in turning_points if low < b < theta), default=low)
        above = min((b for b in turning_points if theta < b < high), default=high)
        if below > low:
            probe(below)
            intervals.append((low, below))
        if above < high:
            probe(above)
            intervals.append((above, high))
    found: list[TrialReduction] = []
    for theta in sorted(value for value in proposed if 0 <= value <= longest * (1 + SAME_DELAY)):
        trial = at(theta)
        value = trial.theta(theta)
        if abs(value - theta) <= SAME_DELAY * longest and not any(_same(value, other, longest) for other in found):
            found.append(resolved(trial, theta))
    return found or [_nearest(probed)]


def _same(theta: float, other: TrialReduction, longest: float) -> bool:
    return abs(theta - other.theta.at) <= 2 * SAME_DELAY * longest


def _nearest(probed: list[tuple[float, TrialReduction]]) -> TrialReduction:
    """Where theta_out jumps across theta there is no fixed point (2 of 12000 random plants): the closest probe."""
    theta, trial = min(probed, key=lambda item: abs(item[1].theta(item[0]) - item[0]))
    return replace(resolved(trial, theta), consistent=False)


def _choose(plant: Plant, models: list[Model]) -> tuple[Candidate, ...]:
    """Candidates with Ms and load error; the smallest error of those with theta > 0 and a finite tight Ms.

    Where no error is known: the smallest theta > 0 with Ms <= 2, else the smallest Ms, else the largest theta.
    """
    if len(models) == 1:
        return (Candidate(models[0].theta, models[0], math.nan, math.nan, True),)
    peaks = [_tight_Ms(plant, model) for model in models]
    finite = [i for i, Ms in enumerate(peaks) if math.isfinite(Ms)]
    found = [at_equal_peak(plant, model) for model in models]
    errors = [math.nan if each is None else each.load_error for each in found]
    compared = [i for i in finite if math.isfinite(errors[i])]
    good = [i for i in finite if peaks[i] <= LARGEST_MS]
    if compared:
        chosen = min(compared, key=lambda i: errors[i])
    else:
        chosen = good[0] if good else min(finite, key=lambda i: peaks[i], default=len(models) - 1)
    rows = zip(models, peaks, errors, strict=True)
    return tuple(Candidate(model.theta, model, Ms, error, i == chosen) for i, (model, Ms, error) in enumerate(rows))


def _tight_Ms(plant: Plant, model: Model) -> float:
    """Ms of the SIMC loop at tau_c = theta round the original plant, nan where there is no such stable loop."""
    try:
        return margins(Loop(plant, simc(model))).Ms
    except InvalidParameter:  # the rule ends before this model, or the loop is ill-posed
        return math.nan
