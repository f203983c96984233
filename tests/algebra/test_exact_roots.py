"""Simple roots of polynomials with exact coefficients, far more sensitive than doubles can hold."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from simc_core import Loop, half_rule, parse_plant, performance, simc
from simc_core.algebra.exact_roots import polished


def expanded(roots) -> tuple[Fraction, ...]:
    product = [Fraction(1)]
    for root in roots:
        product = [a - root * b for a, b in zip([0, *product], [*product, 0], strict=True)]
    return tuple(product)


def test_the_roots_of_wilkinsons_polynomial_are_whole_numbers():
    """[Wilkinson 1959] prod (s + i), i = 1..30."""
    exact = expanded([Fraction(-i) for i in range(1, 31)])
    guesses = np.roots([float(c) for c in reversed(exact)])
    assert np.abs(guesses.imag).max() > 1
    assert sorted(root.real for root in polished(exact, guesses.tolist())) == [float(-i) for i in range(30, 0, -1)]


def test_roots_that_are_good_are_left_as_they_are():
    guesses = [complex(-1), complex(-2), complex(-3)]
    assert polished(expanded([-1, -2, -3]), guesses) == guesses


def test_complex_roots_against_mpmath():
    rng = np.random.default_rng(2)
    pairs = [(Fraction(int(a)), Fraction(int(b))) for a, b in rng.integers(1, 60, (9, 2))]
    exact = (Fraction(1),)
    for a, b in pairs:  # s^2 + 2 a s + a^2 + b^2
        factor = (a * a + b * b, 2 * a, Fraction(1))
        exact = tuple(
            sum(exact[i] * factor[n - i] for i in range(len(exact)) if 0 <= n - i < 3) for n in range(len(exact) + 2)
        )
    found = polished(exact, np.roots([float(c) for c in reversed(exact)]).tolist())
    with mpmath.workdps(80):
        right = mpmath.polyroots([int(c) for c in exact], maxsteps=500, extraprec=400, asc=True)

    def key(z: complex):
        return round(z.real, 6), round(z.imag, 6)

    assert sorted(found, key=key) == pytest.approx(sorted(map(complex, right), key=key), rel=1e-14)


def test_a_sum_of_37_lags_has_36_real_zeros_between_its_poles():
    plant = parse_plant("+".join(f"1/(s+{i})" for i in range(1, 38)))
    corners = sorted(1 / lead for lead in plant.leads)
    assert len(corners) == 36
    assert not plant.lead_pairs
    assert all(i < corner < i + 1 for i, corner in enumerate(corners, 1))
    for corner in corners:
        distances = [i - Fraction(corner) for i in range(1, 38)]
        assert abs(sum(1 / d for d in distances)) < 1e-10 * sum(1 / d**2 for d in distances)
    assert math.isclose(plant.k, sum(1 / i for i in range(1, 38)), rel_tol=1e-14)


def test_a_load_step_on_a_sum_of_37_lags_has_the_integral_of_its_controller():
    """int y dt = tau_I/Kc after a load step, whatever the plant: here y hardly changes its sign."""
    plant = parse_plant("+".join(f"1/(s+{i})" for i in range(1, 38)))
    controller = simc(half_rule(plant, 1).model)
    IAE = performance(Loop(plant, controller)).disturbance.IAE
    assert controller.tau_I / controller.Kc <= IAE <= 1.1 * controller.tau_I / controller.Kc
