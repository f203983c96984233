"""What was read, in words: typed by hand for plants of every kind."""

import re

import pytest
from hypothesis import given

from simc_core import Plant, parse_plant, read_back

from .pages.test_links import plants


@pytest.mark.parametrize(
    ("plant", "words"),
    [
        (Plant(2.2, 20, (180,)), "gain 2.2, lag 180, dead time 20"),
        (Plant(12500, 0, (5,)), "gain 12500, lag 5, no dead time"),
        (Plant(-1.5, 4, (20, 6, 1)), "gain -1.5, lags 20, 6 and 1, dead time 4"),
        (Plant(1, 0.5, (3, 3, 3)), "gain 1, lags 3 (3 times), dead time 0.5"),
        (Plant(0.05, 2, integrators=1), "gain 0.05, integrator, dead time 2"),
        (Plant(3, 0, (4,), integrators=2), "gain 3, double integrator, lag 4, no dead time"),
        (Plant(-1, 0, (-20,)), "gain -1, unstable lag -20, no dead time"),
        (Plant(1, 1, (-20, 2)), "gain 1, lag 2, unstable lag -20, dead time 1"),
        (Plant(1, 0, (10, 6), (-2, 0.5)), "gain 1, lags 10 and 6, lead 0.5, inverse response lead -2, no dead time"),
        (Plant(1.5, 1, lag_pairs=((5, 0.2),)), "gain 1.5, pair tau 5 zeta 0.2, dead time 1"),
        (Plant(1, 1, lag_pairs=((5, -0.2),)), "gain 1, unstable pair tau 5 zeta -0.2, dead time 1"),
        (
            Plant(1, 0, (2, 2), lead_pairs=((0.3, 0),)),
            "gain 1, lags 2 (2 times), numerator pair tau 0.3 zeta 0, no dead time",
        ),
        (Plant(5), "gain 5, no dead time"),
        (Plant(1 / 3, 1e-6, (1e6,)), "gain 0.333333, lag 1e6, dead time 1e-6"),
    ],
)
def test_words_of_a_plant(plant, words):
    assert read_back(plant) == words


def test_a_slip_of_the_comma_shows():
    assert read_back(parse_plant("12 500/(5s+1)")) == "gain 12500, lag 5, no dead time"
    assert read_back(parse_plant("0,5e^{-2,75s}/(5s+1)")) == "gain 0.5, lag 5, dead time 2.75"


@given(plants)
def test_every_number_of_the_plant_is_said(plant):
    said = [float(word) for word in re.findall(r"(?<![\w(])-?[\d.]+(?:e-?\d+)?(?! times)", read_back(plant))]
    for value in {plant.k, *plant.lags, *plant.leads}:
        assert any(abs(word - value) <= 6e-6 * abs(value) for word in said)
