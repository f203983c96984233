"""Facts of a step test against responses that scipy computes, and the bounds of each fact."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal

from simc_core import Plant
from simc_core.errors import InvalidParameter
from simc_core.plants.step_facts import SettlingFacts, SlopeFacts

changes = st.floats(-100, 100).filter(lambda change: abs(change) > 0.1)
times = st.floats(0.1, 100)


@given(changes, changes, times, times)
def test_scipy_finds_63_per_cent_of_the_change_at_t63(dOP, dPV, theta, tau1):
    plant = SettlingFacts(dOP, dPV, theta, theta + tau1).plant
    since = np.linspace(0.0, theta + tau1 - plant.theta, 50)
    _, y = signal.step((plant.k, [plant.lags[0], 1.0]), T=since)
    assert dOP * y[-1] == pytest.approx((1 - math.exp(-1)) * dPV, rel=1e-9)


@given(changes, changes, times, times)
def test_counted_from_the_first_movement_it_is_the_same_plant(dOP, dPV, theta, tau1):
    moved = SettlingFacts(dOP, dPV, theta, tau1, from_movement=True).plant
    assert moved.lags == (tau1,)
    assert SettlingFacts(dOP, dPV, theta, theta + tau1).plant.lags == pytest.approx((tau1,), rel=1e-12)


@given(changes, changes, times, times)
def test_an_integrating_response_covers_the_change_in_its_time(dOP, dPV, theta, duration):
    plant = SlopeFacts(dOP, dPV, theta, duration).plant
    _, y = signal.step((plant.k, [1.0, 0.0]), T=np.linspace(0.0, duration, 50))
    assert (plant.integrators, plant.lags, plant.theta) == (1, (), theta)
    assert dOP * y[-1] == pytest.approx(dPV, rel=1e-9)


def test_op_from_40_to_45_and_pv_from_120_to_131_degrees_with_63_per_cent_after_3_minutes():
    """The example of a heater: 20 s of dead time, and 3 minutes counted in the one way and in the other."""
    assert SettlingFacts(5, 11, 20, 180).plant == Plant(2.2, 20, (160,))
    assert SettlingFacts(5, 11, 20, 180, from_movement=True).plant == Plant(2.2, 20, (180,))


def test_opposite_signs_are_a_negative_gain():
    assert SettlingFacts(-5, 11, 0, 8).plant.k == -2.2
    assert SlopeFacts(4, -0.1, 1).plant.k == -0.025


def test_a_response_at_its_end_after_the_dead_time_is_pure_dead_time():
    assert SettlingFacts(1, 3, 5, 5).plant == Plant(3, 5)


@given(changes, changes, times, times)
def test_another_time_unit_changes_times_and_not_the_gain(dOP, dPV, theta, tau1):
    minutes = SettlingFacts(dOP, dPV, theta, theta + tau1).rescaled(Fraction(1, 60)).plant
    assert minutes.k == dPV / dOP
    assert minutes.lags == pytest.approx((tau1 / 60,), rel=1e-11)
    level = SlopeFacts(dOP, dPV, theta, tau1)
    assert level.rescaled(Fraction(1, 60)).plant.k == pytest.approx(60 * level.plant.k, rel=1e-14)


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (lambda: SettlingFacts(0, 11, 20, 180), "dOP must not be zero, found 0"),
        (lambda: SettlingFacts(5, math.nan, 20, 180), "dPV must be finite, found nan"),
        (lambda: SettlingFacts(5, 11, -1, 180), "theta must be >= 0, found -1"),
        (lambda: SettlingFacts(5, 11, 20, 19), "t63 must be >= theta = 20 where it counts from the step, found 19"),
        (lambda: SettlingFacts(1e-9, 1e9, 0, 1), r"\|k\| must be between 1e-12 and 1e\+12, found 1e\+18"),
        (lambda: SlopeFacts(5, 11, 20, 0), "duration must not be zero, found 0"),
        (lambda: SlopeFacts(5, 11, 20, -3), "duration must be > 0, found -3"),
    ],
)
def test_a_fact_out_of_bounds_is_named_with_its_bound_and_value(make, why):
    with pytest.raises(InvalidParameter, match=why):
        make()
