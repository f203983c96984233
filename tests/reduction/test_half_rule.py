"""The half rule against the published reductions, conservation laws and brute force over theta."""

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from simc_core import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    InvalidParameter,
    NotReducible,
    OscillatingDelay,
    Plant,
    SecondOrderDelay,
    UnstableDelay,
    half_rule,
)
from simc_core.reduction.dynamics import dynamics
from simc_core.reduction.half_rule import _at, _removed
from tests.oracles.published import PUBLISHED, plant_of, select

TIMES = st.floats(0.01, 100)
E6 = Plant(1, 0, (1, 1, 0.028), (0.17, 0.17), 1)
E12 = Plant(1, 0.3, (10, 8, 1), (6, 3))


def numbers(model):
    """Gain, theta, tau1, tau2 in the order of the published rows."""
    match model:
        case FirstOrderDelay(k, theta, tau1):
            return (k, theta, tau1)
        case SecondOrderDelay(k, theta, tau1, tau2):
            return (k, theta, tau1, tau2)
        case IntegratingDelay(k_prime, theta, tau2):
            return (k_prime, theta, tau2)


@pytest.mark.parametrize("row", [row for row in select("S03-E") if "-model" in row.id and "E6PI-" not in row.id])
def test_rows_of_the_2003_table(row):
    model = half_rule(row.plant, row.inputs["order"]).model
    for i, value in enumerate(numbers(model)):
        assert value == row.approx(i)


def test_E6_PI_differs_from_its_row():
    """[SK03] prints theta = 1.69 = 1 + 0.66 + 0.028, all lags whole; by the half rule the first lag counts half."""
    row = PUBLISHED["S03-E6PI-model"]
    reduction = half_rule(E6, 1)
    assert reduction.model.theta == pytest.approx(1 / 2 + 0.66 + 0.028, rel=1e-12)
    assert reduction.model.theta + 1 / 2 == row.approx()
    assert [candidate.theta for candidate in reduction.candidates] == pytest.approx([0.014, 1.188])


@pytest.mark.parametrize("row", select("S03-T-rule"))
def test_rules_T(row):
    k, theta, tau1 = numbers(half_rule(row.plant).model)
    assert (k, tau1, theta) == (row.approx(0), row.approx(1), row.approx(2))


@pytest.mark.parametrize("row", select("S000-ex1", "S000-ex2"))
def test_examples_of_v06(row):
    """Printed as T1, (T2,) Td."""
    model = half_rule(row.plant, row.inputs["order"]).model
    printed = (model.tau1, model.theta) if row.inputs["order"] == 1 else (model.tau1, model.tau2, model.theta)
    for i, value in enumerate(printed):
        assert value == row.approx(i)


@pytest.mark.parametrize("rules", ["2003", "1998"])
def test_example_1_of_1998_by_both_rules(rules):
    plant = plant_of(PUBLISHED["S002-ex1-order2"].inputs)
    model, row = half_rule(plant, 2, rules=rules).model, PUBLISHED["S002-ex1-order2"]
    assert (model.tau1, model.tau2, model.theta) == (row.approx(0), row.approx(1), row.approx(2))
    model, row = half_rule(plant, 1, rules=rules).model, PUBLISHED["S002-ex1-order1"]
    assert (model.tau1, model.theta) == (row.approx(0), row.approx(1))


def test_example_2_of_1998():
    row = PUBLISHED["S002-ex2-model"]
    model = half_rule(row.plant, 2, rules="1998").model
    assert isinstance(model, UnstableDelay)
    assert (model.tau2, model.theta) == (row.approx(0), row.approx(1))
    given = PUBLISHED["S002-ex2-tune"].inputs
    assert (model.k_prime, model.a) == pytest.approx((given["kprime"], given["a"]))


def test_E12_has_two_self_consistent_delays():
    """theory.md: 0.3 and 0.8; 0.3 is published."""
    reduction = half_rule(E12)
    assert [candidate.theta for candidate in reduction.candidates] == pytest.approx([0.3, 0.8])
    assert [candidate.chosen for candidate in reduction.candidates] == [True, False]
    assert [model.theta for model in reduction.alternatives] == pytest.approx([0.8])
    assert reduction.candidates[0].Ms == PUBLISHED["S03-E12PI-Ms"].approx()
    told = next(step for step in reduction.steps if step.rule == "choice")
    assert "0.8" in told.text
    assert "at Ms = 1.6" in told.text


@given(st.lists(TIMES, min_size=1, max_size=8), st.lists(TIMES, max_size=2), st.floats(0, 10), st.sampled_from([1, 2]))
def test_without_zeros_delay_and_lags_are_conserved(lags, inverse, h, order):
    h = round(h, 2)
    plant = Plant(2, 0.5, lags, [-T for T in inverse[: len(lags)]])
    model = half_rule(plant, order, h).model
    total = 0.5 + sum(lags) + sum(inverse[: len(lags)]) + h / 2
    assert sum(numbers(model)[1:]) == pytest.approx(total, rel=1e-12)
    assert model.k == 2


@given(
    st.lists(TIMES, min_size=1, max_size=5), st.lists(TIMES, max_size=3), st.floats(0.1, 10), st.floats(1e-3, 1e3),
    st.sampled_from([1, 2]), st.sampled_from(["2003", "1998"]),
)  # fmt: skip
def test_scaling_of_time(lags, leads, theta, scale, order, rules):
    """A plant in seconds and in minutes has one model."""
    leads = leads[: len(lags)]
    model = half_rule(Plant(1, theta, lags, leads), order, rules=rules).model
    scaled = half_rule(
        Plant(1, theta * scale, [scale * x for x in lags], [scale * x for x in leads]), order, rules=rules
    )
    assume(type(scaled.model) is type(model))
    k, *times = numbers(model)
    assert numbers(scaled.model) == pytest.approx((k, *(scale * x for x in times)), rel=1e-6, abs=1e-7)


@given(st.lists(TIMES, min_size=1, max_size=5), st.lists(TIMES, min_size=1, max_size=3), st.floats(0.01, 10))
def test_every_share_of_the_budget_is_accounted_for(lags, leads, theta):
    """The parts of each lag add up to it, and what is put to tau1 and theta makes up the model."""
    leads = leads[: len(lags)]
    reduction = half_rule(Plant(1, theta, lags, leads), 1)
    for share in reduction.budget:
        assert sum(time for _, time in share.parts) == pytest.approx(share.amount, rel=1e-9)
    placed = {where: 0.0 for share in reduction.budget for where, _ in share.parts} | {"tau1": 0.0, "theta": 0.0}
    for share in reduction.budget:
        for where, time in share.parts:
            placed[where] += time
    assert placed["theta"] == pytest.approx(reduction.model.theta, rel=1e-9)
    assert placed["tau1"] == pytest.approx(reduction.model.tau1, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(
    ("plant", "errors"),
    [
        (Plant(1, 1, (19.6,), (4.9,), 1), (1016, 9.83)),
        (Plant(1, 1, (20,), (5,), 1), (19.8, 19.8)),
        (Plant(1, 1, (24,), (6,), 1), (9.18, 9.18)),
    ],
)
def test_orders_at_equal_peak_where_a_zero_makes_them_differ(plant, errors):
    """Load errors at Ms = 1.6 found apart from this code: tau_c searched, |S| on a grid of frequencies."""
    for order in (1, 2):
        found = half_rule(plant, order).orders
        assert (found.first, found.second) == pytest.approx(errors, rel=0.01)
        assert found.second_pays == (errors[1] < errors[0])


@pytest.mark.parametrize(
    ("plant", "delays", "errors"),
    [
        (Plant(1, 1, (20,), (5,), 1), (1, 8.5), (19.8, 1040)),
        (Plant(1, 1, (24,), (6,), 1), (1, 10), (9.18, 1400)),
    ],
)
def test_the_delay_with_the_smaller_load_error_is_chosen(plant, delays, errors):
    """Tight Ms of the smaller delay is 2.058 and 1.963: a limit of 2 made a factor of 50 of that."""
    small, large = half_rule(plant, 1).candidates
    assert (small.theta, large.theta) == pytest.approx(delays)
    assert (small.load_error, large.load_error) == pytest.approx(errors, rel=0.01)
    assert (small.chosen, large.chosen) == (True, False)


@pytest.mark.parametrize("seed", range(12))
def test_candidates_against_iteration_from_everywhere(seed):
    """theta <- half_rule(theta), iterated from 400 starts, ends on the candidates and reaches all of them."""
    rng = np.random.default_rng(seed)
    lags = 10 ** rng.uniform(-1, 1.5, rng.integers(2, 6))
    leads = 10 ** rng.uniform(-1, 1.5, rng.integers(1, len(lags) + 1))
    plant = Plant(1, float(rng.choice([0.0, 10 ** rng.uniform(-2, 1)])), lags, leads[:2], int(rng.integers(0, 2)))
    parts = dynamics(plant)
    reached = set()
    for start in np.linspace(0, plant.theta + sum(lags), 400):
        theta = start
        for _ in range(60):
            theta, before = _at(parts, partial(_removed, parts), 1, 0.0, theta).theta(theta), theta
            if theta == before:  # so it stays
                break
        if math.isclose(theta, before, rel_tol=1e-12, abs_tol=1e-12):
            reached.add(round(theta, 9))
    found = {round(candidate.theta, 9) for candidate in half_rule(plant).candidates}
    assert found == reached


@pytest.mark.parametrize(
    ("plant", "order", "model"),
    [
        (Plant(2, 3), 1, FirstOrderDelay(2, 3, 0)),
        (Plant(2, 3), 2, FirstOrderDelay(2, 3, 0)),
        (Plant(2, 3, (5,)), 2, SecondOrderDelay(2, 3, 5, 0)),
        (Plant(2, 1, (4, 2, 1), integrators=1), 1, IntegratingDelay(2, 1 + 2 + 2 + 1)),
        (Plant(2, 1, (4, 2, 1), integrators=1), 2, IntegratingDelay(2, 1 + 1 + 1, 5)),
        (Plant(2, 1, (0.4, 0.2), integrators=2), 1, DoubleIntegratingDelay(2, 1.6)),
        (Plant(-1, 1, (-20, 2, 1)), 2, UnstableDelay(0.05, 1.5, 0.05, 2.5)),
        (Plant(-1, 1, (-20, 2, 1)), 1, UnstableDelay(0.05, 4, 0.05)),
        (Plant(3, 1, (0.2,), (-0.1,), lag_pairs=((5, 0.3),)), 1, OscillatingDelay(3, 1.3, 5, 0.3)),
        (Plant(1, 1, lag_pairs=((5, 0.8),)), 2, SecondOrderDelay(1, 1, 5, 5)),
        (Plant(1, 1, lag_pairs=((2, 1.25),)), 2, SecondOrderDelay(1, 1, 4, 1)),
        (Plant(1, 1, (4,), lead_pairs=((0.2, -1.0),), lag_pairs=((5, 0.8),)), 1, FirstOrderDelay(1, 7.9, 7.5)),
        (Plant(1, 1, (4, 1), (1,)), 1, FirstOrderDelay(1, 1, 4)),
        (Plant(1, 1, (4,), lag_pairs=((2, 0.1),), lead_pairs=((2, 0.1),)), 1, FirstOrderDelay(1, 1, 4)),
        (Plant(2, 1, (1,), (10,), integrators=1), 1, FirstOrderDelay(20, 1, 1)),
        (Plant(2, 1, (), (10,), integrators=2), 1, IntegratingDelay(20, 1)),
        (Plant(2, 3, (), (10,), integrators=1), 1, FirstOrderDelay(2 * 15, 3, 5)),
        (Plant(1, 1, (2,), (3,)), 1, FirstOrderDelay(1.5, 1, 0)),  # T1
        (Plant(1, 2, (1,), (3,)), 1, FirstOrderDelay(1.5, 2, 0)),  # T1a
        (Plant(1, 4, (1,), (3,)), 1, FirstOrderDelay(1, 4, 0)),  # T1b
        (Plant(1, 1, (20,), (10,)), 1, FirstOrderDelay(0.5, 1, 0)),  # T2
        (Plant(1, 1, (20,), (2,)), 1, FirstOrderDelay(5 / 20, 1, 3)),  # T3, t = 5 theta
        (Plant(1, 10, (20,), (2,)), 1, FirstOrderDelay(1, 10, 18)),  # T3, t = tau0
        (Plant(1, 10, (20, 20), (2,)), 2, SecondOrderDelay(1, 10, 20, 18)),
    ],
)
def test_by_hand(plant, order, model):
    reduced = half_rule(plant, order).model
    assert type(reduced) is type(model)
    for name in model.__dataclass_fields__:
        assert getattr(reduced, name) == pytest.approx(getattr(model, name), rel=1e-12)


@pytest.mark.parametrize(
    ("plant", "model"),
    [
        (Plant(1, 3, (10,), (2,)), FirstOrderDelay(1, 1, 10)),  # small: subtracted
        (Plant(1, 1, (10,), (2,)), FirstOrderDelay(1, 1, 8)),  # large: 10 - 2
        (Plant(1, 1, (10,), (20,)), FirstOrderDelay(2, 1, 0)),  # larger than any lag: cancelled
        (Plant(1, 1, (0.5,), (20,), integrators=1), FirstOrderDelay(20, 1, 0.5)),
    ],
)
def test_rules_of_1998_by_hand(plant, model):
    assert half_rule(plant, rules="1998").model == model


def test_sampling_adds_half_a_period():
    """[V06 eq. 15]: h/2 in the delay, nothing else."""
    plant = Plant(1, 3, (6, 4, 2))
    assert half_rule(plant, 1, h=1.0).model == FirstOrderDelay(1, 7.5, 8)


def test_a_filter_that_the_rule_does_not_know_adds_half_its_time():
    """As sampling does, and both together; each is told apart."""
    plant = Plant(1, 3, (6, 4, 2))
    assert half_rule(plant, 1, tau_F=1.0).model == FirstOrderDelay(1, 7.5, 8)
    both = half_rule(plant, 1, h=1.0, tau_F=0.5)
    assert both.model.theta == 7.75
    (told,) = (step.text for step in both.steps if step.rule == "delay")
    assert "half the sampling period, half the filter time" in told
    assert {entry.kind: entry.amount for entry in both.budget}.items() >= {"sampling": 0.5, "filter": 0.25}.items()


def test_what_pays_and_what_is_said():
    """[SK03 sect. 3.1]: order 2 pays where tau2 > theta of the second-order model, on plants without zeros."""
    assert half_rule(Plant(1, 3, (6, 4, 2))).orders.second_pays  # 5 > 4
    assert not half_rule(Plant(1, 1, (1, 0.2))).orders.second_pays
    assert half_rule(Plant(1, 1, integrators=2)).orders is None
    assert any("dead time is 0" in note for note in half_rule(Plant(1, 0, (5,))).notes)
    assert any("ring" in note or "oscillatory" in note for note in half_rule(Plant(1, 1, lag_pairs=((5, 0.3),))).notes)
    rules = [step.rule for step in half_rule(Plant(1, 0, (1, 1, 1, 1)), 2).steps]
    assert rules == ["keep", "keep", "half rule", "delay", "swap", "model"]


@pytest.mark.parametrize(
    ("plant", "words"),
    [
        (Plant(1, 1, integrators=3), "integrators must be <= 2.*cascade"),
        (Plant(1, 1, (-5, -2)), "at most one unstable pole.*found 2.*inner loop"),
        (Plant(1, 1, (-5,), integrators=1), "unstable pole together with integrators"),
        (Plant(1, 1, lag_pairs=((1, -0.5),)), "at most one unstable pole.*found 2"),
        (Plant(1, 1, lag_pairs=((1, 0.5), (2, 0.5))), "at most one pair"),
        (Plant(1, 1, lag_pairs=((1, 0.5),), integrators=1), "only slow dynamics"),
        (Plant(1, 1, (2,), lag_pairs=((1, 0.5),)), "slowest dynamics.*beside a lag of 2"),
        (Plant(1, 1, (1, 1), lead_pairs=((1, 0.5),)), "complex zeros.*found zeta = 0.5"),
        (Plant(1, 1, (-5,), (2,)), "no lag left"),
    ],
)
def test_what_the_rule_does_not_cover(plant, words):
    for rules in ("2003", "1998"):
        with pytest.raises(NotReducible, match=words):
            half_rule(plant, rules=rules)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"order": 3}, "order must be <= 2, found 3"),
        ({"order": 1.5}, "whole number"),
        ({"h": -1}, "h must be >= 0, found -1"),
        ({"h": math.nan}, "finite"),
        ({"tau_F": -1}, "tau_F must be >= 0, found -1"),
        ({"rules": "2005"}, "rules must be one of 2003, 1998, found '2005'"),
    ],
)
def test_arguments_out_of_bounds(arguments, words):
    with pytest.raises(InvalidParameter, match=words):
        half_rule(Plant(1, 1, (2,)), **arguments)


def test_forty_poles_and_zeros_are_reduced_in_bounded_time():
    rng = np.random.default_rng(1)
    reduction = half_rule(Plant(1, 0.01, 10 ** rng.uniform(-2, 2, 40), 10 ** rng.uniform(-2, 2, 40)))
    assert reduction.model.theta >= 0.01
