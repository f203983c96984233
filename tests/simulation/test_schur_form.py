"""Functions of the collocation matrix behind all elements, against elimination."""

import numpy as np
import pytest

from simc_core.simulation.collocation.elements import COLLOCATION
from simc_core.simulation.collocation.schur_form import BACK, Q, inverse, polynomial

P = len(COLLOCATION)


@pytest.mark.parametrize("degree", [1, 2])
def test_many_inverses_at_once_are_those_of_elimination(degree):
    """Coefficients and lengths over eight decades; backward error within some roundings."""
    rng = np.random.default_rng(3)
    m, L = 40, 5
    coefficients = [10 ** rng.uniform(-4, 4, (m, 1, 1, 1)) for _ in range(degree + 1)]
    length, right = 10 ** rng.uniform(-4, 4, (L, 1, 1)), rng.normal(size=(m, L, P, P + 3))
    K = length * COLLOCATION
    powers = (np.eye(P), K, K @ K)
    matrix = sum(c * power for c, power in zip(coefficients, powers, strict=False))
    found = Q @ (inverse(polynomial(coefficients, length)) @ (BACK @ right))
    size = np.abs(matrix).max(axis=(2, 3)) * np.abs(found).max(axis=(2, 3))
    assert np.all(np.abs(matrix @ found - right).max(axis=(2, 3)) <= 2e-14 * size)
    expected = np.linalg.solve(matrix, right)
    assert found == pytest.approx(expected, rel=0, abs=1e-9 * float(np.abs(expected).max()))


def test_a_polynomial_is_that_of_the_collocation_matrix():
    """Also where coefficients are 0."""
    length = np.array([0.3, 2.0])[:, None, None]
    for given in ((2.0, 3.0, 0.5), (0.0, 3.0, 0.0), (0.0, 0.0, 0.5), (2.0, 0.0)):
        found = Q @ polynomial([np.full((1, 1, 1, 1), c) for c in given], length) @ BACK
        K = length * COLLOCATION
        expected = sum(c * np.linalg.matrix_power(K, power) for power, c in enumerate(given))
        assert found[0] == pytest.approx(expected, rel=0, abs=2e-14 * float(np.abs(expected).max()))
