"""Quality measures against closed forms: a second-order loop, a first-order loop, and numbers of another program."""

import math
from dataclasses import replace

import numpy as np
import pytest

from simc_core import (
    IController,
    IdealPid,
    Loop,
    NotStable,
    ParallelPid,
    Plant,
    Scenario,
    SeriesPid,
    bandwidth,
    performance,
    simulate,
    static_errors,
    step_quality,
    tune,
)

ZETA, OMEGA = 0.3, 2.0
# k = 1, tau = 1, b = 0: y/r = Ki/(s^2 + (1 + Kp) s + Ki), y/d = s/(the same)
SECOND = Loop(Plant(1, 0, (1,)), ParallelPid(2 * ZETA * OMEGA - 1, OMEGA**2, 0, b=0))
DAMPED, DECAY = OMEGA * math.sqrt(1 - ZETA**2), ZETA * OMEGA
FIRST = Loop(Plant(2, 0, (8,)), SeriesPid(1, 8))  # L = 1/(4 s)
LAGGING = Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))
INTEGRATING = Plant(1, 1, integrators=1)


def test_a_second_order_loop_swings_as_the_formulas_say():
    found = step_quality(SECOND)
    overshoot = math.exp(-math.pi * DECAY / DAMPED)
    assert performance(SECOND).setpoint.overshoot == pytest.approx(overshoot, rel=1e-8)
    assert found.setpoint.decay_ratio == pytest.approx(overshoot**2, rel=1e-7)
    assert found.setpoint.period == pytest.approx(2 * math.pi / DAMPED, rel=1e-7)
    assert found.setpoint.first_arrival == pytest.approx((math.pi - math.acos(ZETA)) / DAMPED, rel=1e-8)
    assert found.disturbance.decay_ratio == pytest.approx(overshoot**2, rel=1e-7)
    assert found.disturbance.period == pytest.approx(2 * math.pi / DAMPED, rel=1e-7)
    assert math.isnan(found.disturbance.first_arrival)


def test_the_time_weighted_square_of_a_second_order_loop():
    """y = e^{-a t} sin(w t)/w after a load step: int t y^2 = (1/(4 a^2) - Re 1/(2 a - 2 i w)^2)/(2 w^2)."""
    exact = (1 / (4 * DECAY**2) - (1 / (2 * DECAY - 2j * DAMPED) ** 2).real) / (2 * DAMPED**2)
    assert pytest.approx(exact, rel=1e-8) == step_quality(SECOND).disturbance.ITSE


def test_a_first_order_loop_settles_as_its_exponential_does():
    """y = 1 - e^{-t/4}; u = 1/2 + e^{-t/4}/2 begins with Kc."""
    found = step_quality(FIRST).setpoint
    assert (found.settling_1, found.settling_5) == pytest.approx((4 * math.log(100), 4 * math.log(20)), rel=1e-8)
    assert pytest.approx(4.0, rel=1e-8) == found.ITSE  # int t e^{-t/2}
    assert found.largest_u == pytest.approx(1.0, rel=1e-12)
    assert math.isnan(found.first_arrival)
    assert math.isnan(found.decay_ratio)
    assert math.isnan(found.period)


def test_a_first_order_loop_has_the_bandwidth_of_its_lag():
    """S = 4 s/(4 s + 1), T = 1/(4 s + 1), KS = (8 s + 1)/(2 (4 s + 1)) rises from 1/2 to 1."""
    found = bandwidth(FIRST)
    assert pytest.approx((0.25, 0.25), rel=1e-10) == (found.omega_bS, found.omega_bT)
    assert pytest.approx(1.0, rel=1e-9) == found.max_KS
    assert found.omega_KS == math.inf


def test_the_largest_noise_gain_may_be_the_one_at_rest():
    """L = e^{-s}/(10 s) by an I controller: |KS| falls from 1/k."""
    found = bandwidth(Loop(Plant(2, 1), IController(0.05)))
    assert (found.max_KS, found.omega_KS) == pytest.approx((0.5, 0.0))


def test_bandwidths_with_dead_time_are_those_that_are_known():
    found = bandwidth(LAGGING)
    assert pytest.approx(0.355417, abs=5e-7) == found.omega_bS
    assert pytest.approx(1.124334, abs=5e-7) == found.omega_bT
    assert pytest.approx(0.8588, abs=5e-5) == bandwidth(Loop(INTEGRATING, SeriesPid(0.5, 8))).max_KS


def test_a_neutral_loop_may_have_no_end_of_its_band():
    """Pure dead time under PI: |L(inf)| = Kc, |T| comes back to Kc/(1 - Kc) for ever."""
    assert math.inf == bandwidth(Loop(Plant(1, 1), SeriesPid(0.45, 1))).omega_bT
    assert math.isfinite(bandwidth(Loop(Plant(1, 1), SeriesPid(0.2, 1 / 3))).omega_bT)


def test_a_derivative_without_filter_passes_noise_without_limit():
    assert math.inf == bandwidth(Loop(Plant(1, 1, (6, 2)), SeriesPid(1, 6, 2))).max_KS
    found = bandwidth(Loop(Plant(1, 1, (6, 2)), SeriesPid(1, 6, 2, 0.1)))
    assert found.max_KS >= 2 / 0.1


def test_ziegler_nichols_swings_on_an_integrating_plant_as_it_is_known_to():
    found = step_quality(Loop(INTEGRATING, tune("zn_ultimate", INTEGRATING, "PI"))).setpoint
    assert found.decay_ratio == pytest.approx(0.0677, abs=5e-5)
    assert found.period == pytest.approx(7.425, abs=1e-3)


@pytest.mark.parametrize(
    ("loop", "type_", "ramp", "parabola"),
    [
        (LAGGING, 1, 2.0, math.inf),  # tau_c + theta
        (Loop(INTEGRATING, SeriesPid(0.5, 8)), 2, 0.0, 16.0),  # tau_I/(Kc k')
        (Loop(INTEGRATING, IdealPid(0.5, math.inf)), 1, 2.0, math.inf),
    ],
)
def test_offsets_follow_from_the_type_of_the_loop(loop, type_, ramp, parabola):
    found = static_errors(loop)
    assert (found.type, found.step, found.ramp, found.parabola) == (type_, 0.0, ramp, parabola)


def test_offsets_without_integral_action():
    """G(0) = 3, Kc = 2: 1/7 after a set point, 3/7 after a load."""
    found = static_errors(Loop(Plant(3, 1, (20,)), IdealPid(2, math.inf)))
    assert (found.type, found.step, found.load_step) == pytest.approx((0, 1 / 7, 3 / 7))
    assert (found.ramp, found.load_ramp, found.IE_load, found.IE_setpoint) == (math.inf,) * 4


@pytest.mark.parametrize("b", [0.0, 0.6, 1.0])
@pytest.mark.parametrize("plant", [Plant(2, 1, (8, 1)), Plant(-0.3, 2, integrators=1)], ids=["lags", "integrating"])
def test_the_integral_of_the_error_is_that_of_the_response(b, plant):
    """int (r - y) of the simulated response by Simpson's rule between its samples."""
    controller = replace(tune("simc", plant, "PI"), b=b)
    loop = Loop(plant, controller)
    from_zero = static_errors(loop)
    t = np.linspace(0, 400 * plant.theta, 80_001)
    response = simulate_unit_steps(loop, t)
    width = t[1] - t[0]
    weights = np.ones(len(t))
    weights[1:-1:2], weights[2:-1:2] = 4, 2
    setpoint, load = (float(width / 3 * (weights @ each)) for each in response)
    assert from_zero.IE_setpoint == pytest.approx(setpoint, rel=1e-4, abs=1e-4 * plant.theta)
    assert from_zero.IE_load == pytest.approx(load, rel=1e-4)


def simulate_unit_steps(loop, t):
    r = simulate(loop, Scenario(disturbance=0.0, t=t))
    d = simulate(loop, Scenario(setpoint=0.0, disturbance_time=0.0, t=t))
    return 1 - r.y, d.y


@pytest.mark.parametrize("factor", [0.01, 60.0])
def test_measures_scale_with_time(factor):
    plant, controller = Plant(2, 1, (8, 3)), SeriesPid(1.2, 8, 3, 0.3)
    slow = Loop(Plant(2, factor, (8 * factor, 3 * factor)), SeriesPid(1.2, 8 * factor, 3 * factor, 0.3 * factor))
    one, other = step_quality(Loop(plant, controller)), step_quality(slow)
    for mine, its in ((one.setpoint, other.setpoint), (one.disturbance, other.disturbance)):
        assert pytest.approx(mine.ITSE * factor**2, rel=1e-7) == its.ITSE
        for name in ("settling_1", "settling_5", "first_arrival", "period"):
            assert getattr(its, name) == pytest.approx(getattr(mine, name) * factor, rel=1e-6, nan_ok=True)
        assert its.decay_ratio == pytest.approx(mine.decay_ratio, rel=1e-6, nan_ok=True)
        assert its.largest_u == pytest.approx(mine.largest_u, rel=1e-8)
    a, b = bandwidth(Loop(plant, controller)), bandwidth(slow)
    assert (b.omega_bS * factor, b.omega_bT * factor, b.max_KS) == pytest.approx(
        (a.omega_bS, a.omega_bT, a.max_KS), rel=1e-8
    )


def test_loops_that_are_not_stable_have_no_measures():
    loop = Loop(Plant(1, 1, (8,)), SeriesPid(20, 8))
    with pytest.raises(NotStable):
        step_quality(loop)
    assert math.isnan(bandwidth(loop).omega_bT)
