"""Step metrics over an infinite horizon, from the piecewise polynomials of the engine.

    IAE = int |e|    ISE = int e^2    ITAE = int t |e|    TV = sum |change of u|, jumps included    e = r - y

Zeros of e and extrema are bracketed on a fine grid in each piece and polished there; between them the polynomials are
integrated exactly. The horizon is doubled until y and u stay within REST = 1e-9 of their largest value over the last
quarter of it. The truncation error is what a decaying mode still adds behind that, REST times its time constant.
"""

import math
from dataclasses import dataclass
from functools import singledispatch

import numpy as np
from numpy.polynomial import chebyshev

from simc_core.errors import NotStable
from simc_core.loop import Loop
from simc_core.simulation.elements import P
from simc_core.simulation.pieces import Pieces, clenshaw
from simc_core.simulation.simulate import settling_horizon
from simc_core.simulation.steps import unit_steps
from simc_core.simulation.system import closed_loop
from simc_core.stability import stability

REST = 1e-9
ROUNDING = 1e-6  # a stiff loop whose values no longer come nearer to rest than this has reached its rounding errors
MOST_DOUBLINGS = 6
HORIZON = 6.0  # first horizon, in times to settle to 1 %
NOISE = 1e-11  # of the largest value; a signal this small has come to rest, its signs are rounding
SAMPLES = np.cos(np.pi * np.arange(32, -1, -1) / 32)  # where sign changes are looked for in a piece
NEWTON = 8
VANDERMONDE = chebyshev.chebvander(SAMPLES, P - 1)
SETTLING, RISE = 0.02, (0.1, 0.9)
GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(17)  # exact for e^2 of degree 30


@dataclass(frozen=True, slots=True)
class StepMetrics:
    """For a unit step. Times in the user's unit, from the step on.

    overshoot: of a set-point step, beyond 1 as a fraction; of a load step, beyond 0 on the other side as a fraction of
    the peak.   peak, peak_time: largest y of a set-point step, largest |y| of a load step (with its sign).
    rise_time: 10 % to 90 %, nan for a load step.   settling_time: within 2 % of the step, of the peak for a load step.
    """

    IAE: float
    ISE: float
    ITAE: float
    TV: float
    overshoot: float
    peak: float
    peak_time: float
    rise_time: float
    settling_time: float


@dataclass(frozen=True, slots=True)
class Performance:
    """Unit step of the set point, and of the disturbance at the plant input."""

    setpoint: StepMetrics
    disturbance: StepMetrics


@singledispatch
def performance(loop: Loop) -> Performance:
    """Metrics of both unit steps, see the module docstring.

    Raises NotStable where the loop is not stable, and where an offset remains so that the integrals diverge.
    """
    verdict = stability(loop)
    if verdict.verdict != "stable":
        raise NotStable(f"step metrics exist for a stable loop only, got one that is {verdict.verdict}")
    pieces = _to_rest(loop)
    _, right = pieces.ends()
    offsets = np.array([1.0, 0.0]) - right[-1, 0]
    largest = np.max(np.abs(right[:, 0]), axis=0)
    for name, offset, size in zip(("set-point", "load"), offsets, largest, strict=True):
        if abs(offset) > 1e-7 * max(size, 1e-300):
            raise NotStable(f"IAE needs a loop that settles without offset, got {offset:.4g} after a {name} step")
    return Performance(step_metrics(pieces, 0), step_metrics(pieces, 1))


def _to_rest(loop: Loop) -> Pieces:
    system, t_end = closed_loop(loop), HORIZON * settling_horizon(loop)
    before = np.inf
    for _ in range(MOST_DOUBLINGS):
        pieces = unit_steps(system, t_end)
        left, right = pieces.ends()
        late = pieces.edges[1:] >= 0.75 * pieces.edges[-1]
        change = np.max(np.abs(np.stack([left[late], right[late]]) - right[-1]), axis=(0, 1))
        moving = float(np.max(change / (np.max(np.abs(right), axis=0) + 1e-300)))
        if moving <= REST or before / 2 < moving <= ROUNDING:
            return pieces
        before = moving
        t_end *= 2
    raise NotStable(f"the loop must come to rest within {t_end:.3g}, got one too close to its stability limit")


def step_metrics(pieces: Pieces, column: int) -> StepMetrics:
    """Metrics of y and u, the values of `pieces` (y, u) x (r, d), for column 0 (set point) or 1 (load)."""
    target = 1.0 - column
    y, u = pieces.coefficients[:, :, 0, column], pieces.coefficients[:, :, 1, column]
    e = -y
    e[:, 0] += target
    IAE, ITAE = _absolute_integrals(pieces.edges, e)
    half = np.diff(pieces.edges) / 2
    squares = (chebyshev.chebvander(GAUSS_X, e.shape[1] - 1) @ e.T) ** 2
    t_extreme, y_extreme = _extrema(pieces.edges, y)
    _, u_extreme = _extrema(pieces.edges, u)
    i = int(np.argmax(y_extreme if target else np.abs(y_extreme)))
    peak, peak_time = float(y_extreme[i]), float(t_extreme[i])
    band = SETTLING * (1.0 if target else abs(peak))
    if target:
        overshoot = max(peak - 1.0, 0.0)
        rise = _first(pieces.edges, y, RISE[1]) - _first(pieces.edges, y, RISE[0])
    else:
        overshoot = max(float(np.max(-np.sign(peak) * y_extreme)), 0.0) / abs(peak) if peak else 0.0
        rise = math.nan
    return StepMetrics(
        IAE,
        float(half @ (GAUSS_W @ squares)),
        ITAE,
        float(np.sum(np.abs(np.diff(u_extreme, prepend=0.0)))),
        overshoot if overshoot > 1e-10 else 0.0,
        peak,
        peak_time,
        rise,
        max(_last(pieces.edges, e, band), _last(pieces.edges, e, -band)),
    )


def _roots(series: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sign changes within pieces: piece and place x in (-1, 1), in order of time.

    A piece with |c_0| > sum |c_k| has none. The others are sampled, brackets polished by Newton kept inside them.
    """
    size = np.abs(series)
    total = size.sum(axis=1)
    able = np.flatnonzero((2 * size[:, 0] <= total) & (total > NOISE * np.max(total, initial=0.0)))
    own = series[able]
    values = own @ VANDERMONDE[:, : series.shape[1]].T
    row, at = np.nonzero(values[:, 1:] * values[:, :-1] < 0)
    own, low, high = own[row], SAMPLES[at], SAMPLES[at + 1]
    first, last = values[row, at], values[row, at + 1]
    slope = chebyshev.chebder(own, axis=1)
    x = low - first * (high - low) / (last - first)
    for _ in range(NEWTON):
        f = clenshaw(own, x)
        same = np.sign(f) == np.sign(first)
        low, high = np.where(same, x, low), np.where(same, high, x)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = x - f / clenshaw(slope, x)
        x = np.where((step >= low) & (step <= high), step, np.where(f == 0, x, (low + high) / 2))
    return able[row], x


def _absolute_integrals(edges: np.ndarray, e: np.ndarray) -> tuple[float, float]:
    """int |e| and int t |e|."""
    half, left = np.diff(edges) / 2, edges[:-1]
    once = chebyshev.chebint(e, lbnd=-1, axis=1)
    twice = chebyshev.chebint(once, lbnd=-1, axis=1)
    piece, x = _roots(e)
    count = len(e)
    pieces = np.concatenate([np.arange(count), piece, np.arange(count)])
    places = np.concatenate([np.full(count, -1.0), x, np.ones(count)])
    order = np.lexsort((places, pieces))
    pieces, places = pieces[order], places[order]
    first = half[pieces] * clenshaw(once[pieces], places)
    t = left[pieces] + half[pieces] * (places + 1)
    moment = t * first - half[pieces] ** 2 * clenshaw(twice[pieces], places)
    same = pieces[1:] == pieces[:-1]
    return float(np.sum(np.abs(np.diff(first))[same])), float(np.sum(np.abs(np.diff(moment))[same]))


def _extrema(edges: np.ndarray, series: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Times and values of local extrema and of both limits at all edges, in order of time."""
    piece, x = _roots(chebyshev.chebder(series, axis=1))
    count = len(series)
    pieces = np.concatenate([np.arange(count), piece, np.arange(count)])
    places = np.concatenate([np.full(count, -1.0), x, np.ones(count)])
    order = np.lexsort((places, pieces))
    pieces, places = pieces[order], places[order]
    times = edges[pieces] + np.diff(edges)[pieces] * (places + 1) / 2
    return times, clenshaw(series[pieces], places)


def _crossings(edges: np.ndarray, series: np.ndarray, level: float) -> np.ndarray:
    shifted = series.copy()
    shifted[:, 0] -= level
    piece, x = _roots(shifted)
    inside = edges[piece] + np.diff(edges)[piece] * (x + 1) / 2
    signs = (-1.0) ** np.arange(series.shape[1])
    left, right = shifted @ signs, shifted.sum(axis=1)
    jumped = np.concatenate([[False], left[1:] * right[:-1] < 0])
    return np.sort(np.concatenate([inside, edges[:-1][jumped]]))


def _first(edges: np.ndarray, series: np.ndarray, level: float) -> float:
    found = _crossings(edges, series, level)
    return float(found[0]) if len(found) else 0.0


def _last(edges: np.ndarray, series: np.ndarray, level: float) -> float:
    found = _crossings(edges, series, level)
    return float(found[-1]) if len(found) else 0.0
