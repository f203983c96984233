"""Relay, set-point overshoot and oscillation against closed forms and published numbers."""

import math

import numpy as np
import pytest

from simc_core import (
    FirstOrderDelay,
    IntegratingDelay,
    InvalidParameter,
    Loop,
    NotIdentifiable,
    NotReducible,
    Plant,
    SeriesPid,
    Trend,
    dominant_poles,
    margins,
    relay_from_trend,
    relay_test,
    retune_oscillation,
    setpoint_overshoot,
)


def limit_cycle(k, theta, tau1, up, down, hysteresis):
    """Peak, trough, times with OP up and down of a first-order plant under a relay [T84]."""
    E = math.exp(-theta / tau1)
    high = k * up - (k * up - hysteresis) * E
    low = k * down - (k * down - hysteresis) * E
    rising = tau1 * math.log((k * up + low) / (k * up - high))
    falling = tau1 * math.log((k * down + high) / (k * down - low))
    return high, low, rising, falling


@pytest.mark.parametrize(
    ("k", "theta", "tau1", "bias", "hysteresis"),
    [(1, 0.2, 1, 0, 0), (1, 5, 1, 0, 0), (1.5, 0.5, 10, 0, 0.05), (2, 3, 12, 0.2, 0), (-2, 3, 12, 0.3, 0.1)],
)
def test_a_first_order_plant_has_the_limit_cycle_of_the_closed_form(k, theta, tau1, bias, hysteresis):
    found = relay_test(Plant(k, theta, (tau1,)), 1.0, hysteresis, bias)
    sign = math.copysign(1, k)
    high, low, rising, falling = limit_cycle(abs(k), theta, tau1, 1 + sign * bias, 1 - sign * bias, hysteresis)
    assert found.Pu == pytest.approx(rising + falling, rel=1e-9)
    assert found.amplitude == pytest.approx((high + low) / 2, rel=1e-9)
    assert found.model.k == pytest.approx(k, rel=1e-6)
    assert found.model.theta == pytest.approx(theta, rel=1e-6)
    assert found.model.tau1 == pytest.approx(tau1, rel=1e-6)


@pytest.mark.parametrize(
    ("plant", "hysteresis", "amplitude", "period", "gain", "slower"),
    [
        (Plant(1, 0.2, (1,)), 0.0, 0.18127, 0.73318, 0.826, None),
        (Plant(1, 5, (1,)), 0.0, 0.99326, 11.3796, 1.132, None),
        (Plant(1.5, 0.5, (10,)), 0.05, 0.12072, 3.2261, 0.542, 1.645),
        (Plant(1, 0.3, (10, 1)), 0.0, 0.035461, 3.5631, 35.9 / 38.60, None),
    ],
)
def test_relay_against_the_printed_numbers(plant, hysteresis, amplitude, period, gain, slower):
    found = relay_test(plant, 1.0, hysteresis)
    assert found.amplitude == pytest.approx(amplitude, abs=6e-6)
    assert found.Pu == pytest.approx(period, rel=2e-5)
    assert found.Ku / found.Ku_exact == pytest.approx(gain, abs=6e-4)
    if slower:
        assert found.Pu / found.Pu_exact == pytest.approx(slower, abs=6e-4)


def test_an_integrating_plant_oscillates_with_four_dead_times():
    """y is a triangle: peak k' d theta, period 4 theta."""
    found = relay_test(Plant(0.5, 2.0, integrators=1), 3.0)
    assert (found.Pu, found.amplitude) == pytest.approx((8.0, 3.0), rel=1e-9)
    assert isinstance(found.model, IntegratingDelay)
    assert (found.model.k_prime, found.model.theta) == pytest.approx((0.5, 2.0), rel=1e-6)


def test_relay_refusals():
    with pytest.raises(NotReducible):
        relay_test(Plant(1, 0, (1,)), 1.0)
    with pytest.raises(InvalidParameter, match="amplitude must be > 0"):
        relay_test(Plant(1, 1, (1,)), -1.0)
    with pytest.raises(InvalidParameter, match="bias"):
        relay_test(Plant(1, 1, (1,)), 1.0, bias=1.0)


def test_a_recorded_relay_test_gives_model_and_point_back():
    """Unequal levels and 2 % noise; the exact ultimate point of the model is that of the plant."""
    plant = Plant(2, 3, (12,))
    made = relay_test(plant, 1.0, bias=0.2)
    y = made.y + 0.02 * made.amplitude * np.random.default_rng(0).normal(size=made.t.size)
    t = np.concatenate([[-1.0], made.t])
    found = relay_from_trend(Trend(t, np.concatenate([[0.0], y]), np.concatenate([[0.0], made.u])))
    assert found.Pu == pytest.approx(made.Pu, rel=0.01)
    assert found.Ku == pytest.approx(made.Ku, rel=0.05)
    assert found.model.theta == pytest.approx(3, rel=0.02)
    assert found.model.k / found.model.tau1 == pytest.approx(2 / 12, rel=0.02)
    with pytest.raises(NotIdentifiable, match="two levels"):
        relay_from_trend(Trend(range(40), range(40), np.arange(40) % 7))


def test_setpoint_overshoot_of_the_published_example():
    """E2 of [SS10], Kc0 = 1.5: read from the plot, and from an exact simulation."""
    read = setpoint_overshoot(1.5, 1.0, 0.79, 4.4, 0.54)
    assert (read.model.k, read.model.theta, read.model.tau1) == pytest.approx((0.99, 1.67, 3.00), abs=6e-3)
    exact = setpoint_overshoot(1.5, 1.0, 0.7816, 4.446, 0.5443)
    assert (exact.model.k, exact.model.theta, exact.model.tau1) == pytest.approx((0.986, 1.681, 3.047), abs=6e-4)
    assert (exact.controller.Kc, exact.controller.tau_I) == pytest.approx((0.919, 3.46), abs=6e-3)


def test_setpoint_overshoot_does_not_mind_units():
    one = setpoint_overshoot(1.5, 1.0, 0.79, 4.4, 0.54)
    other = setpoint_overshoot(-1.5 / 10, -10.0, -7.9, 264, -5.4)
    assert other.controller.Kc == pytest.approx(-one.controller.Kc / 10)
    assert other.controller.tau_I == pytest.approx(60 * one.controller.tau_I)
    assert other.model.tau1 == pytest.approx(60 * one.model.tau1)


def test_setpoint_overshoot_of_an_integrating_plant_does_not_divide_by_its_offset():
    found = setpoint_overshoot(0.9, 1.0, 1.3, 5.0, 1 / 0.45 - 1.3)
    assert isinstance(found.model, IntegratingDelay)
    assert found.controller.tau_I == pytest.approx(2.44 * 5)


def test_setpoint_overshoot_outside_its_correlation():
    with pytest.raises(InvalidParameter, match="a smaller Kc0"):
        setpoint_overshoot(1.0, 1.0, 1.9, 4.0, 0.1)
    with pytest.raises(InvalidParameter, match="between 0 and peak"):
        setpoint_overshoot(1.0, 1.0, 0.5, 4.0, 0.6)
    assert any("Aim at 0.3" in text for text in setpoint_overshoot(1.0, 1.0, 0.52, 4.0, 0.5).advice)


def period_of(loop):
    pole = max(dominant_poles(loop), key=lambda one: one.s.real)
    return 2 * math.pi / abs(pole.s.imag)


@pytest.mark.parametrize(("Kc", "tau_I"), [(0.025, 8), (0.05, 4), (0.1, 3), (0.02, 20), (0.2, 2)])
def test_retuning_a_slow_oscillation_makes_the_loop_robust(Kc, tau_I):
    """k' = theta = 1, with theta known and not: Ms from the exact loop."""
    plant = Plant(1, 1, integrators=1)
    period = period_of(Loop(plant, SeriesPid(Kc, tau_I)))
    for theta in (None, 1.0):
        found = retune_oscillation(SeriesPid(Kc, tau_I), period, theta)
        assert found.cause == "integral"
        assert margins(Loop(plant, found.controller)).Ms < 1.9


def test_raising_the_gain_alone_is_not_what_a_short_slow_oscillation_gets():
    """Kc k' = 0.5/theta, tau_I = 2 theta, P0 = 9.9 theta: the factor 2.5 on Kc would make the loop unstable."""
    plant = Plant(1, 1, integrators=1)
    assert not margins(Loop(plant, SeriesPid(0.5 * 2.5, 2))).stable
    found = retune_oscillation(SeriesPid(0.5, 2), 9.9, 1.0)
    assert found.controller.Kc == 0.5
    assert margins(Loop(plant, found.controller)).Ms < 1.9


def test_a_fast_oscillation_lowers_the_gain():
    plant = FirstOrderDelay(1, 1, 8).plant
    running = SeriesPid(11.0, 8)
    found = retune_oscillation(running, period_of(Loop(plant, running)), 1.0)
    assert found.cause == "gain"
    assert found.controller.Kc == 5.5
    with pytest.raises(InvalidParameter, match="integral action"):
        retune_oscillation(SeriesPid(1, math.inf), 5)
