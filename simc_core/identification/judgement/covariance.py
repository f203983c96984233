"""Standard errors that hold where the noise is correlated, the measurement quantised, and drift may be hidden.

V = H M H s^2, H = (J'J)^-1 over all parameters, the linear ones too; M = sum_ij J_i J_j r^|i-j| for noise whose
neighbours are correlated by r [NW87 with the correlation of a first-order process instead of a window].
"""

import numpy as np
from scipy.signal import lfilter

from simc_core.identification.estimator.fit import Fit
from simc_core.identification.estimator.held_input import Array
from simc_core.identification.judgement.noise import Noise

WIDE = 2.0  # standard deviation of ln lag before the record is looked at


def covariance(fit: Fit, noise: Noise, floor: float) -> Array:
    """Covariance of x = (theta, ln lags...) and the linear part, shape (p, p).

    Parameters
    ----------
    fit : Fit
    noise : Noise
        Of the same record.
    floor : float
        Standard deviation below which the noise is not believed.
    """
    freedom = degrees_of_freedom(fit, noise)
    return _spread(_bounded(fit, noise, floor), fit.problem.parts, noise, floor) * (freedom + fit.free) / freedom


def _bounded(fit: Fit, noise: Noise, floor: float) -> Array:
    """The jacobian with a row for each of x: theta lies in its bounds, lags within a few powers of e of what is found.

    Without them a lag far below the sampling interval, which no sample shows, would spoil the errors of the others.
    """
    count = fit.point.x.size
    wide = np.array([fit.problem.high[0], *[1.0 if lag == "zeta" else WIDE for lag in fit.problem.structure.lags]])
    rows = np.zeros((count, fit.free))
    rows[:, :count] = np.diag(max(noise.sigma, floor) / wide)
    return np.concatenate([fit.jacobian, rows])


def _spread(jacobian: Array, parts: list[slice], noise: Noise, floor: float) -> Array:
    """Covariance, shape (p, p), for the columns of `jacobian`, shape (n, p)."""
    scale = np.sqrt(np.sum(jacobian**2, axis=0))
    scale = np.where(scale > 0, scale, 1.0)
    jacobian = jacobian / scale
    square = jacobian.T @ jacobian
    inverse = np.linalg.pinv(square, rcond=1e-13, hermitian=True)
    middle = square
    if noise.correlation > 0:
        r = noise.correlation
        across = np.zeros_like(square)
        for part in parts:
            own = jacobian[part]
            across += own.T @ lfilter([0.0, r], [1.0, -r], own, axis=0)
        middle = square + across + across.T
    return inverse @ middle @ inverse * max(noise.sigma, floor) ** 2 / np.outer(scale, scale)


def degrees_of_freedom(fit: Fit, noise: Noise) -> float:
    """Effective samples less parameters, at least 3."""
    return max(noise.effective - fit.free, 3.0)


def quantised(fit: Fit, noise: Noise, step: float) -> Array:
    """What a resolution adds to the variances of x and of the gains where no noise smooths it, shape (p,).

    The error of a level is up to half a step and does not average out: it moves theta by the time in which the
    steepest part of the response crosses it, and a gain by both levels.
    """
    found = np.zeros(fit.free)
    if step <= 0 or noise.sigma > 0.6 * step:
        return found
    largest = np.max(np.abs(fit.jacobian), axis=0)
    variance = step**2 / 12
    unlinear = fit.point.x.size
    gains = len(fit.problem.structure.gains)
    for i in range(unlinear + gains):
        if largest[i] > 0:
            found[i] = (2.0 if i >= unlinear else 1.0 if i == 0 else 0.3) * variance / largest[i] ** 2
    return found
