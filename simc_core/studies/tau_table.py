"""A table over tau_c that is read between its rows: the instrument that moves while it is dragged.

Rows lie on a grid in x = ln tau_c. Between rows a curve is the Lagrange polynomial through up to four of them. It never
goes across a kink, where tau_I = min(tau1, 4 (tau_c + theta)) changes branch: kinks are rows, and stencils stop there.
Dead time does not depend on tau_c, so jumps of a response stay at their instants and every point of it is a smooth
function of x, stable or not. L is read likewise; S and T follow from it exactly.

pages/common/live/kit/table.js reads in the same way in the browser; tests/browser/test_live.py holds them together.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from simc_core.errors import InvalidParameter
from simc_core.plants.models import Model
from simc_core.rules.simc_family import lag_of
from simc_core.wording import said

PER_DECADE = 7
STENCIL = 4
TOLERANCE = 1e-3  # of a curve's range: half of what the reader is promised
HALVED = 8  # times smaller the error is taken to be between rows half as far apart: a cubic's falls by 2^4
MOST_ROWS = 320
NEAR = 1e-7

Curves = Sequence[np.ndarray]  # each of shape (rows, points)


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """x: ln tau_c, increasing, shape (n,).   breaks: rows at which stencils stop, first and last included."""

    x: np.ndarray
    breaks: tuple[int, ...]

    @property
    def tau_c(self) -> np.ndarray:
        """tau_c of the rows."""
        return np.exp(self.x)


def first_rows(low: float, high: float, kinks: Sequence[float], per_decade: int = PER_DECADE) -> Rows:
    """An even grid from low to high, kinks between them among its rows."""
    edges = [math.log(tau_c) for tau_c in (low, *sorted(tau_c for tau_c in kinks if low < tau_c < high), high)]
    parts = []
    for begin, end in pairwise(edges):
        count = max(STENCIL - 1, math.ceil((end - begin) / math.log(10) * per_decade))
        parts.append(np.linspace(begin, end, count + 1)[:-1])
    x = np.concatenate([*parts, edges[-1:]])
    return Rows(x, tuple(int(at) for at in np.searchsorted(x, edges)))


def kinks(model: Model, rule: str = "simc") -> list[float]:
    """tau_c > 0 at which the settings of `model` change branch: 4 (tau_c + theta) = tau1, or the lag of the rule."""
    tau_c = lag_of(rule, model) / 4 - model.theta
    return [tau_c] if tau_c > 0 else []


def stencil(rows: Rows, x: float) -> tuple[int, np.ndarray]:
    """First row and weights of the rows from there on, for reading at x; weights sum to 1."""
    i = min(max(int(np.searchsorted(rows.x, x)) - 1, 0), len(rows.x) - 2)
    section = max(b for b in range(len(rows.breaks) - 1) if rows.breaks[b] <= i)
    low, high = rows.breaks[section : section + 2]
    count = min(STENCIL, high - low + 1)
    first = max(low, min(i - 1, high - count + 1))
    nodes = rows.x[first : first + count]
    weights = [np.prod([(x - m) / (node - m) for m in nodes if m != node]) for node in nodes]
    return first, np.array(weights)


def read(rows: Rows, curves: np.ndarray, x: float) -> np.ndarray:
    """The curve at x, shape (points,), from curves of shape (rows, points)."""
    first, weights = stencil(rows, x)
    return weights @ curves[first : first + len(weights)]


def refined(
    rows: Rows, compute: Callable[[np.ndarray], Curves], tolerance: float = TOLERANCE, most: int = MOST_ROWS
) -> tuple[Rows, Curves]:
    """Rows between which every curve is read to `tolerance` of its range, and the curves.

    compute: from tau_c, shape (m,), to the curves there. What is computed in the middle of an interval tells how well
    it was read, and becomes a row, so that all intervals are halved once. Where the error was more than HALVED times
    the tolerance the halves are looked at again. At `most` rows it ends.
    """
    values = compute(rows.tau_c)
    suspects = np.arange(len(rows.x) - 1)
    while len(suspects) and len(rows.x) < most:
        middle = (rows.x[suspects] + rows.x[suspects + 1]) / 2
        exact = compute(np.exp(middle))
        errors = [_error(rows, values, x, [each[i] for each in exact]) for i, x in enumerate(middle)]
        after = suspects + 1
        breaks = tuple(int(at + np.sum(after <= at)) for at in rows.breaks)
        rows = Rows(np.insert(rows.x, after, middle), breaks)
        values = [np.insert(each, after, new, axis=0) for each, new in zip(values, exact, strict=True)]
        halved = (after + np.arange(len(after)))[np.array(errors) > HALVED * tolerance]
        suspects = np.unique(np.clip(halved[:, None] + np.arange(-2, 2), 0, len(rows.x) - 2))
    return rows, values


def smallest(judge: Callable[[float], float], limit: float, low: float, high: float) -> float:
    """Smallest tau_c in [low, high] with judge(tau_c) <= limit, to 1e-7; judge may be nan, which is above any limit.

    The first row of a grid that keeps the limit is bracketed by the one before, and bisection does the rest.
    Raises InvalidParameter where no row keeps it.
    """
    best = below = math.inf
    for above in np.geomspace(low, high, math.ceil(PER_DECADE * math.log10(high / low)) + 1):
        value = judge(above)
        if value <= limit:
            break
        best, below = min(best, math.inf if math.isnan(value) else value), above
    else:
        raise InvalidParameter(
            said(
                "Ms must be >= {best:.4g}, the least up to tau_c = {high:.4g}, found {limit:g}",
                best=best,
                high=high,
                limit=limit,
            )
        )
    below = min(below, above)
    while above / below > 1 + NEAR:
        middle = math.sqrt(below * above)
        below, above = (below, middle) if judge(middle) <= limit else (middle, above)
    return float(above)


def _error(rows: Rows, values: Curves, x: float, exact: Sequence[np.ndarray]) -> float:
    """Largest difference between what is read at x and the exact curve, over the range of that curve."""
    worst = 0.0
    for curves, true in zip(values, exact, strict=True):
        span = float(np.ptp(true)) or 1.0
        worst = max(worst, float(np.max(np.abs(read(rows, curves, x) - true))) / span)
    return worst
