"""Several records of one process on the page From data: fitted together, each shown in turn, and made a schedule."""

import re

import numpy as np
import pytest

from pages.common.session import links
from pages.common.session.time_unit import in_time_unit
from tests.identification.simulated import rise
from tests.pages.tools import address, run_page, texts


def record(u0: float, k: float, seed: int = 0, unit: str = "s", theta: float = 6.0) -> str:
    """A step of 10 at t = 60 of k e^{-theta s}/(20 s + 1)."""
    t = np.arange(300.0)
    y = 20 + 10 * k * rise(t - 60 - theta, 20.0) + 0.05 * np.random.default_rng(seed).normal(size=300)
    rows = "\n".join(f"{a:.0f};{b:.3f};{u0 + 10 * (a >= 60):.0f}" for a, b in zip(t, y, strict=True))
    return f"Time [{unit}];PV;OP\n{rows}\n"


def paste(app, text: str, turn: int):
    app.text_area(key=f"trend_paste_{turn}").set_value(text)
    next(button for button in app.button if button.label == "Read").click().run()
    assert not app.exception
    return app


def two(view: str = "", k: float = 2.0, **how):
    app = run_page("from_data", view=view, tabs="ways")
    paste(app, record(30, 2.0), 0)
    app.toggle(key="add_record").set_value(True).run()
    return paste(app, record(60, k, 1, **how), 1)


def test_two_records_are_fitted_together():
    app = two()
    assert "Fitted together with" in texts(app)
    assert "600 samples" in texts(app)
    app.button(key="tune").click().run()
    design, ignored = links.decode(address(app))
    assert not ignored
    assert design.plant.k == pytest.approx(2, rel=0.02)
    assert design.origin.samples == 600
    assert design.origin.source == "pasted rows and 1 more"


def test_another_one_is_shown_with_what_was_chosen_of_it():
    app = two()
    app.text_input(key="part_end").set_value("200").run()
    assert "501 samples" in texts(app)
    app.button(key="show_0").click().run()
    assert not app.exception
    assert "end" not in address(app)
    assert "501 samples" in texts(app)  # the other one is still cut
    app.button(key="show_0").click().run()
    assert address(app)["end"] == "200"


def test_one_is_taken_out_again():
    app = two()
    app.button(key="remove_0").click().run()
    assert "300 samples" in texts(app)
    assert "Fitted together with" not in texts(app)


def test_another_unit_of_time_is_not_fitted_along():
    app = two(unit="min")
    assert any("not fitted along: its time is in min, here in s" in item.value for item in app.warning)
    assert "300 samples" in texts(app)


def test_without_the_switch_a_record_takes_the_place_of_the_other():
    app = run_page("from_data")
    paste(app, record(30, 2.0), 0)
    paste(app, record(60, 1.0, 1), 1)
    assert "Fitted together with" not in texts(app)
    assert "300 samples" in texts(app)


def test_their_gains_make_a_schedule_on_the_page_take_home():
    app = two("Operating points", 1.0)
    app.button(key="tune_points").click().run()
    assert not app.exception
    points = [[float(number) for number in point.split("~")] for point in address(app)["points"].split("!")]
    assert [point[0] for point in points] == [35, 65]
    for point, k in zip(points, (2.0, 1.0), strict=True):
        assert point[1:] == pytest.approx([k, 6, 20], rel=0.05)
    home = run_page("take_home", view="Schedule", tabs="home_views", **address(app))
    table = home.dataframe[0].value
    assert list(table["value"]) == ["35", "65"]
    assert float(table["Kc"][1]) == pytest.approx(2 * float(table["Kc"][0]), rel=0.05)


def test_one_operating_point_makes_none():
    app = run_page("from_data", view="Operating points", tabs="ways")
    paste(app, record(30, 2.0), 0)
    assert any(re.search("A gain schedule needs two", item.value) for item in app.caption)
    assert not [button for button in app.button if button.key == "tune_points"]


def test_gains_that_differ_are_told_with_the_offer_of_a_schedule_and_on_the_tuning_page():
    app = two(k=1.0)
    assert "from record to record, 1 from 60 to 70 in record 2 and 2 from 30 to 40 in record 1" in texts(app)
    assert "Record 2: `pasted rows`" in texts(app)
    assert not [button for button in app.button if button.key == "tune_points"]
    assert "Not for gains that differ" in texts(app)
    app.button(key="to_points").click().run()
    assert not app.exception
    assert app.button(key="tune_points")
    app = two(k=1.0)
    app.button(key="tune").click().run()
    here = address(app)
    design, ignored = links.decode(here)
    assert not ignored
    assert design.origin.gains == pytest.approx((1, 2), rel=0.02)
    assert in_time_unit(design, "min").origin.gains == design.origin.gains
    tuning = run_page("tuning", **here)
    assert any("show gains of 1" in item.value and "gain schedule" in item.value for item in tuning.warning)


def test_equal_gains_are_offered_no_schedule():
    app = two()
    assert "gain differs" not in texts(app)
    assert not [button for button in app.button if button.key == "to_points"]
    app.button(key="tune").click().run()
    assert not run_page("tuning", **address(app)).warning
