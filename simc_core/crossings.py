"""All crossings and peaks of a loop transfer function over frequency.

    gain crossings     |L| = 1                     log|L| = 0
    phase crossings    L real and negative         arg(-L) = 0
    peaks              |S|, |T| largest            d log|S|/d omega = -Re(T l') = 0,   d log|T|/d omega = Re(S l') = 0

with l = log L (module logresponse). They are bracketed by sign changes on a grid (module search_grid).
A crossing hidden as a pair between two nodes is found by its extremum. All of them together, of all loops that are
asked for, are then polished by bracketed Newton steps with the derivatives in closed form.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from simc_core.logresponse import LARGEST, FactoredResponse, Response, Together, sensitivities
from simc_core.search_grid import Evaluate, Grid, search_grid

TOGETHER = 32  # loops; more do not fit the cache
FLAT = 1e-10  # d log|S|/d log omega below which there is only rounding
QUADRATIC = 1e-9  # after a Newton step this small the next would be below rounding
SETTLED = 5e-15  # the next step would be this small
ROUNDING = 4e-16
HUGE = 1e43
STEPS = 60  # of the polishing; two or three are usual
GAIN, PHASE, S_PEAK, T_PEAK = range(4)


@dataclass(frozen=True, slots=True, eq=False)
class Crossings:
    """Frequencies in ascending order, and what is there.

    gain: omega where |L| = 1, with the phase margin there, arg(-L) in (-pi, pi].
    phase: omega where L is real and negative, with |L| there.   S, T: omega of the peaks of |S| and |T|, and these.
    envelope: bounds of |S| and |T| beyond the grid, 0 if it reaches far enough.
    """

    gain_omega: np.ndarray
    gain_phase: np.ndarray
    phase_omega: np.ndarray
    phase_gain: np.ndarray
    S_omega: np.ndarray
    S_peak: np.ndarray
    T_omega: np.ndarray
    T_peak: np.ndarray
    envelope: tuple[float, float] = (0.0, 0.0)


def search(response: Response) -> Crossings:
    """Every crossing and peak at 0 < omega < inf that margins can depend on."""
    return _search([response], lambda omega, _: response.log_derivatives(omega))[0]


def search_many(responses: Sequence[FactoredResponse]) -> list[Crossings]:
    """The same for each of `responses`, worked on together."""
    found: list[Crossings] = []
    for start in range(0, len(responses), TOGETHER):
        some = responses[start : start + TOGETHER]
        found += _search(some, Together(some).log_derivatives)
    return found


class _Brackets(NamedTuple):
    """Intervals [low, high] that hold a zero of the function `kind` of loop `owner`; start: a guess at it.

    rising: whether the function is negative at low.
    """

    low: np.ndarray
    high: np.ndarray
    kind: np.ndarray
    owner: np.ndarray
    start: np.ndarray
    rising: np.ndarray


def _search(responses: Sequence[Response], evaluate: Evaluate) -> list[Crossings]:
    grid = search_grid(responses, evaluate)
    values = _values(*grid.samples)
    brackets = _brackets(grid, values)
    hidden = _hidden(evaluate, grid, values)
    if hidden:
        brackets = _Brackets(*(np.concatenate(pair) for pair in zip(brackets, hidden, strict=True)))
    kind, owner = brackets.kind, brackets.owner
    omega, what = _polished(evaluate, brackets)
    key = 4 * owner + kind
    jump = (np.abs(what[GAIN]) > 1e-6) | (what[PHASE] < 1 / HUGE) | (what[PHASE] > HUGE)  # at an undamped root
    order = np.lexsort((omega, key))
    order = order[~(jump & (kind == PHASE))[order]]
    omega, what, key = omega[order], what[kind[order], order], key[order]
    edges = key.searchsorted(np.arange(4 * len(responses) + 1)).tolist()
    parts = [(omega[i:j], what[i:j]) for i, j in pairwise(edges)]
    return [
        Crossings(*parts[4 * i], *parts[4 * i + 1], *parts[4 * i + 2], *parts[4 * i + 3], envelope)
        for i, envelope in enumerate(grid.envelopes)
    ]


def from_negative(log: np.ndarray) -> np.ndarray:
    """arg(-L) in (-pi, pi]."""
    return math.pi - (-log.imag) % (2 * math.pi)


def _values(log, first, _, S, T) -> np.ndarray:
    """The four functions whose zeros are sought, shape (4, n)."""
    return np.array([log.real, from_negative(log), -(T * first).real, (S * first).real])


def _slopes(log, first, second, S, T) -> np.ndarray:
    """Their derivatives."""
    bend = T * S * first**2
    return np.array([first.real, first.imag, -(T * second + bend).real, (S * second - bend).real])


def _brackets(grid: Grid, values: np.ndarray) -> _Brackets:
    """Between nodes. Where the grid does not resolve the phase, only |L| is looked at."""
    left, right = values[:, :-1], values[:, 1:]
    holds = (left < 0) != (right < 0)
    holds[PHASE] &= np.abs(left[PHASE] - right[PHASE]) < math.pi  # arg(-L) = 0, not its jump at pi
    holds[S_PEAK:] &= (left[S_PEAK:] - right[S_PEAK:]) * grid.omega[1:] > FLAT  # peaks, not valleys
    holds[PHASE:] &= grid.resolved
    holds[GAIN] &= grid.inside
    kind, at = np.nonzero(holds)
    low, high, below, above = grid.omega[at], grid.omega[at + 1], left[kind, at], right[kind, at]
    slopes = _slopes(*grid.samples[:, np.concatenate([at, at + 1])]).reshape(4, 2, -1)[kind, :, np.arange(kind.size)].T
    return _Brackets(low, high, kind, grid.owner[at], _guess(low, high, below, above, *slopes), below < 0)


def _guess(low, high, below, above, slope_low, slope_high) -> np.ndarray:
    """Where the function is zero: omega as its cubic from values and slopes at both ends, else by the secant."""
    width, part = high - low, below / (below - above)
    rest = 1 - part
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = rest * ((above - below) / slope_low - width) - part * ((above - below) / slope_high - width)
    secant = low + width * part
    cubic = secant + part * rest * bend
    return np.where((cubic > low) & (cubic < high), cubic, secant)


def _hidden(evaluate: Evaluate, grid: Grid, values: np.ndarray) -> _Brackets | None:
    """Left and right of the extrema of log|L| or arg(-L) between two nodes, where these are beyond zero."""
    first = grid.samples[1]
    values, slopes, step = values[:2], np.array([first.real, first.imag]), grid.omega[1:] - grid.omega[:-1]
    trend, size, change = values * slopes, np.abs(values), np.abs(slopes)
    reach = (size[:, :-1] < change[:, :-1] * step) | (size[:, 1:] < change[:, 1:] * step)
    turns = (trend[:, :-1] < 0) & (trend[:, 1:] > 0) & (values[:, :-1] * values[:, 1:] > 0) & reach & grid.inside
    kind, at = np.nonzero(turns)
    if not kind.size:
        return None
    low, high, owner, outer = grid.omega[at], grid.omega[at + 1], grid.owner[at], values[kind, at]
    is_gain = kind == GAIN

    def slope(omega):
        _, first, second = evaluate(omega, owner)
        return np.where(is_gain, first.real, first.imag), np.where(is_gain, second.real, second.imag)

    middle = _newton(slope, low, high, np.sqrt(low * high), slopes[kind, at] < 0)
    log, *_ = evaluate(middle, owner)
    inner = np.where(is_gain, log.real, from_negative(log))
    i = np.flatnonzero(inner * outer < 0)
    if not i.size:
        return None
    low, middle, high, kind, owner, rising = low[i], middle[i], high[i], kind[i], owner[i], outer[i] < 0
    ends = np.concatenate([low, middle]), np.concatenate([middle, high])
    return _Brackets(
        *ends, np.tile(kind, 2), np.tile(owner, 2), np.sqrt(ends[0] * ends[1]), np.concatenate([rising, ~rising])
    )


def _polished(evaluate: Evaluate, brackets: _Brackets) -> tuple[np.ndarray, np.ndarray]:
    """omega of the zeros to full precision, (n,), and arg(-L), |L|, |S|, |T| there, (4, n)."""
    kind, owner = brackets.kind, brackets.owner
    if not kind.size:
        return brackets.low, np.zeros((4, 0))
    is_gain, is_crossing, is_S_peak = kind == GAIN, kind <= PHASE, kind == S_PEAK

    def function(omega):
        log, first, second = evaluate(omega, owner)
        S, T = sensitivities(log)
        weight, bend = np.where(is_S_peak, -T, S), S * T * (first * first)
        value = np.where(is_gain, log.real, from_negative(log))
        slope = np.where(is_gain, first.real, first.imag)
        return (
            np.where(is_crossing, value, (weight * first).real),
            np.where(is_crossing, slope, (weight * second - bend).real),
        )

    omega = _newton(function, brackets.low, brackets.high, brackets.start, brackets.rising)
    log, *_ = evaluate(omega, owner)
    S, T = sensitivities(log)
    return omega, np.array([from_negative(log), np.exp(np.minimum(log.real, LARGEST)), np.abs(S), np.abs(T)])


def _newton(function: Callable, low, high, omega, rising) -> np.ndarray:
    """Zeros inside the brackets: Newton from omega, or bisection where Newton would leave the bracket.

    function: value and slope at omega.   rising: whether the value is negative at low.
    """
    previous = np.zeros_like(omega)
    for _ in range(STEPS):
        value, slope = function(omega)
        below = (value < 0) == rising
        low, high = np.where(below, omega, low), np.where(below, high, omega)
        newton = omega - value / np.where(slope == 0, np.nan, slope)
        inside = (newton >= low) & (newton <= high)
        following = np.where(value == 0, omega, np.where(inside, newton, np.sqrt(low * high)))
        step = np.abs(following - omega)
        ahead = step**3 <= SETTLED * omega * previous**2  # errors square: the next step would be step^3/previous^2
        settled = (inside & (ahead | (step <= QUADRATIC * omega))) | (high - low <= ROUNDING * omega) | (value == 0)
        omega, previous = following, np.where(inside, step, 0.0)
        if settled.all():
            break
    return omega
