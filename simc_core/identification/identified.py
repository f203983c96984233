"""What identification gives: a model with its errors, and words about both."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simc_core.identification.judgement.estimate import Estimate
from simc_core.identification.judgement.gain_per_move import GainOfMove
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Identified:
    """A model fitted to a trend.

    Attributes
    ----------
    structure : str
        Its key, see `identify`.
    model : reduced model
        What the tuning rules take; of "inverse" the half-rule model of `plant`.
    plant : Plant
        What was fitted.
    parameters, standard_errors : mapping from str to float
        By name, in the units of the trend: k in PV per OP, times in its time unit.
    intervals : mapping from str to (float, float)
        95 % confidence intervals.
    covariance : array, shape (m, m)
        Of the parameters, in their order.
    bias : float or tuple of float
        PV at the first sample with OP at rest at its first value; one for each trend where there are several.
    drift : float or tuple of float
        Change of PV per time unit that OP does not explain.
    residuals, predicted : array, shape (n,)
        PV less the model, and the model, at the samples; of several trends one after the other.
    fit : float
        1 - norm(residuals)/norm(PV - mean), at most 1.
    verdicts : tuple of str
        What to think of it, in words, the most serious first.
    slope : (float, float) or None
        k/tau1 with its standard error: known well where k and tau1 are not.
    gains : tuple of GainOfMove
        Gain of each move of OP, where there are several; of several trends, of each move of each.
    noise : float
        Standard deviation of the residuals.
    correlation : float
        Of neighbouring residuals, 0 to 0.995.
    criterion : float
        From `identify_all`: how much worse than the best structure, 0 for the best; nan from `identify`.
    estimate : Estimate
        The same in the coordinates of the estimator: theta, ln lags, gains.
    """

    structure: str
    model: Model
    plant: Plant
    parameters: Mapping[str, float]
    standard_errors: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    covariance: Array
    bias: float | tuple[float, ...]
    drift: float | tuple[float, ...]
    residuals: Array
    predicted: Array
    fit: float
    verdicts: tuple[str, ...]
    slope: tuple[float, float] | None
    gains: tuple[GainOfMove, ...]
    noise: float
    correlation: float
    criterion: float
    estimate: Estimate
