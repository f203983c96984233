"""Further measures of unit steps, for those who ask: they cost a second search that `performance` does without.

IE = int e: of r - y after a set point, of y after a load
ITSE = int t e^2                       settling to 1 % and 5 %, as that to 2 % of StepMetrics
first_arrival  of y at its end       decay ratio   second over first peak beyond the end value, and the period
largest_u   largest |u|, jumps included              between the two
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.loops.loop import Loop
from simc_core.loops.static_errors import static_errors
from simc_core.metrics.piece_zeros import SLOPE, Turns, crossings
from simc_core.metrics.step_metrics import LEAST_OVERSHOOT, Steps, both_steps, passages
from simc_core.metrics.step_records import StepMetrics, StepQuality
from simc_core.simulation.collocation.pieces import ENDS
from simc_core.simulation.simulate import settled

BANDS = (0.01, 0.05)
LEAST_PEAK = 1e-9  # of the first: a second peak below it is rounding
COEFFICIENTS = len(SLOPE)  # of a piece
NODES, WEIGHTS = np.polynomial.legendre.leggauss(COEFFICIENTS + 1)
AT_NODES = chebyshev.chebvander(NODES, COEFFICIENTS - 1).T


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


@dataclass(frozen=True, slots=True)
class Known:
    """What StepMetrics knows already."""

    peak: float
    overshoot: float


def known_of(metrics: StepMetrics) -> Known:
    """Of one step."""
    return Known(metrics.peak, metrics.overshoot)


def quality_of(loop: Loop, known: Sequence[Known]) -> list[StepQuality]:
    """Of unit steps of set point and load; IE is exact, from low frequencies."""
    rest = static_errors(loop)
    exact = (rest.IE_setpoint, rest.IE_load)
    measured = quality_of_steps(both_steps(settled(loop)), known)
    return [replace(each, IE=IE) for each, IE in zip(measured, exact, strict=True)]


def quality_of_steps(steps: Steps, known: Sequence[Known]) -> list[StepQuality]:
    """Of responses that come to rest."""
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
    IE, ITSE = _integrals(steps, rows[:m])
    found = []
    for i, metrics in enumerate(known):
        setpoint = steps.target[i] != 0
        ratio, period = _decay(*_extremes(steps, ends[:, :m], of_y, i), peak=math.inf if setpoint else metrics.peak)
        reached = float(arrival[i]) if setpoint and metrics.overshoot > LEAST_OVERSHOOT else math.nan
        within_1, within_5 = settling[:, i].tolist()
        found.append(StepQuality(IE[i], ITSE[i], within_1, within_5, reached, ratio, period, largest_u[i]))
    return found


def _integrals(steps: Steps, y: np.ndarray) -> list[list[float]]:
    """IE and ITSE."""
    target = steps.target[steps.owner]
    e = y @ AT_NODES - target[:, None]
    half = steps.length / 2
    t = steps.begin[:, None] + half[:, None] * (NODES + 1)
    pieces = np.array([half * (1 - 2 * target) * (e @ WEIGHTS), half * ((t * e**2) @ WEIGHTS)])
    return np.add.reduceat(pieces, steps.first, axis=1).tolist()


def _largest(steps: Steps, ends: np.ndarray, row: np.ndarray, turned: np.ndarray) -> list[float]:
    largest = np.maximum.reduceat(np.abs(ends).max(axis=0), steps.first)
    np.maximum.at(largest, steps.owner[row], np.abs(turned))
    return largest.tolist()


def _times(
    steps: Steps, y: np.ndarray, right: np.ndarray, turns: Turns, known: Sequence[Known]
) -> tuple[np.ndarray, np.ndarray]:
    """Settling times, (bands, responses), and the first time at the end value."""
    sides = np.array([side * band for band in BANDS for side in (-1.0, 1.0)])
    height = np.where(steps.target != 0, 1.0, [abs(each.peak) for each in known])
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
