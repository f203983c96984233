"""Further measures of unit steps, for those who ask: they cost a second search that `performance` does without.

ITSE = int t e^2                       settling to 1 % and 5 %, as that to 2 % of StepMetrics
first_arrival  of y at its end       decay ratio   second over first peak beyond the end value, and the period
largest_u   largest |u|, jumps included              between the two
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.loops.loop import Loop
from simc_core.metrics.performance import both_steps, performance
from simc_core.metrics.piece_zeros import SLOPE, Turns, crossings
from simc_core.metrics.step_metrics import LEAST_OVERSHOOT, StepMetrics, Steps, passages
from simc_core.simulation.collocation.pieces import ENDS
from simc_core.simulation.simulate import settled

BANDS = (0.01, 0.05)
LEAST_PEAK = 1e-9  # of the first: a second peak below it is rounding
COEFFICIENTS = len(SLOPE)  # of a piece
NODES, WEIGHTS = np.polynomial.legendre.leggauss(COEFFICIENTS + 1)
AT_NODES = chebyshev.chebvander(NODES, COEFFICIENTS - 1).T


@dataclass(frozen=True, slots=True)
class StepQuality:
    """For a unit step. Times in the user's unit, from the step on.

    Attributes
    ----------
    ITSE : float
        int t e^2, in output units squared and time squared.
    settling_1, settling_5 : float
        As StepMetrics.settling_time, to 1 % and 5 %.
    first_arrival : float
        When y first passes its end after a set-point step; nan where it never does, and after a load.
    decay_ratio : float
        Second peak over the first; nan without overshoot, 0 where there is no second peak.
    period : float
        From the first peak to the second, nan where there is none.
    largest_u : float
        Largest abs(u), in input units.
    """

    ITSE: float
    settling_1: float
    settling_5: float
    first_arrival: float
    decay_ratio: float
    period: float
    largest_u: float


@dataclass(frozen=True, slots=True)
class Quality:
    """Unit step of the set point, and of the disturbance at the plant input.

    Attributes
    ----------
    setpoint, disturbance : StepQuality
        After either step.
    """

    setpoint: StepQuality
    disturbance: StepQuality


def step_quality(loop: Loop) -> Quality:
    """ITSE, settling to 1 % and 5 %, first arrival, decay ratio and period, largest u; the dead time is exact.

    Parameters
    ----------
    loop : Loop
        A plant under feedback.

    Returns
    -------
    Quality
        Of unit steps of set point and load.

    Raises
    ------
    NotStable
        As `performance` does.

    Examples
    --------
    Without dead time SIMC leaves 1 - e^{-t/tau_c}, which is within 5 % after tau_c ln 20:

    >>> from simc_core import Loop, Plant, SeriesPid, step_quality
    >>> found = step_quality(Loop(Plant(1, 0, (8,)), SeriesPid(4, 8)))
    >>> round(found.setpoint.settling_5, 4)
    5.9915
    """
    known = performance(loop)
    steps = both_steps(settled(loop))
    return Quality(*_measured(steps, (known.setpoint, known.disturbance)))


def _measured(steps: Steps, known: tuple[StepMetrics, StepMetrics]) -> list[StepQuality]:
    m, rows = len(steps.owner), steps.y_and_u.reshape(-1, COEFFICIENTS)
    ends = ENDS @ rows.T
    size = np.abs(steps.y_and_u)
    change = np.add.reduce(size[:, :, 1:], axis=2)
    turning = np.where(steps.alive(change, change + size[:, :, 0]), 0.0, -np.inf)
    turns = crossings(rows @ SLOPE, turning.reshape(1, -1))
    values, k = turns.of(rows), turns.row.searchsorted(m)
    of_y = Turns(turns.row[:k], turns.interval[:k], turns.x[:k], values[:k])
    largest_u = _largest(steps, ends[:, m:], turns.row[k:] - m, values[k:])
    settling, arrival = _times(steps, rows[:m], ends[1, :m], of_y, known)
    ITSE = _itse(steps, rows[:m])
    found = []
    for i, metrics in enumerate(known):
        ratio, period = _decay(*_extremes(steps, ends[:, :m], of_y, i), peak=metrics.peak if i else math.inf)
        reached = float(arrival[i]) if not i and metrics.overshoot > LEAST_OVERSHOOT else math.nan
        within_1, within_5 = settling[:, i].tolist()
        found.append(StepQuality(ITSE[i], within_1, within_5, reached, ratio, period, largest_u[i]))
    return found


def _itse(steps: Steps, y: np.ndarray) -> list[float]:
    e = y @ AT_NODES - steps.target[steps.owner][:, None]
    half = steps.length / 2
    t = steps.begin[:, None] + half[:, None] * (NODES + 1)
    return np.add.reduceat(half * ((t * e**2) @ WEIGHTS), steps.first).tolist()


def _largest(steps: Steps, ends: np.ndarray, row: np.ndarray, turned: np.ndarray) -> list[float]:
    largest = np.maximum.reduceat(np.abs(ends).max(axis=0), steps.first)
    np.maximum.at(largest, steps.owner[row], np.abs(turned))
    return largest.tolist()


def _times(
    steps: Steps, y: np.ndarray, right: np.ndarray, turns: Turns, known: tuple[StepMetrics, StepMetrics]
) -> tuple[np.ndarray, np.ndarray]:
    """Settling times, (bands, responses), and the first time at the end value."""
    sides = np.array([side * band for band in BANDS for side in (-1.0, 1.0)])
    height = np.array([1.0, abs(known[1].peak)])
    levels = np.concatenate([steps.target[None], steps.target + sides[:, None] * height])[:, steps.owner]
    found = crossings(y, levels, turns)
    first, last = passages(steps, found, levels, right)
    return last[1:].reshape(len(BANDS), 2, -1).max(axis=1), first[0]


def _extremes(steps: Steps, ends: np.ndarray, turns: Turns, which: int) -> tuple[np.ndarray, np.ndarray]:
    """Instants and y - end value of one response, such that y is monotone from each to the next."""
    own = np.flatnonzero(steps.owner == which)
    mine = np.isin(turns.row, own)
    times = np.concatenate(
        [steps.begin[own], steps.begin[own] + steps.length[own], steps.time(turns.row[mine], turns.x[mine])]
    )
    values = np.concatenate([ends[0, own], ends[1, own], turns.value[mine]]) - steps.target[which]
    order = np.argsort(times, kind="stable")
    return times[order], values[order]


def _decay(times: np.ndarray, beyond: np.ndarray, peak: float) -> tuple[float, float]:
    """Second over first peak beyond the end value, and the time between; peak: its sign tells the side."""
    side = beyond * math.copysign(1.0, peak)
    peaks: list[tuple[float, float]] = []
    inside = True
    for t, value in zip(times.tolist(), side.tolist(), strict=True):
        if value <= 0:
            inside = True
        elif inside:
            peaks.append((t, value))
            inside = False
        elif value > peaks[-1][1]:
            peaks[-1] = (t, value)
    peaks = [each for each in peaks if each[1] > max(LEAST_OVERSHOOT, LEAST_PEAK * max(value for _, value in peaks))]
    if not peaks:
        return math.nan, math.nan
    if len(peaks) == 1:
        return 0.0, math.nan
    (t1, first), (t2, second) = peaks[:2]
    return second / first, t2 - t1
