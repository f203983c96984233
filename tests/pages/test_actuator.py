"""The Actuator tab and its mark, without a browser."""

import json
import re

import pytest

from pages.common.session import links
from pages.common.studies.single import present_study, time_responses

from .tools import address, run_page, texts, unfold

EXAMPLE = "exp(-3s)/((6s+1)(4s+1)(2s+1))"  # [V06] example 1
VIEWS = ("Live", "Figures", "Bode of L", "Model error", "As built", "Compare")


def opened(view="As built", **parameters):
    return run_page("tuning", view, plant=EXAMPLE, **parameters)


def strip(app):
    (html,) = [item.proto.body for item in app.get("html") if '<div class="strip built' in item.proto.body]
    return html


def cell(app, label):
    return re.search(f"<small>{label}</small><b>(.*?)</b>", strip(app))[1]


def curves(app):
    return [{trace["name"] for trace in json.loads(chart.proto.spec)["data"]} for chart in app.get("plotly_chart")]


@pytest.mark.parametrize("view", VIEWS)
def test_every_view_is_marked_where_the_loop_as_built_is_another(view):
    assert "As built:" not in texts(opened(view, r="2"))
    app = opened(view, u_min="0", u_max="1.2", noise="0.02", sampling="0.5")
    assert "u limited to 0 … 1.2, measurement noise 0.02, sampled every 0.5" in texts(app)


@pytest.mark.parametrize(
    ("given", "words"),
    [({"u_min": "-1"}, "u limited to ≥ -1"), ({"u_max": "3"}, "u limited to ≤ 3"), ({"sampling": "2"}, "every 2")],
)
def test_one_thing_alone_is_enough_for_the_mark(given, words):
    assert words in texts(opened("Bode of L", **given))


def test_off_by_default_and_then_the_linear_loop_itself():
    app = opened()
    assert curves(app) == [{"r", "linear", "as built"}, {"linear", "as built"}]
    built, linear = map(float, cell(app, "IAE: as built · linear").split(" · "))
    assert built == pytest.approx(linear, rel=2e-3)
    assert "Nothing is limited yet" in texts(app)


def test_a_limit_is_typed_and_emptied_again():
    app = opened(tau_c="2")
    app.text_input(key="widget_u_max").set_value("1.1").run()
    assert address(app)["u_max"] == "1.1"
    assert cell(app, "u applied").endswith("… 1.1")
    assert float(cell(app, "Time at a limit")) > 0
    assert {"no anti-windup", "u max"} <= curves(app)[1]
    assert "Tracking time $T_t$ = 8" in texts(app)  # tau_I
    app.text_input(key="widget_T_t").set_value("2").run()
    assert "$T_t$ = 2" in texts(app)
    app.text_input(key="widget_u_max").set_value("").run()
    assert "u_max" not in address(app)
    assert "Time at a limit" not in strip(app)


def test_heights_noise_and_sampling_have_their_words():
    app = opened(r="2", d="0", noise="0.1", sampling="1", h="1")
    assert "Set point 2 from t = 0." in texts(app)
    assert "new value every 1" in texts(app)
    assert "The half rule allows for the sampling" in texts(app)
    assert "Largest move of u" in strip(app)


def test_a_loop_that_is_not_stable_has_curves_and_no_numbers():
    app = opened(tau_c="0.01", order="2", filter="3", u_min="-1", u_max="2")
    assert "not stable" in strip(app)
    assert "<b>" not in strip(app)
    assert len(curves(app)) == 2


def test_what_is_too_costly_is_said_in_the_tab_and_the_rest_of_the_page_stays():
    app = opened(sampling="1e-6")
    assert "steps for a sampling period of 1e-06" in "\n".join(error.value for error in app.error)
    assert "As built:" in texts(app)
    assert not app.get("plotly_chart")


SITE = {"plant": "2.2 exp(-20s)/(180s+1)", "OP_low": "0", "OP_high": "100", "OP_now": "45", "OP_unit": "%"}


def site(view="As built", **parameters):
    return run_page("tuning", view, **SITE | parameters)


def test_limits_are_typed_on_the_scale_of_OP_and_kept_as_deviations():
    app = site()
    assert app.text_input("widget_u_max").label == "Highest OP [%]"
    app.text_input("widget_u_max").set_value("45,4").run()
    assert float(address(app)["u_max"]) == pytest.approx(0.4, rel=1e-12)
    assert app.text_input("widget_u_max").value == "45,4"
    assert "r = 1 needs OP = 45.5, the limit is 45.4: it is never reached" in texts(app)
    assert "OP [%] limited to ≤ 45.4" in texts(app)


def test_what_is_out_of_reach_is_told_in_every_view_once():
    for view in ("Bode of L", "As built"):
        assert texts(site(view, u_max="0.4")).count("it is never reached") == 1


def test_a_limit_beyond_where_OP_is_now_is_refused_on_that_scale():
    app = site()
    app.text_input("widget_u_min").set_value("50").run()
    assert "Lowest OP must be ≤ 45, which is OP now, found 50" in app.error[0].value
    assert "u_min" not in address(app)


def test_the_range_of_the_loop_sheet_is_one_click():
    app = site()
    assert app.button("range_of_OP").label == "Limits as in the loop sheet: OP 0 to 100 [%]"
    app.button("range_of_OP").click().run()
    assert (address(app)["u_min"], address(app)["u_max"]) == ("-45", "55")
    assert "range_of_OP" not in [button.key for button in app.button]
    unfold(app, "sheet")
    app.text_input("widget_OP_now").set_value("60").run()  # the valve is the same, the limits stay on its scale
    assert (address(app)["u_min"], address(app)["u_max"]) == ("-60", "40")


@pytest.mark.parametrize("view", VIEWS)
def test_a_load_or_a_set_point_that_is_nothing_leaves_every_view_whole(view):
    opened(view, d="0")
    opened(view, r="0", d="-0.5", d_time="40")


def test_heights_and_times_are_fields_and_ramps_are_offered_for_a_level():
    app = unfold(opened("Bode of L"), "excitation")
    app.text_input("widget_r").set_value("-2,5").run()
    app.text_input("widget_d_time").set_value("60").run()
    assert (address(app)["r"], address(app)["d_time"]) == ("-2.5", "60")
    assert "widget_r_ramp" not in [field.key for field in app.text_input]
    app = unfold(run_page("tuning", "Live", plant="0.05 exp(-2s)/s", unit="min"), "excitation")
    assert app.text_input("widget_d_ramp").label == "Load over [min]"
    app.text_input("widget_d_ramp").set_value("30").run()
    assert address(app)["d_ramp"] == "30"
    assert not app.exception


def test_an_actuator_with_a_resolution_has_a_limit_cycle_that_is_called_so():
    app = opened(sampling="0.5", r="0.977")
    assert not app.info
    app.text_input(key="widget_resolution").set_value("0,2").run()
    assert address(app)["resolution"] == "0.2"
    (told,) = (each.value for each in app.info if "Limit cycle" in each.value)
    assert "not from the tuning" in told
    assert "resolution 0.2, sampled every 0.5" in texts(app)


def test_the_fastest_move_is_emptied_again_and_follows_the_time_unit():
    app = opened(unit="s", rate_limit="0.5", dead_band="0.1", backlash="0.05")
    assert "fastest move 0.5" in texts(app)
    assert app.text_input(key="widget_rate_limit").value == "0.5"
    unfold(app, "sheet").selectbox(key="sheet_unit").set_value("min").run()
    assert float(address(app)["rate_limit"]) == pytest.approx(30)
    app.text_input(key="widget_rate_limit").set_value("").run()
    assert "rate_limit" not in address(app)
    assert not app.exception


def test_the_set_point_stops_at_its_limit_and_rises_at_its_rate():
    """r = 2 with a limit 1.5 and a rate 0.25: the ramp to 1.5 in 6 that r_ramp = 6 makes."""
    limited, _ = links.decode({"plant": EXAMPLE, "r": "2", "r_high": "1.5", "r_rate": "0.25"})
    plain, _ = links.decode({"plant": EXAMPLE, "r": "1.5", "r_ramp": "6"})
    both = [time_responses([present_study(each)], each.excitation)[0] for each in (limited, plain)]
    assert (both[0].y == both[1].y).all()
    app = unfold(opened("Bode of L", r="2", r_high="1.5", r_rate="0.25"), "excitation")
    assert "The set point stops at 1.5" in texts(app)
    app.text_input(key="widget_r_high").set_value("-1").run()
    assert "Highest set point must be ≥ 0" in app.error[0].value
    assert address(app)["r_high"] == "1.5"


def test_sampled_margins_stand_beside_those_of_the_linear_loop():
    """FOPDT 8, 1 under PI 4, 8: Ms 1.5905, sampled at 0.2 1.6908, one scan later 1.898; PM at 0.1
    59.823 [measured apart]."""
    given = {"plant": "exp(-s)/(8s+1)"}
    app = run_page("tuning", "As built", **given, sampling="0.2")
    assert cell(app, "Ms: sampled · linear") == "1.69 · 1.59"
    app = run_page("tuning", "As built", **given, sampling="0.2", scans="1")
    assert cell(app, "Ms: sampled · linear") == "1.9 · 1.59"
    assert "sampled every 0.2, its output written one scan later" in texts(app)
    app = run_page("tuning", "As built", **given, sampling="0.1")
    assert cell(app, r"PM \[°\]: sampled · linear").startswith("59.8 · ")
