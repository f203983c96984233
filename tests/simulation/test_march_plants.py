"""Loops with plants of their own march together: against each alone, and scaled in time."""

import numpy as np
import pytest

from simc_core import Loop, Plant, SeriesPid, half_rule, performance, simc, stability
from simc_core.errors import InvalidParameter
from simc_core.metrics.performance import performance_many
from simc_core.simulation.one_delay.march_plants import march_plants
from tests.oracles.random_plants import random_plants


def loops(number: int, seed: int) -> list[Loop]:
    """Stable SIMC loops round plants of every kind, PI and PID, with and without filter."""
    found = []
    for i, (_, plant) in enumerate(random_plants(number, seed)):
        model = half_rule(plant, 1 + i % 2).model
        try:
            loop = Loop(plant, simc(model, model.theta or 1.0).with_filter(0.1 * (i % 4 == 3)))
            if stability(loop).verdict == "stable":
                found.append(loop)
        except InvalidParameter:
            continue
    return found


def test_courses_are_those_of_each_loop_alone():
    """y and u at 50 instants of every response."""
    some = loops(40, seed=11)
    forms = [loop.controller.to_parallel() for loop in some]
    seen = 0
    for which, together in march_plants([loop.plant for loop in some], forms):
        assert not isinstance(together, InvalidParameter)
        for place, i in enumerate(which):
            ((_, alone),) = march_plants([some[i].plant], [forms[i]])
            t = np.linspace(0, alone.begin[-1], 50)
            expected = alone(t)[0]
            size = np.abs(expected).max(axis=2, keepdims=True)
            assert np.all(np.abs(together(t)[place] - expected) <= 1e-9 * size)
            seen += 1
    assert seen == len(some) > 20


@pytest.mark.parametrize("scale", [1e-6, 60.0, 1e5])
def test_time_has_no_unit(scale):
    """A plant and settings in another time unit: IAE scales, TV and overshoot stay. All of them in one march."""
    plants = [Plant(2, 3, (10, 4)), Plant(0.5, 0, (7, 2, 1))]
    settings = [SeriesPid(1.2, 10), SeriesPid(3, 7, 2, 0.2)]
    some = [Loop(plant, controller) for plant, controller in zip(plants, settings, strict=True)]
    scaled = [
        Loop(
            Plant(plant.k, plant.theta * scale, tuple(tau * scale for tau in plant.lags)),
            SeriesPid(c.Kc, c.tau_I * scale, c.tau_D * scale, c.tau_F * scale),
        )
        for plant, c in zip(plants, settings, strict=True)
    ]
    found = performance_many([*some, *scaled])
    for one, other in zip(found[:2], found[2:], strict=True):
        numbers = other.disturbance.IAE / scale, other.setpoint.TV, other.setpoint.overshoot
        expected = one.disturbance.IAE, one.setpoint.TV, one.setpoint.overshoot
        assert numbers == pytest.approx(expected, rel=1e-10, abs=1e-12)


def test_closed_form_of_the_load_error():
    """Without overshoot IAE of a load step is tau_I/Kc, whatever the plant [SK03]."""
    some = [Loop(Plant(k, theta, (tau,)), SeriesPid(tau / (k * 4 * theta), tau)) for k, theta, tau in PLANTS]
    for loop, found in zip(some, performance_many(some), strict=True):
        expected = loop.controller.tau_I / loop.controller.Kc
        assert found.disturbance.IAE / expected == pytest.approx(1.0, rel=1e-7)


PLANTS = [(10.0**a, 10.0**b, 10.0 ** (b + c)) for a in (-2, 1) for b in (-3, 0, 3) for c in (0, 0.5, 1)]


def test_a_loop_that_cannot_march_is_refused_alone():
    """Derivative action without a filter on a plant whose response jumps, among others."""
    good = Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))
    jumps = Loop(Plant(1, 1, (8,), (2,)), SeriesPid(0.1, 8, 1))
    found = performance_many([good, jumps, good])
    assert isinstance(found[1], InvalidParameter)
    for other in (found[0], found[2]):
        ratio = other.disturbance.IAE / performance(good).disturbance.IAE
        assert ratio == pytest.approx(1.0, rel=1e-12)
