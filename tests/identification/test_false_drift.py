"""A drift that only makes up for a process whose lag differs from move to move is not believed."""

import numpy as np
import pytest

from simc_core import Trend, identify
from tests.identification.simulated import two_lags


@pytest.mark.parametrize("seed", range(3))
def test_the_gain_is_not_said_to_differ_where_the_lag_does(seed):
    """Three moves of 0.36/((tau s + 1)(10 s + 1)) e^{-5s} with tau = 150, 120, 140, PV in steps of 0.32."""
    t = np.arange(0.0, 570.0)
    at, sizes = (11.0, 201.0, 402.0), (150.0, -140.0, 140.0)
    moves = zip(sizes, at, (150.0, 120.0, 140.0), strict=True)
    y = 295 + sum(0.36 * size * two_lags(np.maximum(t - s - 5, 0), tau, 10.0) for size, s, tau in moves)
    y = np.round((y + 0.1 * np.random.default_rng(seed).normal(size=t.size)) / 0.32) * 0.32
    found = identify(Trend(t, y, np.cumsum([0.0, *sizes]), t_u=[0.0, *at]), "SOPDT")
    assert found.drift == 0
    assert not any("gain differs" in text for text in found.verdicts)
    low, high = found.intervals["k"]
    assert low < 0.36 < high
    assert found.parameters["k"] == pytest.approx(0.36, rel=0.1)
