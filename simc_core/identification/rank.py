"""All structures against one trend, ranked by a criterion that has the same noise for all.

IC = 2 n_e ln(sigma) + p ln(n_e) + 2 p, with n_e the effective samples of the closest fit: with its own n_e, a structure
that fits badly, and so leaves correlated residuals, would win.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import exp, log, sqrt

import numpy as np

from simc_core import checks
from simc_core.controllers.forms import IController
from simc_core.errors import InvalidParameter, NotIdentifiable, SimcError
from simc_core.identification.identified import Identified
from simc_core.identification.identify import identify, resolution_of, response_of, trends_of
from simc_core.identification.trend import Trend
from simc_core.identification.uncertainty import NEAR
from simc_core.rules.simc import simc
from simc_core.wording import Text, said

USUAL = ("FOPDT", "SOPDT", "IPDT", "IPDT_lag")
MARGIN = 2.0  # of the criterion, for each parameter
BELIEVED = 1e-3  # of the response: a structure gains nothing by fitting better
REST = 10  # samples before the first move from which a drift can be seen
SURE = 4.0  # standard errors of it
UNLIKELY = 10.0  # of the criterion, behind the best self-regulating structure
UNSEEN = said(
    "The drift of this model is not seen before OP moves: PV has not settled rather than integrates. Do not tune on it."
)


def identify_all(
    trend: Trend | Sequence[Trend],
    structures: Sequence[str] = USUAL,
    *,
    drift: bool | None = None,
    between_samples: bool = False,
    sign: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Identified, ...]:
    """Several structures fitted, the best first.

    Parameters
    ----------
    trend : Trend, or several
    structures : sequence of str
        Keys, see `identify`; by default those that any trend may be asked for.
    drift : bool, optional
    between_samples : bool
    sign : {1, -1}, optional
        As for `identify`.
    progress : callable, optional
        Called with the number of structures that are done and of all, before each.

    Returns
    -------
    tuple of Identified
        `criterion` is the distance from the first, and the first says which others fit nearly as well.

    Raises
    ------
    NotIdentifiable
        No structure could be fitted; the reason of the first.
    InvalidParameter
        As for `identify`.

    Examples
    --------
    >>> import numpy as np
    >>> from simc_core import Trend, identify_all
    >>> t = np.arange(0.0, 60.0)
    >>> y = 10 * np.where(t > 13.5, 1 - np.exp(-(t - 13.5).clip(0) / 8), 0)
    >>> identify_all(Trend(t, y, np.where(t >= 10, 55, 50)))[0].structure
    'FOPDT'
    """
    trends = trends_of(trend)
    keys = checks.items("structures", structures, 8)
    if not keys:
        raise InvalidParameter(said("structures must name at least one, found none"))
    found: list[Identified] = []
    reasons: list[NotIdentifiable] = []
    for i, key in enumerate(keys):
        if progress is not None:
            progress(i, len(keys))
        try:
            found.append(identify(trends, key, drift=drift, between_samples=between_samples, sign=sign))
        except NotIdentifiable as error:
            reasons.append(error)
    if not found:
        raise reasons[0]
    return _ranked(found, trends)


def _ranked(found: list[Identified], trends: list[Trend]) -> tuple[Identified, ...]:
    step = resolution_of(trends)
    floor = max(BELIEVED * response_of(trends), step / sqrt(12))
    closest = min(found, key=lambda one: one.noise)
    effective = max(closest.estimate.noise.effective, 4.0)
    value = {
        one.structure: 2 * effective * log(max(one.noise, floor)) + one.estimate.fit.free * (log(effective) + MARGIN)
        for one in found
    }
    regulating = [value[one.structure] for one in found if not one.plant.integrators]
    found = [_doubted(one, trends, floor) for one in found]
    for one in found:
        if regulating and UNSEEN in one.verdicts:
            value[one.structure] = max(value[one.structure], min(regulating) + UNLIKELY)
    ranked = sorted(found, key=lambda one: value[one.structure])
    best = value[ranked[0].structure]
    placed = [replace(one, criterion=value[one.structure] - best) for one in ranked]
    placed[0] = replace(placed[0], verdicts=(*placed[0].verdicts, *_nearly(placed)))
    return tuple(placed)


def _doubted(one: Identified, trends: list[Trend], floor: float) -> Identified:
    """An integrating model whose drift is not there while OP rests: a process that has not settled looks like that."""
    if not one.plant.integrators:
        return one
    for trend, drift in zip(trends, np.atleast_1d(one.drift), strict=True):
        rest = trend.t < trend.instants_of_u[np.flatnonzero(np.diff(trend.u))[0] + 1]
        t, y = trend.t[rest] - trend.t[0], trend.y[rest]
        if t.size < REST or t[-1] <= t[0]:
            continue
        y = y - drift * t
        slope, level = np.polyfit(t, y, 1)
        spread = max(float(np.std(y - slope * t - level)), floor)
        if abs(slope) * float(np.std(t)) > SURE * spread / sqrt(t.size):
            return replace(one, verdicts=(UNSEEN, *one.verdicts))
    return one


def _nearly(placed: list[Identified]) -> list[Text]:
    """What the structures that fit nearly as well would change."""
    return [_as_well(placed[0], other) for other in placed[1:] if other.criterion <= NEAR]


def _as_well(best: Identified, other: Identified) -> Text:
    likely = 100 / (1 + exp(other.criterion / 2))
    title = other.estimate.fit.problem.structure.title
    plain = said(
        "A model {title} fits nearly as well ({likely:.0f} to {best:.0f} %).",
        title=title,
        likely=likely,
        best=100 - likely,
    )
    try:
        ours, theirs = simc(best.model), simc(other.model)
    except SimcError:
        return plain
    if isinstance(ours, IController) or isinstance(theirs, IController):
        return plain
    return said(
        "A model {title} fits nearly as well ({likely:.0f} to {best:.0f} %); SIMC with tau_c = theta would set "
        "Kc {Kc:.3g} and tau_I {tau_I:.3g} instead of {our_Kc:.3g} and {our_tau_I:.3g}.",
        title=title,
        likely=likely,
        best=100 - likely,
        Kc=theirs.Kc,
        tau_I=theirs.tau_I,
        our_Kc=ours.Kc,
        our_tau_I=ours.tau_I,
    )
