"""Limits, anti-windup, noise and sampling against solve_ivp, closed forms and python-control with a high Pade order."""

import math

import control
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import solve_discrete_lyapunov
from scipy.signal import cont2discrete, tf2ss

from simc_core import (
    CascadeLoop,
    InvalidParameter,
    Loop,
    ParallelPid,
    Plant,
    Scenario,
    SeriesPid,
    simulate,
)
from simc_core.interop import closed_loop
from simc_core.simulation.actuator.actuation import Actuation, Inputs, Stepped, tracking_time_in_use
from simc_core.simulation.actuator.continuous import actuated as run
from tests.oracles.saturated_loop import by_steps


def actuated(loop, actuation, *inputs) -> Stepped:
    return run(loop, actuation, Inputs(*inputs))


LOOPS = [
    Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 8.0, b=0.5)),
    Loop(Plant(1.0, 1.0, (8.0, 2.0)), SeriesPid(4.0, 8.0, 2.0, 0.1)),
    Loop(Plant(1.0, 0.0, (8.0, 2.0)), SeriesPid(4.0, 8.0)),
    Loop(Plant(1.0, 0.0, (8.0,), (2.0,)), SeriesPid(4.0, 8.0)),
    Loop(Plant(1.0, 0.0, (8.0, 2.0, 1.0)), SeriesPid(4.0, 8.0, 2.0, 0.1)),
    Loop(Plant(0.2, 1.0, integrators=1), SeriesPid(2.5, 8.0)),
]


@pytest.mark.parametrize("loop", LOOPS)
@pytest.mark.parametrize("inputs", [(1.0, 0.0), (0.0, 1.0)])
def test_without_limits_it_is_the_linear_loop(loop, inputs):
    course = actuated(loop, Actuation(), *inputs, 0.0, 30.0)
    t = np.linspace(0.0, 30.0, 601)
    given = np.outer(inputs, np.ones_like(t))
    y, u = control.forced_response(closed_loop(loop, 10), t, given).y
    at = course.at(t)
    # nearer to the jump a Pade approximation rings, and u is linear over steps of 0.06 tau_F; of order 14 it would be
    # worse, by what rounding does to its coefficients
    away = t > max(3 * loop.plant.theta, 10 * loop.controller.tau_F)
    np.testing.assert_allclose(at[0][away], y[away], atol=2e-5 * max(1.0, np.abs(y).max()))
    np.testing.assert_allclose(at[1][away], u[away], atol=1e-4 * max(1.0, np.abs(u).max()))


def test_the_continuous_controller_is_of_second_order_in_the_step(monkeypatch):
    loop = LOOPS[0]
    t = np.linspace(0.0, 20.0, 101)
    exact_y = [1 - math.exp(-x / 8) for x in t]  # plant alone under u = u_max, before and after the dead time
    held = actuated(loop, Actuation(u_max=1.0), 10.0, 0.0, 0.0, 20.0).at(t)
    np.testing.assert_allclose(held[1], 1.0)
    np.testing.assert_allclose(held[0], np.interp(t - 1.0, t, exact_y, left=0.0), atol=2e-4)
    results = []
    for steps in (500, 1000, 8000):
        monkeypatch.setattr("simc_core.simulation.actuator.continuous.FEWEST_STEPS", steps)
        results.append(actuated(loop, Actuation(u_max=1.3), 1.0, 0.4, 10.0, 20.0).at(t)[0])
    coarse, half = (np.abs(each - results[-1]).max() for each in results[:2])
    assert coarse / half > 3


@pytest.mark.parametrize("tracking", [0.5, 4.0])
def test_saturated_loop_without_dead_time_against_solve_ivp(tracking):
    """10/((8 s + 1)(2 s + 1)) under a PI controller, set point 1, load -0.3 from t = 10, u in [-0.1, 0.2]."""
    Kc, tau_I = 2.0, 6.0
    loop = Loop(Plant(10.0, 0.0, (8.0, 2.0)), SeriesPid(Kc, tau_I))

    def right(t, x):
        first, y, integral = x
        v = Kc * (1 - y) + integral
        u = min(max(v, -0.1), 0.2)
        d = -0.05 if t >= 10 else 0.0
        return [(10 * (u + d) - first) / 8, (first - y) / 2, Kc / tau_I * (1 - y) + (u - v) / tracking]

    options = {"rtol": 1e-10, "atol": 1e-12, "max_step": 0.01}
    before = solve_ivp(right, (0, 10), [0, 0, 0], t_eval=np.linspace(0, 9.9, 100), **options)
    middle = solve_ivp(right, (0, 10 - 1e-12), [0, 0, 0], **options).y[:, -1]
    after = solve_ivp(right, (10, 30), middle, t_eval=np.linspace(10, 30, 201), **options)
    course = actuated(loop, Actuation(-0.1, 0.2, tracking), 1.0, -0.05, 10.0, 30.0)
    t = np.concatenate([before.t, after.t])
    y = np.concatenate([before.y[1], after.y[1]])
    assert course.u.max() == 0.2
    np.testing.assert_allclose(course.at(t)[0], y, atol=1e-4)


def test_sampled_integrating_plant_against_its_difference_equation():
    """k'/s e^{-theta s} with u held: y grows by k' h u of the sample before the dead time; theta = 2.4 h by hand."""
    k, theta, h, Kc, tau_I = 0.2, 1.2, 0.5, 1.0, 10.0
    course = actuated(Loop(Plant(k, theta, integrators=1), SeriesPid(Kc, tau_I)), Actuation(h=h), 1.0, 0.0, 0.0, 30.0)
    y, integral, u = [0.0], 0.0, [0.0, 0.0, 0.0]
    for j in range(60):
        integral += h * Kc / tau_I * (1 - y[j])
        u.append(Kc * (1 - y[j]) + integral)
        y.append(y[j] + k * h * (0.4 * u[j] + 0.6 * u[j + 1]))  # u[j + 3] belongs to sample j
    t = h * np.arange(60)
    np.testing.assert_allclose(course.at(t)[0], y[:60], atol=1e-12)
    np.testing.assert_allclose(course.at(t)[1], u[3:], atol=1e-12)


@pytest.mark.parametrize("loop", LOOPS[:3])
def test_a_fast_sampled_controller_is_the_continuous_one(loop):
    t = np.linspace(5.0, 30.0, 100)
    continuous = actuated(loop, Actuation(u_max=3.0), 1.0, 1.0, 15.0, 30.0).at(t)[0]
    errors = [
        np.abs(actuated(loop, Actuation(u_max=3.0, h=h), 1.0, 1.0, 15.0, 30.0).at(t)[0] - continuous).max()
        for h in (0.02, 0.01)
    ]
    assert errors[1] < 0.01
    assert 1.7 < errors[0] / errors[1] < 2.3  # first order: half a period of extra dead time


def test_noise_has_its_size_and_its_seed():
    loop = LOOPS[1]
    quiet, noisy, again, other = (
        actuated(loop, Actuation(noise=size, seed=seed), 1.0, 0.0, 0.0, 30.0)
        for size, seed in ((0.0, 0), (0.01, 1), (0.01, 1), (0.01, 2))
    )
    np.testing.assert_array_equal(noisy.u, again.u)
    assert np.abs(noisy.u - other.u).max() > 0
    assert 0 < np.std(noisy.y - quiet.y) < 0.01
    sampled = Loop(Plant(1e-6, 1.0, (8.0,)), SeriesPid(4.0, 1e6))
    u = actuated(sampled, Actuation(noise=0.1, h=0.01), 0.0, 0.0, 0.0, 50.0).u[:, 0]
    assert np.std(u) == pytest.approx(0.4, rel=0.05)  # Kc times the noise, 5000 samples


def test_anti_windup_shortens_the_overshoot_that_a_saturated_integrator_makes():
    loop = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 3.0))
    wound = actuated(loop, Actuation(0.0, 1.2, 1e6), 1.0, 0.0, 0.0, 60.0)
    tracked = actuated(loop, Actuation(0.0, 1.2), 1.0, 0.0, 0.0, 60.0)
    assert tracked.y.max() < wound.y.max() - 0.05


def test_a_tracking_time_that_is_given_goes_before_the_usual_one():
    loop = Loop(Plant(2.0, 1.0, (8.0,)), SeriesPid(4.0, 8.0))
    assert tracking_time_in_use(loop, Actuation()) == 8.0
    assert tracking_time_in_use(loop, Actuation(tracking_time=3.0)) == 3.0


def test_what_costs_too_much_or_has_no_meaning_is_refused():
    with pytest.raises(InvalidParameter, match="50000 steps for a dead time of 1e-05"):
        actuated(Loop(Plant(1.0, 1e-5, (8.0,)), SeriesPid(4.0, 8.0)), Actuation(), 1.0, 0.0, 0.0, 30.0)
    with pytest.raises(InvalidParameter, match="tau_F must be > 0"):
        actuated(Loop(Plant(1.0, 1.0, (8.0,), (2.0,)), SeriesPid(4.0, 8.0, 1.0)), Actuation(), 1.0, 0.0, 0.0, 30.0)


@pytest.mark.parametrize("T_t", [0.4, 6.0])
def test_saturated_loop_with_dead_time_against_solve_ivp_from_delay_to_delay(T_t):
    t, y = by_steps(2.0, 5.0, 1.0, 1.5, 3.0, (-0.1, 0.8), T_t, 24.0, 12.3, -0.25)
    loop = Loop(Plant(2.0, 1.0, (5.0,)), SeriesPid(1.5, 3.0))
    scenario = Scenario(1.0, -0.25, 12.3, t=t, actuation=Actuation(u_min=-0.1, u_max=0.8, tracking_time=T_t))
    np.testing.assert_allclose(simulate(loop, scenario).y, y, atol=2e-5)


def discrete(plant, h):
    """The plant under a held input at multiples of h: scipy's zero-order hold."""
    den = np.polymul([plant.lags[0], 1.0], [plant.lags[1], 1.0])
    A, B, C, _, _ = cont2discrete(tf2ss([plant.k], den), h)
    return A, B[:, 0], C[0]


def test_sampled_pid_with_filter_limits_and_anti_windup_against_its_difference_equations():
    h, T_t, limits = 0.25, 1.5, (-0.2, 1.6)
    plant = Plant(1.0, 1.0, (8.0, 2.0))  # theta = 4 h
    Kp, Ki, Kd, tau_F, b, c = 4.0, 0.5, 6.0, 0.3, 0.8, 0.4
    A, B, C = discrete(plant, h)
    x, sent, yF, rF, integral, excess = np.zeros(2), [0.0] * 4, 0.0, 0.0, 0.0, 0.0
    y_hand, u_hand = [], []
    for j in range(160):
        y = C @ x
        new_y, new_r = (tau_F * yF + h * y) / (tau_F + h), (tau_F * rF + h) / (tau_F + h)
        integral += h * Ki * (new_r - new_y) + h / T_t * excess
        v = Kp * (b * new_r - new_y) + integral + Kd * (c * (new_r - rF) - (new_y - yF)) / h
        u = min(max(v, limits[0]), limits[1])
        yF, rF, excess = new_y, new_r, u - v
        sent.append(u)
        y_hand.append(y)
        u_hand.append(u)
        load = -0.4 if h * j >= 21.0 else 0.0  # 20 and the dead time
        x = A @ x + B * (sent[j] + load)
    t = h * np.arange(160)
    controller = ParallelPid(Kp, Ki, Kd, tau_F, b, c)
    scenario = Scenario(1.0, -0.4, 20.0, t=t, actuation=Actuation(u_min=-0.2, u_max=1.6, tracking_time=T_t, h=h))
    found = simulate(Loop(plant, controller), scenario)
    assert max(u_hand) == 1.6
    np.testing.assert_allclose(found.y, y_hand, atol=1e-12)
    np.testing.assert_allclose(found.u, u_hand, atol=1e-12)


def test_noise_of_a_sampled_loop_has_the_variance_of_its_lyapunov_equation():
    """x = (plant, u one sample old, integral); the noise enters u = -Kp (y + n) + I, I += -h Ki (y + n)."""
    h, Kp, Ki = 0.5, 3.0, 0.4
    plant = Plant(1.0, 0.5, (8.0, 2.0))
    A, B, C = discrete(plant, h)
    whole, entry = np.zeros((4, 4)), np.zeros(4)
    gain = Kp + h * Ki
    whole[:2, :2], whole[:2, 2] = A, B
    whole[2, :2], whole[2, 3], entry[2] = -gain * C, 1.0, -gain
    whole[3, :2], whole[3, 3], entry[3] = -h * Ki * C, 1.0, -h * Ki
    P = solve_discrete_lyapunov(whole, np.outer(entry, entry))
    course = actuated(Loop(plant, ParallelPid(Kp, Ki)), Actuation(noise=0.02, seed=4, h=h), 0.0, 0.0, 0.0, 25_000.0)
    assert np.std(course.y[1000:, 0]) == pytest.approx(0.02 * math.sqrt(C @ P[:2, :2] @ C), rel=0.03)
    assert np.std(course.u[1000:, 0]) == pytest.approx(0.02 * math.sqrt(P[2, 2]), rel=0.03)  # 50 000 samples


def test_both_limits_at_jumps_without_instants_and_the_right_one_with_them():
    """P control of pure dead time: u = Kc sum (-Kc)^j, until it saturates."""
    loop = Loop(Plant(1.0, 1.0), SeriesPid(0.5, math.inf))
    found = simulate(loop, Scenario(1.0, 0.0, t_end=4.0, points=50, actuation=Actuation(u_max=0.4)))
    twice = np.flatnonzero(np.diff(found.t) == 0)
    assert found.t[twice] == pytest.approx([0.0, 1.0, 2.0, 3.0, 4.0])
    assert found.u[twice] == pytest.approx([0.0, 0.4, 0.3, 0.35, 0.325])
    assert found.u[twice + 1] == pytest.approx([0.4, 0.3, 0.35, 0.325, 0.3375])
    assert found.r[0] == 0.0
    assert found.r[1] == 1.0
    instants = np.array([0.0, 1.0, 1.5, 2.0])
    at = simulate(loop, Scenario(1.0, 0.0, t=instants, actuation=Actuation(u_max=0.4)))
    assert at.u == pytest.approx([0.4, 0.3, 0.3, 0.35])
    sampled = simulate(loop, Scenario(1.0, 0.0, t_end=4.0, points=9, actuation=Actuation(h=0.25)))
    assert np.all(np.diff(sampled.u)[np.diff(sampled.t) > 0] == 0)  # between jumps u is held


@pytest.mark.parametrize("h", [0.0, 0.5])
def test_a_tracking_time_below_the_step_acts_like_it_and_does_not_ring(h):
    """Its limit: the integral gives up at once what the actuator does not do, v is never beyond the limit for long."""
    loop = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 3.0))
    course = actuated(loop, Actuation(u_max=1.2, tracking_time=1e-9, h=h), 1.0, 0.0, 0.0, 60.0)
    begun = course.t[:-1] > 2 * course.h
    assert np.max(course.v[begun]) < 1.201 + 4.0 / 3.0 * course.h  # one step of the integral, Ki h
    assert np.min(course.u[course.t[:-1] < 5]) > 1.2 - 4.0 / 3.0 * course.h


def test_periods_and_dead_times_beyond_the_horizon():
    """One sample, u = Kc, or nothing that arrives."""
    loop = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 1e6))
    course = actuated(loop, Actuation(h=1e8), 1.0, 0.0, 0.0, 20.0)
    t = np.linspace(0.0, 20.0, 11)
    step = 4.0 * (1 + 1e8 / 1e6)  # the integral of a whole period is taken at the sample
    np.testing.assert_allclose(course.at(t)[0], step * -np.expm1(-np.maximum(t - 1, 0) / 8), rtol=1e-9)
    far = Loop(Plant(1.0, 1e9, (8.0,)), SeriesPid(4.0, 8.0))
    for h in (0.0, 0.1):
        assert np.all(actuated(far, Actuation(-1.0, 1.0, h=h), 1.0, 1.0, 5.0, 20.0).y == 0)


def test_a_plant_that_is_a_gain_answers_at_once():
    """y = u + d under PI: v = Kc (1 - y) + I with u = v gives u' = (1 - u - d)/(2 tau_I) for Kc = 1, from u = 1/2."""
    t = np.linspace(0.0, 40.0, 41)
    found = simulate(
        Loop(Plant(1.0), SeriesPid(1.0, 4.0)), Scenario(1.0, -0.5, 20.0, t=t, actuation=Actuation(u_max=1.2))
    )
    first = 1 - 0.5 * np.exp(-t / 8)
    late = np.minimum(1.5 - (0.25 + 0.5 * np.exp(-2.5)) * np.exp(-(t - 20) / 8), 1.2)
    assert found.u[t < 20] == pytest.approx(first[t < 20], abs=1e-6)
    assert found.u[t >= 20] == pytest.approx(late[t >= 20], abs=1e-6)
    assert found.y == pytest.approx(found.u - 0.5 * (t >= 20))


def test_an_unstable_response_is_cut_off_and_not_infinite():
    loop = Loop(Plant(-1.0, 1.0, (-1.0,)), SeriesPid(-1.0, 8.0))
    found = simulate(loop, Scenario(t_end=3000.0, actuation=Actuation(u_min=-0.1, u_max=0.1)))
    assert np.all(np.isfinite(found.y))
    assert np.max(np.abs(found.y)) > 1e100


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"u_min": 0.1}, "u_min must be <= 0, where the loop is at rest, found 0.1$"),
        ({"u_max": -1.0}, "u_max must be >= 0, where the loop is at rest, found -1$"),
        ({"u_min": 0.0, "u_max": 0.0}, "u_max must be > u_min = 0, found 0"),
        ({"u_min": math.nan}, "u_min must be finite, found nan"),
        ({"u_max": "1"}, "u_max must be a number, found '1'"),
        ({"u_max": 1e13}, "u_max must be <= 1e[+]12"),
        ({"tracking_time": 0.0}, "tracking_time must not be zero"),
        ({"tracking_time": -1.0}, "tracking_time must be > 0, found -1"),
        ({"noise": -0.1}, "noise must be >= 0, found -0.1"),
        ({"noise": math.inf}, "noise must be finite"),
        ({"seed": 0.5}, "seed must be a whole number"),
        ({"seed": -1}, "seed must be >= 0"),
        ({"h": -1.0}, "h must be >= 0"),
        ({"h": 1e10}, "h must be <= 1e[+]09"),
    ],
)
def test_the_door_names_field_bound_and_value(fields, words):
    with pytest.raises(InvalidParameter, match=words):
        Actuation(**fields)


def test_a_scenario_takes_nothing_else_for_an_actuation():
    with pytest.raises(TypeError, match="actuation must be an Actuation, found dict"):
        Scenario(actuation={"u_max": 1.0})


def test_what_has_no_meaning_is_refused():
    both = Loop(Plant(1.0, 1.0, (8.0, 2.0)), SeriesPid(4.0, 8.0, 1.0, c=1.0))
    with pytest.raises(InvalidParameter, match="tau_F must be > 0 for derivative action on a set-point step"):
        simulate(both, Scenario(actuation=Actuation(u_max=2.0)))
    cascade = CascadeLoop(Plant(1, 1, (5,)), Plant(1, 0.2, (1,)), SeriesPid(1, 5), SeriesPid(1, 1))
    with pytest.raises(InvalidParameter, match="nested loops"):
        simulate(cascade, Scenario(actuation=Actuation(u_max=2.0)))
    with pytest.raises(InvalidParameter, match="u is not defined"):
        simulate(Loop(Plant(-1.0), SeriesPid(1.0, 8.0)), Scenario(t_end=5.0, actuation=Actuation(u_max=1.0)))
    with pytest.raises(InvalidParameter, match="50000 steps for a sampling period of 1e-06"):
        simulate(LOOPS[0], Scenario(actuation=Actuation(h=1e-6)))
