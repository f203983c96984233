"""First-order recursions beside SciPy's filter."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import lfilter

from simc_core.algebra.recursion import first_order


@pytest.mark.parametrize("r", [0.9, -0.3, 0.999999, 0.0, 0.5 + 0.3j])
@pytest.mark.parametrize("shape", [(1,), (50,), (50, 3)])
@pytest.mark.parametrize("turn", [1.0, 1j])
def test_as_a_filter(r, shape, turn):
    b = turn * np.random.default_rng(1).standard_normal(shape)
    assert_allclose(first_order(b, r), lfilter([1.0], [1.0, -r], b, axis=0), rtol=0, atol=1e-13)
