"""Limits, anti-windup, noise and sampling against solve_ivp, closed forms and python-control with a high Pade order."""

import math

import control
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from simc_core import IController, InvalidParameter, Loop, Plant, SeriesPid
from simc_core.interop import closed_loop
from simc_core.simulation.actuation import Actuation, Course, Inputs, tracking_time
from simc_core.simulation.saturation import actuated as run


def actuated(loop, actuation, *inputs) -> Course:
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
    y, u = control.forced_response(closed_loop(loop, 14), t, given).y
    at = course.at(t)
    # nearer to the jump a Pade approximation rings, and u is linear over steps of 0.06 tau_F
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
        monkeypatch.setattr("simc_core.simulation.saturation.STEPS", steps)
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


def test_default_tracking_times():
    plant = Plant(2.0, 1.0, (8.0,))
    assert tracking_time(Loop(plant, SeriesPid(4.0, 8.0)), Actuation()) == 8.0
    assert tracking_time(Loop(plant, SeriesPid(4.0, 8.0, 2.0)), Actuation()) == pytest.approx(4.0)  # sqrt(10 * 1.6)
    assert tracking_time(Loop(plant, IController(0.25)), Actuation()) == 2.0
    assert tracking_time(Loop(plant, SeriesPid(4.0, 8.0)), Actuation(tracking_time=3.0)) == 3.0


def test_what_costs_too_much_or_has_no_meaning_is_refused():
    with pytest.raises(InvalidParameter, match="100000 steps for a dead time of 1e-05"):
        actuated(Loop(Plant(1.0, 1e-5, (8.0,)), SeriesPid(4.0, 8.0)), Actuation(), 1.0, 0.0, 0.0, 30.0)
    with pytest.raises(InvalidParameter, match="tau_F must be > 0"):
        actuated(Loop(Plant(1.0, 1.0, (8.0,), (2.0,)), SeriesPid(4.0, 8.0, 1.0)), Actuation(), 1.0, 0.0, 0.0, 30.0)
