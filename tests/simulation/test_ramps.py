"""Ramps of set point and load: closed forms, what is left of the error, and the mean of exact steps."""

from itertools import pairwise

import numpy as np
import pytest

from simc_core import InvalidParameter, Loop, Plant, Scenario, SeriesPid, simulate
from simc_core.loops.nested import CascadeLoop
from simc_core.simulation.actuator.actuation import Actuation, Inputs
from simc_core.simulation.actuator.continuous import actuated
from tests.oracles.high_precision import course

LEVEL = Loop(Plant(0.05, 2.0, integrators=1), SeriesPid(5.0, 16.0))
DEAD_TIME = Loop(Plant(1, 1), SeriesPid(0.8, 4))  # y and u jump for ever
NEUTRAL = Loop(Plant(1, 1, (5,)), SeriesPid(1.5, 5, 2))  # u jumps for ever


def test_a_first_order_loop_follows_a_ramp_by_its_closed_form():
    """k'/s with gain Kc: y = (t - tau (1 - e^{-t/tau}))/T, tau = 1/(k' Kc), until T, then the mean of two of these."""
    loop, T, tau = Loop(Plant(0.5, integrators=1), SeriesPid(4.0, np.inf)), 3.0, 0.5
    t = np.linspace(0.0, 8.0, 81)

    def rising(s):
        s = np.maximum(s, 0.0)
        return s - tau * (1 - np.exp(-s / tau))

    got = simulate(loop, Scenario(2.0, 0.0, setpoint_ramp=T, t=t))
    np.testing.assert_allclose(got.y, 2.0 * (rising(t) - rising(t - T)) / T, rtol=0, atol=1e-11)
    np.testing.assert_allclose(got.r, 2.0 * np.minimum(t / T, 1.0), rtol=1e-15)
    np.testing.assert_allclose(got.u, 4.0 * (got.r - got.y), rtol=0, atol=1e-10)


def test_a_load_ramp_on_a_level_leaves_the_error_that_the_final_value_theorem_gives():
    """y -> slope tau_I/Kc, since y/d = G/(1 + G C) -> 1/C as s -> 0."""
    got = simulate(LEVEL, Scenario(0.0, 20.0, 0.0, disturbance_ramp=2000.0, t=[900.0, 1000.0]))
    np.testing.assert_allclose(got.y, 0.01 * 16.0 / 5.0, rtol=1e-8)


def test_a_set_point_ramp_leaves_no_error_on_a_level_and_slope_tau_I_over_k_Kc_on_a_lag():
    got = simulate(LEVEL, Scenario(20.0, 0.0, setpoint_ramp=2000.0, t=[900.0, 1000.0]))
    np.testing.assert_allclose(got.y, got.r, rtol=1e-8)
    lag = Loop(Plant(2.0, 1.0, (10.0,)), SeriesPid(2.0, 8.0))
    got = simulate(lag, Scenario(20.0, 0.0, setpoint_ramp=2000.0, t=[900.0, 1000.0]))
    np.testing.assert_allclose(got.r - got.y, 0.01 * 8.0 / (2.0 * 2.0), rtol=1e-8)


@pytest.mark.parametrize("loop", [DEAD_TIME, NEUTRAL])
@pytest.mark.parametrize("load", [False, True])
@pytest.mark.parametrize("ramp", [0.6, 2.0, 3.3])
def test_a_ramp_is_the_mean_of_steps_known_to_seventy_five_digits(loop, load, ramp):
    """Gauss's rule between the jumps, at multiples of the dead time 1."""
    unit = course(loop, load, 6.5)
    nodes, weights = np.polynomial.legendre.leggauss(16)
    t = np.array([0.25, 1.5, 2.75, 4.0, 6.25])
    expected = []
    for end in t:
        begin = max(end - ramp, 0.0)
        cuts = [begin, *[k for k in range(1, 7) if begin < k < end], end]
        total = np.zeros(2)
        for low, high in pairwise(cuts):
            places = (low + high) / 2 + (high - low) / 2 * nodes
            values = np.array([[float(v) for v in unit.at(place, False)] for place in places])
            total += (high - low) / 2 * weights @ values
        expected.append(total / ramp)
    names = ("disturbance_ramp", "setpoint_ramp")
    given = {"setpoint": 0.0 if load else 1.0, "disturbance": 1.0 if load else 0.0, names[not load]: ramp}
    got = simulate(loop, Scenario(disturbance_time=0.0, t=t, **given))
    np.testing.assert_allclose(np.array([got.y, got.u]).T, expected, rtol=0, atol=1e-9)


def test_a_very_short_ramp_is_a_step():
    t = np.linspace(0.05, 12.0, 40)
    step, ramp = (
        simulate(NEUTRAL, Scenario(1.0, 0.5, 6.0, setpoint_ramp=T, disturbance_ramp=T, t=t)) for T in (0, 1e-6)
    )
    np.testing.assert_allclose(ramp.y, step.y, rtol=0, atol=1e-5)


@pytest.mark.parametrize("tau_F", [0.0, 0.4])
def test_the_loop_as_built_within_its_limits_is_the_linear_one_to_second_order(tau_F, monkeypatch):
    loop = Loop(Plant(2.0, 1.0, (10.0,)), SeriesPid(2.0, 8.0, 0.5, tau_F=tau_F, b=0.7))
    inputs = Inputs(1.0, 0.4, 30.0, 60.0, 12.3, 7.7)
    errors = []
    for steps in (500, 1000, 2000):
        monkeypatch.setattr("simc_core.simulation.actuator.continuous.FEWEST_STEPS", steps)
        found = actuated(loop, Actuation(u_max=1e6), inputs)
        asked = Scenario(1.0, 0.4, 30.0, setpoint_ramp=12.3, disturbance_ramp=7.7, t=found.t[:-1])
        errors.append(np.max(np.abs(simulate(loop, asked).y - found.y[:, 0])))
    assert errors[0] < 1e-4
    assert errors[2] < errors[0] / 8  # 16 but for the ends of the ramps, which lie within a step


def test_a_sampled_controller_sees_the_ramp_at_its_samples():
    """P control of an integrator without dead time, by hand: y_{k+1} = y_k + h k' (Kc (r_k - y_k) + mean of d)."""
    loop, h = Loop(Plant(0.5, integrators=1), SeriesPid(1.0, np.inf)), 0.25
    got = actuated(loop, Actuation(h=h), Inputs(1.0, 0.3, 2.0, 6.0, 1.1, 1.3))

    def area(t):
        s = max(t - 2.0, 0.0)
        return 0.3 * (s**2 / 2.6 if s < 1.3 else s - 0.65)

    y, samples = 0.0, []
    for k in range(24):
        samples.append(y)
        u = min(k * h / 1.1, 1.0) - y
        y += 0.5 * (h * u + area((k + 1) * h) - area(k * h))
    at = np.searchsorted(got.t, h * np.arange(24) - 1e-9)
    np.testing.assert_allclose(got.y[at, 0], samples, rtol=0, atol=1e-12)


def test_a_ramp_of_negative_duration_is_refused_and_nested_loops_have_none():
    with pytest.raises(InvalidParameter, match="setpoint_ramp must be >= 0, found -1"):
        Scenario(setpoint_ramp=-1)
    nested = CascadeLoop(Plant(1, 1, (5,)), Plant(1, 0.5, (1,)), SeriesPid(0.5, 5), SeriesPid(0.5, 1))
    with pytest.raises(InvalidParameter, match="must be 0 for nested loops, found 3 and 0"):
        simulate(nested, Scenario(setpoint_ramp=3))
