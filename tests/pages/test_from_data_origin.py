"""What a link and the other pages know of a record and of the plant that was found in it."""

import re
from dataclasses import replace
from fractions import Fraction

import pytest

from pages.common.from_data.examples import EXAMPLES
from pages.common.from_data.work import work_on
from pages.common.session import links
from pages.common.session.design import Design
from pages.common.session.record import Chosen, Origin
from pages.common.session.time_unit import in_time_unit
from simc_core import DataError, FirstOrderDelay, InvalidParameter, Plant
from tests.pages.from_data import html
from tests.pages.tools import address, run_page


def test_a_link_opens_its_example_with_the_model():
    app = run_page("from_data", example="step")
    shown = html(app)
    assert 'aria-label="Parameters of the model' in shown
    assert re.search(r"<small>k</small><b>1\.5\d*</b> <i>°C/%</i>", shown)
    assert app.get("plotly_chart")[0].proto.alt.startswith("Record of PV, OP over 699 s")


def test_a_link_to_no_example_is_told():
    app = run_page("from_data", example="nothing")
    assert "example must be one of" in app.error[0].value
    assert "example" not in address(app)


def test_the_model_goes_to_the_tuning_with_its_units_and_origin():
    app = run_page("from_data", example="step")
    app.button(key="tune").click().run()
    assert not app.exception
    given = address(app)
    design, ignored = links.decode(given)
    assert not ignored
    assert design.plant.k == pytest.approx(1.5, rel=0.01)
    assert design.plant.theta == pytest.approx(12, abs=0.4)
    assert (design.sheet.time_unit, design.sheet.PV_unit, design.sheet.OP_unit) == ("s", "°C", "%")
    assert design.origin.structure == "FOPDT"
    assert design.origin.source == EXAMPLES["step"].title
    assert design.origin.samples == 700
    assert design.record.example == "step"


@pytest.mark.parametrize("unit", ["min", "h", "ms"])
def test_origin_follows_the_plant_into_another_time_unit(unit):
    plant = FirstOrderDelay(2.0, 12.0, 60.0).plant
    origin = Origin(plant, "FOPDT", (0.1, 1.2, 3.0), 0.97, 500, "test.csv")
    design = in_time_unit(
        replace(Design(), plant=plant, origin=origin, sheet=replace(Design().sheet, time_unit="s")), unit
    )
    per = {"min": Fraction(1, 60), "h": Fraction(1, 3600), "ms": Fraction(1000)}[unit]
    assert design.origin.plant == design.plant
    assert design.origin.errors == pytest.approx((0.1, 1.2 * float(per), 3.0 * float(per)))
    back, ignored = links.decode(links.encode(design))
    assert not ignored
    assert back.origin == design.origin


def test_origin_ends_with_its_plant():
    plant = FirstOrderDelay(2.0, 12.0, 60.0).plant
    design = replace(Design(), plant=plant, origin=Origin(plant, "FOPDT", (0.1, 1.2, 3.0), 0.97, 500))
    assert replace(design, plant=Plant(1.0, 1.0, (2.0,))).origin is None


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("origin", "FOPDT~0.9~700~0.1~nan~1~x"),
        ("origin", "FOPDT~0.9"),
        ("origin", "<b>~1"),
        ("bad", "1~2~3"),
        ("bad", "1~x"),
        ("begin", "inf"),
        ("structure", "FOPDT2"),
        ("example", "../../etc"),
    ],
)
def test_what_a_link_says_wrongly_is_ignored_and_told(name, text):
    design, ignored = links.decode({name: text})
    assert design == Design()
    assert [each.name for each in ignored] == [name]


def test_bounds_of_what_is_chosen():
    with pytest.raises(InvalidParameter, match="end must be > begin = 5"):
        Chosen(begin=5, end=5)
    with pytest.raises(DataError, match="empty"):
        work_on("file", b"")


def test_every_page_tells_where_an_identified_plant_comes_from():
    plant = FirstOrderDelay(2.0, 12.0, 60.0).plant
    origin = Origin(plant, "FOPDT", (0.1, 1.2, 3.0), 0.97, 500, "a*b*.csv")
    link = links.encode(replace(Design(), plant=plant, origin=origin))
    for page in ("plant", "tuning"):
        told = [item.proto.help for item in run_page(page, **link).caption if item.proto.help]
        assert any("`a*b*.csv`" in text and "fit 97.0 %, 500 samples" in text and "θ 1.2" in text for text in told)


def test_a_link_with_a_rare_structure_opens_it():
    app = run_page("from_data", example="step", structure="inverse")
    assert app.segmented_control(key="structure").value == "inverse"
    assert "<small>T</small>" in html(app)
