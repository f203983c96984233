"""Grids of many loops made together are those made one by one."""

import numpy as np
import pytest

from simc_core.certificate.segments import geometric, geometric_rows


def test_rows_are_the_grids_of_each_loop():
    """Spans from less than one step to thirty decades; 0 in front, both ends exact."""
    rng = np.random.default_rng(4)
    first = 10 ** rng.uniform(-12, 6, 60)
    last = first * 10 ** rng.uniform(0.01, 30, 60)
    omega, owner, ends = geometric_rows(first, last, 24)
    for i, (low, high) in enumerate(zip(first, last, strict=True)):
        own, alone = omega[owner == i], geometric(low, high, 24)
        assert own[0] == 0
        assert (own[1], own[-1], omega[ends[i]]) == (low, high, high)
        assert own[1:] == pytest.approx(alone, rel=1e-13)
