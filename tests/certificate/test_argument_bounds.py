"""What the certificate takes for certain on one segment, against f on a fine grid inside it."""

import math

import numpy as np

from simc_core import IdealPid, Loop, Plant, SeriesPid
from simc_core.algebra.factors import Factored
from simc_core.certificate.argument_bounds import BatchedSum
from simc_core.certificate.characteristic import Characteristic, characteristic
from simc_core.certificate.segments import Nodes

FINE = 2000


def random_pairs(rng: np.random.Generator, share: float) -> list[tuple[float, float]]:
    """One pair with this probability: growing, undamped, light, damped or real."""
    return [(10 ** rng.uniform(-1, 1), rng.choice([-0.3, 0.0, 0.01, 0.5, 2.0]))] if rng.random() < share else []


def random_terms(rng: np.random.Generator) -> list[Factored]:
    """One or two feedback terms; light pairs, right-half-plane roots, integrators, neutral and without dead time."""
    products = []
    for _ in range(rng.integers(1, 3)):
        lags = 10 ** rng.uniform(-1.5, 1.5, rng.integers(1, 4)) * rng.choice([1, 1, 1, -1])
        leads = rng.choice([-1, 1], rng.integers(0, 2)) * 10 ** rng.uniform(-1, 1)
        lag_pairs, lead_pairs = random_pairs(rng, 0.4), random_pairs(rng, 0.2)
        if len(leads) + 2 * len(lead_pairs) > len(lags) + 2 * len(lag_pairs):
            lead_pairs = []
        theta = rng.choice([0.0, 10 ** rng.uniform(-1, 1)])
        plant = Plant(10 ** rng.uniform(-1, 1), theta, lags, leads, int(rng.integers(0, 3)), lag_pairs, lead_pairs)
        tau_I, tau_D = 10 ** rng.uniform(-1, 1), rng.choice([0.0, 1.0])
        products.append(Loop(plant, rng.choice([SeriesPid, IdealPid])(1.0, tau_I, tau_D, 0.1 * tau_D)).L)
    return products if len(products) == 1 else [products[0], products[0] * products[1]]


def values(f: Characteristic, omega: np.ndarray) -> np.ndarray:
    """f(j omega), factor by factor."""
    s, total = 1j * omega, 0
    for powers, gain, theta in zip(f.exponents, f.gains, f.thetas, strict=True):
        term = gain * np.exp(-theta * s)
        for (a, b, c), power in zip(f.rows, powers, strict=True):
            term = term * (a * s * s + b * s + c) ** power
        total = total + term
    return total


def test_what_is_certain_is_true():
    rng = np.random.default_rng(7)
    certain = 0
    for _ in range(400):
        f = characteristic(random_terms(rng))
        omega = np.sort(10 ** rng.uniform(-2, 2, 12))
        found = BatchedSum([f]).at(Nodes(omega, np.zeros(12, dtype=int), np.ones(11, dtype=bool)))
        assert np.allclose(np.exp(1j * found.angle), np.exp(1j * np.angle(values(f, omega))), atol=1e-9)
        for i in np.flatnonzero(found.certain & ~found.zeros[1:] & ~found.zeros[:-1]):
            inside = values(f, np.linspace(omega[i], omega[i + 1], FINE))
            steps = np.angle(inside[1:] / inside[:-1])
            if np.max(np.abs(steps)) < 2:  # the fine grid is fine enough to tell
                assert abs(found.change[i] - math.fsum(steps)) < 1e-6
                certain += 1
    assert certain > 1000


def test_the_bound_of_the_slope_holds():
    """Length of the curve on a fine grid <= K (b - a), K (b - a) = excess (|f(a)| + |f(b)|) but for rounding."""
    rng = np.random.default_rng(8)
    for _ in range(300):
        f = characteristic(random_terms(rng))
        a = 10 ** rng.uniform(-2, 2)
        omega = np.array([a, a * rng.uniform(1.01, 2)])
        found = BatchedSum([f]).at(Nodes(omega, np.zeros(2, dtype=int), np.ones(1, dtype=bool)))
        inside = values(f, np.linspace(*omega, FINE))
        assert np.sum(np.abs(np.diff(inside))) <= found.excess[0] * np.abs(inside[[0, -1]]).sum() * (1 + 1e-9)


def test_loops_side_by_side_do_not_touch():
    """Segments of many loops in one row give what each gives alone."""
    rng = np.random.default_rng(9)
    plant = Plant(1.0, 1.0, (5.0, 2.0), (-0.5,), lag_pairs=((1.0, 0.1),))
    functions = [characteristic([Loop(plant, SeriesPid(Kc, 5.5)).L]) for Kc in 10 ** rng.uniform(-1, 1, 20)]
    grids = [np.sort(10 ** rng.uniform(-2, 2, 9)) for _ in functions]
    owner = np.repeat(np.arange(20), 9)
    together = BatchedSum(functions).at(Nodes(np.concatenate(grids), owner, owner[1:] == owner[:-1]))
    for i, (f, omega) in enumerate(zip(functions, grids, strict=True)):
        alone = BatchedSum([f]).at(Nodes(omega, np.zeros(9, dtype=int), np.ones(8, dtype=bool)))
        mine = slice(9 * i, 9 * i + 8)
        assert np.array_equal(together.certain[mine], alone.certain)
        assert np.allclose(together.change[mine], alone.change, rtol=0, atol=1e-12)
        assert np.allclose(together.excess[mine], alone.excess, rtol=1e-9)
