"""The relay test: ultimate gain and period as the describing function reads them, beside the exact ones [AH84; T84].

Ku = 4 d/(pi sqrt(a^2 - hysteresis^2)), Pu the period. It is off in a known way: for a first-order plant by -17 % at
theta/tau1 = 0.2 and by +13 % at 5. Tune from the model, which is fitted to the record with every switching exact.
"""

from dataclasses import dataclass
from math import inf, nan, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from simc_core import checks
from simc_core.errors import InvalidParameter, NotIdentifiable, NotReducible, SimcError, WrongType
from simc_core.identification.experiments.relay_course import Course, course
from simc_core.identification.identify import identify
from simc_core.identification.trend import Trend, check_trend
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.sensitivity.ultimate import ultimate
from simc_core.wording import said

POINTS = 2000  # of the record, about


@dataclass(frozen=True, slots=True, eq=False)
class Relay:
    """A relay test.

    Attributes
    ----------
    t, y, u : array, shape (n,)
        The record from rest; u as it is from each instant on.
    Ku, Pu : float
        By describing function from amplitude and period; Ku is inf where the amplitude is the hysteresis.
    Ku_exact, Pu_exact : float
        Of the plant; nan where it is not known or has none.
    model : reduced model or None
        Fitted to the record; None where that cannot tell.
    amplitude : float
        Half the distance of the peaks of y.
    """

    t: NDArray[np.float64]
    y: NDArray[np.float64]
    u: NDArray[np.float64]
    Ku: float
    Pu: float
    Ku_exact: float
    Pu_exact: float
    model: Model | None
    amplitude: float


def relay_test(plant: Plant, amplitude: float, hysteresis: float = 0.0, bias: float = 0.0) -> Relay:
    """A relay test of a plant, simulated exactly from rest.

    Parameters
    ----------
    plant : Plant
    amplitude : float
        OP goes to bias + amplitude and bias - amplitude, > 0.
    hysteresis : float
        The relay switches where y passes +hysteresis upwards and -hysteresis downwards, >= 0.
    bias : float
        abs(bias) < amplitude: unequal levels show the gain, k = mean(y)/mean(u) over a period.

    Returns
    -------
    Relay

    Raises
    ------
    InvalidParameter
        A number outside its bounds.
    NotStable
        No lasting oscillation.
    NotReducible
        There is no ultimate point, and no hysteresis that would make the plant oscillate.

    References
    ----------
    [AH84], [T84]

    Examples
    --------
    1/((s + 1)(10s + 1)) e^{-0.3s}; the relay shows 7 % less than the exact Ku:

    >>> from simc_core import Plant, relay_test
    >>> found = relay_test(Plant(1, 0.3, (10, 1)), amplitude=1)
    >>> round(found.Pu, 4), round(found.Ku, 1), round(found.Ku_exact, 2)
    (3.5631, 35.9, 38.6)
    """
    if not isinstance(plant, Plant):
        raise WrongType(said("plant must be a Plant, found {found}", found=type(plant).__name__))
    amplitude = checks.magnitude("amplitude", amplitude, checks.LARGEST_GAIN)
    if amplitude < 0:
        raise InvalidParameter(said("{name} must be > 0, found {number:g}", name="amplitude", number=amplitude))
    hysteresis = checks.real("hysteresis", hysteresis, 0.0, checks.LARGEST_GAIN)
    bias = checks.real("bias", bias, -0.999 * amplitude, 0.999 * amplitude)
    try:
        point = ultimate(plant)
        exact, period = (point.Ku, point.Pu), point.Pu
    except NotReducible:
        exact, period = (nan, nan), plant.total_time
        if hysteresis == 0 or period == 0:
            raise
    sign = 1.0 if _rising(plant) else -1.0
    levels = (bias + sign * amplitude, bias - sign * amplitude)
    found = course(plant, levels, hysteresis, period)
    span = float(found.at[-1] - found.at[-3])
    peak = float(np.ptp(found.z[found.t > found.t[-1] - span])) / 2
    t, y = _samples(found, plant.theta)
    return Relay(
        t=t,
        y=y,
        u=found.level[np.searchsorted(found.at, t, "right") - 1],
        Ku=sign * gain(amplitude, peak, hysteresis),
        Pu=span,
        Ku_exact=exact[0],
        Pu_exact=exact[1],
        model=_model(plant, found, t, y),
        amplitude=peak,
    )


def relay_from_trend(trend: Trend) -> Relay:
    """What a recorded relay test says; the first switchings, before the oscillation lasts, do no harm.

    Parameters
    ----------
    trend : Trend
        With OP at two levels, and the level before the first switching.

    Returns
    -------
    Relay
        Ku_exact and Pu_exact are nan.

    Raises
    ------
    NotIdentifiable
        Fewer than two periods, or OP has more than two levels after the first switching.

    References
    ----------
    [AH84], [B17]

    Examples
    --------
    The record of a simulated test says what the test said:

    >>> from simc_core import Plant, Trend, relay_from_trend, relay_test
    >>> test = relay_test(Plant(1, 0.3, (10, 1)), amplitude=1)
    >>> found = relay_from_trend(Trend(test.t, test.y, test.u))
    >>> round(found.Pu / test.Pu, 2), round(found.Ku / test.Ku, 2)
    (1.0, 1.0)
    """
    trend = check_trend(trend)
    changed = 1 + np.flatnonzero(np.diff(trend.u))
    at, to = trend.instants_of_u[changed], trend.u[changed]
    if at.size < 6:
        raise NotIdentifiable(said("A relay test needs at least 6 switchings of OP, found {n}", n=at.size))
    if np.unique(to).size > 2:
        raise NotIdentifiable(said("A relay has two levels of OP, found {n}", n=np.unique(to).size))
    later = at[max(at.size - 7, 1) :]
    period = float(np.mean(later[2:] - later[:-2]))
    begin, end = later[0], later[0] + 2 * period
    part = trend.y[(trend.t >= begin) & (trend.t <= end)]
    if part.size < 8:
        raise NotIdentifiable(
            said("A relay test needs at least 4 samples of PV in a period, found {n:.0f}", n=part.size / 2)
        )
    low, high = np.quantile(part, [0.02, 0.98])
    sign, model = 1.0, None
    try:
        model = identify(trend).model
        sign = float(np.sign(model.plant.k))
    except SimcError:
        pass
    u = trend.u[np.maximum(np.searchsorted(trend.instants_of_u, trend.t, "right") - 1, 0)]
    amplitude, peak = float(np.ptp(to)) / 2, float(high - low) / 2
    return Relay(trend.t, trend.y, u, sign * gain(amplitude, peak, 0.0), period, nan, nan, model, peak)


def gain(amplitude: float, peak: float, hysteresis: float) -> float:
    """4 d/(pi sqrt(a^2 - hysteresis^2)), the inverse of the describing function of a relay [AH84]."""
    inside = peak**2 - hysteresis**2
    return 4 * amplitude / (pi * sqrt(inside)) if inside > 0 else inf


def _rising(plant: Plant) -> bool:
    return plant.k * (-1) ** sum(tau < 0 for tau in plant.lags) > 0


def _samples(found: Course, theta: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Instants and y, exact at each, from rest to the last switching."""
    every = max(found.t.size // POINTS, 1)
    t, z = found.t[::every] + theta, found.z[::every]
    inside = t <= found.at[-1]
    t, z = t[inside], z[inside]
    return (np.concatenate([[0.0], t]), np.concatenate([[0.0], z])) if theta else (t, z)


def _model(plant: Plant, found: Course, t: NDArray[np.float64], y: NDArray[np.float64]) -> Model | None:
    before = -1e-9 * (t[-1] - t[0])  # OP was at rest before the first switching
    t_u, u = np.concatenate([[before], found.at]), np.concatenate([[0.0], found.level])
    try:
        return identify(Trend(t, y, u, t_u=t_u), "IPDT" if plant.integrators == 1 else "FOPDT", drift=False).model
    except SimcError:
        return None
