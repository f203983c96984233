"""The solver behind all elements, against elimination."""

import numpy as np
import pytest

from simc_core.simulation.collocation.elements import COLLOCATION
from simc_core.simulation.collocation.shifted import solved

P = len(COLLOCATION)


@pytest.mark.parametrize("second_order", [True, False])
def test_many_matrices_at_once_are_solved_as_by_elimination(second_order):
    """Coefficients and lengths over eight decades; backward error within some roundings."""
    rng = np.random.default_rng(3)
    m, L = 40, 5
    a, b, c = (10 ** rng.uniform(-4, 4, (m, 1, 1, 1)) for _ in range(3))
    c = c * second_order
    length, right = 10 ** rng.uniform(-4, 4, (L, 1, 1)), rng.normal(size=(m, L, P, P + 3))
    K = length * COLLOCATION
    matrix = a * np.eye(P) + b * K + c * (K @ K)
    found = solved(a, b, c, length, right)
    size = np.abs(matrix).max(axis=(2, 3)) * np.abs(found).max(axis=(2, 3))
    assert np.all(np.abs(matrix @ found - right).max(axis=(2, 3)) <= 2e-14 * size)
    expected = np.linalg.solve(matrix, right)
    assert found == pytest.approx(expected, rel=0, abs=1e-9 * float(np.abs(expected).max()))
