"""Series that only touch a level: the bracket that rounding leaves has no secant inside, and metrics stay numbers."""

import math

import numpy as np
import pytest

from simc_core import Loop, Plant, Scenario, SeriesPid, performance, simulate


def test_a_wild_stable_loop_has_an_IAE_and_an_ITAE():
    """Against sums over 400 000 instants of the simulated response."""
    loop = Loop(Plant(123, 0, (142.0, 54.4), (-0.013, -0.089, -322.0), 2), SeriesPid(1.1e-9, 5420, 5420, 542))
    found = performance(loop).setpoint
    end, parts = 1.2e5, 8
    IAE = ITAE = 0.0
    for part in range(parts):
        t = np.linspace(part * end / parts, (part + 1) * end / parts, 50_001)
        e = np.abs(1 - simulate(loop, Scenario(1.0, 0.0, t=t)).y)
        IAE, ITAE = IAE + np.trapezoid(e, t), ITAE + np.trapezoid(t * e, t)
    assert pytest.approx(IAE, rel=1e-5) == found.IAE
    assert pytest.approx(ITAE, rel=1e-4) == found.ITAE
    assert all(math.isfinite(getattr(found, name)) for name in ("ISE", "TV", "overshoot", "settling_time"))
