"""Multiple roots given by expanded coefficients are found exactly, in plants from polynomials and from text."""

from fractions import Fraction
from math import comb

import numpy as np
import pytest

from simc_core import Plant, half_rule, parse_plant
from simc_core.algebra.square_free import square_free


def power_of_binomial(n: int) -> list[int]:
    """Coefficients of (s + 1)^n, descending."""
    return [comb(n, i) for i in range(n + 1)]


@pytest.mark.parametrize("n", range(2, 21))
def test_n_equal_lags_are_n_equal_lags(n):
    assert Plant.from_polynomials([1], power_of_binomial(n)).lags == pytest.approx((1.0,) * n, rel=1e-14)


@pytest.mark.parametrize(("n", "tau1", "theta"), [(10, 1.5, 8.5), (20, 1.5, 18.5)])
def test_the_half_rule_of_equal_lags(n, tau1, theta):
    """tau1 = 1 + 1/2, theta = 1/2 + (n - 2) [SK03 eq. 10]."""
    text = "1/(" + "+".join(f"{c}s^{n - i}" for i, c in enumerate(power_of_binomial(n))) + ")"
    model = half_rule(parse_plant(text)).model
    assert (model.tau1, model.theta) == pytest.approx((tau1, theta), rel=1e-12)


def test_mixed_multiplicities():
    """(s + 1)^3 (3 s + 2)^4 (s^2 + s + 1)^2 s: expanded by numpy with whole numbers."""
    product = np.array([1])
    for factor, power in (([1, 1], 3), ([3, 2], 4), ([1, 1, 1], 2), ([1, 0], 1)):
        for _ in range(power):
            product = np.convolve(product, factor)
    plant = Plant.from_polynomials([1], product.tolist())
    assert sorted(plant.lags) == pytest.approx([1.0] * 3 + [1.5] * 4, rel=1e-12)
    assert np.array(plant.lag_pairs) == pytest.approx(np.array([(1.0, 0.5)] * 2), rel=1e-12)
    assert plant.integrators == 1


def test_decimals_in_a_text_are_exact():
    """(s + 0.1)^5 expanded: none of its coefficients is a double."""
    text = "1/(s^5+0.5s^4+0.1s^3+0.01s^2+0.0005s+0.00001)"
    assert parse_plant(text).lags == pytest.approx((10.0,) * 5, rel=1e-14)


def test_the_factors_multiply_to_the_polynomial():
    rng = np.random.default_rng(5)
    for _ in range(40):
        parts = [
            ([Fraction(int(c)) for c in rng.integers(1, 9, rng.integers(2, 4))], int(rng.integers(1, 5))) for _ in "ab"
        ]
        product = [Fraction(1)]
        for part, power in parts:
            for _ in range(power):
                product = _times(product, part)
        back = [Fraction(1)]
        for part, power in square_free(tuple(product)):
            for _ in range(power):
                back = _times(back, part)
        assert back == [c / product[-1] for c in product]


def _times(p, q):
    found = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            found[i + j] += a * b
    return found


def test_forty_lags_are_forty_poles():
    assert len(Plant.from_polynomials([1], np.poly(-1 / np.geomspace(0.1, 10, 40)).tolist()).poles) == 40
