"""The time unit of a loop: changing it converts everything and loses nothing."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pages.common.parts.units import unit_of
from pages.common.session.actuator import Actuator
from pages.common.session.design import Design
from pages.common.session.fields import put
from pages.common.session.sheet import Sheet
from pages.common.session.time_unit import in_time_unit
from pages.common.session.tuning import Tuning
from pages.common.studies.single import study
from simc_core import IdealPid, InvalidParameter, Plant, SeriesPid, parse_plant
from simc_core.plants.step_facts import SettlingFacts, SlopeFacts
from tests.pages.test_links import designs
from tests.pages.tools import address, run_page, texts, unfold

HEATER = Design(Plant(2.2, 20.0, (180.0,)), own=IdealPid(1.2, 240.0), sheet=Sheet(time_unit="s"))


def test_seconds_to_minutes_and_back_to_the_last_bit():
    minutes = in_time_unit(HEATER, "min")
    assert minutes.plant == Plant(2.2, 20.0 / 60.0, (3.0,))
    assert minutes.own == IdealPid(1.2, 4.0)
    assert in_time_unit(minutes, "s").plant.lags == (180.0,)


def test_a_unit_named_for_the_first_time_converts_nothing():
    unnamed = replace(HEATER, sheet=Sheet())
    assert in_time_unit(unnamed, "min") == replace(unnamed, sheet=Sheet(time_unit="min"))


@settings(max_examples=25, deadline=None)
@given(designs, st.sampled_from(["s", "min", "h"]))
def test_there_and_back_is_the_same_design(design, unit):
    start = replace(design, sheet=replace(design.sheet, time_unit="s"))
    back = in_time_unit(in_time_unit(start, unit), "s")
    assert back.plant.lags == pytest.approx(start.plant.lags, rel=1e-15)
    assert back.plant.k == pytest.approx(start.plant.k, rel=1e-14)
    assert back.sheet == start.sheet


def test_facts_of_a_step_test_are_converted_with_their_plant():
    facts = SettlingFacts(5, 11, 20, 200)
    minutes = in_time_unit(Design(facts.plant, facts=facts, sheet=Sheet(time_unit="s")), "min")
    assert minutes.facts.t63 == 200 / 60
    assert minutes.plant.lags == pytest.approx((3.0,), rel=1e-15)
    level = SlopeFacts(10, 0.3, 2, 60)
    hours = in_time_unit(Design(level.plant, facts=level, sheet=Sheet(time_unit="min")), "h")
    assert (hours.facts.duration, hours.plant.k) == (1.0, 0.03)


def test_limits_of_the_output_stay_on_its_scale_when_the_operating_point_moves():
    valve = Design(sheet=Sheet(OP_now=45), actuator=Actuator(u_min=-45, u_max=55))
    moved = put(valve, "OP_now", 60).actuator
    assert (moved.u_min, moved.u_max) == (-60, 40)
    assert put(valve, "OP_now", None).actuator == valve.actuator
    with pytest.raises(InvalidParameter, match="OP_now must be within the limits of the output, 0 to 100, found 110"):
        put(valve, "OP_now", 110)


def test_margins_do_not_know_the_unit_and_times_are_sixty_times_smaller():
    level = Design(Plant(0.05, 2.0, integrators=1), Tuning(), sheet=Sheet(time_unit="s"))
    seconds, minutes = (study(each.plant, each.tuning) for each in (level, in_time_unit(level, "min")))
    assert minutes.margins.Ms == pytest.approx(seconds.margins.Ms, rel=1e-12)
    assert minutes.controller.Kc == pytest.approx(seconds.controller.Kc, rel=1e-12)
    assert 60 * minutes.controller.tau_I == pytest.approx(seconds.controller.tau_I, rel=1e-12)
    assert 60 * minutes.margins.delay_margin == pytest.approx(seconds.margins.delay_margin, rel=1e-9)


def test_per_cent_of_span():
    assert Sheet(PV_low=0, PV_high=200, OP_low=0, OP_high=100).per_cent_of_span == 2.0
    assert Sheet(PV_low=0, PV_high=200).per_cent_of_span is None


def test_a_range_that_ends_before_it_begins_is_refused():
    with pytest.raises(InvalidParameter, match="PV_high must be > PV_low = 100, found 20"):
        Sheet(PV_low=100, PV_high=20)
    with pytest.raises(InvalidParameter, match="OP_now must be within 0 to 100, found 145"):
        Sheet(OP_low=0, OP_high=100, OP_now=145)


def test_the_gain_of_a_controller_falls_as_that_of_the_plant_grows():
    assert SeriesPid(2.0, 120.0, 30.0).rescaled(gain=0.5) == SeriesPid(1.0, 120.0, 30.0)


def test_a_unit_in_which_a_number_is_out_of_bounds_is_refused_in_words_and_nothing_changes():
    app = unfold(run_page("tuning", plant="exp(-1e6s)/(1e7s+1)", unit="h"), "sheet")
    app.selectbox(key="sheet_unit").set_value("ms").run()
    assert not app.exception
    assert address(app)["unit"] == "h"
    assert "the unit stays h" in texts(app)


def test_another_unit_converts_what_is_on_the_page_and_says_so():
    app = unfold(run_page("tuning", plant="2.2exp(-20s)/(180s+1)", unit="s"), "sheet")
    app.selectbox(key="sheet_unit").set_value("min").run()
    assert parse_plant(address(app)["plant"]).lags == (3.0,)
    assert "converted from s to min" in texts(app)


def test_a_unit_within_another_is_read_in_one_way():
    level = Sheet(time_unit="min", PV_unit="m", OP_unit="m3/h")
    assert [unit_of(what, level) for what in ("OP", "OP/PV", "PV time")] == ["m3/h", "(m3/h)/m", "m min"]
    assert unit_of("OP/PV", Sheet(OP_unit="%")) == ""
