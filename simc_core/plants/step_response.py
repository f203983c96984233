"""Step response of a plant alone, exact dead time.

G(s) = g(s) e^{-theta s}; y(t) = y0(t - theta), with y0 the unit step response of g. g is a chain of sections,
x' = A x + B with constant input, and [x; 1] moves from one instant to the next by one matrix exponential.
The grid is uniform; the dead time shifts it by a first step of another length, never by rounding to the grid.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import expm

from simc_core import checks
from simc_core.algebra.state_space import chain
from simc_core.plants.plant import Plant

POINTS = 600
RISEN = 1 - math.exp(-1)
SPREADS_TO_REST = 4.0  # spreads of the decay after which a stable response is at rest to 2 %
GROWN = 3.0  # time constants of an unstable pole that are shown
MOST_PERIODS = 15.0  # of an oscillation that hardly decays


@dataclass(frozen=True, slots=True, eq=False)
class PlantStep:
    """t, y: arrays of shape (n,); y at a jump is its right-hand limit."""

    t: np.ndarray
    y: np.ndarray


def plant_step(plant: Plant, t_end: float | None = None) -> PlantStep:
    """Response of the plant to a unit step at t = 0; t_end = None takes the plant's own horizon.

    An unstable response beyond the range of doubles is not finite.
    Raises InvalidParameter where t_end is not a positive time.
    """
    t_end = step_horizon(plant) if t_end is None else checks.positive_time("t_end", t_end)
    t, step = np.linspace(0.0, t_end, POINTS, retstep=True)
    after = np.flatnonzero(t >= plant.theta)
    y = np.zeros(POINTS)
    if after.size == 0:
        return PlantStep(t, y)
    A, B, C, D = chain(plant.factored, step)
    n = len(B)
    motion = np.zeros((n + 1, n + 1))
    motion[:n, :n], motion[:n, n] = A, B
    with np.errstate(over="ignore", invalid="ignore"):
        state = expm(motion * (t[after[0]] - plant.theta) / step)[:, n]
        advance = expm(motion)
        for i in after:
            y[i] = C @ state[:n] + D
            state = advance @ state
    return PlantStep(t, y)


@lru_cache(maxsize=64)  # each choice of tau_c is compared with it
def rise_time(plant: Plant) -> float:
    """When the unit step response first reaches 63 % of its end, dead time included; math.inf where it has no end."""
    if plant.integrators or plant.unstable_poles or any(zeta <= 0 for _, zeta in plant.lag_pairs):
        return math.inf
    alone = plant_step(plant)
    reached = np.flatnonzero(alone.y / plant.k >= RISEN)
    if not reached.size:
        return math.inf
    i = int(reached[0])
    if i == 0 or alone.t[i - 1] < plant.theta:
        return float(alone.t[i])
    level = [float(alone.y[j] / plant.k) for j in (i - 1, i)]
    return float(np.interp(RISEN, level, alone.t[i - 1 : i + 1]))


def step_horizon(plant: Plant) -> float:
    """How long a step response is worth watching: to rest, or until an unstable one has grown."""
    growing = [-tau for tau in plant.lags if tau < 0]
    growing += [tau / -zeta for tau, zeta in plant.lag_pairs if zeta < 0]
    if growing:
        return plant.theta + GROWN * min(growing)
    decay = [*plant.lags, *(_envelope(tau, zeta) for tau, zeta in plant.lag_pairs)]
    total = sum(plant.lags) + sum(2 * zeta * tau for tau, zeta in plant.lag_pairs)
    if decay:  # n equal lags spread like sqrt(n) round the sum of all
        return plant.theta + total + SPREADS_TO_REST * float(np.linalg.norm(decay))
    return 3 * plant.theta or SPREADS_TO_REST


def _envelope(tau: float, zeta: float) -> float:
    """Time constant of the envelope of a pair, of its slower part if it does not oscillate."""
    if zeta >= 1:
        return tau * (zeta + np.sqrt(zeta * zeta - 1))
    return tau / max(zeta, SPREADS_TO_REST / (2 * np.pi * MOST_PERIODS))
