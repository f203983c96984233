"""Plants of every kind that SIMC has a rule for, at random but the same each time."""

import numpy as np

from simc_core import Plant

KINDS = (
    "stable",
    "high order",
    "inverse response",
    "zeros",
    "pure delay",
    "delay dominant",
    "integrating",
    "double integrating",
    "unstable",
    "oscillating",
)


def random_plants(number: int, seed: int = 0) -> list[tuple[str, Plant]]:
    """`number` plants with their kind, the kinds in turn."""
    rng = np.random.default_rng(seed)
    return [(kind, _plant(kind, rng)) for kind in (KINDS[i % len(KINDS)] for i in range(number))]


def _plant(kind: str, rng: np.random.Generator) -> Plant:
    k, theta = float(rng.choice([-1, 1]) * 10 ** rng.uniform(-2, 2)), float(10 ** rng.uniform(-1, 1))

    def times(count, low=-1.0, high=1.5):
        return tuple(float(x) for x in 10 ** rng.uniform(low, high, count))

    match kind:
        case "stable":
            return Plant(k, theta, times(rng.integers(1, 4)))
        case "high order":
            return Plant(k, theta * float(rng.integers(0, 2)), times(rng.integers(6, 11)))
        case "inverse response":
            return Plant(k, theta, times(3), tuple(-T for T in times(1, -1, 0.5)))
        case "zeros":
            return Plant(k, theta, times(3), times(rng.integers(1, 3)), int(rng.integers(0, 2)))
        case "pure delay":
            return Plant(k, theta)
        case "delay dominant":
            return Plant(k, theta, (theta * float(rng.uniform(0.05, 0.8)),))
        case "integrating":
            return Plant(k, theta, times(rng.integers(0, 4)), integrators=1)
        case "double integrating":
            return Plant(k, theta, times(rng.integers(0, 2), -1, 0), integrators=2)
        case "unstable":
            slow = theta / float(rng.uniform(0.02, 0.4))
            return Plant(k, theta, (-slow, *(theta * x for x in times(rng.integers(0, 3), -1, 0.3))))
        case _:
            tau0 = theta * float(rng.uniform(0.5, 10))
            return Plant(k, theta, lag_pairs=((tau0, float(rng.uniform(0.05, 0.68))),))
