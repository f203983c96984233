"""The Actuator tab and its mark, without a browser."""

import json
import re

import pytest

from .tools import address, run_page, texts

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
    assert "u limited to [0, 1.2], measurement noise 0.02, sampled every 0.5" in texts(app)


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
    assert "Set-point step 2 at t = 0." in texts(app)
    assert "new value every 1" in texts(app)
    assert "(now 1), adds h/2" in texts(app)
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
