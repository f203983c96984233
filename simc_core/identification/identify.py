"""A model from a trend: one structure, or all of them ranked."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from simc_core import checks
from simc_core.errors import InvalidParameter, NotIdentifiable
from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.records import as_record
from simc_core.identification.estimator.structures import STRUCTURES
from simc_core.identification.identified import Identified
from simc_core.identification.judgement.estimate import Estimate, estimate
from simc_core.identification.judgement.gain_per_move import GainOfMove, disagreement, gains_per_move
from simc_core.identification.judgement.noise import resolution
from simc_core.identification.judgement.refusals import refuse_before, refuse_weak
from simc_core.identification.judgement.verdicts import along, disagree, verdicts
from simc_core.identification.models import as_model
from simc_core.identification.moves import find_moves
from simc_core.identification.parameters import natural
from simc_core.identification.trend import MOST_SAMPLES, Trend, check_trend
from simc_core.wording import counted, said

MOST_TRENDS = 20
PLAINER = 1.5  # times the noise that a plainer model may leave
ON_SETPOINT = 0.03  # share of the moves
BELIEVED = 1e-4  # of the response: deviations below are not believed


def identify(
    trend: Trend | Sequence[Trend],
    structure: str = "FOPDT",
    *,
    drift: bool | None = None,
    between_samples: bool = False,
    sign: int | None = None,
) -> Identified:
    """A model by output error, y = model(u) + e, with the dead time exact, and what it is worth.

    Parameters
    ----------
    trend : Trend, or several
        Several are fitted together: gain, dead time and lags are theirs in common, level, drift and start their own.
    structure : str
        FOPDT, SOPDT, IPDT, IPDT_lag, DIPDT, inverse, oscillating or unstable (closed-loop records only).
    drift : bool, optional
        Whether PV drifts by itself. None: it is weighed whether it does.
    between_samples : bool
        OP was written down from time to time, and moved somewhere between: its moves are put half-way.
    sign : {1, -1}, optional
        Known sign of the gain.

    Returns
    -------
    Identified
        Times in the unit of the trend, gains in PV per OP.

    Raises
    ------
    NotIdentifiable
        The trend cannot tell: OP never moves, the loop was closed and not excited, PV does not answer OP.
    InvalidParameter
        Another structure, or another value.

    References
    ----------
    [GP73] variable projection; [YIG07] search along the dead time; [H64] weights; [NW87] standard errors.

    Examples
    --------
    2 e^{-3.5s}/(8s + 1), a step of 5 at t = 10:

    >>> import numpy as np
    >>> from simc_core import Trend, identify
    >>> t = np.arange(0.0, 60.0)
    >>> y = 40 + 10 * np.where(t > 13.5, 1 - np.exp(-(t - 13.5).clip(0) / 8), 0)
    >>> found = identify(Trend(t, y, np.where(t >= 10, 55, 50)))
    >>> {name: round(value, 4) for name, value in found.parameters.items()}
    {'k': 2.0, 'theta': 3.5, 'tau1': 8.0}
    """
    trends = trends_of(trend)
    shape = _structure(structure)
    if sign is not None and checks.whole("sign", sign, -1, 1) == 0:
        raise InvalidParameter(said("sign must be 1 or -1, found 0"))
    for one in trends:
        refuse_before(one)
    found = _estimate(trends, shape, drift, between_samples)
    if drift is None:
        found = _plainer(trends, found, between_samples)
    return _told(trends, found, sign)


def trends_of(given: Trend | Sequence[Trend]) -> list[Trend]:
    """One trend or several as a list. Raises WrongType, InvalidParameter."""
    if isinstance(given, Trend):
        return [given]
    trends = [check_trend(one) for one in checks.items("trend", given, MOST_TRENDS)]
    if not trends:
        raise InvalidParameter(said("trend must be a Trend or a list of them, found an empty list"))
    size = sum(one.t.size for one in trends)
    if size > MOST_SAMPLES:
        raise InvalidParameter(
            said("The trends may have {most} samples together, found {size}", most=MOST_SAMPLES, size=size)
        )
    return trends


def _structure(name: str) -> str:
    return checks.one_of("structure", name, STRUCTURES)


def response_of(trends: list[Trend]) -> float:
    """How far PV moves, single samples left out."""
    ranges = [float(np.quantile(one.y, 0.98) - np.quantile(one.y, 0.02)) for one in trends]
    return max(*ranges, *(1e-9 * float(np.ptp(one.y)) for one in trends))


def resolution_of(trends: list[Trend]) -> float:
    """The step in which PV is written down, 0 for none."""
    return max(resolution(one.y) for one in trends)


def _estimate(
    trends: list[Trend], structure: str, drift: bool | None, between_samples: bool, start: bool = True
) -> Estimate:
    shape = STRUCTURES[structure]
    records = [as_record(one, between_samples) for one in trends]
    fewest = 2 * (4 + len(shape.lags) + len(shape.gains))
    size = sum(record.t.size for record in records)
    if size < fewest:
        raise NotIdentifiable(
            counted(
                "{n} sample is too little for this structure: it needs at least {fewest}",
                "{n} samples are too few for this structure: it needs at least {fewest}",
                size,
                fewest=fewest,
            )
        )
    return estimate(shape, records, _floor(trends), resolution_of(trends), drift, start)


def _plainer(trends: list[Trend], found: Estimate, between_samples: bool) -> Estimate:
    """The estimate, or one without drift and unsettled start where these make the gains of the moves disagree.

    A drift that is one leaves the moves their common gain. One that only makes up for a poor structure does not, and
    what it takes from the gain is doubt about it.
    """
    structure = found.fit.problem.structure
    if structure.integrating or not (found.drift or found.start) or not disagreement(_gains(trends, found)):
        return found
    for drift, start in ((False, False), (False, True), (True, False)):
        if drift > found.drift or start > found.start or (drift, start) == (found.drift, found.start):
            continue
        other = _estimate(trends, structure.key, drift, between_samples, start)
        if other.start > start or other.noise.sigma > PLAINER * found.noise.sigma:
            continue
        gains = _gains(trends, other)
        if gains and not disagreement(gains):
            off = other.values - found.values
            return replace(other, spread=other.spread + np.outer(off, off))
    return found


def _gains(trends: list[Trend], found: Estimate) -> tuple[GainOfMove, ...]:
    """Of each move of each trend."""
    share = 1 - found.noise.sigma / max(float(np.std(_about_means(found))), 1e-300)
    return gains_per_move(found.fit, share, [find_moves(one) for one in trends], _floor(trends))


def _about_means(found: Estimate) -> Array:
    """PV as its deviation from its mean, of each trend its own."""
    problem = found.fit.problem
    return np.concatenate([problem.y[part] - problem.y[part].mean() for part in problem.parts])


def _floor(trends: list[Trend]) -> float:
    """Deviation of PV below which nothing is believed."""
    return max(BELIEVED * response_of(trends), resolution_of(trends) / np.sqrt(12))


def _told(trends: list[Trend], found: Estimate, sign: int | None) -> Identified:
    problem = found.fit.problem
    first = problem.structure.gains[0]
    names, values, covariance = natural(found)
    errors = np.sqrt(np.diag(covariance))
    parameters: Mapping[str, float] = dict(zip(names, values.tolist(), strict=True))
    _refuse_weak(trends, found)
    if sign is not None and parameters[first] * sign <= 0:
        raise NotIdentifiable(
            said(
                "The gain is {gain:.3g}, against the sign given: PV was moved by something else, or the loop was "
                "closed and not excited.",
                gain=parameters[first],
            )
        )
    width = found.half_width
    plant, model = as_model(problem.structure.key, parameters)
    own = problem.root_weight > 0
    residuals = found.fit.residual
    moved = float(np.linalg.norm(_about_means(found) * own))
    share = 1 - float(np.linalg.norm(residuals * own)) / moved if moved > 0 else 0.0
    moves = _gains(trends, found)
    bias, slope = along(found)
    return Identified(
        structure=problem.structure.key,
        model=model,
        plant=plant,
        parameters=parameters,
        standard_errors=dict(zip(names, errors.tolist(), strict=True)),
        intervals=_intervals(names, values, errors, width),
        covariance=covariance,
        bias=float(bias[0]) if len(trends) == 1 else tuple(bias.tolist()),
        drift=float(slope[0]) if len(trends) == 1 else tuple(slope.tolist()),
        residuals=residuals,
        predicted=problem.y - residuals,
        fit=share,
        verdicts=(*_follows(trends, parameters, bias), *verdicts(found, width, moves, share)),
        slope=_slope(names, values, covariance),
        gains=moves,
        noise=found.noise.sigma,
        correlation=found.noise.correlation,
        criterion=np.nan,
        estimate=found,
    )


def _refuse_weak(trends: list[Trend], found: Estimate) -> None:
    """Refuse a gain that is none; where that is so because moves disagree, this is the reason."""
    try:
        refuse_weak(found)
    except NotIdentifiable:
        for reason in disagree(_gains(trends, found)):
            raise NotIdentifiable(reason) from None
        raise


def _follows(trends: list[Trend], parameters: Mapping[str, float], bias: Array) -> list[str]:
    """A warning where PV comes to rest on the values of OP themselves, as it does on a set point."""
    if abs(parameters.get("k", 0.0) - 1) > ON_SETPOINT:
        return []
    for one, level in zip(trends, bias.tolist(), strict=True):
        if abs(level - one.u[0]) > ON_SETPOINT * float(np.ptp(one.u)):
            return []
    return [
        said(
            "PV comes to rest on the very values taken for OP: are they the set point? Then this is the model of a "
            "closed loop, not of the process, and no settings follow from it."
        )
    ]


def _intervals(names: list[str], values: Array, errors: Array, width: float) -> dict[str, tuple[float, float]]:
    """Symmetric for gains, theta and zeta (theta and zeta >= 0), in proportion for lags."""
    found = {}
    for name, value, error in zip(names, values.tolist(), errors.tolist(), strict=True):
        if name.startswith("tau") or name == "a":
            factor = float(np.exp(min(width * error / value, 700.0)))
            found[name] = (value / factor, value * factor)
        else:
            low = value - width * error
            found[name] = (max(low, 0.0) if name in ("theta", "zeta") else low, value + width * error)
    return found


def _slope(names: list[str], values: Array, covariance: Array) -> tuple[float, float] | None:
    if "k" not in names or "tau1" not in names:
        return None
    i, j = names.index("k"), names.index("tau1")
    gradient = np.zeros(len(names))
    gradient[i], gradient[j] = 1 / values[j], -values[i] / values[j] ** 2
    return float(values[i] / values[j]), max(float(gradient @ covariance @ gradient), 0.0) ** 0.5
