"""Time responses against closed forms, and properties; see test_accuracy.py for the reference in high precision."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simc_core import IController, InvalidParameter, Loop, ParallelPid, Plant, Scenario, SeriesPid, simulate
from tests.oracles.high_precision import without_delay


def test_the_step_response_of_2_over_s_with_unit_delay_is_piecewise_polynomial():
    """L = 2 e^{-s}/s: y(1.5) = 1, y(2) = 2, y(2.5) = 2.5, y(3) = 2, by hand."""
    t = np.array([0.5, 1.0, 1.5, 2.0, 2.5, 3.0])
    response = simulate(Loop(Plant(1, 1), IController(2)), Scenario(disturbance=0, t=t))
    assert np.array_equal(response.t, t)
    assert response.y == pytest.approx([0, 0, 1, 2, 2.5, 2], abs=1e-13)


def test_without_dead_time_against_the_closed_form():
    """k/(tau s + 1) under P control: y = T (1 - e^{-t (1 + k K)/tau}), T = k K/(1 + k K)."""
    t = np.linspace(0, 5, 41)
    got = simulate(Loop(Plant(2, 0, (3,)), ParallelPid(1.5, 0)), Scenario(disturbance=0, t=t))
    assert got.y == pytest.approx(0.75 * (1 - np.exp(-t * 4 / 3)), abs=1e-12)


@pytest.mark.parametrize("ratio", [1e4, 1e6])
def test_a_horizon_of_many_dead_times_against_the_limit_without_dead_time(ratio):
    """theta -> 0: y moves by O(theta); Richardson on two small theta gives the loop without dead time to O(theta^2)."""
    t = np.linspace(1, 20, 20)
    theta, controller = 20 / ratio, SeriesPid(3, 8)

    def y(theta):
        return simulate(Loop(Plant(1, theta, (8, 1)), controller), Scenario(disturbance=0, t=t)).y

    limit = without_delay(Loop(Plant(1, 0, (8, 1)), controller), load=False)
    expected = [limit(instant)[0] for instant in t]
    assert 2 * y(theta) - y(2 * theta) == pytest.approx(expected, abs=max(40 * theta**2, 1e-9))


def test_an_unfiltered_derivative_on_the_set_point_is_refused():
    with pytest.raises(InvalidParameter, match="tau_F"):
        simulate(Loop(Plant(1, 1, (5, 2)), SeriesPid(1, 5, 2, c=1.0)))


def test_an_unstable_loop_is_simulated_and_grows():
    response = simulate(Loop(Plant(1, 1), IController(2)), Scenario(t_end=60))
    assert np.max(np.abs(response.y[response.t > 50])) > 10 * np.max(np.abs(response.y[response.t < 10]))
    assert np.all(np.isfinite(response.y))


times = st.floats(0.2, 5)


@settings(max_examples=30)
@given(theta=times, tau=times, scale=st.floats(0.01, 100), gain=st.floats(0.1, 10))
def test_scaling_of_time_and_gain(theta, tau, scale, gain):
    t = np.linspace(0, 20, 9)
    one = simulate(Loop(Plant(1, theta, (tau,)), SeriesPid(0.4, tau)), Scenario(disturbance_time=10, t=t))
    two = simulate(
        Loop(Plant(gain, theta * scale, (tau * scale,)), SeriesPid(0.4 / gain, tau * scale)),
        Scenario(disturbance=1 / gain, disturbance_time=10 * scale, t=t * scale),
    )
    assert two.y == pytest.approx(one.y, abs=1e-9)
    assert two.u * gain == pytest.approx(one.u, abs=1e-9)


@settings(max_examples=30)
@given(r=st.floats(-5, 5), d=st.floats(-5, 5))
def test_responses_are_linear_in_the_heights(r, d):
    loop, t = Loop(Plant(1, 1, (4, 2)), SeriesPid(1, 4)), np.linspace(0, 30, 12)
    both = simulate(loop, Scenario(r, d, 12.0, t=t)).y
    unit = [simulate(loop, Scenario(a, b, 12.0, t=t)).y for a, b in ((1, 0), (0, 1))]
    assert both == pytest.approx(r * unit[0] + d * unit[1], abs=1e-10)


def test_an_offset_free_end():
    response = simulate(Loop(Plant(3, 2, (10,)), SeriesPid(0.8, 10)))
    assert response.y[-1] == pytest.approx(1.0, abs=0.02)
    assert response.u[-1] == pytest.approx(1 / 3 - 1, abs=0.02)
    assert math.isclose(response.t[-1] / 2, response.t[response.d > 0][0])
