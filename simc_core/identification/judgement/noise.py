"""The noise of a record: size, correlation, resolution of the measurement."""

from dataclasses import dataclass

import numpy as np

from simc_core.identification.estimator.fit import Fit
from simc_core.identification.estimator.held_input import Array

MOST_CORRELATED = 0.995  # beyond that a record is one sample, and says nothing


@dataclass(frozen=True, slots=True)
class Noise:
    """Residuals in numbers.

    Parameters
    ----------
    sigma : float
        Standard deviation.
    correlation : float
        Of neighbours, 0 to 0.995, with its bias taken out.
    effective : float
        n (1 - r)/(1 + r): independent samples that would say as much.
    """

    sigma: float
    correlation: float
    effective: float


def noise_of(fit: Fit) -> Noise:
    """The noise that a fit leaves."""
    problem = fit.problem
    residual = fit.residual * (problem.root_weight > 0)
    kept = int(np.count_nonzero(problem.root_weight))
    together, square = 0.0, 0.0
    for part in problem.parts:
        one = residual[part]
        together += float(one[1:] @ one[:-1])
        square += float(one @ one)
    plain = together / square if square > 0 else 0.0
    left = max(kept - fit.free, 1)
    correlation = min(max((plain * kept + 1) / left, 0.0), MOST_CORRELATED) if plain > 0 else 0.0
    sigma = float(np.sqrt(fit.point.cost / left))
    return Noise(sigma, correlation, kept * (1 - correlation) / (1 + correlation))


def resolution(y: Array) -> float:
    """The step in which y is written down; 0 where there is none to be seen.

    Half or more of the distances of neighbouring values are whole multiples of it, within 2 % for rounded exports.
    """
    values = np.unique(y)
    if values.size < 3 or values.size > 0.5 * y.size:
        return 0.0
    steps = np.diff(values)
    step = float(np.quantile(steps, 0.1))
    multiples = steps / step
    off = np.abs(multiples - np.round(multiples))
    return step if np.mean(off < 0.02 * np.maximum(np.round(multiples), 1)) > 0.95 else 0.0
