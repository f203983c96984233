"""What becomes of a loop when the plant is not what it was taken for: k, theta and tau1 off by a given part.

The controller stays. Corners: every combination of the largest changes. Samples: a Latin hypercube between them
[McKay, Beckman, Conover 1979], seeded, so that the picture is the same each time. tau1 is the slowest lag, or the
slowest pair; a plant that has none is changed in k and theta alone.

How far k and theta may change singly is exact and needs no samples: the loop survives k times GM_lower < c < GM, and
theta plus anything below delay_margin.
"""

import math
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from simc_core import checks
from simc_core.loops.loop import Loop
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins import margins
from simc_core.wording import Numeral, joined

LARGEST_CHANGE = 0.9  # a change of 100 % would leave no plant
SAMPLES, SEED = 24, 1979
SYMBOLS = ("k", "theta", "tau1")


@dataclass(frozen=True, slots=True)
class Case:
    """One plant of the family. change: relative change by symbol.   Ms: math.inf where the loop is not stable."""

    change: dict[str, float]
    loop: Loop
    Ms: float

    @property
    def stable(self) -> bool:
        """Whether the loop survives."""
        return math.isfinite(self.Ms)

    @property
    def name(self) -> str:
        """The changes in words, as "k +20 %, theta +20 %"."""
        return joined(
            [joined((symbol, " ", Numeral(f"{100 * part:+.3g}"), " %"), "") for symbol, part in self.change.items()]
        )


@dataclass(frozen=True, slots=True)
class Robustness:
    """corners, samples: all with the same controller.   worst: the one with the largest Ms, a corner or a sample.

    k_low, k_high: factors on k; theta_more: additional dead time. Between and below them the nominal loop survives.
    """

    corners: tuple[Case, ...]
    samples: tuple[Case, ...]
    k_low: float
    k_high: float
    theta_more: float

    @property
    def worst(self) -> Case:
        """The case with the largest Ms."""
        return max((*self.corners, *self.samples), key=lambda case: case.Ms)

    @property
    def worst_corner(self) -> Case:
        """The corner with the largest Ms."""
        return max(self.corners, key=lambda case: case.Ms)


def robustness(loop: Loop, change: float = 0.2, samples: int = SAMPLES, seed: int = SEED) -> Robustness:
    """Corners and samples of the family k, theta, tau1 -change ... +change, 0 < change <= 0.9."""
    change = checks.real("change", change, 1e-6, LARGEST_CHANGE)
    symbols = [symbol for symbol in SYMBOLS if _has(loop.plant, symbol)]
    signs = product((-1.0, 1.0), repeat=len(symbols))
    inside = 2 * _latin_hypercube(samples, len(symbols), seed) - 1
    nominal = margins(loop)
    return Robustness(
        tuple(_case(loop, symbols, change * np.array(sign)) for sign in signs),
        tuple(_case(loop, symbols, change * part) for part in inside),
        nominal.GM_lower,
        nominal.GM,
        nominal.delay_margin,
    )


def _latin_hypercube(n: int, d: int, seed: int) -> np.ndarray:
    """n points of the unit cube, shape (n, d): in each direction one in every n-th part of it, as SciPy's qmc has them.

    Importing scipy.stats for it would double the time in which the program starts.
    """
    draw = np.random.default_rng(seed)
    inside = draw.uniform(size=(n, d))
    place = np.tile(np.arange(1, n + 1), (d, 1))
    for one in place:
        draw.shuffle(one)
    return (place.T - inside) / n


def changed(plant: Plant, change: dict[str, float]) -> Plant:
    """`plant` with k, theta, tau1 changed by these parts."""
    factor = {symbol: 1 + change.get(symbol, 0.0) for symbol in SYMBOLS}
    k, theta = plant.k * factor["k"], plant.theta * factor["theta"]
    if plant.lags:
        slowest = max(range(len(plant.lags)), key=lambda i: abs(plant.lags[i]))
        lags = list(plant.lags)
        lags[slowest] *= factor["tau1"]
        return replace(plant, k=k, theta=theta, lags=tuple(lags))
    if plant.lag_pairs:
        (tau, zeta), *rest = sorted(plant.lag_pairs, reverse=True)
        return replace(plant, k=k, theta=theta, lag_pairs=((tau * factor["tau1"], zeta), *rest))
    return replace(plant, k=k, theta=theta)


def _has(plant: Plant, symbol: str) -> bool:
    return {"k": True, "theta": plant.theta > 0, "tau1": bool(plant.lags or plant.lag_pairs)}[symbol]


def _case(loop: Loop, symbols: list[str], parts: np.ndarray) -> Case:
    change = dict(zip(symbols, map(float, parts), strict=True))
    off = Loop(changed(loop.plant, change), loop.controller)
    Ms = margins(off).Ms
    return Case(change, off, math.inf if math.isnan(Ms) else Ms)
