"""Rows: what is read, what comes out, what is refused."""

import gc
import math
import pickle

import pytest

from simc_core import (
    IdealPid,
    Loop,
    ParallelPid,
    Plant,
    SeriesPid,
    half_rule,
    margins,
    performance,
    simc,
    to_box,
    tune,
    tune_chunk,
    tune_row,
)
from simc_core.errors import SimcError
from simc_core.many.request import read_request
from simc_core.notation import plain
from simc_core.reduction.half_rule import reduced_model
from tests.many.lists import mixed_rows
from tests.oracles.published import PUBLISHED, select
from tests.oracles.random_plants import random_plants

TUNINGS = [each for each in select("-tuning") if each.values[0].id.startswith("S03-E")]


@pytest.mark.parametrize("value", [each for each in TUNINGS if "E6PI-" not in each.values[0].id])
def test_settings_of_the_published_examples(value):
    """[SK03 Table 4]; for E6PI another delay is taken than the one printed, see the tests of the half rule."""
    kind = "PID" if "PID" in value.id else "PI"
    found = tune_row({"plant": plain(value.plant), "kind": kind})
    settings = found.controller.Kc, found.controller.tau_I, found.controller.tau_D
    for i, number in enumerate(settings[: len(value.expected)]):
        assert number == value.approx(i)


def test_integral_errors_of_a_published_example():
    """[SK03 Table 3]: k = 1, theta = 1, tau1 = 4: both IAE and TV as printed."""
    found = tune_row({"k": "1", "theta": "1,0", "tau1": 4.0}).performance
    value = PUBLISHED["S03-T3-5-perf"]
    setpoint, load = found.setpoint, found.disturbance
    for i, number in enumerate((setpoint.IAE, load.IAE, load.TV)):
        assert number == value.approx(i)


def test_rows_together_are_the_rows_one_by_one():
    """300 rows with 10 bad ones among them: to 1e-12; ITAE, in which rounding at a late end counts, to 1e-9.

    An unstable plant lets the rounding of one element grow on the next: there 1e-9, and ITAE 1e-8.
    """
    rows, bad = mixed_rows(300, 10)
    together = tune_chunk(rows)
    assert [result.tag for result in together] == [f"L{i}" for i in range(300)]
    for i, (row, result) in enumerate(zip(rows, together, strict=True)):
        alone = tune_row(row)
        assert result.refusal == alone.refusal
        assert result.advice == alone.advice
        assert bool(result.refusal) >= (i in bad)
        if not result.refusal:
            assert result.controller == alone.controller
            assert_same(alone.margins, result.margins)
            assert (result.performance is None) == (alone.performance is None)
        if result.performance:
            rel, ITAE = (1e-9, 1e-8) if result.plant.unstable_poles else (1e-12, 1e-9)
            assert_same(alone.performance.setpoint, result.performance.setpoint, rel, ITAE=ITAE)
            assert_same(alone.performance.disturbance, result.performance.disturbance, rel, ITAE=ITAE)


def test_rows_are_the_functions_called_one_by_one():
    """Model, simc, margins, performance: margins to 1e-12, integrals to the 1e-6 to which they are known."""
    rows, bad = mixed_rows(100, 5, seed=4)
    for i, (row, result) in enumerate(zip(rows, tune_chunk(rows), strict=True)):
        if i in bad:
            assert result.refusal
            continue
        plant, order = read_request(row).plant, 2 if row["kind"] == "PID" else 1
        if result.refusal:
            with pytest.raises(SimcError) as refusal:
                margins(Loop(plant, simc(reduced_model(plant, order))))
            assert str(refusal.value) == result.refusal
            continue
        loop = Loop(plant, simc(reduced_model(plant, order)))
        assert result.controller == loop.controller
        assert_same(margins(loop), result.margins)
        if result.performance:
            alone = performance(loop)
            for one, other in (
                (alone.setpoint, result.performance.setpoint),
                (alone.disturbance, result.performance.disturbance),
            ):
                assert_same(one, other, rel=1e-6)
        else:
            with pytest.raises(SimcError):
                performance(loop)
            assert [each for each in result.advice if each.quantity in ("Not stable", "No IAE")]


def assert_same(alone, found, rel: float = 1e-12, **other: float) -> None:
    """Two records of numbers agree."""
    for name in type(alone).__slots__:
        expected = pytest.approx(getattr(alone, name), rel=other.get(name, rel), abs=1e-300, nan_ok=True)
        assert getattr(found, name) == expected, name


def test_the_model_alone_is_that_of_the_half_rule():
    for i, (_, plant) in enumerate(random_plants(60, seed=8)):
        order = 1 + i % 2
        assert reduced_model(plant, order) == half_rule(plant, order).model


@pytest.mark.parametrize(
    ("row", "present"),
    [
        ({"Kc": 2, "tau_I": "8"}, IdealPid(2, 8)),
        ({"Kc": 2, "tau_I": 8, "tau_D": 1, "form": "Series"}, SeriesPid(2, 8, 1)),
        ({"Kc": 2, "tau_I": 0}, IdealPid(2, math.inf)),
        ({"Kp": 2, "Ki": 0.25, "form": "parallel"}, ParallelPid(2, 0.25)),
        ({}, None),
    ],
)
def test_present_settings(row, present):
    request = read_request({"k": 1, "theta": 1, "tau1": 8} | row)
    assert request.present == present
    assert not request.present_refusal


def test_present_settings_are_judged_beside_the_new_ones():
    """Without overshoot of the load step IAE = tau_I/Kc: 8/1 now, 8/4 by SIMC."""
    found = tune_row({"k": 1, "theta": 1, "tau1": 8, "Kc": 1, "tau_I": 8})
    load = found.present.performance.disturbance
    assert pytest.approx(8.0, rel=1e-6) == load.IAE
    assert found.load_ratio == pytest.approx(4.0, rel=1e-6)
    assert found.trouble == ""


def test_slow_oscillation_of_the_present_settings():
    """Kc k' tau_I = 0.5 < 4 [SK03 eq. 22]: zeta = 0.354 without dead time. A lag damps itself: 2 is no case."""
    found = tune_row({"k_prime": 1, "theta": 0.1, "Kc": 0.1, "tau_I": 5})
    assert found.trouble == "slow oscillation"
    assert tune_row({"k": 2.79, "theta": 2.44, "tau1": 15.8, "Kc": 0.966, "tau_I": 11.7}).trouble == ""


def test_present_settings_that_make_no_controller_cost_the_comparison_alone():
    found = tune_row({"k": 1, "theta": 1, "tau1": 8, "tau_I": 8})
    assert not found.refusal
    assert found.present is None
    assert "Kc must be given" in next(each.text for each in found.advice if each.quantity == "settings now")


def test_what_is_typed_into_the_box():
    row = {"k": 1, "theta": 1, "tau1": 8, "box": "honeywell_udc", "pv_span": 50, "out_span": 100, "time_unit": "min"}
    expected = to_box(SeriesPid(4, 8), "honeywell_udc", 50, 100, "min", rounded=True)
    assert tune_row(row).typed.values == expected.values


def test_a_box_that_does_not_exist_costs_the_box_alone():
    found = tune_row({"k": 1, "theta": 1, "tau1": 8, "box": "abacus"})
    assert found.controller
    assert found.typed is None
    assert any(each.quantity == "box" for each in found.advice)


def test_another_rule():
    plant = Plant(1, 1, (8,))
    assert tune_row({"k": 1, "theta": 1, "tau1": 8, "rule": "amigo"}).controller == tune("amigo", plant)


def test_an_Ms_asked_for_is_met():
    found = tune_row({"k": 1, "theta": 1, "tau1": 8, "Ms": 1.4}).margins
    assert max(found.Ms, found.Mt) == pytest.approx(1.4, rel=1e-6)


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ({"k": 1, "theta": 1}, "tau1 must be given"),
        ({"k": 1, "theta": 1, "tau1": 8, "plant": "1/(s+1)"}, "both given"),
        ({"k": 1, "theta": 0, "tau1": 8}, "tau_c must be given"),
        ({"k": 1, "theta": 1, "tau1": -8}, "tau1 must be >= 0"),
        ({"k": 1, "theta": 1, "tau1": 8, "kind": "PD"}, "kind must be one of PI, PID, found 'PD'"),
        ({"k": 1, "theta": 1, "tau1": 8, "tau_c": 1, "Ms": 1.5}, "leave one of them empty"),
        ({"plant": "x" * 3000}, "at most 2000 characters"),
        ({"k": "1,234", "theta": 1, "tau1": 8}, "two ways"),
        ({"k": object(), "theta": 1, "tau1": 8}, "k must be a number"),
    ],
)
def test_refusals_name_the_cell(row, words):
    assert words in tune_row(row).refusal


def test_an_error_that_is_not_the_users_is_named(monkeypatch):
    monkeypatch.setattr("simc_core.many.tune_rows.reduced_model", lambda plant, order: 1 / 0)
    assert tune_row({"k": 1, "theta": 1, "tau1": 8}).refusal.endswith("ZeroDivisionError: division by zero")


def test_results_can_be_sent():
    result = tune_row({"k": 1, "theta": 1, "tau1": 8, "Kc": 1, "tau_I": 8, "box": "matlab_pid"})
    again = pickle.loads(pickle.dumps(result))
    assert again.controller == result.controller
    assert again.typed.values == result.typed.values


@pytest.mark.parametrize("on", [True, False])
def test_the_collector_of_cycles_is_left_as_it_was_and_has_nothing_to_collect(on):
    """It waits while a chunk is tuned."""
    rows, _ = mixed_rows(100, 5, seed=7)
    tune_chunk(rows)  # what is made once is made
    was_on = gc.isenabled()
    try:
        (gc.enable if on else gc.disable)()
        gc.collect()
        found = tune_chunk(rows)
        assert gc.isenabled() == on
        assert gc.collect() == 0
        assert len(found) == 100
    finally:
        (gc.enable if was_on else gc.disable)()
