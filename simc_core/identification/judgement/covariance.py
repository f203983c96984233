"""Standard errors that hold where the noise is correlated, the measurement quantised, and drift may be hidden.

V = H M H s^2, H = (J'J)^-1 over all parameters, the linear ones too; M = sum_ij J_i J_j r^|i-j| for noise whose
neighbours are correlated by r [NW87 with the correlation of a first-order process instead of a window].
"""

import numpy as np

from simc_core.algebra.recursion import first_order
from simc_core.identification.estimator.fit import FEW, Fit
from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.problem import Problem
from simc_core.identification.judgement.noise import Noise

NEARLY_EQUAL = 0.35  # half the logarithm of the ratio of two lags
UNEQUAL = 0.8  # the same, from where they are surely told apart
TWICE = 4.0  # the rise at two standard deviations
APART = np.geomspace(0.05, 5.0, 24)  # by how much more it is tried
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
    found = _spread(_bounded(fit, noise, floor), fit.problem.parts, noise, floor) * (freedom + fit.free) / freedom
    _, equal = _parting(fit, noise, floor)
    found[1:3, 1:3] += equal**2 * np.array([[1.0, -1.0], [-1.0, 1.0]]) if equal else 0.0
    return found


def _bounded(fit: Fit, noise: Noise, floor: float) -> Array:
    """The jacobian with a row for each of x: theta lies in its bounds, lags within a few powers of e of what is found.

    Without them a lag far below the sampling interval, which no sample shows, would spoil the errors of the others.
    """
    count = fit.point.x.size
    wide = np.array([fit.problem.high[0], *[1.0 if lag == "zeta" else WIDE for lag in fit.problem.structure.lags]])
    rows = np.zeros((count, fit.free))
    rows[:, :count] = np.diag(max(noise.sigma, floor) / wide)
    apart, _ = _parting(fit, noise, floor)
    if np.isfinite(apart):
        row = np.zeros((1, fit.free))
        row[0, 1:3] = np.array([0.5, -0.5]) * max(noise.sigma, floor) / apart
        rows = np.concatenate([rows, row])
    return np.concatenate([fit.jacobian, rows])


def _parting(fit: Fit, noise: Noise, floor: float) -> tuple[float, float]:
    """How much farther two lags may part, and whether they may be equal, in half the logarithm of their ratio.

    About equality that does not show in the jacobian, which is even there: it is looked up in the sum of squares, the
    sum of the lags held. inf where it need not be, or nothing holds them; 0 where they are not equal.
    """
    structure = fit.problem.structure
    if structure.lags != ("tau1", "tau2"):
        return np.inf, 0.0
    x = fit.point.x
    half = abs(x[1] - x[2]) / 2
    if half > UNEQUAL:
        return np.inf, 0.0
    problem = fit.problem
    few = [record.reduced(FEW) for record in problem.records]
    small = Problem(structure, few, problem.degree > 0, problem.start)
    total = np.exp(x[1]) + np.exp(x[2])
    kept = int(np.count_nonzero(problem.root_weight))
    rise = max(noise.sigma, floor) ** 2 * kept / max(noise.effective, 1.0)

    def cost(half: float) -> float:
        lags = total * np.exp([half, -half]) / (2 * np.cosh(half))
        return small.at(np.array([x[0], *np.log(lags)])).cost

    least = cost(half)
    equal = half if cost(0.0) - least < TWICE * rise else 0.0
    if half > NEARLY_EQUAL:
        return np.inf, equal
    return next((apart for apart in APART.tolist() if cost(half + apart) - least > rise), np.inf), equal


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
            across += r * own[1:].T @ first_order(own, r)[:-1]
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
