"""Gain schedule on its tab: points typed and pasted, kept in link and unit, Ms between them, code and table."""

import csv
import io

import numpy as np
import pytest

from pages.common.session import links
from pages.common.session.time_unit import in_time_unit
from pages.common.take_home.operating_points import points_of, schedule_code, schedule_csv, schedule_of, table_of
from simc_core import InvalidParameter
from tests.pages.tools import address, run_page, texts

POINTS = "20~1~4~20!50~2~3~15!80~5~2~8"
TABLE = ((20, 1, 4, 20), (50, 2, 3, 15), (80, 5, 2, 8))


def opened(**given):
    return run_page("take_home", "Schedule", "home_views", **{"plant": "exp(-4s)/(20s+1)", "unit": "s"} | given)


def test_without_points_the_page_says_what_they_are_and_takes_them():
    app = opened()
    assert "a row for each point" in app.info[0].value
    app.text_area(key="points_text").set_value("SP\tk\ttheta\ttau\n20\t1\t4\t20\n50\t2\t3\t15\n80\t5\t2\t8").run()
    assert address(app)["points"] == POINTS
    table = app.dataframe[0].value
    assert table["Kc"].tolist() == ["2.5", "1.25", "0.4"]  # tau1/(2 k theta)
    assert table["τI [s]"].tolist() == ["20", "15", "8"]
    assert set(table["Ms"]) == {"1.59"}
    assert not app.exception


def test_what_cannot_be_read_stays_and_the_points_before_stay_in_use():
    app = opened(points=POINTS)
    app.text_area(key="points_text").set_value("20 1 4 20\n10 2 3 15").run()
    assert "values must increase" in app.error[0].value
    assert app.text_area(key="points_text").value == "20 1 4 20\n10 2 3 15"
    assert address(app)["points"] == POINTS
    assert len(app.dataframe[0].value) == 3


def test_language_and_kind_of_interpolation_are_in_the_link():
    app = opened(points=POINTS, between="PB", language="c")
    (code,) = app.get("code")
    assert "void pid_schedule(Pid *pid, PID_REAL x)" in code.value
    assert "largest Ms 1.59" in texts(app)
    app.selectbox(key="schedule_language").set_value("st").run()
    assert address(app)["language"] == "st"
    assert (address(app)["between"], address(app)["points"]) == ("PB", POINTS)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("20 1 4 20\n50 2 3 15\n80 5 2 8", TABLE),
        ("20;1;4;20\r\n\r\n50;2;3;15\r\n80;5;2;8\r\n", TABLE),
        ("0 0,5 1\n1 0,7 1", ((0, 0.5, 1), (1, 0.7, 1))),
        ("0 1 1 10 3\n1 2 1 8 2", ((0, 1, 1, 10, 3), (1, 2, 1, 8, 2))),
        ("", ()),
    ],
)
def test_rows_are_read_as_people_have_them(text, found):
    assert points_of(text) == found


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("1 2 3 4", "2 rows at least"),
        ("1 2\n3 4", "row 1 must have 3 to 5 numbers"),
        ("1 2 -3 4\n2 2 3 4", "row 1: theta must be >= 0, found -3"),
        ("1 2 3 4\n2 2 3", "models must be reduced models of one kind"),
        ("1 2 3 4\n2 -2 3 4", "gains must have one sign"),
        ("1 2 x 4\n2 2 3 4", "row 1"),
        ("\n".join(f"{i} 1 1 1" for i in range(21)), "at most 20 entries"),
    ],
)
def test_rows_that_make_no_schedule_are_refused_in_words(text, why):
    with pytest.raises(InvalidParameter, match=why):
        points_of(text)


def test_another_time_unit_is_the_same_schedule():
    design, _ = links.decode({"points": POINTS, "unit": "s", "plant": "exp(-4s)/(20s+1)"})
    other = in_time_unit(design, "min")
    assert schedule_of(other).settings(35).tau_I == pytest.approx(schedule_of(design).settings(35).tau_I / 60)
    assert schedule_of(other).worst_Ms() == pytest.approx(schedule_of(design).worst_Ms(), rel=1e-9)
    hours = in_time_unit(design, "h")
    scopes = [{}, {}]
    for each, scope in zip((design, hours), scopes, strict=True):
        exec(schedule_code(each), scope)

    class Pid:
        Kp = Ki = Kd = 0.0

    pids = []
    for scope in scopes:
        pid = Pid()
        scope["schedule"](pid, 33.0)
        pids.append((pid.Kp, pid.Ki, pid.Kd))
    assert pids[1] == pytest.approx(pids[0], rel=1e-12)


def test_integrating_points_keep_their_slope_in_another_unit():
    design, _ = links.decode({"points": "0~0.5~1!1~0.7~1", "unit": "min", "plant": "0.5 exp(-s)/s"})
    other = in_time_unit(design, "s")
    assert other.home.points[0] == pytest.approx((0, 0.5 / 60, 60))


def test_the_table_as_csv_is_the_table():
    design, _ = links.decode({"points": POINTS, "between": "PB", "unit": "s", "plant": "exp(-4s)/(20s+1)"})
    table = table_of(schedule_of(design))
    head, *rows = csv.reader(io.StringIO(schedule_csv(table, design.sheet)))
    assert head == ["value", "Kp", "tau_I [s]", "tau_D [s]"]
    assert np.array([list(map(float, row)) for row in rows]) == pytest.approx(
        np.array([(20, 2.5, 20, 0), (50, 1.25, 15, 0), (80, 0.4, 8, 0)])
    )
