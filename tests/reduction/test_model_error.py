"""The model error against closed forms and against a dense search."""

import math

import numpy as np
import pytest

from simc_core import FirstOrderDelay, Plant, SeriesPid, simc
from simc_core.plants.step_response import plant_step
from simc_core.reduction.half_rule import half_rule
from simc_core.reduction.model_error import model_error


def test_a_perfect_model_has_no_error():
    plant = Plant(2.0, 1.0, (5.0,))
    model = FirstOrderDelay(2.0, 1.0, 5.0)
    compared = model_error(plant, model, simc(model))
    assert compared.step_difference == pytest.approx(0, abs=1e-12)
    assert compared.error == pytest.approx(0, abs=1e-12)
    assert compared.verdict == "good"


def test_a_wrong_gain_is_the_relative_error_at_every_frequency():
    model = FirstOrderDelay(2.0, 1.0, 5.0)
    compared = model_error(Plant(2.6, 1.0, (5.0,)), model, simc(model))
    assert compared.error == pytest.approx(np.full(compared.omega.shape, 0.3), rel=1e-12)
    assert compared.used == pytest.approx(0.3, rel=1e-3)  # |T| is at most 1 for this tight loop, at omega -> 0
    assert compared.step_fraction == pytest.approx(0.6 / 2.6, rel=1e-2)


def test_a_missing_delay_shows_its_closed_form():
    model = FirstOrderDelay(1.0, 1.0, 4.0)
    compared = model_error(Plant(1.0, 3.0, (4.0,)), model, simc(model))
    assert compared.error == pytest.approx(2 * np.abs(np.sin(compared.omega)), abs=1e-9)  # |e^{-2jw} - 1|
    assert compared.step_difference == pytest.approx(1 - math.exp(-2 / 4), rel=1e-9)
    assert compared.step_time == pytest.approx(3.0, rel=1e-9)


@pytest.mark.parametrize("order", [1, 2])
def test_the_largest_step_difference_is_that_of_a_fine_search(order):
    plant = Plant(1.0, 3.0, (6.0, 4.0, 2.0))
    model = half_rule(plant, order).model
    compared = model_error(plant, model, simc(model))
    near = [compared.step_time * (1 + shift) for shift in np.linspace(-0.02, 0.02, 41)]
    best = max(abs(plant_step(plant, t).y[-1] - plant_step(model.plant, t).y[-1]) for t in near)
    assert compared.step_difference == pytest.approx(best, rel=2e-5)


def test_without_a_stable_loop_round_the_model_there_is_no_bound():
    model = FirstOrderDelay(1.0, 1.0, 5.0)
    compared = model_error(Plant(1.0, 1.0, (5.0,)), model, SeriesPid(100.0, 5.0))
    assert compared.verdict == "not certain"
    assert np.isnan(compared.bound).all()
