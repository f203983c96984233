"""Swings that last are told from swings that die out."""

import numpy as np
import pytest

from simc_core import Actuation, Loop, Plant, Scenario, SeriesPid
from simc_core.studies.limit_cycle import limit_cycle
from simc_core.studies.with_actuator import as_built

T = np.linspace(0, 200, 8001)
STEP = np.where(T < 100, 1 - np.exp(-T), 1 + 0.5 * np.exp(-(T - 100)))


def test_a_sine_that_lasts_has_its_swing_and_period():
    found = limit_cycle(T, STEP + 0.02 * np.sin(2 * np.pi * T / 6), 100.0)
    assert found.swing == pytest.approx(0.04, rel=2e-3)
    assert found.period == pytest.approx(6, rel=2e-3)


@pytest.mark.parametrize(
    "y",
    [STEP, STEP + 0.2 * np.exp(-(T - 100) / 40) * np.sin(2 * np.pi * T / 6), STEP + 0.02 * np.sin(2 * np.pi * T / 60)],
)
def test_what_rests_dies_out_or_is_not_seen_twice_is_none(y):
    assert limit_cycle(T, y, 100.0) is None


def test_the_loop_as_built_knows_it_and_the_loop_without_a_mechanism_has_none():
    loop = Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))
    swings = as_built(loop, Scenario(0.977, 0.3, actuation=Actuation(h=0.1, resolution=0.1))).numbers.cycle
    assert swings.swing == pytest.approx(0.0135, rel=0.5)  # of the same size; it depends on where r lies
    assert as_built(loop, Scenario(0.977, 0.3, actuation=Actuation(h=0.1, u_max=1.2))).numbers.cycle is None
    assert as_built(loop, Scenario(0.977, 0.3, actuation=Actuation(h=0.1, backlash=0.1))).numbers.cycle is None
