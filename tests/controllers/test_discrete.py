"""The sampled laws: their responses, what they are equal to, and that simulation does the same."""

import math

import numpy as np
import pytest

from simc_core import Actuation, InvalidParameter, Loop, ParallelPid, Plant, Scenario, SeriesPid, simulate
from simc_core.controllers.discrete import LAWS, State, law_for
from tests.oracles.sampled_loop import driven

PID = ParallelPid(6.875, 0.625, 15.0, 0.375, b=0.7, c=0.3)


def outputs(law, pid, h, r, y, pull=0.0, limits=(-math.inf, math.inf)):
    state, u = State(), []
    for set_point, measured in zip(r, y, strict=True):
        state = LAWS[law].step(pid, h, pull, state, set_point, measured)
        state = state._replace(u=min(max(state.v, limits[0]), limits[1]))
        u.append(state.u)
    return np.array(u)


@pytest.mark.parametrize("law", LAWS)
def test_the_response_is_the_transform_of_what_the_law_does(law):
    """An impulse of y, summed up with z^-k where that converges."""
    h, log_z = 0.2, np.array([0.3 + 0.5j, 0.2 + 3j, 0.5])
    n = 400
    impulse = np.eye(1, n)[0]
    u = outputs(law, PID, h, np.zeros(n), impulse)
    assert np.exp(-np.outer(log_z, np.arange(n))) @ -u == pytest.approx(LAWS[law].response(PID, h, log_z), rel=1e-12)


@pytest.mark.parametrize("law", LAWS)
def test_far_below_the_sampling_frequency_the_response_is_that_of_the_continuous_controller(law):
    omega = np.array([0.01, 0.1, 1.0])
    errors = [
        abs(LAWS[law].response(PID, h, 1j * omega * h) / PID.response(1j * omega) - 1).max() for h in (1e-3, 5e-4)
    ]
    assert errors[0] / errors[1] == pytest.approx({"backward": 2, "tustin": 4}[law], rel=0.01)


def test_backward_pi_is_a_trapezoid_with_a_larger_gain():
    h, rng = 0.3, np.random.default_rng(1)
    y = rng.standard_normal(50)
    one = outputs("backward", ParallelPid(4, 0.5), h, 0 * y, y)
    other = outputs("tustin", ParallelPid(4 + 0.5 * h / 2, 0.5), h, 0 * y, y)
    assert one == pytest.approx(other, abs=1e-12)


def test_a_velocity_form_with_a_clamped_output_is_the_law_that_forgets_the_excess_in_one_sample():
    h, rng = 0.3, np.random.default_rng(2)
    r, y = rng.standard_normal((2, 200))
    pid = ParallelPid(4, 2, 0.5)
    u, e1, y1, y2, moved = 0.0, 0.0, 0.0, 0.0, []
    for e, now in zip(r - y, y, strict=True):
        u += pid.Kp * (e - e1) + h * pid.Ki * e - pid.Kd / h * (now - 2 * y1 + y2)
        u = min(max(u, -3.0), 5.0)
        e1, y1, y2 = e, now, y1
        moved.append(u)
    found = outputs("backward", pid, h, r, y, pull=1.0, limits=(-3.0, 5.0))
    assert np.any(found == 5)
    assert found == pytest.approx(np.array(moved), abs=1e-12)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("limit", [math.inf, 3.0])
@pytest.mark.parametrize("h", [0.25, 0.3])
def test_simulation_does_what_the_law_says(law, limit, h):
    plant, controller = Plant(1, 1, (10, 3)), SeriesPid(5, 8, 3, 0.375, b=0.7, c=0.2)
    r = np.ones(100)
    state = State()

    def step(set_point, y):
        nonlocal state
        state = LAWS[law].step(controller.to_parallel(), h, min(h / math.sqrt(24), 1), state, set_point, y)
        state = state._replace(u=min(max(state.v, -limit), limit))
        return state.u

    y, u = driven(1, 1, (10, 3), h, step, r)
    scenario = Scenario(1, 0, t=h * np.arange(100), actuation=Actuation(h=h, law=law, u_max=limit, u_min=-limit))
    found = simulate(Loop(plant, controller), scenario)
    assert found.y == pytest.approx(y, abs=1e-11)
    assert found.u == pytest.approx(u, abs=1e-11)


def test_a_filter_that_would_ring_is_refused():
    with pytest.raises(InvalidParameter, match=r"tau_F must be >= h/2 = 0.25 .* found 0.1"):
        law_for("tustin", ParallelPid(1, 1, 1, 0.1), 0.5)
    assert law_for("tustin", ParallelPid(1, 1), 0.5) is LAWS["tustin"]


def test_an_unknown_law_is_refused():
    with pytest.raises(InvalidParameter, match="law must be one of backward, tustin, found 'forward'"):
        Actuation(law="forward")
