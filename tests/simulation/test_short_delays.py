"""Limits where u is back at the controller within a step: no dead time, or one of a step or less."""

from itertools import pairwise

import control
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from simc_core import Actuation, Loop, ParallelPid, Plant, Scenario, SeriesPid, simulate
from simc_core.interop import closed_loop
from tests.oracles.saturated_loop import by_steps


@pytest.mark.parametrize("plant", [Plant(1.0, 0.005, (8.0, 2.0)), Plant(0.4, 0.005, (8.0,), (2.0,))])
def test_a_dead_time_of_one_step_without_limits_against_pade(plant):
    """6000 steps of theta; a Pade approximation of order 3 is exact to 1e-9 at all frequencies the loop reaches."""
    loop = Loop(plant, ParallelPid(4.0, 0.5, 6.0 if len(plant.lags) == 2 else 0.0, 0.3, 0.8, 0.4))
    t = np.linspace(1.0, 30.0, 291)
    found = simulate(loop, Scenario(1.0, -0.5, 10.0, t=t, actuation=Actuation(u_max=1e6)))
    grid = np.linspace(0.0, 30.0, 30_001)
    given = np.stack([np.ones_like(grid), -0.5 * (grid >= 10.0)])
    y, u = control.forced_response(closed_loop(loop, 3), grid, given).y
    away = (t < 10.0) | (t > 10.02)  # there the grid makes a ramp of the jump of d
    np.testing.assert_allclose(found.y[away], np.interp(t, grid, y)[away], atol=5e-5)
    np.testing.assert_allclose(found.u[away], np.interp(t, grid, u)[away], atol=5e-4)


def test_steps_of_a_dead_time_and_of_half_of_it_are_of_second_order(monkeypatch):
    """Against solve_ivp from one dead time to the next; u is at its limit at first."""
    theta, T_t, t_end = 0.25, 2.0, 15.0
    t, y = by_steps(2.0, 5.0, theta, 1.5, 3.0, (-0.1, 0.8), T_t, t_end, 7.5, -0.25)
    loop = Loop(Plant(2.0, theta, (5.0,)), SeriesPid(1.5, 3.0))
    scenario = Scenario(1.0, -0.25, 7.5, t=t, actuation=Actuation(u_min=-0.1, u_max=0.8, tracking_time=T_t))
    errors = []
    for parts in (1, 2, 4):
        monkeypatch.setattr("simc_core.simulation.actuator.continuous.FEWEST_STEPS", parts * t_end / theta)
        errors.append(np.abs(simulate(loop, scenario).y - y).max())
    assert errors[2] < 1e-3
    assert errors[0] / errors[2] > 8  # 16 but for where u leaves a limit within a step


@pytest.mark.parametrize("T_t", [0.5, 5.0])
def test_a_filtered_pid_controller_without_dead_time_against_solve_ivp(T_t):
    """1/((6 s + 1)(3 s + 1)(s + 1)(0.5 s + 1)), u in [-0.2, 1.6], load 1.15 from t = 30."""
    Kp, Ki, Kd, tau_F, b, c = 3.0, 0.3, 6.0, 0.4, 0.7, 0.2
    lags = np.array([6.0, 3.0, 1.0, 0.5])

    def right(t, z, d):
        x, integral, yF, rF = z[:4], *z[4:]
        y_slope, r_slope = (x[3] - yF) / tau_F, (1 - rF) / tau_F
        v = Kp * (b * rF - yF) + integral + Kd * (c * r_slope - y_slope)
        u = min(max(v, -0.2), 1.6)
        flow = (np.array([u + d, *x[:3]]) - x) / lags
        return [*flow, Ki * (rF - yF) + (u - v) / T_t, y_slope, r_slope]

    options = {"rtol": 1e-9, "atol": 1e-11, "max_step": 0.02, "dense_output": True}
    before = solve_ivp(right, (0, 30), np.zeros(7), args=(0.0,), **options).sol
    after = solve_ivp(right, (30, 60), before(30.0), args=(1.15,), **options).sol
    t = np.linspace(0.0, 60.0, 241)
    exact = np.where(t < 30, before(np.minimum(t, 30.0))[3], after(np.maximum(t, 30.0))[3])
    loop = Loop(Plant(1.0, 0.0, tuple(lags)), ParallelPid(Kp, Ki, Kd, tau_F, b, c))
    scenario = Scenario(1.0, 1.15, 30.0, t=t, actuation=Actuation(u_min=-0.2, u_max=1.6, tracking_time=T_t))
    found = simulate(loop, scenario)
    assert found.u.max() == 1.6
    assert found.u.min() == -0.2
    np.testing.assert_allclose(found.y, exact, atol=1e-5)


@pytest.mark.parametrize("samples", [150, 6000])  # with steps between the samples, and without
@pytest.mark.parametrize("part", [0.0, 0.4, 1.0, 1.7])  # theta/h
def test_sampled_plant_with_a_jump_against_its_difference_equation(part, samples):
    """(2 s + 1)/(8 s + 1) = 1/4 + (3/4)/(8 s + 1), so that the y measured holds u of the sample before."""
    h, Kp, Ki, T_t, limits = 0.1, 2.0, 0.5, 1.5, (-0.22, 1.4)
    load, load_at = 1.2, 8.03  # reaches the plant between two samples
    whole = int(np.ceil(part))
    late = whole - part  # of a period, u of one sample later

    def moved(x, w, duration):
        return w + (x - w) * np.exp(-duration / 8.0)

    x, integral, excess, before = 0.0, 0.0, 0.0, 0.0
    sent, us = [0.0] * (whole + 1), []
    for j in range(samples):
        t = h * j
        y = 0.75 * x + 0.25 * before
        integral += h * Ki * (1 - y) + h / T_t * excess
        v = Kp * (1 - y) + integral
        u = min(max(v, limits[0]), limits[1])
        excess = u - v
        sent.append(u)
        w = [sent[j + 1], sent[j + 2] if late else sent[j + 1]]
        edges = sorted({t, t + h * (1 - late), t + h} | {s for s in (load_at + part * h,) if t < s < t + h})
        us.append(u)
        for begin, end in pairwise(edges):
            d = load if begin >= load_at + part * h - 1e-9 else 0.0
            before = w[begin >= t + h * (1 - late) - 1e-9] + d
            x = moved(x, before, end - begin)
    actuation = Actuation(u_min=limits[0], u_max=limits[1], tracking_time=T_t, h=h)
    scenario = Scenario(1.0, load, load_at, t=h * np.arange(samples), actuation=actuation)
    found = simulate(Loop(Plant(1.0, part * h, (8.0,), (2.0,)), ParallelPid(Kp, Ki)), scenario)
    np.testing.assert_allclose(found.u, us, atol=1e-11)
