"""A march holds a bounded number of elements, whatever the plant and however many tunings there are."""

import numpy as np
import pytest

from simc_core import (
    InvalidParameter,
    Loop,
    NotStable,
    Scenario,
    half_rule,
    parse_plant,
    performance,
    simc,
    simulate,
    sweep,
)
from simc_core.simulation.one_delay import march as marching
from simc_core.simulation.one_delay.limits import MOST_HELD, MOST_TO_REST
from simc_core.simulation.one_delay.march import march

STIFF = "(10s+1)exp(-100s)/((0.001s+1)(20s+1))"
STIFFER = "(10s+1)exp(-1000s)/((0.001s+1)(20s+1))"
RINGING = "exp(-s)/(1e4s^2+1e-4s+1)"
USUAL = "exp(-s)/((10s+1)(2s+1))"


def tunings(text: str, count: int):
    """Plant, and SIMC settings from far too fast to slow."""
    plant = parse_plant(text)
    model = half_rule(plant, 2).model
    unit = model.theta
    return plant, [simc(model, unit * ratio).to_parallel() for ratio in np.geomspace(0.1, 100, count)]


@pytest.mark.parametrize("text", [STIFF, STIFFER, RINGING, USUAL, "exp(-0.001s)/((10s+1)(2s+1))"])
def test_elements_of_all_tunings_together_are_bounded(text):
    plant, forms = tunings(text, 300)
    found = march(plant, forms, 30.0 * plant.theta)
    assert 1 <= len(found.at_rest) <= 300
    assert len(found.owner) <= MOST_HELD


@pytest.mark.parametrize("most", [20, 50, 100])
@pytest.mark.parametrize("text", [STIFF, USUAL])
def test_a_march_that_leaves_tunings_to_the_next_one_computes_the_same(monkeypatch, text, most):
    plant, forms = tunings(text, 12)
    t = np.linspace(0.0, 60 * plant.theta, 200)
    alone = np.concatenate([march(plant, [form], t[-1])(t) for form in forms])
    monkeypatch.setattr(marching, "MOST_HELD", most)
    parts, left = [], forms
    while left:
        found = march(plant, left, t[-1])
        parts.append(found(t))
        left = left[len(found.at_rest) :]
    assert len(parts) > 1
    size = np.abs(alone).max(axis=3, keepdims=True)
    assert np.all(np.abs(np.concatenate(parts) - alone) <= 1e-10 * size)


def test_an_oscillation_that_outlasts_the_bound_is_given_up_long_before_it():
    plant, forms = tunings(RINGING, 5)
    found = march(plant, forms[-1:], None)
    assert not found.at_rest[0]
    assert len(found.owner) < MOST_TO_REST / 10
    with pytest.raises(InvalidParameter, match="the loop oscillates too fast for it"):
        simulate(Loop(plant, forms[-1]), Scenario(t_end=1e8))
    with pytest.raises(NotStable, match="too close to its stability limit"):
        performance(Loop(plant, forms[-1]))


def test_a_horizon_in_which_a_light_oscillation_fits_is_simulated():
    plant, forms = tunings(RINGING, 5)
    assert np.isfinite(simulate(Loop(plant, forms[-1]), Scenario(t_end=1e5)).y).all()


def test_fast_modes_of_a_long_dead_time_are_refused_before_the_work():
    plant = parse_plant("(s^2+1)exp(-6000s)/(s^2+1e-3s+1)")
    with pytest.raises(InvalidParameter, match="the first 21 dead times must need at most 12000 elements"):
        march(plant, [simc(half_rule(parse_plant(USUAL), 1).model).to_parallel()], None)


def test_a_sweep_of_too_many_numbers_is_refused_in_words():
    plant = parse_plant(USUAL)
    model = half_rule(plant, 1).model
    with pytest.raises(InvalidParameter, match=r"4 len.t. [+] 2 len.omega.. must be <= 20000000"):
        sweep(plant, model, np.geomspace(1, 2, 1000), np.linspace(0, 10, 10_000), [1.0])
