"""Random loops for tests of verdicts, margins and responses."""

import math

import numpy as np

from simc_core import IdealPid, Loop, Plant, SeriesPid


def third_unstable_loop(rng: np.random.Generator) -> Loop:
    """A third of the plants unstable."""
    theta = 10 ** rng.uniform(-1.5, 0.7)
    lags = 10 ** rng.uniform(-1, 1, rng.integers(1, 4))
    gain = 10 ** rng.uniform(-1.0, 1.3)
    if rng.random() < 1 / 3:
        lags[0] = -lags.max() - theta * 10 ** rng.uniform(-1, 1)
        gain = -(10 ** rng.uniform(-0.2, 0.7))
    leads = rng.choice([-1, 1], rng.integers(0, 2)) * 10 ** rng.uniform(-1.5, 0.3)
    pairs = [(10 ** rng.uniform(-0.5, 0.5), 10 ** rng.uniform(-2, 0))] if rng.random() < 0.3 else []
    integrators = int(rng.random() < 0.2)
    tau_D = rng.choice([0.0, 10 ** rng.uniform(-1, 0.5)])
    return Loop(
        Plant(gain, theta, lags, leads, integrators, pairs),
        rng.choice([SeriesPid, IdealPid])(1.0, 10 ** rng.uniform(-0.3, 2), tau_D, 0.1 * tau_D),
    )


def resonant_loop(rng: np.random.Generator) -> Loop:
    """RHP zeros, resonances down to zeta = 0.005, integrators, PID with and without filter, theta from 0.01 to 10."""
    theta = 10 ** rng.uniform(-2, 1)
    lags = 10 ** rng.uniform(-1.5, 1.5, rng.integers(1, 5))
    leads = rng.choice([-1, 1], rng.integers(0, 2)) * 10 ** rng.uniform(-1, 0.7)
    pairs = [(10 ** rng.uniform(-1, 1), 10 ** rng.uniform(math.log10(0.005), 0))] if rng.random() < 0.4 else []
    plant = Plant(1.0, theta, lags, leads, int(rng.random() < 0.3), pairs)
    slow = theta + lags.sum()
    tau_D = rng.choice([0.0, 0.2 * slow * rng.random()])
    tau_F = tau_D * rng.choice([0.0, 0.1, 0.5]) if plant.order > len(leads) + 1 else 0.1 * tau_D
    Kc = 10 ** rng.uniform(-2.5, 0.7) / (slow if plant.integrators else 1.0)
    form = IdealPid if rng.random() < 0.3 else SeriesPid
    return Loop(plant, form(Kc, slow * 10 ** rng.uniform(-0.5, 1), tau_D, tau_F))


def simulated_loop(rng: np.random.Generator) -> Loop:
    """Lags over three decades about theta, zeros on either side, pairs, integrators, unstable plants, all forms."""
    theta = 2.0 ** rng.integers(-6, 7)
    lags = theta * 10 ** rng.uniform(-1.5, 1.5, rng.integers(1, 4))
    if rng.random() < 0.2:
        lags[0] = -theta * rng.uniform(2, 20)
    leads = theta * rng.choice([-1, 1], rng.integers(0, 2)) * 10 ** rng.uniform(-1, 0.7)
    pairs = [(theta * 10 ** rng.uniform(-1, 1), 10 ** rng.uniform(-2, 0))] if rng.random() < 0.3 else []
    zeros = [(theta * 10 ** rng.uniform(-1, 1), 10 ** rng.uniform(-2, 0))] if pairs and rng.random() < 0.4 else []
    integrators = int(rng.random() < 0.3)
    plant = Plant(np.sign(lags[0]) / theta**integrators, theta, lags, leads, integrators, pairs, zeros)
    tau_D = theta * rng.choice([0.0, 10 ** rng.uniform(-1, 0.7)])
    smooth = plant.order - len(leads) - 2 * len(zeros) > 1
    tau_F = tau_D * rng.choice([0.0, 0.05, 0.5]) if smooth else 0.1 * tau_D
    form = IdealPid if rng.random() < 0.5 else SeriesPid
    weights = {"b": rng.uniform(0, 1), "c": rng.uniform(0, 1) if tau_F else 0.0}
    return Loop(plant, form(10 ** rng.uniform(-1, 0.5), theta * 10 ** rng.uniform(0, 1.5), tau_D, tau_F, **weights))


def wild_loop(rng: np.random.Generator) -> Loop:
    """Times over six decades, damping down to 1e-4, unstable plants, a filtered PID with settings of any size."""
    theta = 10 ** rng.uniform(-3, 3)
    lags = 10 ** rng.uniform(-3, 3, rng.integers(1, 5))
    if rng.random() < 0.2:
        lags[0] = -500.0
    pairs = [(10 ** rng.uniform(-3, 3), 10 ** rng.uniform(-4, 0))] if rng.random() < 0.5 else []
    leads = rng.choice([-1, 1], len(lags)) * 10 ** rng.uniform(-3, 3, len(lags))
    leads = leads[: rng.integers(0, len(lags) + 2 * len(pairs))]
    plant = Plant(1.0, theta, lags, leads, int(rng.random() < 0.25), pairs)
    tau_D = theta * 10 ** rng.uniform(-2, 1) * rng.integers(0, 2)
    smooth = plant.order > len(leads) + 1
    tau_F = theta * 10 ** rng.uniform(-3, 0) if tau_D or not smooth else 0.0
    return Loop(plant, SeriesPid(10 ** rng.uniform(-3, 2), theta * 10 ** rng.uniform(-2, 3), tau_D, tau_F))
