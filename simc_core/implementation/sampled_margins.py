"""Margins of a loop with a sampled controller: those of margins_of_response.py, over 0 < omega <= pi/h."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from simc_core import checks
from simc_core.controllers.discrete import known_law, law_for, scans
from simc_core.errors import InvalidParameter, NotStable
from simc_core.implementation.sampled_loop import MOST_PERIODS, SAME_INSTANT, SampledLoop
from simc_core.loops.loop import Loop
from simc_core.sensitivity.crossings import Crossings
from simc_core.sensitivity.log_response import Asymptote, FactoredResponse
from simc_core.sensitivity.margins import margins
from simc_core.sensitivity.margins_of_response import NOT_STABLE, Margins, margins_from
from simc_core.wording import said

PARTS = 32  # into which a bracket is cut at a time
CUTS_ZERO, CUTS_PEAK = 10, 7  # 32^10 = 2^50; peaks are flat
NEAR_HIGHEST = 0.9  # peaks lower than this part of the highest node are not looked at
HALVINGS = 35  # of an interval of dead time
NEWTON_STEPS = 30  # to a delay margin; four are usual
NEARBY = 1e-7  # relative, of the difference quotient
LOG_L_ERROR = 1e-12  # |log(-L)| at the delay margin
FIRST_PERIOD = 1 / 64  # of the dead time, or of 1/omega_Ms, in the search for the longest one


class _Ends(NamedTuple):
    """L at omega = 0, which sampling does not change, and at pi/h, in the words of a Response."""

    at_zero: Asymptote
    at_infinity: Asymptote
    theta: float = 0.0


def sampled_margins(loop: Loop, h: float, law: str = "backward", delay_scans: int = 0) -> Margins:
    """Margins of a loop whose controller is sampled, with its dead time exact, a multiple of h or not.

    Parameters
    ----------
    loop : Loop
        The loop, its controller as designed.
    h : float
        Sampling period, in the time unit of the loop.
    law : {"backward", "tustin"}
        What the computer does at each sample, see controllers/discrete.py.
    delay_scans : {0, 1}
        Whole sampling periods after which the output is written.

    Returns
    -------
    Margins
        As of `margins`; frequencies up to pi/h. delay_margin: the smallest additional dead time, whatever part of h,
        that makes the sampled loop swing. All nan where it is not stable.

    Raises
    ------
    InvalidParameter
        h is too short for the dead time, the law does not suit the filter, or the loop is no single loop.

    Examples
    --------
    Sampling at a fifth of the dead time takes a tenth of the robustness:

    >>> from simc_core import FirstOrderDelay, Loop, Plant, sampled_margins, simc
    >>> tight = Loop(Plant(1, 1, (8,)), simc(FirstOrderDelay(1, 1, 8)))
    >>> round(sampled_margins(tight, h=0.2).Ms, 4)
    1.6908
    """
    if not isinstance(loop, Loop):
        raise InvalidParameter(
            said("loop must be a Loop, found {what}: nested loops are not sampled", what=type(loop).__name__)
        )
    h = checks.positive_time("h", h)
    law_for(law, loop.controller.to_parallel(), h)
    sampled = SampledLoop(loop, h, law, scans("delay_scans", delay_scans))
    if loop.plant.theta > MOST_PERIODS * h:
        shortest = loop.plant.theta / MOST_PERIODS
        raise InvalidParameter(
            said(
                "h must be >= theta/{most_periods} = {shortest:g}, found {h:g}",
                most_periods=MOST_PERIODS,
                shortest=shortest,
                h=h,
            )
        )
    if not sampled.stable:
        return NOT_STABLE
    crossed = _crossings(sampled)
    last = float(sampled.L(np.array([1j * math.pi]))[0].real)
    found = margins_from(_Ends(FactoredResponse(loop.L).at_zero, Asymptote(last, 0)), crossed)
    omega_180, omega_Ms, omega_Mt = (
        math.pi / h if omega == math.inf else omega for omega in (found.omega_180, found.omega_Ms, found.omega_Mt)
    )
    delay_margin = _delay_margin(sampled, crossed)
    return replace(found, delay_margin=delay_margin, omega_180=omega_180, omega_Ms=omega_Ms, omega_Mt=omega_Mt)


def longest_sampling_period(loop: Loop, law: str = "backward", delay_scans: int = 0, more: float = 0.05) -> float:
    """The sampling period at which Ms has grown by a part `more` over that of the continuous loop.

    Parameters
    ----------
    loop : Loop
        A stable loop with its controller as designed.
    law : {"backward", "tustin"}
        As of `sampled_margins`.
    delay_scans : {0, 1}
        As of `sampled_margins`.
    more : float
        Part of Ms, > 0.

    Returns
    -------
    float
        In the time unit of the loop, to four digits; math.inf where Ms does not grow as much as that within the limit
        of the law.

    Raises
    ------
    NotStable
        The continuous loop is not stable.

    Examples
    --------
    At that period Ms is 5 % higher:

    >>> from simc_core import FirstOrderDelay, Loop, Plant, longest_sampling_period, margins, sampled_margins, simc
    >>> loop = Loop(Plant(1, 1, (8,)), simc(FirstOrderDelay(1, 1, 8)))
    >>> round(sampled_margins(loop, longest_sampling_period(loop)).Ms / margins(loop).Ms, 4)
    1.05
    """
    more, delay_scans = checks.real("more", more, 1e-6, 10.0), scans("delay_scans", delay_scans)
    continuous = margins(loop)
    if not continuous.stable:
        raise NotStable(said("the loop must be stable with a continuous controller, found one that is not"))
    pid, allowed = loop.controller.to_parallel(), continuous.Ms * (1 + more)
    limit = 2 * pid.tau_F if known_law(law) == "tustin" and (pid.tau_F or pid.Kd) else checks.LONGEST_TIME
    law_for(law, pid, 0.0 if pid.tau_F else 1.0)

    def excess(h: float) -> float:
        """Of Ms over what is allowed, as a part of it; at most 1, also where the loop is not stable."""
        sampled = SampledLoop(loop, h, law, delay_scans)
        return min(_Ms(sampled) / allowed - 1, 1.0) if sampled.stable else 1.0

    slowest = 1 / continuous.omega_Ms if 0 < continuous.omega_Ms < math.inf else 1.0
    low = high = min((loop.plant.theta or slowest) * FIRST_PERIOD, limit)
    while excess(high) < 0:
        if high == limit:
            return math.inf
        low, high = high, min(2 * high, limit)
    return high if low == high else float(brentq(excess, low, high, rtol=1e-5))


def _Ms(sampled: SampledLoop) -> float:
    values = sampled.sensitivity(sampled.angles)
    return float(max([values.max(), *_peaks(sampled.sensitivity, sampled.angles, values)[1]]))


def _crossings(sampled: SampledLoop) -> Crossings:
    """Crossings and peaks of L between the nodes of `sampled.angles`, as omega."""
    angles, h = sampled.angles, sampled.h
    L = sampled.L(1j * angles)

    def size(angle: np.ndarray) -> np.ndarray:
        return np.log(np.abs(sampled.L(1j * angle)))

    def phase(angle: np.ndarray) -> np.ndarray:
        return np.angle(-sampled.L(1j * angle))

    def T(angle: np.ndarray) -> np.ndarray:
        return np.abs(1 - 1 / (1 + sampled.L(1j * angle)))

    below, turn = np.abs(L) < 1, np.angle(-L)
    at = np.flatnonzero(below[:-1] != below[1:])
    gains = _zeros(size, angles[at], angles[at + 1])
    at = np.flatnonzero(((turn[:-1] < 0) != (turn[1:] < 0)) & (np.abs(np.diff(turn)) < math.pi))
    phases = _zeros(phase, angles[at], angles[at + 1])
    phases = phases[phases < math.pi * (1 - SAME_INSTANT)]  # pi itself is an end
    S_omega, S_peak = _peaks(sampled.sensitivity, angles, np.abs(1 / (1 + L)))
    T_omega, T_peak = _peaks(T, angles, np.abs(1 - 1 / (1 + L)))
    left = phase(gains), phases / h, np.abs(sampled.L(1j * phases))
    return Crossings(gains / h, *left, S_omega / h, S_peak, T_omega / h, T_peak)


def _zeros(function: Callable, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Where `function` changes its sign between low and high, shape (n,)."""
    for _ in range(CUTS_ZERO if low.size else 0):
        points = np.linspace(low, high, PARTS + 1)
        below = function(points.ravel()).reshape(points.shape) < 0
        at = np.argmax(below[1:] != below[:-1], axis=0), np.arange(low.size)
        low, high = points[at], points[1:][at]
    return (low + high) / 2


def _peaks(function: Callable, angles: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angles and heights of the highest maxima of `function` between nodes; values: at the nodes."""
    inner = values[1:-1]
    at = 1 + np.flatnonzero((inner >= values[:-2]) & (inner >= values[2:]) & (inner > NEAR_HIGHEST * values.max()))
    low, high = angles[at - 1], angles[at + 1]
    for _ in range(CUTS_PEAK if at.size else 0):
        points = np.linspace(low, high, PARTS + 1)
        top = np.argmax(function(points.ravel()).reshape(points.shape)[1:-1], axis=0), np.arange(at.size)
        low, high = points[top], points[2:][top]
    return (low + high) / 2, function((low + high) / 2)


def _delay_margin(sampled: SampledLoop, crossed: Crossings) -> float:
    """The smallest additional dead time with L = -1 somewhere.

    From arg(-L)/omega by Newton in both: log L changes by -j omega with the dead time but for what happens within a
    period, and by a difference quotient with omega. Where u goes straight through the plant, L jumps with the dead time
    at multiples of h; there the verdict is asked.
    """
    phases = zip(crossed.gain_phase.tolist(), crossed.gain_omega.tolist(), strict=True)
    more, omega = min(((phase % math.tau / omega, omega) for phase, omega in phases), default=(math.inf, math.nan))
    if sampled.direct and more < math.inf:
        return _last_stable(sampled, more)
    for _ in range(NEWTON_STEPS if more < math.inf else 0):
        here, ahead = sampled.later(more).L(1j * omega * sampled.h * np.array([1.0, 1 + NEARBY]))
        miss, slope = np.log(-here), np.log(ahead / here) / (omega * NEARBY)
        step = -miss.real / slope.real
        more, omega = max(more + (miss.imag + slope.imag * step) / omega, 0.0), omega + step
        if abs(miss) < LOG_L_ERROR:
            break
    return float(more)


def _last_stable(sampled: SampledLoop, more: float) -> float:
    """The additional dead time up to which the loop is stable, near `more`."""
    low, high = 0.0, more
    while sampled.later(high).stable:
        low, high = high, high + sampled.h
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if sampled.later(middle).stable else (low, middle)
    return high
