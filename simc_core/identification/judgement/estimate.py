"""One structure with its errors: drift and unsettled start are weighed, and what is not decided adds to the errors."""

from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from simc_core.identification.estimator.fit import Fit, continued, fitted, polished
from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.records import OFTEN, Record
from simc_core.identification.estimator.structures import Structure
from simc_core.identification.judgement.covariance import covariance, degrees_of_freedom, quantised
from simc_core.identification.judgement.noise import Noise, noise_of

MARGIN = 2.0  # of the criterion, for each parameter of drift and start
WORSE = 2.0  # times the deviation, at which what is not plausible is taken after all
BEFORE = 4  # samples before the first move from which an unsettled start can be told


@dataclass(frozen=True, slots=True, eq=False)
class Estimate:
    """A structure fitted to records.

    Parameters
    ----------
    fit : Fit
        The variant taken.
    drift, start : bool
        What goes along with it.
    noise : Noise
        That it leaves.
    values : array, shape (m,)
        theta, ln lags (zeta as it is), gains.
    spread : array, shape (m, m)
        Their covariance; variants that fit nearly as well are in it.
    gain_error : float
        Standard error of the gain in the variant taken alone.
    freedom : float
        Degrees of freedom of Student's t for the intervals.
    """

    fit: Fit
    drift: bool
    start: bool
    noise: Noise
    values: Array
    spread: Array
    gain_error: float
    freedom: float

    @property
    def half_width(self) -> float:
        """Of a 95 % interval, in standard errors: Student's t for the samples that count."""
        return float(stdtrit(self.freedom, 0.975))


def estimate(
    structure: Structure,
    records: list[Record],
    floor: float,
    step: float,
    drift: bool | None,
    start: bool = True,
) -> Estimate:
    """The structure with its errors.

    Parameters
    ----------
    structure : Structure
    records : list of Record
    floor : float
        Deviation of y below which nothing is believed, > 0.
    step : float
        Resolution of y, 0 for none.
    drift : bool or None
        Whether there is a drift; None: weighed.
    start : bool
        Whether an unsettled start is weighed.
    """
    drifts = [True] if structure.integrating else [drift] if drift is not None else [True, False]
    begun = all(_start_shows(record) for record in records)
    startable = begun and not structure.always_free and bool(structure.lags)
    # searched for with drift and without: what drift makes of a poor structure is no place to begin from
    fits = {(one, False): fitted(structure, records, one, False, floor) for one in drifts}
    near = [fit.point.x for fit in fits.values()]
    if start and startable:
        for one, alone in [(key[0], fit) for key, fit in fits.items()]:
            fits[one, True] = continued(structure, alone.problem.records, one, True, floor, near)
    return _weighed(fits, floor, step)


def _start_shows(record: Record) -> bool:
    """There are samples before the first move, or OP moves all the time, so that no start can be at rest."""
    return int(np.count_nonzero(record.t < record.first_move)) >= BEFORE or record.held.s.size > OFTEN * record.t.size


def _weighed(fits: dict[tuple[bool, bool], Fit], floor: float, step: float) -> Estimate:
    sound = {key: fit for key, fit in fits.items() if fit.problem.structure.integrating or _plausible(fit)}
    noises = {key: noise_of(fit) for key, fit in fits.items()}
    if sound and min(noises[key].sigma for key in sound) <= WORSE * min(noise.sigma for noise in noises.values()):
        fits, noises = sound, {key: noises[key] for key in sound}
    closest = min(noises.values(), key=lambda noise: noise.sigma)
    effective = max(closest.effective, 4.0)
    loss = {key: 2 * effective * np.log(max(noises[key].sigma, floor)) for key in fits}
    criterion = {key: loss[key] + fit.free * np.log(effective) + MARGIN * sum(key) for key, fit in fits.items()}
    chosen = min(criterion, key=lambda key: criterion[key])
    soft = {key: loss[key] + 2 * fit.free for key, fit in fits.items()}
    least = min(soft.values())
    weight = {key: float(np.exp(-(value - least) / 2)) for key, value in soft.items()}
    fit = fits[chosen] = polished(fits[chosen])
    noise = noises[chosen] = noise_of(fit)
    values = _values(fit)
    spread, total = np.zeros((values.size, values.size)), 0.0
    for key, other in fits.items():
        own, off = _spread(other, noises[key], floor, step), _values(other) - values
        if key == chosen or np.max(own.diagonal()[1 : other.point.x.size], initial=0.0) < 1.0:
            spread += weight[key] * (own + np.outer(off, off))
            total += weight[key]
    alone = float(np.sqrt(_spread(fit, noise, floor, step)[fit.point.x.size, fit.point.x.size]))
    return Estimate(fit, *chosen, noise, values, spread / total, alone, degrees_of_freedom(fit, noise))


def _plausible(fit: Fit) -> bool:
    """Drift and start do not make more of PV than there is, and theta is within the record: else they only make up
    for a poor structure."""
    problem, beta = fit.problem, fit.point.beta
    gains, width = len(problem.structure.gains), problem.degree + 1
    moved = max(float(np.ptp(problem.y[problem.root_weight > 0])), 1e-300)
    polynomials = beta[gains : gains + width * len(problem.records)].reshape(-1, width)
    drifts = np.abs(polynomials[:, 1:]).max(initial=0.0)
    starts = np.abs(beta[gains + width * len(problem.records) :]).max(initial=0.0)
    return bool(fit.point.x[0] < 0.98 * problem.high[0] and max(drifts, starts) < moved)


def _values(fit: Fit) -> Array:
    found = np.concatenate([fit.point.x, fit.point.beta[: len(fit.problem.structure.gains)]])
    return found[_order(fit)]


def _spread(fit: Fit, noise: Noise, floor: float, step: float) -> Array:
    whole = covariance(fit, noise, floor) + np.diag(quantised(fit, noise, step))
    order = _order(fit)
    return whole[np.ix_(order, order)]


def _order(fit: Fit) -> list[int]:
    """Places of theta, lags and gains, the larger of two lags first: variants must not differ by their order alone."""
    order = list(range(fit.point.x.size + len(fit.problem.structure.gains)))
    if fit.problem.structure.lags == ("tau1", "tau2") and fit.point.x[2] > fit.point.x[1]:
        order[1], order[2] = 2, 1
    return order
