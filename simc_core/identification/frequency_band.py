"""The frequency response that a trend shows, with its uncertainty."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.identification.cloud import Cloud, Uncertain, clouds
from simc_core.identification.cloud_peaks import scales
from simc_core.identification.estimator.held_input import Array
from simc_core.wording import said

POINTS = 200
MOST_OMEGA = 2000
ABOVE, BELOW = 20.0, 0.02  # of the crossing of -180 degrees, from where to where it is drawn


@dataclass(frozen=True, slots=True, eq=False)
class FrequencyBand:
    """G(j omega) of the estimate, and between what its magnitude and phase lie.

    Attributes
    ----------
    omega : array, shape (n,)
        In rad per time unit.
    G : array, shape (n,)
        Of the estimate, complex.
    phase : array, shape (n,)
        Of the estimate, in degrees, dead time wound on.
    magnitude_low, magnitude_high, phase_low, phase_high : array, shape (n,)
        Between them each value lies with the probability that was asked for.
    omega_180 : (float, float, float)
        Where the phase of the estimate passes -180 degrees, and between what; nan where it does not.
    """

    omega: Array
    G: NDArray[np.complex128]
    phase: Array
    magnitude_low: Array
    magnitude_high: Array
    phase_low: Array
    phase_high: Array
    omega_180: tuple[float, float, float]


def frequency_band(uncertain: Uncertain, omega: ArrayLike | None = None, probability: float = 0.95) -> FrequencyBand:
    """Magnitude and phase over frequency, with the band in which they lie.

    Structures that fit nearly as well are in the band. A quotient of Fourier transforms of OP and PV errs by 9 to 77 %
    at omega_180 with noise of 0 to 3 %; the fitted model by less than 5 %.

    Parameters
    ----------
    uncertain : Identified or Uncertainty, or several
        See `uncertainty_of`.
    omega : array, optional
        Rising and positive, at most 2000. None: around the frequency where the phase is -180 degrees.
    probability : float
        0.5 to 0.999.

    Returns
    -------
    FrequencyBand

    Raises
    ------
    InvalidParameter
        Frequencies that do not rise, or another value outside its bounds.

    Examples
    --------
    Without noise the band is narrow; at omega = 1/tau1 the magnitude of a first-order process is k/sqrt 2:

    >>> import numpy as np
    >>> from simc_core import Trend, frequency_band, identify
    >>> t = np.arange(0.0, 60.0)
    >>> y = 10 * np.where(t > 13.5, 1 - np.exp(-(t - 13.5).clip(0) / 8), 0)
    >>> found = frequency_band(identify(Trend(t, y, np.where(t >= 10, 55, 50))), [0.125])
    >>> bool(1.41 < found.magnitude_low[0] <= 2 / np.sqrt(2) <= found.magnitude_high[0] < 1.42)
    True
    """
    probability = checks.real("probability", probability, 0.5, 0.999)
    drawn = clouds(uncertain)
    if omega is None:
        scale, slowest = scales(drawn)
        grid = np.geomspace(min(BELOW / scale, 0.1 / slowest), ABOVE / scale, POINTS)
    else:
        grid = checks.array("omega", omega, MOST_OMEGA)
        if grid.size == 0 or not np.all((grid > 0) & np.isfinite(grid)) or np.any(np.diff(grid) <= 0):
            raise InvalidParameter(said("omega must be positive and rise"))
    responses = [cloud.response(grid) for cloud in drawn]
    magnitude = np.concatenate([np.abs(G) for G in responses])
    phase = np.concatenate([_phase(cloud, G, grid) for cloud, G in zip(drawn, responses, strict=True)])
    tail = (1 - probability) / 2
    low, high = np.quantile(magnitude, [tail, 1 - tail], axis=0)
    late, early = np.quantile(phase, [tail, 1 - tail], axis=0)
    crossing = np.array([_crossing(row, grid) for row in phase])
    seen = crossing[np.isfinite(crossing)]
    spread = np.quantile(seen, [tail, 1 - tail]) if seen.size > crossing.size / 2 else np.full(2, np.nan)
    return FrequencyBand(
        grid,
        responses[0][0],
        phase[0],
        low,
        high,
        late,
        early,
        (float(crossing[0]), float(spread[0]), float(spread[1])),
    )


def _phase(cloud: Cloud, G: NDArray[np.complex128], omega: Array) -> Array:
    """Degrees, shape (n, number of omega), of k > 0: a negative sign belongs to the action of the controller.

    The dead time is taken apart, so that the rest is slow enough to be unwound.
    """
    gain = next(i for i, name in enumerate(cloud.names) if name.startswith("k"))
    delay = cloud.values[:, :1] * omega[None, :]  # theta is the first
    rest = np.unwrap(np.angle(np.sign(cloud.values[:, gain, None]) * G * np.exp(1j * delay)), axis=1)
    rest -= np.where(rest[:, :1] > 0.6 * np.pi, 2 * np.pi, 0.0)  # two integrators, or an unstable pole, begin at -180
    return np.degrees(rest - delay)


def _crossing(phase: Array, omega: Array) -> float:
    """Where a phase first passes -180 degrees."""
    below = np.flatnonzero(phase <= -180)
    if below.size == 0 or below[0] == 0:
        return float("nan")
    i = int(below[0])
    share = (-180 - phase[i - 1]) / (phase[i] - phase[i - 1])
    return float(np.exp(np.log(omega[i - 1]) + share * np.log(omega[i] / omega[i - 1])))
