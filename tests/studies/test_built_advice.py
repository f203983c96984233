"""Guards of the loop as built: steps out of reach, sampling the tuning does not know, windup in numbers."""

from dataclasses import replace

import numpy as np
import pytest

from simc_core import Actuation, Plant, Scenario, simulate
from simc_core.studies.built_advice import (
    error_integral,
    out_of_reach,
    protections_compared,
    sampling_not_in_tuning,
)
from simc_core.studies.tuned import tuned
from tests.oracles.random_plants import random_plants

SITE = Plant(2.2, 20, (180,))


def followed(scenario, item):
    """The scenario with the height that the advice names."""
    names = {"r": "setpoint", "d": "disturbance"}
    return replace(scenario, **{names[name]: value for name, value in item.change.items()})


def test_a_set_point_that_the_actuator_cannot_hold():
    """r = 1 needs u = 1/2.2 = 0.455; with 0.4 y creeps to 0.88."""
    scenario = Scenario(1.0, 0.0, actuation=Actuation(u_max=0.4))
    (found,) = out_of_reach(SITE, scenario)
    assert "r = 1 needs u = 0.455, the limit is 0.4: it is never reached" in found.text
    response = simulate(tuned(SITE).loop, scenario)
    assert response.y[-1] == pytest.approx(0.88, abs=1e-3)
    assert found.change["r"] == pytest.approx(0.88)
    assert out_of_reach(SITE, followed(scenario, found)) == ()
    assert out_of_reach(SITE, Scenario(1.0, 0.0, actuation=Actuation(u_max=0.5))) == ()


def test_limits_are_told_on_the_scale_of_the_user():
    """OP at 45 %, limits 0 and 46: 2.5 degrees need 1/2.2 * 2.5 = 1.14 % more."""
    (found,) = out_of_reach(SITE, Scenario(2.5, 0.0, actuation=Actuation(u_min=-45.0, u_max=1.0)), "OP", 45.0)
    assert found.text == "r = 2.5 needs OP = 46.1, the limit is 46: it is never reached."


def test_a_load_that_the_actuator_cannot_hold():
    """A tank: r needs no u at rest, a load of 1 needs u = -1."""
    tank = Plant(0.05, 2, integrators=1)
    scenario = Scenario(1.0, 1.0, actuation=Actuation(u_min=-0.5, u_max=0.5))
    (found,) = out_of_reach(tank, scenario)
    assert "u = -1 is needed, the limit is -0.5" in found.text
    assert out_of_reach(tank, followed(scenario, found)) == ()


@pytest.mark.parametrize("sign", [1, -1])
def test_what_is_said_to_be_out_of_reach_is(sign):
    """Random stable plants of both signs: y ends where u at its limit holds it, and the change is in reach."""
    rng = np.random.default_rng(5)
    for kind, plant in random_plants(60, seed=3):
        if plant.integrators or plant.unstable_poles or plant.lag_pairs:
            continue
        r, d = float(sign * rng.uniform(0.5, 2)), float(rng.uniform(-1, 1) / abs(plant.k))
        top = float(rng.uniform(0.2, 2) / abs(plant.k))
        scenario = Scenario(r, d, actuation=Actuation(u_min=-top, u_max=top))
        needed = (r / plant.k, r / plant.k - d)
        found = out_of_reach(plant, scenario)
        assert bool(found) == any(abs(u) > top for u in needed), kind
        for item in found:
            scenario = followed(scenario, item)
        assert out_of_reach(plant, scenario) == ()


def test_sampling_that_the_tuning_does_not_know():
    """A loop of tau 34 sampled every 1000, with nothing said about it."""
    plant = Plant(2, 5, (30, 8))
    design = tuned(plant)
    found = sampling_not_in_tuning(design, 1000.0)
    assert "500 of dead time is missing" in found.text
    assert "The loop bears" in found.text
    assert sampling_not_in_tuning(design.changed(**found.change), 1000.0) is None
    assert sampling_not_in_tuning(design, 0.5) is None
    assert sampling_not_in_tuning(design, 0.0) is None


def test_protections_are_compared_by_their_integrals():
    said = protections_compared({"both protected": 60.0, "inner only": 58.0, "no protection": 40.0})
    assert said == (
        "IAE over the time shown: both protected 60, inner only 58, no protection 40; best here: no protection."
    )
    assert "less than 1 %" in protections_compared({"with": 10.0, "without": 10.05})
    t = np.linspace(0, 40, 4001)
    assert error_integral(t, np.ones_like(t), 1 - np.exp(-t)) == pytest.approx(1, rel=1e-5)
