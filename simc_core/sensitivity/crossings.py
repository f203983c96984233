"""All crossings and peaks of a loop transfer function over frequency.

    gain crossings     |L| = 1                     log|L| = 0
    phase crossings    L real and negative         arg(-L) = 0
    peaks              |S|, |T| largest            d log|S|/d omega = -Re(T l') = 0,   d log|T|/d omega = Re(S l') = 0

with l = log L (module logresponse). They are bracketed by sign changes on a grid (module search_grid).
A crossing hidden as a pair between two nodes is found by its extremum. All of them together, of all loops that are
asked for, are then polished. Values f and slopes f' at both ends a, b of a bracket, in closed form, give omega as a
cubic in f, which is at f = 0, with p = f_a/(f_a - f_b) and d = (f_b - f_a)/f',

    a + p (b - a) + p (1 - p) [(1 - p) (d_a - (b - a)) - p (d_b - (b - a))].

What is there takes the place of one end, and so on; the last step is Newton's. Two evaluations are usual.
"""

import math
from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, TypeVar

import numpy as np

from simc_core.sensitivity.log_response import LARGEST_LOG_L, FactoredResponse, Response, ResponseBatch, sensitivities
from simc_core.sensitivity.search_grid import Evaluate, Grid, sampled, search_grid

TOGETHER = 32  # loops; more do not fit the cache
FLATTEST_PEAK = 1e-10  # d log|S|/d log omega below which there is only rounding
LAST_STEP = np.array([1e-7, 1e-7, 1e-6, 1e-6])  # in widths of the bracket: Newton squares it, and peaks are flat
OMEGA_ROUNDING = 4e-16  # relative
LARGEST_PHASE = 1e-5  # |arg(-L)| before the last step to a phase crossing is smaller
LARGEST_LOG_GAIN = 99.0  # |log|L|| at a phase crossing is smaller
MOST_STEPS = 70  # of the polishing; two are usual
STEPS_BEFORE_HALVING = 5  # steps after which every other one halves the bracket
GAIN, PHASE, S_PEAK, T_PEAK = range(4)

Known = TypeVar("Known")  # what else is known where a function was evaluated


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
    alike: dict[tuple[int, int], list[int]] = defaultdict(list)
    for i, response in enumerate(responses):
        alike[len(response.zeros), len(response.poles)].append(i)
    found: dict[int, Crossings] = {}
    for members in alike.values():
        for start in range(0, len(members), TOGETHER):
            some = members[start : start + TOGETHER]
            chosen = [responses[i] for i in some]
            found |= zip(some, _search(chosen, ResponseBatch(chosen).log_derivatives), strict=True)
    return [found[i] for i in range(len(responses))]


class _Brackets(NamedTuple):
    """Intervals that hold a zero of the function `kind` of loop `owner`, shape (n,), ordered by these and by omega.

    ends: omega, the function and its derivative at both ends, shape (3, 2, n).
    """

    kind: np.ndarray
    owner: np.ndarray
    ends: np.ndarray


def _search(responses: Sequence[Response], evaluate: Evaluate) -> list[Crossings]:
    n, grid = len(responses), search_grid(responses, evaluate)
    functions = _functions(*grid.samples)
    below = functions[0] < 0
    changes = below[:, :-1] != below[:, 1:]
    brackets = _brackets(grid, functions, changes)
    hidden = _hidden(evaluate, grid, functions, changes)
    if hidden:
        kind, owner, ends = (np.concatenate(pair, axis=-1) for pair in zip(brackets, hidden, strict=True))
        order = np.lexsort((ends[0, 0], owner, kind))
        brackets = _Brackets(kind[order], owner[order], ends[..., order])
    omega, what, kept = _polished(evaluate, brackets)
    place = brackets.kind * n + brackets.owner
    if not kept.all():
        omega, what, place = omega[kept], what[:, kept], place[kept]
    edges = place.searchsorted(np.arange(4 * n + 1)).tolist()
    parts = [(omega[i:j], what[k // n, i:j]) for k, (i, j) in enumerate(pairwise(edges))]
    return [
        Crossings(*parts[i], *parts[n + i], *parts[2 * n + i], *parts[3 * n + i], envelope)
        for i, envelope in enumerate(grid.envelopes)
    ]


def from_negative(log: np.ndarray) -> np.ndarray:
    """arg(-L) in (-pi, pi]."""
    return math.pi - (-log.imag) % math.tau


def _functions(log: np.ndarray, first: np.ndarray, second: np.ndarray, S: np.ndarray, T: np.ndarray) -> np.ndarray:
    """The four functions whose zeros are sought, and their derivatives, shape (2, 4, n)."""
    of_S, of_T = T * first, S * first
    bend = T * second + of_S * of_T
    values = [log.real, from_negative(log), -of_S.real, of_T.real]
    return np.array([*values, first.real, first.imag, -bend.real, (second - bend).real]).reshape(2, 4, -1)


def _brackets(grid: Grid, functions: np.ndarray, changes: np.ndarray) -> _Brackets:
    """Between nodes where a function changes its sign. Where the grid does not resolve the phase: only |L| = 1."""
    holds, values = changes.copy(), functions[0]
    holds[PHASE] &= np.abs(values[PHASE, :-1] - values[PHASE, 1:]) < math.pi  # arg(-L) = 0, not its jump at pi
    peaks = values[S_PEAK:]
    holds[S_PEAK:] &= (peaks[:, :-1] - peaks[:, 1:]) * grid.omega[1:] > FLATTEST_PEAK  # not valleys
    holds[PHASE:] &= grid.resolved
    holds[GAIN] &= grid.inside
    kind, at = np.nonzero(holds)
    ends = np.array([at, at + 1])
    return _Brackets(kind, grid.owner[at], np.concatenate([grid.omega[None, ends], functions[:, kind, ends]]))


def _hidden(evaluate: Evaluate, grid: Grid, functions: np.ndarray, changes: np.ndarray) -> _Brackets | None:
    """Left and right of the extrema of log|L| or arg(-L) between two nodes, where these are beyond zero."""
    values, slopes = functions[:, :S_PEAK]
    trend = values * slopes
    turns = (trend[:, :-1] < 0) & (trend[:, 1:] > 0) & ~changes[:S_PEAK]
    if not turns.any():
        return None
    kind, at = np.nonzero(turns & grid.inside)
    ends = np.array([at, at + 1])
    outer, omega = values[kind, ends], grid.omega[ends]
    reach = np.abs(outer) < np.abs(slopes[kind, ends]) * (omega[1] - omega[0])
    turns = (outer[0] * outer[1] > 0) & reach.any(0)
    if not turns.any():
        return None
    kind, at, omega, outer = kind[turns], at[turns], omega[:, turns], outer[0, turns]
    owner, is_gain = grid.owner[at], kind == GAIN

    def parts(samples: np.ndarray) -> np.ndarray:
        return np.where(is_gain, samples.real, samples.imag)

    def slope(omega: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        samples = sampled(evaluate, omega, owner)
        return parts(samples[1]), parts(samples[2]), samples

    samples = grid.samples[:, [at, at + 1]]
    middle, _, _, inner = _zeros(slope, np.array([omega, parts(samples[1]), parts(samples[2])]), LAST_STEP[kind])
    i = np.flatnonzero(np.where(is_gain, inner[0].real, from_negative(inner[0])) * outer < 0)
    if not i.size:
        return None
    kind = kind[i]
    three = [(omega[0], samples[:, 0]), (middle, inner), (omega[1], samples[:, 1])]
    points = np.array([[x[i], *_functions(*known[:, i])[:, kind, np.arange(i.size)]] for x, known in three])
    ends = np.array([points[:2], points[1:]])  # (2 brackets, 2 ends, 3, n)
    return _Brackets(np.tile(kind, 2), np.tile(owner[i], 2), np.concatenate(ends, axis=-1).swapaxes(0, 1))


def _polished(evaluate: Evaluate, brackets: _Brackets) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """omega of the zeros to full precision, (n,), arg(-L), |L|, |S|, |T| there, (4, n), False at those to leave out."""
    kind, owner, ends = brackets
    each = np.arange(kind.size)

    def function(omega: np.ndarray) -> tuple[np.ndarray, np.ndarray, tuple[np.ndarray, np.ndarray]]:
        log, first, second = evaluate(omega, owner)
        value, slope = _functions(log, first, second, *sensitivities(log))[:, kind, each]
        return value, slope, (log, first)

    omega, step, value, (log, first) = _zeros(function, ends, LAST_STEP[kind])
    log = log + step * first
    S, T = sensitivities(log)
    what = np.array([from_negative(log), np.exp(np.minimum(log.real, LARGEST_LOG_L)), np.abs(S), np.abs(T)])
    # no jump by pi at an undamped root
    crossed = (np.abs(value) < LARGEST_PHASE) & (np.abs(log.real) < LARGEST_LOG_GAIN)
    return omega + step, what, crossed | (kind != PHASE)


def _zeros(
    function: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, Known]], ends: np.ndarray, settled: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, Known]:
    """Zeros of `function` in brackets, by the steps of the module docstring.

    function: value and slope at omega, and what else is known there.   ends: omega, value, slope at both, (3, 2, n).
    settled: a Newton step that may be the last, in widths of the bracket.
    Returns the last omega, the Newton step from there to the zero, the value at omega, and what else is known there.
    """
    low, high = ends[0]
    small = np.maximum(settled * (high - low), OMEGA_ROUNDING * high)  # the grid resolves what bends the function
    with np.errstate(divide="ignore", invalid="ignore"):
        omega = _guess(*ends)
        for number in range(MOST_STEPS):
            value, slope, known = function(omega)
            step = -value / slope
            near = done = np.abs(step) <= small
            if number > STEPS_BEFORE_HALVING:
                done = near | (ends[0, 1] - ends[0, 0] <= OMEGA_ROUNDING * omega)
            if done.all():
                break
            below = (value < 0) == (ends[1, 0] < 0)
            ends = np.where([below, ~below], np.array([omega, value, slope])[:, None], ends)
            halve = number > STEPS_BEFORE_HALVING and number % 2
            omega = np.where(done, omega, np.sqrt(ends[0, 0] * ends[0, 1]) if halve else _guess(*ends))
    return omega, np.where(near, step, 0.0), value, known


def _guess(omega: np.ndarray, values: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """The cubic of the module docstring at zero; the middle of the bracket where that is outside."""
    low, high = omega
    width, rise = high - low, values[1] - values[0]
    part = -values[0] / rise
    rest = 1 - part
    left, right = rise / slopes - width
    cubic = low + part * (width + rest * (rest * left - part * right))
    inside = (cubic > low) & (cubic < high)
    return cubic if inside.all() else np.where(inside, cubic, np.sqrt(low * high))
