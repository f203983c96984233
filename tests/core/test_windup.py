"""Limited actuator under nested loops: the linear engine where nothing saturates, and what protection must achieve."""

import numpy as np
import pytest

from simc_core import CascadeLoop, InvalidParameter, ParallelPid, Scenario, simc_cascade, simulate
from simc_core.simulation.windup import PROTECTIONS, limited
from tests.core.pairs import PAIRS

LOOP = simc_cascade(*PAIRS[1], inner="PID").loop


@pytest.mark.parametrize("protection", PROTECTIONS)
@pytest.mark.parametrize("loop", [simc_cascade(*PAIRS[1]).loop, CascadeLoop(*PAIRS[1], ParallelPid(0.2, 0.03), None)])
def test_without_limits_it_is_the_linear_response(loop, protection):
    found = limited(loop, -1e6, 1e6, protection, t_end=60.0)
    exact = simulate(loop, Scenario(disturbance=0.0, disturbance2=0.0, t=found.t))
    assert np.max(np.abs(found.y - exact.y)) < 2e-4
    assert np.max(np.abs(found.ys[0] - exact.ys[0])) < 5e-3  # a jump of u between two instants is a ramp here


def test_protection_pays():
    """Large step, u just enough: the more is protected, the less overshoot."""
    y = {kind: limited(LOOP, -0.2, 0.6, kind, t_end=120.0).y for kind in PROTECTIONS}
    over = {kind: np.max(each) - 1 for kind, each in y.items()}
    assert over["both"] < over["inner"] < over["none"]
    assert over["both"] < 0.5 * over["none"]
    for each in y.values():
        assert each[-1] == pytest.approx(1.0, abs=0.02)


def test_limits_hold():
    response = limited(LOOP, -0.2, 0.6, "both")
    assert np.max(response.u) == pytest.approx(0.6)
    assert np.min(response.u) >= -0.2


def test_bounds():
    with pytest.raises(InvalidParameter, match="u_min <= 0 <= u_max"):
        limited(LOOP, 0.1, 0.6)
    with pytest.raises(InvalidParameter, match="protection"):
        limited(LOOP, -1, 1, "all")
