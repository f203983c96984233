"""Plants: the transfer function against complex arithmetic, polynomials taken apart, and the door."""

import cmath
import math

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    InvalidParameter,
    OscillatingDelay,
    Plant,
    SecondOrderDelay,
    UnstableDelay,
)

S = np.array([0.3 + 0.7j, 1j, 2.0, -0.05 + 3j])
TIMES = st.floats(0.1, 10)


def test_response_by_hand():
    """Every kind of factor once, written out."""
    plant = Plant(2, 0.5, (3, -20), (-2, 0.1), 1, ((1.5, 0.3),), ((0.7, -0.2),))
    value = 2 * np.exp(-0.5 * S) * (-2 * S + 1) * (0.1 * S + 1) * (0.49 * S**2 - 0.28 * S + 1)
    value = value / (S * (3 * S + 1) * (-20 * S + 1) * (2.25 * S**2 + 0.9 * S + 1))
    assert plant.response(S) == pytest.approx(value, rel=1e-13)
    assert plant.response(S.reshape(2, 2)).shape == (2, 2)
    assert plant.response(0.3 + 0.7j) == pytest.approx(value[0])


def test_dead_time_is_exact():
    """|e^{-theta j omega}| = 1 and its phase is -theta omega, at any frequency."""
    omega = np.array([1e-3, 1.0, 1e3])
    assert Plant(1, 3).response(1j * omega) == pytest.approx(np.exp(-3j * omega), rel=1e-12)


@given(
    st.lists(TIMES, min_size=1, max_size=4, unique_by=lambda tau: round(math.log(tau) * 4)),
    st.lists(TIMES, max_size=1),
    st.floats(0.1, 0.9),
)
def test_polynomials_multiplied_out_and_taken_apart(lags, leads, zeta):
    plant = Plant(2, 1, lags, leads, 1, ((3.3, zeta),))
    num, den = np.array([2.0]), np.array([1.0, 0.0])
    for T in leads:
        num = np.polymul(num, [T, 1])
    for tau in lags:
        den = np.polymul(den, [tau, 1])
    again = Plant.from_polynomials(num, np.polymul(den, [3.3**2, 2 * zeta * 3.3, 1]), 1)
    assert sorted(again.lags) == pytest.approx(sorted(lags), rel=1e-6)
    assert again.response(S) == pytest.approx(plant.response(S), rel=1e-9)


@pytest.mark.parametrize(
    ("num", "den", "plant"),
    [
        ([1], [100, 20, 1], Plant(1, 0, (10, 10))),
        ([1], np.poly([-0.5] * 4) / 0.5**4, Plant(1, 0, (2, 2, 2, 2))),
        ([2, 4], [1, 3, 2, 0], Plant(2, 0, (0.5, 1), (0.5,), 1)),
        ([0, 0, 3], [0, 2, 6], Plant(0.5, 0, (1 / 3,))),
        ([1, 0], [1, 1, 0], Plant(1, 0, (1,))),
    ],
)
def test_polynomials_with_multiple_roots_zeros_at_the_origin_and_leading_zeros(num, den, plant):
    again = Plant.from_polynomials(num, den)
    assert again.k == pytest.approx(plant.k, rel=1e-9)
    assert sorted(again.lags) == pytest.approx(sorted(plant.lags), rel=1e-9)
    assert (again.leads, again.integrators) == (pytest.approx(plant.leads), plant.integrators)


def test_poles_and_zeros_against_python_control():
    plant = Plant(2, 0, (3, -20), (-2,), 1, ((1.5, 0.3),))
    num = 2 * np.array([-2.0, 1.0])
    den = np.polymul(np.polymul([3, 1, 0], [-20, 1]), [2.25, 0.9, 1])
    peer = control.tf(num, den)
    assert np.sort_complex(plant.poles) == pytest.approx(np.sort_complex(peer.poles()), abs=1e-9)
    assert plant.zeros == pytest.approx(peer.zeros())
    assert (plant.order, plant.unstable_poles) == (5, 1)


@pytest.mark.parametrize(
    ("plant", "kind"),
    [
        (Plant(1, 1, (8,)), "stable, lag dominant"),
        (Plant(1, 1, (2,)), "stable, lag and dead time alike"),
        (Plant(1, 1, (0.2,)), "stable, dead time dominant"),
        (Plant(1, 0, (2,)), "stable, no dead time"),
        (Plant(1, 1), "pure dead time"),
        (Plant(1), "pure gain"),
        (Plant(1, 1, integrators=1), "integrating"),
        (Plant(1, 1, (-2,)), "unstable"),
        (Plant(1, 1, (2,), (-1,), lag_pairs=((1, 0.1),)), "oscillating, inverse response"),
    ],
)
def test_kind_in_words(plant, kind):
    assert plant.kind == kind


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"k": 0}, "k must not be zero, found 0"),
        ({"k": math.nan}, "k must be finite"),
        ({"k": 1e300}, "between 1e-12 and 1e\\+12, found 1e\\+300"),
        ({"k": "1"}, "k must be a number"),
        ({"k": 1 + 1j}, "k must be a number"),
        ({"k": 1, "theta": -1}, "theta must be >= 0, found -1"),
        ({"k": 1, "theta": math.inf}, "theta must be finite"),
        ({"k": 1, "theta": 1e-12}, "theta must be 0 or >="),
        ({"k": 1, "lags": (1, 0)}, r"lags\[1\] must not be zero"),
        ({"k": 1, "lags": (1e300,)}, r"\|lags\[0\]\| must be between"),
        ({"k": 1, "lags": [1] * 200}, "lags may have at most 40 entries, found 200"),
        ({"k": 1, "lags": 3}, "lags must be a list"),
        ({"k": 1, "lags": "33"}, "lags must be a list"),
        ({"k": 1, "lags": [1] * 39, "integrators": 2}, "at most 40 poles, found 41"),
        ({"k": 1, "leads": (1,)}, "numerator must be <= 0.*found 1"),
        ({"k": 1, "lags": (1,), "lead_pairs": ((1, 0.5),)}, "numerator must be <= 1.*found 2"),
        ({"k": 1, "integrators": 5}, "integrators must be <= 4, found 5"),
        ({"k": 1, "integrators": 0.5}, "integrators must be a whole number"),
        ({"k": 1, "lag_pairs": ((-1, 0.5),)}, r"lag_pairs\[0\] tau must be > 0, found -1"),
        ({"k": 1, "lag_pairs": ((1,),)}, r"lag_pairs\[0\] must be \(tau, zeta\), found 1 number"),
    ],
)
def test_the_door(arguments, words):
    with pytest.raises(InvalidParameter, match=words):
        Plant(**arguments)


@pytest.mark.parametrize(
    ("num", "den", "words"),
    [
        ([], [1], "numerator must not be zero or empty"),
        ([1], [0, 0], "denominator must not be zero or empty"),
        ([1, 0], [1, 1], "must not vanish at s = 0"),
        ([1, 1, 1], [1, 1], "degree of the numerator"),
        ([1], [1] * 60, "at most 41 entries, found 60"),
        ([1], [1, math.nan], "must be finite"),
        ([1], [1e300, 1, 1, 1e-300], "comparable size|must be between"),
    ],
)
def test_polynomials_out_of_bounds(num, den, words):
    with pytest.raises(InvalidParameter, match=words):
        Plant.from_polynomials(num, den)


@pytest.mark.parametrize(
    ("model", "value"),
    [
        (FirstOrderDelay(2, 1, 3), lambda s: 2 / (3 * s + 1)),
        (FirstOrderDelay(2, 1, 0), lambda s: 2),
        (SecondOrderDelay(2, 1, 3, 2), lambda s: 2 / ((3 * s + 1) * (2 * s + 1))),
        (IntegratingDelay(2, 1, 3), lambda s: 2 / (s * (3 * s + 1))),
        (DoubleIntegratingDelay(2, 1), lambda s: 2 / s**2),
        (UnstableDelay(2, 1, 0.1, 3), lambda s: 2 / ((s - 0.1) * (3 * s + 1))),
        (OscillatingDelay(2, 1, 3, 0.2), lambda s: 2 / (9 * s**2 + 1.2 * s + 1)),
    ],
)
def test_models_are_the_plants_of_their_docstrings(model, value):
    s = 0.2 + 0.5j
    assert model.plant.response(s) == pytest.approx(value(s) * cmath.exp(-s), rel=1e-12)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: FirstOrderDelay(0, 1, 1), "k must not be zero"),
        (lambda: FirstOrderDelay(1, -1, 1), "theta must be >= 0, found -1"),
        (lambda: SecondOrderDelay(1, 1, 1, 2), "tau2 must be <= tau1 = 1, found 2"),
        (lambda: UnstableDelay(1, 1, 0), "a must not be zero"),
        (lambda: OscillatingDelay(1, 1, 1, -0.1), "zeta must be >= 0, found -0.1"),
    ],
)
def test_models_out_of_bounds(make, words):
    with pytest.raises(InvalidParameter, match=words):
        make()


def test_times_of_a_plant():
    plant = Plant(1, 2, (5, -7), (30,), 1, lag_pairs=((6, 0.3), (4, 2.0)))
    assert plant.total_time == 2 + 5 + 7 + 6 + 4
    assert plant.slowest == 7
    assert Plant(3, integrators=1).total_time == Plant(3, 1).slowest == 0
