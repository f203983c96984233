"""Each guard speaks where it should and is silent where it should be."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import (
    FirstOrderDelay,
    IController,
    IdealPid,
    IntegratingDelay,
    OscillatingDelay,
    ParallelPid,
    Plant,
    SecondOrderDelay,
    SeriesPid,
    UnstableDelay,
    half_rule,
    simc,
)
from simc_core.studies.advice import advice, deceptive_PM, derivative_noise, large_Ms, order_two, slow_oscillation


def quantities(*arguments, **named):
    return [item.quantity for item in advice(*arguments, **named)]


def test_a_good_loop_is_left_in_peace():
    model = FirstOrderDelay(1, 1, 8)
    assert advice(model, simc(model), 1.59, 61.4, 1.0) == ()


def test_peaks():
    assert large_Ms(2.01).quantity == "Ms = 2.01"
    assert large_Ms(2.0) is None
    assert large_Ms(math.nan) is None
    assert deceptive_PM(60, 2.5).quantity == "PM = 60 deg with Ms = 2.5"
    assert deceptive_PM(30, 2.5) is None
    assert deceptive_PM(60, 1.5) is None


@given(st.floats(0.01, 100), st.floats(0.01, 100), st.floats(0.01, 100), st.floats(0.01, 100))
def test_the_rule_itself_never_oscillates_slowly(k, theta, tau1, tau_c):
    """tau_I = 4 (tau_c + theta) gives Kc k' tau_I = 4, the limit."""
    for model in (FirstOrderDelay(k, theta, tau1), IntegratingDelay(k, theta)):
        assert slow_oscillation(model, simc(model, tau_c)) is None


def test_slow_oscillation():
    """[SG12]: Kc tau_I >= 4/k'."""
    model = IntegratingDelay(0.5, 1)
    found = slow_oscillation(model, SeriesPid(0.5, 8))
    assert found.quantity == "Kc k' tau_I = 2"
    assert "Kc tau_I >= 8" in found.remedy
    assert slow_oscillation(model, SeriesPid(1.0, 8)) is None
    assert slow_oscillation(model, SeriesPid(0.1, math.inf)) is None
    assert slow_oscillation(model, IController(1)) is None
    assert slow_oscillation(FirstOrderDelay(1, 1, 2), SeriesPid(0.1, 2)) is None  # cancels the lag: no oscillation
    assert slow_oscillation(OscillatingDelay(1, 1, 2, 0.1), SeriesPid(0.1, 2)) is None


def test_derivative_noise():
    assert derivative_noise(SeriesPid(1, 8)) is None
    assert derivative_noise(SeriesPid(1, 8, 2)).level == "warning"
    assert derivative_noise(IdealPid(2, 8, 1, 0.1)).quantity == "noise gain Kd/tau_F = 20"
    assert "10 times Kp" in derivative_noise(IdealPid(2, 8, 1, 0.1)).text
    assert derivative_noise(ParallelPid(0, 1, 1)).remedy == "Set tau_F."


def test_models_at_the_edge_of_a_rule():
    model = UnstableDelay(1, 1, 0.4)
    assert "a theta = 0.4" in quantities(model, simc(model), 4.62, 20)
    model = OscillatingDelay(1, 1, 5, 0.3)
    assert "zeta = 0.3" in quantities(model, simc(model), 1.59, 61)
    model = FirstOrderDelay(1, 1, 8)
    assert "tau_c = 0.5" in quantities(model, simc(model, 0.5), 1.9, 50, 0.5)


@pytest.mark.parametrize(
    ("plant", "order", "quantity"),
    [
        (Plant(1, 3, (6, 4, 2)), 1, "PI"),
        (Plant(1, 3, (6, 4, 2)), 2, None),
        (Plant(1, 1, (5, 0.5)), 2, "PID"),
        (Plant(1, 1, (5, 0.5)), 1, None),
        (Plant(1, 1, (5, 0.5), integrators=1), 1, "PI"),
        (Plant(1, 1, integrators=2), 2, None),
    ],
)
def test_whether_order_two_pays(plant, order, quantity):
    reduction = half_rule(plant, order)
    found = order_two(reduction.model, reduction)
    assert (found and found.quantity) == quantity


def test_warnings_come_first():
    model = SecondOrderDelay(1, 1, 8, 0.5)
    levels = [item.level for item in advice(model, simc(model), 2.5, 60, 0.5, half_rule(model.plant, 2))]
    assert levels == sorted(levels, reverse=True)
    assert set(levels) == {"warning", "note"}
