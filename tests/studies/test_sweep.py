"""Many tau_c at once against each of them alone, and what a batch must not do: leak between tunings, or take memory."""

import math
import tracemalloc

import numpy as np
import pytest
from scipy.special import lambertw

from simc_core import (
    InvalidParameter,
    Loop,
    NotStable,
    Plant,
    Scenario,
    frequency_response,
    half_rule,
    margins,
    performance,
    simulate,
    stability,
    sweep,
    tune,
)
from simc_core.plants.models import DoubleIntegratingDelay, FirstOrderDelay, IntegratingDelay
from simc_core.studies.sweep import MARGINS

OMEGA = np.geomspace(0.01, 10, 50)
CASES = {
    "PI, lags": (Plant(1, 3, (6, 4, 2)), 1, 0.0),
    "PID, filter": (Plant(2, 1, (8, 3)), 2, 0.05),
    "PID without filter": (Plant(2, 1, (8, 3)), 2, 0.0),
    "delay dominant": (Plant(1, 1, (0.02,)), 1, 0.0),
    "pure dead time": (Plant(3, 2), 1, 0.0),
    "integrating": (Plant(0.2, 1, (3,), integrators=1), 2, 0.1),
    "double integrating": (Plant(1, 1, integrators=2), 1, 0.1),
    "oscillating": (Plant(1, 1, lag_pairs=((2, 0.1),)), 1, 0.1),
    "inverse response, unstable when fast": (Plant(1, 0.3, (5, 2), (-3,)), 1, 0.0),
    "no dead time": (Plant(1, 0, (8, 2, 0.1)), 2, 0.1),
}


@pytest.mark.parametrize("name", CASES)
def test_a_row_is_the_tuning_alone(name):
    plant, order, ratio = CASES[name]
    model = half_rule(plant, order).model
    tau_c = np.geomspace(0.1, 30, 7) * (model.theta or 0.5)
    t = np.sort(np.concatenate([np.linspace(0, 40, 41), [plant.theta, 7 + plant.theta]]))
    found = sweep(plant, model, tau_c, t, OMEGA, b=0.8, filter_ratio=ratio, disturbance_time=7.0)
    for i, controller in enumerate(found.controllers):
        loop = Loop(plant, controller)
        r = simulate(loop, Scenario(disturbance=0.0, t=t))
        d = simulate(loop, Scenario(setpoint=0.0, disturbance_time=7.0, t=t))
        for got, single in (
            (found.y_setpoint, r.y),
            (found.u_setpoint, r.u),
            (found.y_disturbance, d.y),
            (found.u_disturbance, d.u),
        ):
            assert got[i] == pytest.approx(single, rel=1e-7, abs=1e-7)
        assert found.L[i] == pytest.approx(frequency_response(loop, OMEGA).L, rel=1e-12)
        assert found.stable[i] == (stability(loop).verdict == "stable")
        judged = margins(loop)
        for each in MARGINS:
            assert getattr(found, each)[i] == pytest.approx(getattr(judged, each), rel=1e-7, nan_ok=True)
        if found.stable[i]:
            alone = performance(loop)
            for got, single in (
                (found.IAE_setpoint, alone.setpoint.IAE),
                (found.IAE_disturbance, alone.disturbance.IAE),
                (found.TV_setpoint, alone.setpoint.TV),
                (found.TV_disturbance, alone.disturbance.TV),
                (found.overshoot, alone.setpoint.overshoot),
            ):
                assert got[i] == pytest.approx(single, rel=1e-7, abs=1e-9)


def test_nothing_is_said_of_a_tuning_that_is_not_stable():
    found = sweep(Plant(1, 1, (5,)), FirstOrderDelay(1, 0.2, 5), [0.1, 2.0], [0.0, 50.0], OMEGA)
    assert found.stable.tolist() == [False, True]
    for name in (*MARGINS, "IAE_setpoint", "IAE_disturbance", "TV_setpoint", "TV_disturbance", "overshoot"):
        assert math.isnan(getattr(found, name)[0])
        assert not math.isnan(getattr(found, name)[1])
    with pytest.raises(NotStable):
        performance(Loop(Plant(1, 1, (5,)), found.controllers[0]))


def test_a_tuning_does_not_know_what_it_is_swept_with():
    plant, model = Plant(1, 1, (6, 0.5)), FirstOrderDelay(1, 1.25, 6.25)
    t, all_of_them = np.linspace(0, 60, 30), np.geomspace(0.2, 80, 40)
    whole = sweep(plant, model, all_of_them, t, OMEGA)
    part = sweep(plant, model, all_of_them[[31, 4, 17]], t, OMEGA)
    for name in ("y_setpoint", "u_disturbance", "Ms", "delay_margin", "IAE_setpoint", "TV_disturbance"):
        assert getattr(part, name) == pytest.approx(getattr(whole, name)[[31, 4, 17]], rel=1e-10, abs=1e-10)


def test_IAE_of_load_steps_is_tau_I_over_Kc_where_they_keep_their_sign():
    """[SK03 sect. 6], for all tau_c of a PI on an integrating process at once; 4 (tau_c + theta) k' (tau_c + theta)."""
    k, theta, tau_c = 0.5, 2.0, np.geomspace(1.5, 100, 50)
    found = sweep(Plant(k, theta, integrators=1), IntegratingDelay(k, theta), tau_c, [0.0, 1.0], OMEGA)
    assert found.IAE_disturbance == pytest.approx(4 * k * (tau_c + theta) ** 2, rel=1e-8)


def test_margins_of_a_first_order_model_are_those_of_the_book():
    """L = e^{-theta s}/((tau_c + theta) s): GM = (pi/2)(tau_c/theta + 1), PM = 90 - 57.2958/(tau_c/theta + 1)."""
    tau_c = np.geomspace(0.3, 1.0, 9)
    found = sweep(Plant(2, 1, (5,)), FirstOrderDelay(2, 1, 5), tau_c, [0.0, 1.0], OMEGA)
    assert pytest.approx(math.pi / 2 * (tau_c + 1), rel=1e-10) == found.GM
    assert found.PM_deg == pytest.approx(90 - math.degrees(1) / (tau_c + 1), rel=1e-10)


def test_a_thousand_tunings_fit_into_a_gigabyte():
    plant = Plant(1, 1, (8, 3, 0.5))
    model = half_rule(plant, 2).model
    tracemalloc.start()
    found = sweep(plant, model, np.geomspace(0.3, 100, 1000), np.linspace(0, 60, 300), np.geomspace(0.01, 10, 300))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert found.y_setpoint.shape == (1000, 300)
    assert peak < 1e9


@pytest.mark.parametrize("tau_c", [[0.0], [-1.0], [math.nan], [], [[1.0]]])
def test_bounds_of_tau_c(tau_c):
    with pytest.raises(InvalidParameter, match="tau_c"):
        sweep(Plant(1, 1, (5,)), FirstOrderDelay(1, 1, 5), tau_c, [0.0, 1.0], OMEGA)


def test_bounds_of_grids():
    for t, omega in (([1.0, 0.0], [1.0]), ([0.0, 1.0], [0.0, 1.0])):
        with pytest.raises(InvalidParameter):
            sweep(Plant(1, 1, integrators=2), DoubleIntegratingDelay(1, 1), [1.0], t, omega)


def test_a_loop_that_hardly_comes_to_rest_is_followed_to_the_last_instant():
    """K e^{-s}/s near K = pi/2: y = 1 - 2 Re e^{s t}/(1 + s) late on, with s e^s = -K (Lambert W)."""
    K, t = math.pi / 2 * (1 - 1e-5), np.array([0.0, 20_000.25, 28_000.5, 30_001.0])
    s = complex(lambertw(-K))
    found = sweep(Plant(2 * K, 1.0), FirstOrderDelay(1, 1, 0), [1.0], t, [1.0])
    assert found.stable[0]
    expected = 1 - 2 * (np.exp(s * t[1:]) / (1 + s)).real
    assert found.y_setpoint[0, 1:] == pytest.approx(expected, abs=1e-8)


def test_ramps_of_many_tunings_are_those_of_each_alone():
    plant = Plant(0.05, 2.0, integrators=1)
    model, t = half_rule(plant, 1).model, np.linspace(0.0, 80.0, 81)
    found = sweep(plant, model, [2.0, 5.0], t, [1.0], disturbance_time=30.0, ramps=(12.0, 7.0))
    for i, controller in enumerate(found.controllers):
        asked = Scenario(1.0, 1.0, 30.0, setpoint_ramp=12.0, disturbance_ramp=7.0, t=t)
        alone = simulate(Loop(plant, controller), asked)
        together = found.y_setpoint[i] + found.y_disturbance[i], found.u_setpoint[i] + found.u_disturbance[i]
        np.testing.assert_allclose(together, (alone.y, alone.u), rtol=0, atol=1e-9)


@pytest.mark.parametrize("rule", ["improved_simc", "isimc"])
def test_a_row_of_a_later_form_is_that_tuning_alone(rule):
    plant, tau_c = Plant(2, 1, (8, 3)), np.array([0.7, 2.0])
    model = half_rule(plant).model
    found = sweep(plant, model, tau_c, [0.0, 9.0, 40.0], OMEGA, filter_ratio=0.1, rule=rule)
    for i, each in enumerate(tau_c.tolist()):
        kind = "PID" if rule == "isimc" else "PI"
        loop = Loop(plant, tune(rule, model, kind, tau_c=each).with_filter(0.1))
        assert found.controllers[i] == loop.controller
        assert found.Ms[i] == pytest.approx(margins(loop).Ms, rel=1e-9)
        assert found.IAE_disturbance[i] == pytest.approx(performance(loop).disturbance.IAE, rel=1e-7)
