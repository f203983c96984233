"""Many values of tau_c at once: everything the tuning page shows, as arrays of shape (len(tau_c), ...).

All tunings of a plant share what the plant does: in time (simulation/one_delay/march.py: one matrix product for
all of them), and in frequency (one grid, one search, one certificate for all).
"""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simc_core import checks
from simc_core.controllers.forms import Controller
from simc_core.errors import InvalidParameter
from simc_core.loops.frequency_response import at_frequencies
from simc_core.loops.loop import Loop
from simc_core.metrics.performance import both_steps
from simc_core.metrics.step_metrics import measures
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.rules.simc_family import settings_of
from simc_core.sensitivity.margins import margins_many
from simc_core.simulation.one_delay.limits import MOST_OF_ALL, share, too_much
from simc_core.simulation.one_delay.march import march
from simc_core.simulation.one_delay.unit_responses import UnitResponses
from simc_core.simulation.scenario import instants
from simc_core.simulation.superposition import ramp_response
from simc_core.wording import said

MOST_TUNINGS = 10_000
MOST_VALUES = 20_000_000  # numbers in the arrays of a sweep: 160 MB
MARGINS = ("GM", "GM_lower", "PM_deg", "delay_margin", "Ms", "Mt")
METRICS = ("IAE_setpoint", "IAE_disturbance", "TV_setpoint", "TV_disturbance", "overshoot")


@dataclass(frozen=True, slots=True, eq=False)
class Sweep:
    """n tunings of one plant. Margins and metrics are nan where the loop is not stable.

    Attributes
    ----------
    tau_c : np.ndarray, shape (n,)
        Closed-loop time constants, in the user's time unit.
    controllers : tuple of controllers, n of them
        Their settings.
    t, omega : np.ndarray, shape (m,), (p,)
        Instants, in the user's time unit, and frequencies, in rad per time unit.
    y_setpoint, u_setpoint, y_disturbance, u_disturbance : np.ndarray, shape (n, m)
        Responses to set point and load of height 1, right-hand limits at jumps.
    L : np.ndarray, shape (n, p), complex
        Loop transfer functions.
    stable : np.ndarray of bool, shape (n,)
        Whether each loop is.
    GM, GM_lower, PM_deg, delay_margin, Ms, Mt : np.ndarray, shape (n,)
        As in Margins.
    IAE_setpoint, IAE_disturbance, TV_setpoint, TV_disturbance : np.ndarray, shape (n,)
        As in StepMetrics.
    overshoot : np.ndarray, shape (n,)
        Of the set-point step, as a fraction.
    """

    tau_c: np.ndarray
    controllers: tuple[Controller, ...]
    t: np.ndarray
    omega: np.ndarray
    y_setpoint: np.ndarray
    u_setpoint: np.ndarray
    y_disturbance: np.ndarray
    u_disturbance: np.ndarray
    L: np.ndarray
    stable: np.ndarray
    GM: np.ndarray
    GM_lower: np.ndarray
    PM_deg: np.ndarray
    delay_margin: np.ndarray
    Ms: np.ndarray
    Mt: np.ndarray
    IAE_setpoint: np.ndarray
    IAE_disturbance: np.ndarray
    TV_setpoint: np.ndarray
    TV_disturbance: np.ndarray
    overshoot: np.ndarray


def sweep(
    plant: Plant,
    model: Model,
    tau_c: ArrayLike,
    t: ArrayLike,
    omega: ArrayLike,
    b: float = 1.0,
    filter_ratio: float = 0.0,
    disturbance_time: float = 0.0,
    ramps: tuple[float, float] = (0.0, 0.0),
    rule: str = "simc",
) -> Sweep:
    """SIMC tunings of `model` for many tau_c at once, each in the loop round `plant`.

    Parameters
    ----------
    plant : Plant
        The plant, as it is.
    model : Model
        The reduced model that is tuned.
    tau_c : array_like, shape (n,)
        Closed-loop time constants > 0, in the user's time unit.
    t : array_like, shape (m,)
        Increasing instants >= 0, in the user's time unit.
    omega : array_like, shape (p,)
        Frequencies > 0, in rad per time unit.
    b : float
        Set-point weight.
    filter_ratio : float
        tau_F/tau_D.
    disturbance_time : float
        When the load begins.
    ramps : tuple of float
        Times in which set point and load reach their heights, 0 for steps. Metrics are those of steps in any case.
    rule : str
        "simc", "improved_simc" or "isimc".

    Returns
    -------
    Sweep
        Margins and metrics of shape (n,), responses (n, m), L (n, p).

    Raises
    ------
    InvalidParameter
        Where the rule does, and where `simulate` does for one of the loops.

    Examples
    --------
    GM = (pi/2) (tau_c + theta)/theta of a first-order model [SK03], here for tau_c = theta and 2 theta:

    >>> from simc_core import FirstOrderDelay, Plant, sweep
    >>> found = sweep(Plant(1, 1, (8,)), FirstOrderDelay(1, 1, 8), tau_c=[1, 2], t=[0, 1, 2], omega=[0.1, 1])
    >>> found.GM.round(4).tolist(), found.y_setpoint.shape, found.L.shape
    ([3.1416, 4.7124], (2, 3), (2, 2))
    """
    speeds, times, at = _tau_c(tau_c), instants(t), at_frequencies(omega)
    values = len(speeds) * (4 * len(times) + 2 * len(at))
    if values > MOST_VALUES:
        raise InvalidParameter(
            said(
                "len(tau_c) (4 len(t) + 2 len(omega)) must be <= {most_values}, numbers of one sweep, found {values}",
                most_values=MOST_VALUES,
                values=values,
            )
        )
    controllers = tuple(
        settings_of(rule, model, each).with_filter(filter_ratio).with_weight(b) for each in speeds.tolist()
    )
    loops = [Loop(plant, controller) for controller in controllers]
    found = margins_many(loops)
    stable = [each.stable for each in found]
    curves, metrics = _curves_and_metrics(plant, controllers, stable, times, disturbance_time, ramps)
    G = plant.factored(1j * at)
    return Sweep(
        tau_c=speeds,
        controllers=controllers,
        t=times,
        omega=at,
        y_setpoint=curves[:, 0, 0],
        u_setpoint=curves[:, 1, 0],
        y_disturbance=curves[:, 0, 1],
        u_disturbance=curves[:, 1, 1],
        L=np.array([G * controller.factored(1j * at) for controller in controllers]),
        stable=np.array(stable),
        **{name: np.array([getattr(each, name) for each in found]) for name in MARGINS},
        **dict(zip(METRICS, metrics.T, strict=True)),
    )


def time_curves(
    plant: Plant,
    controllers: Sequence[Controller],
    t: np.ndarray,
    disturbance_time: float = 0.0,
    ramps: tuple[float, float] = (0.0, 0.0),
) -> np.ndarray:
    """y, u for r and d of height 1, steps or ramps, (n, 2, 2, len(t)); stable or not."""
    found = np.zeros((len(controllers), 2, 2, len(t)))
    for some, course in _courses(plant, controllers, [float(t[-1]) or 1.0] * len(controllers)):
        found[some] = _at(course, t, disturbance_time, ramps)
    return found


def _curves_and_metrics(
    plant: Plant,
    controllers: Sequence[Controller],
    stable: Sequence[bool],
    t: np.ndarray,
    disturbance_time: float,
    ramps: tuple[float, float],
) -> tuple[np.ndarray, np.ndarray]:
    """As time_curves, and METRICS, (n, 5); nan where the loop is not stable, or too near its limit to come to rest."""
    n = len(controllers)
    curves, metrics = np.zeros((n, 2, 2, len(t))), np.full((n, len(METRICS)), math.nan)
    ends = [None if each else float(t[-1]) or 1.0 for each in stable]
    for some, course in _courses(plant, controllers, ends):
        curves[some] = _at(course, t, disturbance_time, ramps)
        rest, k = course.at_rest, len(some)
        reached = course.begin[course.first[1:] - 1] + course.length[course.first[1:] - 1]
        short = some[~rest & (reached < t[-1])]  # too near its limit to come to rest, and not far enough
        if short.size and ends[short[0]] is None:
            curves[short] = time_curves(plant, [controllers[i] for i in short], t, disturbance_time, ramps)
        if rest.any():
            found = measures(both_steps(course), with_times=False)
            columns = (found.IAE[:k], found.IAE[k:], found.TV[:k], found.TV[k:], found.overshoot[:k])
            metrics[some[rest]] = np.array(columns).T[rest]
    return curves, metrics


def _courses(
    plant: Plant, controllers: Sequence[Controller], ends: Sequence[float | None]
) -> Iterator[tuple[np.ndarray, UnitResponses]]:
    """Tunings that can march together, and their course; ends: None for one that goes to its rest."""
    forms = [controller.to_parallel() for controller in controllers]
    work, alike = 0, defaultdict(list)
    for i, (form, end) in enumerate(zip(forms, ends, strict=True)):
        alike[form.tau_F, form.Kd != 0, end].append(i)
    for (*_, end), members in alike.items():
        at = 0
        while at < len(members):
            most = share(len(forms)) if end is None else (MOST_OF_ALL - work) / (len(members) - at)
            course = march(plant, [forms[i] for i in members[at:]], end, most)
            some = members[at : at + len(course.at_rest)]
            at += len(some)
            if end is not None:
                work += len(course.owner)
                if work > MOST_OF_ALL:
                    raise InvalidParameter(too_much(end))
            yield np.array(some), course


def _at(course: UnitResponses, t: np.ndarray, disturbance_time: float, ramps: tuple[float, float]) -> np.ndarray:
    values = course(t)
    if disturbance_time:
        values[:, :, 1] = course(t - disturbance_time)[:, :, 1]
    for source, (ramp, start) in enumerate(zip(ramps, (0.0, disturbance_time), strict=True)):
        if ramp:
            for i in range(len(values)):
                values[i, :, source] = ramp_response(course.pieces(i), ramp, t - start)[:, :, source].T
    return values


def _tau_c(given: ArrayLike) -> np.ndarray:
    values = np.atleast_1d(np.asarray(given, dtype=float))
    if values.ndim != 1 or not 1 <= values.size <= MOST_TUNINGS:
        raise InvalidParameter(
            said(
                "tau_c must be a list of 1 to {most_tunings} times, found shape {shape}",
                most_tunings=MOST_TUNINGS,
                shape=values.shape,
            )
        )
    return np.array([checks.positive_time("tau_c", each) for each in values.tolist()])
