"""Time responses against closed forms, an mpmath method of steps that shares no code, and properties."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simc_core import IController, IdealPid, InvalidParameter, Loop, ParallelPid, Plant, Scenario, SeriesPid, simulate
from tests.core.high_precision import by_series

WITHIN = 1e-9


def test_the_step_response_of_2_over_s_with_unit_delay_is_piecewise_polynomial():
    """L = 2 e^{-s}/s: y(1.5) = 1, y(2) = 2, y(2.5) = 2.5, y(3) = 2, by hand."""
    t = np.array([0.5, 1.0, 1.5, 2.0, 2.5, 3.0])
    response = simulate(Loop(Plant(1, 1), IController(2)), Scenario(disturbance=0, t=t))
    assert np.array_equal(response.t, t)
    assert response.y == pytest.approx([0, 0, 1, 2, 2.5, 2], abs=1e-13)


CASES = {
    "lag dominant": (Plant(1, 1, (8,)), SeriesPid(4, 8), (1.5, 3.7, 9.0)),
    "delay dominant": (Plant(1, 1, (0.1,)), SeriesPid(0.05, 0.1), (1.2, 2.5, 5.3)),
    "integrating": (Plant(1, 1, integrators=1), SeriesPid(0.5, 8), (1.7, 6.2, 12.0)),
    "double integrating": (Plant(1, 1, integrators=2), SeriesPid(0.0625, 8, 8, 0.8), (1.7, 6.2, 9.0)),
    "SOPDT, PID with filter": (Plant(1, 1, (6, 3)), SeriesPid(3, 6, 3, 0.3), (1.4, 3.3, 8.1)),
    "unstable": (Plant(-1, 1, (-4,)), SeriesPid(-2.2, 20), (1.5, 4.4, 9.3)),
    "inverse response, oscillating": (Plant(1, 1, (2,), (-0.7,), 0, ((1, 0.2),)), SeriesPid(0.3, 2), (1.5, 4.4, 9.3)),
    "eight equal lags": (Plant(1, 0.8, (1,) * 8), SeriesPid(0.2, 1.5), (2.2, 7.0, 12.0)),
    "order 12": (Plant(1, 2, (100, 50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1, 0.05, 0.01)), SeriesPid(2, 100), (2.5, 9.0)),
    "ideal PID, complex zeros": (Plant(1, 1, (6, 3)), IdealPid(3, 5, 3, 0.3), (1.4, 8.1)),
}


@pytest.mark.parametrize("name", CASES)
def test_against_the_expansion_in_delays_in_high_precision(name):
    plant, controller, instants = CASES[name]
    one = (
        SeriesPid(controller.Kc, controller.tau_I, controller.tau_D, controller.tau_F, c=1.0)
        if isinstance(controller, SeriesPid)
        else IdealPid(controller.Kc, controller.tau_I, controller.tau_D, controller.tau_F, c=1.0)
    )
    loop = Loop(plant, one)
    t = np.array(instants)
    got_r = simulate(loop, Scenario(disturbance=0, t=t)).y
    got_d = simulate(loop, Scenario(setpoint=0, disturbance_time=0, t=t)).y
    with mp.workdps(400 if "order 12" in name else 60):
        for i, instant in enumerate(instants):
            if "order 12" in name and instant > 3:
                continue
            y_r, y_d = by_series(plant, one.factored, instant)
            assert got_r[i] == pytest.approx(float(y_r), abs=WITHIN)
            assert got_d[i] == pytest.approx(float(y_d), abs=WITHIN)


def test_without_dead_time_against_the_closed_form():
    """k/(tau s + 1) under P control: y = T (1 - e^{-t (1 + k K)/tau}), T = k K/(1 + k K)."""
    t = np.linspace(0, 5, 41)
    got = simulate(Loop(Plant(2, 0, (3,)), ParallelPid(1.5, 0)), Scenario(disturbance=0, t=t))
    assert got.y == pytest.approx(0.75 * (1 - np.exp(-t * 4 / 3)), abs=1e-12)


@pytest.mark.parametrize("ratio", [1e4, 1e6])
def test_a_horizon_of_many_dead_times_against_the_limit_without_dead_time(ratio):
    """theta -> 0: y moves by O(theta); Richardson on two small theta gives the loop without dead time to O(theta^2)."""
    t = np.linspace(0, 20, 21)
    theta = 20 / ratio

    def y(theta):
        return simulate(Loop(Plant(1, theta, (8, 1)), SeriesPid(2, 8)), Scenario(disturbance_time=10, t=t)).y

    assert 2 * y(theta) - y(2 * theta) == pytest.approx(y(0.0), abs=max(40 * theta**2, 1e-9))


def test_u_has_both_limits_where_it_jumps_and_y_is_zero_before_theta():
    response = simulate(Loop(Plant(1, 1), SeriesPid(0.3, 1)), Scenario(disturbance=0, t_end=4))
    twice = response.t[:-1][np.diff(response.t) == 0]
    assert np.allclose(twice[twice != 2.0], [0.0, 1.0, 3.0])  # and at 2, where the disturbance would begin
    at = np.flatnonzero(np.diff(response.t) == 0)
    assert response.u[at[1] + 1] - response.u[at[1]] == pytest.approx(-0.09)  # -Kc^2: what comes back after theta
    assert np.all(response.y[response.t < 1] == 0)


def test_an_unfiltered_derivative_on_the_set_point_is_refused():
    with pytest.raises(InvalidParameter, match="tau_F"):
        simulate(Loop(Plant(1, 1, (5, 2)), SeriesPid(1, 5, 2, c=1.0)))


def test_instants_that_do_not_increase_are_refused():
    with pytest.raises(InvalidParameter, match="increasing"):
        Scenario(t=np.array([1.0, 0.5]))


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
