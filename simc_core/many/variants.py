"""Plants that differ a little from the one known: does the loop bear them? Monte Carlo over k, theta and tau1."""

import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from simc_core import checks
from simc_core.controllers.forms import Controller
from simc_core.errors import SimcError
from simc_core.loops.loop import Loop
from simc_core.many.result import Result, Robust
from simc_core.many.tune_rows import tune_chunk
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins import margins_many

SPREAD = 0.2  # of k, theta, tau1, either way
MOST_VARIANTS = 1000
HIGH = 0.95  # quantile of Ms


def varied(plant: Plant, n: int, seed: Sequence[int], spread: float = SPREAD) -> list[Plant]:
    """n plants; k, theta and the largest lag each times a random factor, evenly from 1 - spread to 1 + spread."""
    factors = np.random.default_rng(list(seed)).uniform(1 - spread, 1 + spread, (n, 3))
    slowest = max(range(len(plant.lags)), key=lambda i: abs(plant.lags[i]), default=None)
    found = []
    for k, theta, tau in factors.tolist():
        lags = tuple(each * tau if i == slowest else each for i, each in enumerate(plant.lags))
        found.append(replace(plant, k=plant.k * k, theta=plant.theta * theta, lags=lags))
    return found


def robust(plant: Plant, controller: Controller, n: int, seed: Sequence[int], spread: float = SPREAD) -> Robust:
    """What the settings are on n plants that differ from the one known."""
    found = margins_many([Loop(each, controller) for each in varied(plant, n, seed, spread)])
    Ms = np.array([each.Ms if each.stable else np.inf for each in found])
    high = float(np.quantile(Ms, HIGH, method="higher"))
    middle = float(np.quantile(Ms, 0.5, method="higher"))
    return Robust(n, sum(each.stable for each in found) / n, middle, high)


@dataclass(frozen=True, slots=True)
class TuneWithVariants:
    """`tune_chunk`, and n variants of each plant; the same for a row in whatever chunk or process it is.

    n: variants.   seed: of the random numbers.   spread: of k, theta and tau1.
    """

    n: int = 100
    seed: int = 1
    spread: float = SPREAD

    def __post_init__(self) -> None:
        checks.whole("variants", self.n, 1, MOST_VARIANTS)
        checks.whole("seed", self.seed, 0, 2**32)
        checks.real("spread", self.spread, 0.0, 0.9)

    @property
    def weight(self) -> float:
        """How many times longer than a plain one a row may take."""
        return 1 + self.n / 5

    def __call__(self, rows: Sequence[Mapping[str, Any]]) -> list[Result]:
        return [self._with_variants(result) for result in tune_chunk(rows)]

    def _with_variants(self, result: Result) -> Result:
        if result.plant is None or result.controller is None:
            return result
        seed = self.seed, zlib.crc32(f"{result.row.get('row', '')}|{result.tag}".encode(errors="replace"))
        try:
            return replace(result, robust=robust(result.plant, result.controller, self.n, seed, self.spread))
        except SimcError:
            return result
