"""Controllers: the forms against their formulas and the published conversions, and the door."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import (
    FormError,
    IController,
    IdealPid,
    InvalidParameter,
    Loop,
    ParallelPid,
    Plant,
    SeriesPid,
    frequency_response,
)
from tests.oracles.published import controller_of, select

S = np.array([0.3 + 0.7j, 1j, 2.0])
TIMES = st.floats(0.01, 100)
GAINS = st.floats(0.01, 100) | st.floats(-100, -0.01)


@pytest.mark.parametrize("row", select("SG12-E2-ideal", "S002-conv"))
def test_published_conversions(row):
    ideal = controller_of(row.inputs).to_ideal()
    for i, value in enumerate((ideal.Kc, ideal.tau_I, ideal.tau_D)):
        assert value == row.approx(i)


@pytest.mark.parametrize(
    ("controller", "value"),
    [
        (SeriesPid(2, 6, 5, 0.1), 2 * (6 * S + 1) / (6 * S) * (5 * S + 1) / (0.1 * S + 1)),
        (SeriesPid(2, math.inf, 5), 2 * (5 * S + 1)),
        (IdealPid(2, 6, 5, 0.1), 2 * (1 + 1 / (6 * S) + 5 * S) / (0.1 * S + 1)),
        (IdealPid(2, 60, 5, 0.1), 2 * (1 + 1 / (60 * S) + 5 * S) / (0.1 * S + 1)),
        (IdealPid(2, math.inf, 5), 2 * (1 + 5 * S)),
        (ParallelPid(2, 3, 4, 0.1), (2 + 3 / S + 4 * S) / (0.1 * S + 1)),
        (ParallelPid(0, 3, -4), 3 / S - 4 * S),
        (ParallelPid(2, 0, 0), 2 + 0 * S),
        (ParallelPid(0, 0, 4, 0.1), 4 * S / (0.1 * S + 1)),
        (IController(0.5), 0.5 / S),
    ],
)
def test_response_is_the_formula(controller, value):
    assert controller.response(S) == pytest.approx(value, rel=1e-12)


@given(GAINS, TIMES, TIMES, st.just(0.0) | TIMES, st.floats(0, 2), st.floats(0, 2))
def test_all_forms_of_a_series_controller_are_one_controller(Kc, tau_I, tau_D, tau_F, b, c):
    series = SeriesPid(Kc, tau_I, tau_D, tau_F, b, c)
    ideal, parallel = series.to_ideal(), series.to_parallel()
    for form in (ideal, parallel, parallel.to_ideal()):
        assert form.response(S) == pytest.approx(series.response(S), rel=1e-9)
        assert form.setpoint_response(S) == pytest.approx(series.setpoint_response(S), rel=1e-9)
    # back: of the two real factors the larger time constant becomes tau_I
    again = ideal.to_series()
    assert (again.tau_I, again.tau_D) == pytest.approx((max(tau_I, tau_D), min(tau_I, tau_D)), rel=1e-5)
    assert again.response(S) == pytest.approx(series.response(S), rel=1e-9)


@given(GAINS, TIMES, TIMES, st.floats(0, 2), st.floats(0, 2))
def test_setpoint_weights_are_those_of_the_parallel_form(Kc, tau_I, tau_D, b, c):
    form = IdealPid(Kc, tau_I, tau_D, 0.1, b, c).to_parallel()
    expected = (b * form.Kp + form.Ki / S + c * form.Kd * S) / (0.1 * S + 1)
    assert form.setpoint_response(S) == pytest.approx(expected, rel=1e-9)


def test_without_derivative_and_with_b_one_both_paths_are_equal():
    for controller in (SeriesPid(2, 6), IdealPid(2, 6), ParallelPid(2, 3), IController(0.5)):
        assert controller.setpoint_response(S) == pytest.approx(controller.response(S), rel=1e-12)


@pytest.mark.parametrize(
    ("convert", "words"),
    [
        (lambda: IdealPid(1, 3.9, 1).to_series(), "tau_I >= 4 tau_D = 4, found tau_I = 3.9"),
        (lambda: ParallelPid(0, 1).to_ideal(), "Kp != 0, found Kp = 0"),
        (lambda: ParallelPid(1, -1).to_ideal(), "one sign"),
        (lambda: ParallelPid(1, 1, 1).to_series(), "tau_I >= 4 tau_D"),
        (lambda: IController(1).to_ideal(), "no ideal form.*found K_I = 1"),
        (lambda: IController(1).to_series(), "no series form"),
    ],
)
def test_forms_that_do_not_exist(convert, words):
    with pytest.raises(FormError, match=words):
        convert()


def test_double_zero_converts():
    """tau_I' = 4 tau_D' is the last one with real zeros: two equal ones."""
    series = IdealPid(2, 4, 1).to_series()
    assert (series.Kc, series.tau_I, series.tau_D) == pytest.approx((1, 2, 2))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: SeriesPid(0, 1), "Kc must not be zero"),
        (lambda: SeriesPid(math.inf, 1), "Kc must be finite"),
        (lambda: SeriesPid(1, 0), "tau_I must not be zero"),
        (lambda: SeriesPid(1, -1), "tau_I must be > 0, found -1"),
        (lambda: IdealPid(1, math.nan), "tau_I must be finite"),
        (lambda: IdealPid(1, 1, -1), "tau_D must be >= 0, found -1"),
        (lambda: IdealPid(1, 1, 1, -1), "tau_F must be >= 0, found -1"),
        (lambda: SeriesPid(1, 1, b=3), "b must be <= 2, found 3"),
        (lambda: SeriesPid(1, 1, c=-1), "c must be >= 0, found -1"),
        (lambda: ParallelPid(0, 0, 0), "must not be zero"),
        (lambda: ParallelPid(1e300, 0), "Kp must be <= 1e\\+15"),
        (lambda: IController(0), "K_I must not be zero"),
    ],
)
def test_the_door(make, words):
    with pytest.raises(InvalidParameter, match=words):
        make()


def test_frequency_response_is_the_block_diagram():
    """S = 1/(1+L), T = L S, KS = C S, GS = G S, written out for e^{-s}/(2 s + 1) under PI."""
    omega = np.array([0.1, 1.0, 5.0])
    s = 1j * omega
    G, C = np.exp(-s) / (2 * s + 1), 0.9 * (1 + 1 / (3 * s))
    found = frequency_response(Loop(Plant(1, 1, (2,)), SeriesPid(0.9, 3)), omega)
    for value, expected in zip(
        (found.L, found.S, found.T, found.KS, found.GS),
        (G * C, 1 / (1 + G * C), G * C / (1 + G * C), C / (1 + G * C), G / (1 + G * C)),
        strict=True,
    ):
        assert value == pytest.approx(expected, rel=1e-12)


POSITIVE, ROW = "omega must be positive", "omega must be a list of 1 to"


@pytest.mark.parametrize(
    ("omega", "says"), [([0.0], POSITIVE), ([-1.0], POSITIVE), ([math.nan], POSITIVE), ([[1.0, 2.0]], ROW)]
)
def test_frequencies_must_be_a_list_of_positive_numbers(omega, says):
    with pytest.raises(InvalidParameter, match=says):
        frequency_response(Loop(Plant(1, 1), IController(0.5)), omega)


@pytest.mark.parametrize("controller", [SeriesPid(2, 8, 3), IdealPid(2, 8, 3), ParallelPid(2, 0.25, 6)])
def test_a_filter_is_a_part_of_the_derivative_time_and_a_weight_changes_nothing_else(controller):
    found = controller.with_filter(0.1).with_weight(0.6)
    assert found.tau_F == pytest.approx(0.3)
    assert found.b == 0.6
    assert found.settings == controller.settings
    s = 0.4j
    assert found.response(s) == pytest.approx(controller.response(s) / (0.3 * s + 1))
    form = controller.to_parallel()
    assert found.setpoint_response(s) == pytest.approx((0.6 * form.Kp + form.Ki / s) / (0.3 * s + 1))


def test_pure_integral_action_has_neither_filter_nor_weight():
    assert IController(0.5).with_filter(0.1).with_weight(0.5) == IController(0.5)
    assert ParallelPid(0, 0.5).with_filter(0.1).tau_F == 0


def test_a_derivative_without_proportional_action_has_no_derivative_time():
    with pytest.raises(FormError, match="Kp != 0"):
        ParallelPid(0, 0.5, 1.0).with_filter(0.1)
