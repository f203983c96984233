"""Half-rule page: the story, the numbers, the advice, without a browser."""

import json
import math
import re

import pytest

from .tools import address, run_page, texts

EXAMPLE = "exp(-3s)/((6s+1)(4s+1)(2s+1))"  # [V06] example 1


def reduced(plant=EXAMPLE, **parameters):
    return run_page("half_rule", plant=plant, **parameters)


def said(app):
    return texts(app) + "\n".join(item.value for kind in ("latex", "info", "success") for item in app.get(kind))


def test_the_model_of_the_literature_is_on_the_screen_with_its_story():
    app = reduced()
    text = said(app)
    assert r"G_r(s) = \frac{e^{-7 s}}{8 s + 1}" in text  # tau1 8, theta 7
    assert r"\theta = 3 + 2 + 2 = 7" in text
    assert r"\tau_1 = 6 + \frac{4}{2} = 8" in text
    assert len(app.get("plotly_chart")) == 2  # budget, step; Bode and error when they are opened


@pytest.mark.parametrize(
    ("view", "label"), [("Bode", "Bode diagrams"), ("Error over frequency", "Relative model error")]
)
def test_the_other_comparisons_are_drawn_when_they_are_opened(view, label):
    app = run_page("half_rule", view, "comparison")
    assert label in app.get("plotly_chart")[1].proto.alt


def test_order_two_sampling_period_and_rules_change_the_model():
    assert r"\frac{e^{-4 s}}{(6 s + 1) (5 s + 1)}" in said(reduced(order="2"))  # [V06]: tau2 5, theta 4
    app = reduced(order="2")
    app.text_input(key="half_rule_sampling").set_value("1").run()
    app.checkbox(key="allowed_h").check().run()
    assert r"\frac{e^{-4.5 s}}{(6 s + 1) (5 s + 1)}" in said(app)  # and h/2
    assert address(app)["h"] == "1"
    zeros = "(0.3s+1)exp(-s)/((5s+1)(s+1))"
    assert "1998 rule" in said(reduced(zeros, rules="1998"))
    assert "Rule T" in said(reduced(zeros))


def test_whether_order_two_pays_is_said():
    assert "(order 2) pays" in said(reduced())
    assert "brings little" in said(reduced("exp(-8s)/((6s+1)(4s+1)(2s+1))"))
    assert "does not pay" in said(reduced("exp(-s)/(s+1)"))


def test_the_error_comes_as_numbers_with_a_verdict():
    text = said(reduced())
    assert "Good enough" in text
    assert re.search(r"limit 1 \\\[\[RMS86\]\(.*?\) eq\. 10", text)  # a link to the source
    # at t = 7 the model still waits, the plant is 4 past its dead time: 1 - 4.5 e^{-4/6} + 4 e^{-1} - 0.5 e^{-2}
    y = 1 - 4.5 * math.exp(-4 / 6) + 4 * math.exp(-1) - 0.5 * math.exp(-2)
    assert f"**{y:.3g}**" in text
    assert "t = 7$." in text


def test_several_self_consistent_delays_are_all_shown():
    app = reduced("(6s+1)(3s+1)exp(-0.3s)/((10s+1)(8s+1)(s+1))")
    (table,) = [frame.value for frame in app.dataframe]
    assert list(table["θ"]) == ["0.3", "0.8"]  # theory.md sect. 2: E12
    assert list(table["taken"]).count("chosen") == 1


@pytest.mark.parametrize("plant", ["1/(s^2+0.6s+1)/(s^2+0.2s+1)", "exp(-s)/s^3", "exp(-s)/((s-1)(s-2))"])
def test_a_plant_that_is_not_covered_is_named_with_what_to_do(plant):
    app = reduced(plant)
    (error,) = [item.value for item in app.error]
    assert "does not cover this plant" in error
    assert ":" in error  # the remedy follows the reason
    assert not app.get("plotly_chart")


@pytest.mark.parametrize(
    "plant",
    [
        "3 exp(-2s)",
        "exp(-s)/s",
        "exp(-s)/s^2",
        "1/(5s+1)",
        "exp(-s)/(20s-1)",
        "1/(s^2+0.6s+1)",
        "(20s+1)exp(-s)/(s(2s+1))",
    ],
)
def test_every_kind_of_model_has_a_page(plant):
    for chart in reduced(plant).get("plotly_chart"):
        assert json.loads(chart.proto.spec)["data"]


def test_a_model_without_a_controller_is_told_all_the_same():
    app = reduced("exp(-s)/(s^2+1)")
    assert "G_r(s)" in said(app)
    assert "ζ must be > 0" in app.error[0].value
