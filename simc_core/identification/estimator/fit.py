"""The estimate: search on few points, refinement on all, single bad samples weighted down, drift and start weighed."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.levenberg import refined
from simc_core.identification.estimator.outliers import weights
from simc_core.identification.estimator.problem import Point, Problem
from simc_core.identification.estimator.records import Record
from simc_core.identification.estimator.search import costs, dead_times, starts
from simc_core.identification.estimator.structures import Structure

FEW, SOME = 400, 2500  # points of the search, and of the refinement before the last


@dataclass(frozen=True)
class Fit:
    """A structure fitted: the problem on all samples, and where its minimum lies."""

    problem: Problem
    point: Point

    @cached_property
    def residual(self) -> Array:
        """y minus the model, not weighted, shape (n,)."""
        target, columns = self.problem.columns(self.point.x)
        return target - columns @ self.point.beta

    @cached_property
    def jacobian(self) -> Array:
        """d model/d (x, linear part), weighted, shape (n, number of both)."""
        columns = self.problem.columns(self.point.x)[1] * self.problem.root_weight[:, None]
        return np.concatenate([self.problem.derivatives(self.point), columns], axis=1)

    @property
    def free(self) -> int:
        """Number of parameters."""
        return self.point.x.size + self.point.beta.size


def fitted(structure: Structure, records: list[Record], drift: bool, start: bool, floor: float) -> Fit:
    """The structure fitted from scratch; of more than 2500 samples, on means of neighbours.

    Parameters
    ----------
    structure : Structure
    records : list of Record
    drift, start : bool
        Whether a drift and an unsettled start go along.
    floor : float
        Deviation of y below which nothing is believed, > 0: its resolution.
    """
    few = Problem(structure, [record.reduced(FEW) for record in records], drift, start)
    tried = [refined(few, x, 15) for x in starts(few, 5 if len(structure.lags) > 1 else 3)]
    best = min(tried, key=lambda point: point.cost)
    theta = dead_times(few)
    walk = costs(few, theta, best.x[1:])
    if walk.min() < best.cost * (1 - 1e-6):
        best = min(best, refined(few, np.concatenate([[theta[walk.argmin()]], best.x[1:]]), 15), key=lambda p: p.cost)
    return continued(structure, records, drift, start, floor, [best.x])


def continued(
    structure: Structure, records: list[Record], drift: bool, start: bool, floor: float, begin: list[Array]
) -> Fit:
    """The structure fitted from the points x in `begin`; of more than 2500 samples, on means of neighbours."""
    whole = Problem(structure, records, drift, start)
    small = [record.reduced(SOME) for record in records]
    best = _best_of(Problem(structure, small, drift, start), begin, records[0].interval)
    for _ in range(4):
        residual = Fit(whole, whole.at(best.x)).residual
        known = [record.weight for record in whole.records]
        found = [weights(residual[part], floor) for part in whole.parts]
        if all(np.allclose(old, new, atol=0.05) for old, new in zip(known, found, strict=True)):
            break
        records = [record.weighted(weight) for record, weight in zip(records, found, strict=True)]
        whole = Problem(structure, records, drift, start)
        small = [record.reduced(SOME) for record in records]
        best = refined(Problem(structure, small, drift, start), best.x, 10)
    return Fit(whole, whole.at(best.x))


def polished(fit: Fit) -> Fit:
    """The fit brought to the minimum over all samples, where it was found on means of them."""
    return Fit(fit.problem, refined(fit.problem, fit.point.x, 2)) if fit.problem.size > SOME else fit


def _best_of(problem: Problem, begin: list[Array], interval: float) -> Point:
    """Refined from each of the points, and once more from a sample to either side, for there are kinks."""
    best = min((refined(problem, x) for x in begin), key=lambda point: point.cost)
    for shift in (-interval, interval):
        moved = best.x.copy()
        moved[0] = np.clip(moved[0] + shift, problem.low[0], problem.high[0])
        best = min(best, refined(problem, moved, 6), key=lambda point: point.cost)
    return best
