"""Rules at equal robustness: factors and errors of an independent program, and what must hold of any table."""

import math
from fractions import Fraction

import pytest

from simc_core import (
    RULES,
    FirstOrderDelay,
    IController,
    InvalidParameter,
    Loop,
    NotReducible,
    OutOfDomain,
    Plant,
    at_equal_robustness,
    comparison,
    margins,
    performance,
    tune,
)
from simc_core.optimal.criterion import J
from simc_core.optimal.under_ms import references

PLANTS = {
    "A": Plant(1, 1, (1,)),
    "B": Plant(1, 1, (8,)),
    "D": Plant(1, 1, integrators=1),
    "F": Plant(1, 1, (6, 2)),
}
AT_159 = [  # rule, kind, plant, factor, IAE of the load; tau_F = 0.1 theta of the half rule
    ("simc", "PI", "A", 1.0006, 2.0360),
    ("simc", "PI", "B", 1.0006, 2.0012),
    ("simc", "PI", "D", 1.1210, 20.108),
    ("simc", "PI", "F", 1.1137, 4.4549),
    ("amigo", "PI", "A", 0.4474, 2.1186),
    ("amigo", "PI", "B", 0.6529, 1.2327),
    ("amigo", "PI", "D", 0.7697, 22.682),
    ("amigo", "PI", "F", 0.6643, 4.3060),
    ("zn_ultimate", "PI", "A", 1.3480, 4.6075),
    ("zn_ultimate", "PI", "B", 1.5974, 1.3650),
    ("zn_ultimate", "PI", "D", 1.7684, 15.110),
    ("zn_ultimate", "PI", "F", 2.0147, 6.8208),
    ("isimc", "PID", "A", 1.1654, 1.7480),
    ("isimc", "PID", "B", 1.1746, 1.5520),
    ("isimc", "PID", "D", 1.2513, 14.093),
    ("isimc", "PID", "F", 1.1322, 3.3966),
    ("imc_1986", "PID", "A", 1.6666, 1.8333),
    ("imc_1986", "PID", "B", 1.6666, 1.8333),
    ("imc_1986", "PID", "F", 1.1439, 2.8302),
    ("zn_step", "PID", "A", 1.7595, 5.1595),
    ("zn_step", "PID", "B", 2.0667, 0.8995),
    ("zn_step", "PID", "D", 2.1206, 8.4298),
    ("zn_step", "PID", "F", 1.4903, 2.1153),
    ("zn_ultimate", "PID", "A", 1.7503, 3.4955),
    ("zn_ultimate", "PID", "B", 1.6685, 0.7380),
    ("zn_ultimate", "PID", "D", 1.7974, 8.8949),
    ("zn_ultimate", "PID", "F", 1.7673, 2.3620),
    ("amigo", "PID", "A", 0.7844, 1.6299),
    ("amigo", "PID", "B", 0.7945, 0.7610),
    ("amigo", "PID", "D", 0.8045, 11.515),
    ("amigo", "PID", "F", 0.9042, 2.9679),
]
J_OF_LAGGING = {
    ("simc", "PI"): 1.3820,
    ("amigo", "PI"): 1.2326,
    ("zn_ultimate", "PI"): 1.2521,
    ("isimc", "PID"): 1.1251,
    ("imc_1986", "PID"): 1.2305,
    ("zn_step", "PID"): 0.9259,
    ("zn_ultimate", "PID"): 0.9035,
    ("amigo", "PID"): 0.9024,
}


@pytest.mark.parametrize(("key", "kind", "plant", "factor", "load"), AT_159)
def test_factor_and_load_error_at_equal_robustness_are_those_that_are_known(key, kind, plant, factor, load):
    found = at_equal_robustness(key, PLANTS[plant], kind)
    assert found.factor == pytest.approx(factor, abs=6e-5)
    loop = Loop(PLANTS[plant], found.controller)
    judged = margins(loop)
    assert max(judged.Ms, judged.Mt) == pytest.approx(1.59, rel=1e-8)
    value = performance(loop).disturbance.IAE
    assert value == pytest.approx(load, rel=6e-5)


@pytest.mark.parametrize(
    ("plant", "setpoint", "load"),
    [("A", 2.0714, 2.0182), ("B", 2.1692, 1.1345), ("D", 2.1692, 15.094), ("F", 5.4208, 4.1982)],
)
def test_the_references_of_J_are_those_that_are_known(plant, setpoint, load):
    found = references(PLANTS[plant], 1.0 if plant != "F" else 2.0)
    assert (found.setpoint, found.load) == pytest.approx((setpoint, load), rel=3e-5)
    assert J(found, found.setpoint, found.load) == 1.0


@pytest.fixture(scope="module")
def lagging():
    """Everything on e^{-s}/(8s+1) at 1.59."""
    return {(row.key, row.kind): row for row in comparison(PLANTS["B"], Ms=1.59)}


def test_J_of_each_rule_is_the_one_that_is_known(lagging):
    assert {key: lagging[key].J for key in J_OF_LAGGING} == pytest.approx(J_OF_LAGGING, abs=6e-5)


def test_J_of_the_controllers_that_are_best_for_the_load_is_the_one_that_is_known(lagging):
    """Their load error is flat about the optimum, J is not: settings that differ by 1e-3 show in it."""
    assert [lagging["optimal", kind].J for kind in ("PI", "PID")] == pytest.approx([1.2477, 0.9759], abs=6e-4)


def test_no_rule_is_better_than_the_optimum(lagging):
    behind = [row.behind for row in lagging.values() if row.controller is not None]
    assert len(behind) > 35
    assert min(behind) > -2e-5
    assert lagging["optimal", "PI"].behind == pytest.approx(0, abs=1e-5)


def test_every_rule_has_a_row_for_each_kind_it_is_offered_for(lagging):
    offered = {(rule.key, kind) for rule in RULES.values() for kind in rule.kinds if kind in ("PI", "PID")}
    assert set(lagging) == offered | {("optimal", "PI"), ("optimal", "PID")}


def test_a_row_without_settings_says_why(lagging):
    without = [row for row in lagging.values() if row.controller is None]
    assert all(row.refusal for row in without)
    assert lagging["symmetrical_optimum", "PI"].refusal.startswith("integrators must be 1")
    assert not lagging["amigo", "PID"].in_domain
    assert lagging["amigo", "PI"].in_domain


def test_as_published_factors_are_1_and_peaks_those_of_the_rules():
    rows = list(comparison(PLANTS["B"], ("PI",), keys=("simc", "zn_step", "amigo", "iae_load")))
    assert [row.factor for row in rows] == [1, 1, 1, 1]
    assert [row.published_Ms for row in rows] == pytest.approx([1.590, 3.271, 1.301, 3.907], abs=6e-4)
    assert [row.Mst for row in rows] == pytest.approx([row.published_Ms for row in rows], rel=1e-12)
    assert rows[3].load == pytest.approx(0.518, abs=6e-4)
    assert all(row.behind > -2e-5 for row in rows)


def test_rows_come_one_by_one_and_wrong_names_at_once():
    rows = comparison(PLANTS["B"], ("PI",))
    assert next(rows).key == "simc"
    with pytest.raises(InvalidParameter, match="rule must be one of"):
        comparison(PLANTS["B"], keys=("simc", "magic"))


@pytest.mark.parametrize("key", ["simc", "amigo", "zn_ultimate", "cohen_coon"])
def test_factors_are_the_same_in_any_units(key):
    plant = PLANTS["B"]
    here = at_equal_robustness(key, plant)
    there = at_equal_robustness(key, plant.rescaled(Fraction(1, 60), -4.0))
    assert there.factor == pytest.approx(here.factor, rel=1e-8)
    assert there.published_Ms == pytest.approx(here.published_Ms, rel=1e-9)
    assert there.controller.Kc == pytest.approx(-here.controller.Kc / 4, rel=1e-7)


def test_the_model_that_the_rule_starts_from_can_be_another_one():
    """The tangent of four lags: theta 1.4254 and, to 63 %, 2.9266."""
    plant, tangent = Plant(1, 0, (1, 1, 1, 1)), FirstOrderDelay(1, 1.4254, 2.9266)
    found, usual = at_equal_robustness("zn_step", plant, model=tangent), at_equal_robustness("zn_step", plant)
    assert found.controller.Kc == pytest.approx(tune("zn_step", FirstOrderDelay(1, 1.4254 * found.factor, 2.9266)).Kc)
    assert found.factor != pytest.approx(usual.factor, rel=0.05)


def test_pure_dead_time_under_simc_stays_integral_action():
    found = at_equal_robustness("simc", Plant(1, 1))
    assert isinstance(found.controller, IController)
    assert found.factor == pytest.approx(1.0006, abs=6e-5)


def test_a_peak_that_a_rule_cannot_have_is_not_reachable():
    found = at_equal_robustness("kuhn", PLANTS["B"])
    assert found.controller is None
    assert found.factor is None
    assert found.published_Ms == pytest.approx(1.125, abs=6e-4)


def test_what_a_rule_is_not_made_for_is_refused():
    with pytest.raises(OutOfDomain, match="integrators must be 1"):
        at_equal_robustness("symmetrical_optimum", PLANTS["B"])
    with pytest.raises(NotReducible, match="ultimate gain"):
        at_equal_robustness("zn_ultimate", Plant(1, 0, (1,)))
    with pytest.raises(InvalidParameter, match="Ms must be > 1"):
        at_equal_robustness("simc", PLANTS["B"], Ms=1)


def test_an_unstable_published_loop_has_no_peak():
    found = at_equal_robustness("cohen_coon", Plant(1, 0.6, (1,), (-0.8,)), model=FirstOrderDelay(1, 0.2, 1))
    assert math.isnan(found.published_Ms)
