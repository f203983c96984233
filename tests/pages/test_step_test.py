"""Facts of a step test typed on the plant page: the plant follows, and the facts travel with it."""

import pytest

from simc_core import Plant, parse_plant
from tests.pages.tools import address, run_page, texts

UNITS = {"unit": "min", "OP_unit": "%", "PV_unit": "°C"}


def opened(**parameters):
    app = run_page("plant", **parameters)
    app.segmented_control("plant_way").set_value("Step test").run()
    return app


def fill(app, **numbers):
    for part, text in numbers.items():
        app.text_input(f"plant_step_{part}").set_value(text).run()


def shown(app, *parts):
    return [app.text_input(f"plant_step_{part}").value for part in parts]


def test_four_facts_make_the_plant_and_stand_in_the_link():
    app = opened(**UNITS)
    before = address(app)["plant"]
    fill(app, dOP="5", dPV="11", theta="0,5")
    assert "Still to fill in: Time to 63 % from the step" in texts(app)
    assert address(app)["plant"] == before
    fill(app, t63="3,5")
    assert parse_plant(address(app)["plant"]) == Plant(2.2, 0.5, (3.0,))
    assert address(app)["facts"] == "step~5~11~0.5~3.5"
    assert "Read: gain 2.2, lag 3, dead time 0.5." in texts(app)


def test_the_units_of_the_loop_stand_in_the_labels():
    app = opened(**UNITS)
    labels = [app.text_input(f"plant_step_{part}").label for part in ("dOP", "dPV", "theta", "t63")]
    assert [label.split("[")[1] for label in labels] == ["%]", "°C]", "min]", "min]"]


def test_a_link_with_facts_opens_with_them():
    app = run_page("plant", plant="2.2 exp(-20 s)/(180 s + 1)", facts="movement~5~11~20~180")
    assert shown(app, "dOP", "dPV", "theta", "tau1") == ["5", "11", "20", "180"]
    assert address(app)["facts"] == "movement~5~11~20~180"


def test_where_63_per_cent_counts_from_is_a_choice():
    app = opened(plant="2.2 exp(-20 s)/(160 s + 1)", facts="step~5~11~20~180")
    app.segmented_control("plant_step_kind").set_value("63 % from movement").run()
    assert parse_plant(address(app)["plant"]) == Plant(2.2, 20.0, (160.0,))  # nothing is reinterpreted
    fill(app, tau1="180")
    assert parse_plant(address(app)["plant"]) == Plant(2.2, 20.0, (180.0,))


def test_a_slope_makes_an_integrating_plant_with_a_negative_gain():
    app = opened(unit="min")
    app.segmented_control("plant_step_kind").set_value("Integrating").run()
    fill(app, dOP="-10", rise="0,3", theta="2")
    assert parse_plant(address(app)["plant"]) == Plant(-0.03, 2.0, integrators=1)
    fill(app, duration="60")
    assert parse_plant(address(app)["plant"]).k == pytest.approx(-0.0005, rel=1e-15)
    assert address(app)["facts"] == "slope~-10~0.3~2~60"


def test_a_time_before_the_dead_time_is_refused_in_the_words_of_the_page():
    app = opened()
    before = address(app)["plant"]
    fill(app, dOP="5", dPV="11", theta="20", t63="3")
    assert "Time to 63 % from the step must be ≥ Dead time θ = 20" in app.error[0].value
    assert address(app)["plant"] == before
    fill(app, t63="0")
    assert "Time to 63 % from the step must be ≥" in app.error[0].value
    fill(app, t63="200")
    assert not app.error


def test_a_change_of_op_of_nothing_stays_in_its_field_with_the_reason():
    app = opened()
    fill(app, dOP="0")
    assert "Change of OP must not be zero" in app.error[0].value
    assert shown(app, "dOP") == ["0"]


def test_facts_go_when_the_plant_comes_from_elsewhere():
    app = opened(plant="2.2 exp(-20 s)/(160 s + 1)", facts="step~5~11~20~180")
    app.segmented_control("plant_way").set_value("Text").run()
    app.text_input("plant_text_text").set_value("3/(7s+1)").run()
    assert "facts" not in address(app)
    app.segmented_control("plant_way").set_value("Step test").run()
    assert shown(app, "dOP", "dPV") == ["", ""]
