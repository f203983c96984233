"""Tuning page: what it says, and what it must not say, without a browser."""

import json
import math
import re

import pytest

from pages.common.session.tuning import Tuning
from pages.common.studies.single import study
from pages.common.tuning.readout import strip_html
from simc_core import parse_plant
from simc_core.studies.bands import band_of

from .tools import address, copyables, run_page, texts, unfold

EXAMPLE = "exp(-3s)/((6s+1)(4s+1)(2s+1))"  # [V06] example 1
PANELS = 4  # y, u, Nyquist, |S| and |T|


def tuned(view="Figures", plant=EXAMPLE, **parameters):
    return run_page("tuning", view, plant=plant, **parameters)


def copied(app):
    """The settings as the copy button gives them, as numbers; the link in the sidebar is another of its kind."""
    (text,) = [text for text in copyables(app) if " = " in text]
    lines = dict(line.split(" = ") for line in text.splitlines())
    assert lines.pop("action") == "reverse"
    return {name: float(value) for name, value in lines.items()}


def strip(app):
    (html,) = [item.proto.body for item in app.get("html") if '<div class="strip' in item.proto.body]
    return html


def specs(app):
    return [json.loads(chart.proto.spec) for chart in app.get("plotly_chart")]


def test_the_pi_controller_of_the_literature_is_on_the_screen():
    app = tuned()
    settings = copied(app)
    assert settings["Kc"] == pytest.approx(0.57, abs=0.005)  # [V06] example 1
    assert settings["tau_I"] == pytest.approx(8)
    assert any("<b>0.5714</b>" in item.proto.body for item in app.get("html"))
    assert len(specs(app)) == PANELS


def test_the_pid_controller_of_the_literature_is_on_the_screen():
    settings = copied(tuned(order="2", form="ideal"))
    assert settings["Kc"] == pytest.approx(1.38, abs=0.005)  # [V06] example 1, ideal form
    assert settings["tau_I"] == pytest.approx(11)
    assert settings["tau_D"] == pytest.approx(2.73, abs=0.005)


def test_all_three_forms_describe_one_controller():
    series = copied(tuned(order="2"))
    parallel = copied(tuned(order="2", form="parallel"))
    assert parallel["Kp"] == pytest.approx(series["Kc"] * (1 + series["tau_D"] / series["tau_I"]))
    assert parallel["Ki"] == pytest.approx(series["Kc"] / series["tau_I"])
    assert parallel["Kd"] == pytest.approx(series["Kc"] * series["tau_D"])


def test_the_exact_margins_of_a_first_order_plant_are_read():
    html = strip(tuned(plant="2 exp(-s)/(8s+1)", tau_c="1"))
    for value in ("1.59", "3.142", "61.35", "2.142"):  # theory.md sect. 3: Ms, GM = pi, PM, delay margin
        assert f"<b>{value}</b>" in html
    assert "robust (up to 1.7)" in html


@pytest.mark.parametrize(
    ("tau_c", "band", "words"), [("14", "calm", "robust"), ("4.5", "attention", "fair"), ("1", "alarm", "fragile")]
)
def test_ms_is_named_by_its_band_in_words(tau_c, band, words):
    html = strip(tuned(tau_c=tau_c))
    assert f'class="first {band}"' in html
    assert f"<span>{words}" in html


def test_a_loop_that_is_not_stable_shows_no_margins_and_no_metrics():
    unstable = {"order": "2", "tau_c": "0.001", "filter": "3"}  # two poles in the right half plane
    app = tuned(**unstable)
    html = strip(app)
    assert "Not stable" in html
    assert not any(word in html for word in ("<small>", "Overshoot", "title="))
    assert "not stable" in "\n".join(error.value for error in app.error)
    pictures = specs(app) + specs(tuned("Bode of L", **unstable))
    assert len(pictures) == PANELS + 1
    for spec in pictures:
        assert "not stable" in spec["layout"]["annotations"][0]["text"]
        shown = [text for trace in spec["data"] for text in trace.get("text", [])]
        assert not [text for text in shown if text.startswith(("Ms ", "Mt ", "GM", "PM", "delay"))]


def test_the_slider_the_exact_number_and_the_presets_set_one_tau_c():
    app = tuned()
    assert app.select_slider(key="tau_c_slider").value == 1.0
    app.text_input(key="tau_c_exact").set_value("9.25").run()
    assert address(app)["tau_c"] == "9.25"
    assert copied(app)["Kc"] == pytest.approx(8 / (9.25 + 7))
    unfold(app, "literature").button(key="preset_moderate").click().run()
    assert "tau_c" not in address(app)
    assert address(app)["speed"] == "moderate"  # a choice, which follows the plant
    assert float(app.text_input(key="tau_c_exact").value) == pytest.approx(56)  # max(tau1, 8 theta)
    assert "(slow)" in app.button(key="preset_moderate").label
    app.button(key="multiple_1.5").click().run()
    assert float(app.text_input(key="tau_c_exact").value) == pytest.approx(10.5)
    assert app.button(key="multiple_1.5").label == "1.5 θ: 10.5 (slow)"  # 63 % after 17.5, the plant alone after 15
    app.select_slider(key="tau_c_slider").set_value(0.1).run()
    assert float(app.text_input(key="tau_c_exact").value) == pytest.approx(0.7)
    app.button(key="preset_tight").click().run()
    assert not {"tau_c", "speed"} & set(address(app))
    assert copied(app)["Kc"] == pytest.approx(8 / 14)


def test_a_pinned_design_stays_what_it_was_and_is_drawn_and_listed():
    app = tuned()
    app.button(key="pin").click().run()
    app.text_input(key="tau_c_exact").set_value("20").run()
    names = {trace["name"] for trace in specs(app)[0]["data"]}
    assert names == {"r", "present", "A"}
    app.session_state["views"] = "Compare"
    app.run()
    (table,) = [frame.value for frame in app.dataframe if "present" in frame.value]
    values = table.set_index("quantity")
    assert values.loc["τc", "A"] == "7"
    assert values.loc["τc", "present"] == "20"
    assert float(values.loc["Kc", "A"]) == pytest.approx(0.5714)
    app.button(key="unpin_0").click().run()
    assert "pins" not in address(app)


@pytest.mark.parametrize(
    ("form", "rows"),
    [
        ("series", {"Kc": "2.222", "τI": "20", "τD": "0"}),  # SIMC of e^{-3s}/(20 s + 1), tau_c = 6: 20/9
        ("ideal", {"Kc": "2.222", "τI": "20", "τD": "0"}),
        ("parallel", {"Kp": "2.222", "Ki": "0.1111", "Kd": "0"}),
    ],
)
def test_the_comparison_is_in_the_form_that_is_chosen(form, rows):
    table = tuned("Compare", "exp(-3s)/(20s+1)", tau_c="6", form=form).dataframe[0].value
    found = dict(zip(table["quantity"], table["present"], strict=True))
    assert found | rows == found
    assert not ({"Kc", "Kp"} - set(rows)) & set(found)


def test_pure_integral_action_is_compared_as_such():
    """e^{-s} with tau_c = 1: K_I = 1/2."""
    table = tuned("Compare", "exp(-s)").dataframe[0].value
    found = dict(zip(table["quantity"], table["present"], strict=True))
    assert (found["KI"], found["Kc"]) == ("0.5", "–")


def test_four_designs_are_enough():
    app = tuned()
    for tau_c in ("8", "9", "10", "11"):
        app.text_input(key="tau_c_exact").set_value(tau_c).run()
        app.button(key="pin").click().run()
    assert app.button(key="pin").disabled
    assert len(address(app)["pins"].split("!")) == 4


def test_the_same_design_is_not_pinned_twice():
    app = tuned()
    app.button(key="pin").click().run()
    app.button(key="pin").click().run()
    assert len(address(app)["pins"].split("!")) == 1


def test_derivative_action_without_a_filter_is_called_by_its_name():
    assert "derivative has no filter" in texts(tuned(order="2"))
    assert "High-frequency gain $K_d$/$\\tau_F$ = 7.5" in texts(tuned(order="2", filter="0.1"))


def test_the_effective_dead_time_is_called_by_its_name():
    """The plant's dead time is 3, that of its model 7."""
    assert "θ = 7 is its effective dead time" in texts(tuned())


@pytest.mark.parametrize(
    ("plant", "parameters", "button", "before", "after"),
    [
        ("exp(-s)/(8s+1)", {"tau_c": "0.2"}, "remedy_Ms", "should be at most 2", {"tau_c"}),
        ("3exp(-2s)/((10s-1)(2s+1))", {}, "remedy_Ms", "should be at most 2", {"order"}),
        ("exp(-s)/s^2", {}, "remedy_PI chosen, PID delivered", "PI chosen, PID delivered", {"order"}),
        ("2.2exp(-20s)/(180s+1)", {"tau_c": "1800"}, "remedy_tau_c", "Sluggish", {"tau_c"}),
        ("exp(-0.01s)/(0.1s^2-1)", {}, "remedy_refusal", "take PID (order 2)", {"order"}),
    ],
)
def test_a_remedy_is_a_button_and_helps(plant, parameters, button, before, after):
    app = tuned(plant=plant, **parameters)
    assert before in texts(app)
    old = address(app)
    app.button(key=button).click().run()
    assert before not in texts(app)
    new = address(app)
    assert {name for name in {*old, *new} if old.get(name) != new.get(name)} == after
    assert not app.error


def test_an_unstable_plant_is_not_told_to_change_what_is_fixed():
    shown = texts(tuned(plant="exp(-s)/(s-0.25)"))
    assert "2.06" in shown
    assert "ncrease" not in shown


def test_the_set_point_weight_changes_the_response_and_not_the_margins():
    full, half = tuned(), tuned(b="0.5")
    assert "Ms" in strip(full)
    first, other = (re.findall("<b>(.*?)</b>", strip(app)) for app in (full, half))
    assert first[:4] == other[:4]  # Ms, GM, PM, delay margin
    assert first[4] != other[4]  # IAE of the set point
    assert first[5:7] == other[5:7]  # IAE of the load, Mt


@pytest.mark.parametrize(
    ("plant", "words"),
    [
        ("1/(s^2+0.6s+1)/(s^2+0.2s+1)", "not cover"),
        ("exp(-s)/s^3", "not cover"),
        ("exp(-6s)/(10s-1)", "a θ must be < 0.5"),
        ("1/(s^2+1)", "ζ must be > 0"),
    ],
)
def test_what_the_rules_do_not_cover_is_said_and_the_page_stays(plant, words):
    """The switches stay, and the plant's own Bode and Nyquist curves; no numbers of a loop that does not exist."""
    app = tuned(plant=plant)
    assert words in texts(app)
    assert app.segmented_control(key="controller_source").value == "simc"
    assert app.segmented_control(key="widget_order").value == "PI"
    assert app.segmented_control(key="widget_rules").value == "2003"
    assert len(specs(app)) == 2
    assert not [item for item in app.get("html") if '<div class="strip' in item.proto.body]


@pytest.mark.parametrize("plant", ["exp(-s)/s^3", "1/(s^2+1)", "exp(-0.1s)/((s-1)(s-2))", "(s^2+1)/(s+1)^3"])
def test_where_no_rule_exists_the_loop_is_closed_by_hand(plant):
    app = tuned(plant=plant)
    app.button(key="own_instead").click().run()
    assert all("The loop is not stable" in error.value for error in app.error)  # said, not refused
    assert app.segmented_control(key="controller_source").value == "own"
    assert len(specs(app)) == PANELS


def test_settings_without_the_form_asked_for_are_shown_in_one_they_have():
    """[SK03 sect. 5]: Kc 2 zeta tau0/(k q) = 2/6, tau_I 2 zeta tau0 = 2, tau_D tau0/(2 zeta) = 12.5; no series form."""
    app = tuned(plant="1.5exp(-2s)/(25s^2+2s+1)", form="series")
    assert copied(app) == pytest.approx({"Kc": 1 / 3, "tau_I": 2, "tau_D": 12.5})
    assert "no series form: shown in the ideal one" in texts(app)


def test_the_plant_is_changed_on_this_page_and_the_choice_of_speed_stays():
    """tau_c = 2 theta: 2 of e^{-s}/(8 s + 1), 6 of e^{-3s}/(20 s + 1); Kc = tau1/(k (tau_c + theta))."""
    app = tuned(plant="exp(-s)/(8s+1)", speed="2theta")
    assert copied(app)["Kc"] == pytest.approx(8 / 3)
    unfold(app, "change_plant").text_input(key="plant_text_text").set_value("exp(-3s)/(20s+1)").run()
    assert copied(app)["Kc"] == pytest.approx(20 / 9)
    assert address(app)["speed"] == "2theta"


def test_a_refusal_is_cured_on_the_page_where_it_is_told():
    """An unstable pole and a lag too long for PI; PID has settings [SK98 eq. 23]."""
    app = tuned(plant="exp(-0.01s)/(0.1s^2-1)")
    assert app.error
    app.segmented_control(key="widget_order").set_value("PID").run()
    assert not app.error
    assert copied(app)["Kc"] == pytest.approx(50 / math.sqrt(10))  # 1/(2 k' theta), k' = sqrt(10)
    assert len(specs(app)) == PANELS


@pytest.mark.parametrize(
    "plant",
    [
        "3 exp(-2s)",
        "exp(-s)/s",
        "exp(-s)/s^2",
        "1/(5s+1)",
        "exp(-s)/(20s-1)",
        "(1-2s)/((10s+1)(6s+1)(s+1))",
        "-2exp(-s)/(5s+1)",
    ],
)
@pytest.mark.parametrize("view", ["Live", "Figures", "Bode of L", "Compare"])
def test_every_kind_of_model_has_a_page_in_every_form(plant, view):
    for form in ("series", "ideal", "parallel") if view == "Bode of L" else ("series",):
        app = tuned(view, plant, order="2", form=form)
        assert not app.error
        assert len(specs(app)) == {"Figures": PANELS, "Bode of L": 1}.get(view, 0)


def test_a_link_to_the_former_tab_of_figures_opens_the_figures_to_export():
    app = tuned()  # by ?view=figures
    assert app.session_state["views"] == "Live"
    assert len(specs(app)) == PANELS
    assert "view" not in address(app)
    assert not texts(app).count("ignored")
    app.segmented_control("drag").set_value("settings").run()
    assert not specs(app)


def test_poles_are_listed_with_their_damping():
    table = next(frame.value for frame in tuned("Compare").dataframe if "damping ζ" in frame.value)
    assert len(table) >= 2
    assert all(0 < float(zeta) <= 1 for zeta in table["damping ζ"])


def test_a_loop_at_the_edge_of_stability_has_margins_and_no_integrals():
    """Stable, and so slow to come to rest that nobody can wait: margins stand, metrics are left open."""
    plant, low, high = parse_plant("exp(-0.2s)/((5s+1)(4s+1))"), 0.01, 10.0

    def tuned(tau_c: float) -> Tuning:
        return Tuning(order=2, filter=3.0, tau_c=tau_c)

    for _ in range(40):
        middle = (low * high) ** 0.5
        low, high = (low, middle) if study(plant, tuned(middle)).stable else (middle, high)
    found = study(plant, tuned(high))
    assert found.stable
    assert found.margins.Ms > 1e4
    assert math.isnan(found.performance.setpoint.IAE)
    assert "does not come to rest in reach" in strip_html(found)


@pytest.mark.parametrize(
    ("Ms", "band"), [(1.59, "calm"), (1.7, "calm"), (1.71, "attention"), (2 + 1e-10, "attention"), (2.001, "alarm")]
)
def test_bands_of_ms(Ms, band):
    assert band_of(Ms).tone == band


def test_later_forms_of_SIMC_stand_beside_it():
    """e^{-s}/(8s+1): iSIMC has 5.333, 6, 0.3333 at theta/2 [GS18], improved SIMC 25/6 and 8 [SG12]."""
    app = tuned(plant="exp(-s)/(8s+1)")
    app.segmented_control(key="widget_rule").set_value("isimc").run()
    assert not app.exception
    assert copied(app) == pytest.approx({"Kc": 16 / 3, "tau_I": 6, "tau_D": 1 / 3})
    assert (address(app)["rule"], address(app).get("tau_c")) == ("isimc", None)
    app.segmented_control(key="widget_rule").set_value("improved_simc").run()
    assert copied(app) == pytest.approx({"Kc": 25 / 6, "tau_I": 8, "tau_D": 0})
    app.segmented_control(key="controller_source").set_value("own").run()
    assert (address(app)["controller"], address(app)["rule"]) == ("own", "improved_simc")
    app.segmented_control(key="controller_source").set_value("simc").run()
    app.segmented_control(key="widget_rule").set_value("simc").run()
    assert copied(app) == pytest.approx({"Kc": 4, "tau_I": 8, "tau_D": 0})


def test_a_later_form_that_does_not_know_the_plant_leads_back_to_SIMC():
    app = tuned(plant="exp(-s)/s^2", rule="isimc")
    assert "first-order one" in texts(app)
    app.button(key="remedy_refusal").click().run()
    assert not app.error
    assert "rule" not in address(app)


def test_further_numbers_are_listed_where_they_are_chosen():
    """e^{-s}/(8s+1), SIMC: bandwidth of S 0.355417, IE 2; tau_c + theta = 2 behind a ramp."""
    app = tuned("Compare", plant="exp(-s)/(8s+1)", unit="s")
    assert "IE, load" not in str(app.dataframe[0].value)
    chosen = ["bandwidth of S", "IE, load", "error behind a set-point ramp of 1 per time", "decay ratio, load"]
    app.multiselect(key="measures").set_value(chosen).run()
    assert not app.exception
    listed = dict(zip(app.dataframe[0].value["quantity"], app.dataframe[0].value["present"], strict=True))
    assert listed["bandwidth of S [rad/s]"] == "0.3554"
    assert listed["IE, load"] == "2"
    assert listed["error behind a set-point ramp of 1 per time"] == "2"
    assert listed["decay ratio, load"] == "0"


@pytest.mark.parametrize(
    "plant", ["exp(-s)/(8s+1)", "exp(-s)/s^2", "exp(-s)", "-2 exp(-s)/(10s+1)", "exp(-s)/(4s^2+s+1)"]
)
@pytest.mark.parametrize("settings", ["", "ideal~0.2~inf~0~0~1~0", "ideal~99~1~0~0~1~0"])
def test_all_further_numbers_are_a_number_or_a_dash(plant, settings):
    own = {"own": settings, "controller": "own"} if settings else {}
    app = tuned("Compare", plant=plant, **own)
    field = app.multiselect(key="measures")
    field.set_value(list(field.options)).run()
    assert not app.exception
    table = app.dataframe[0].value
    assert len(table) > len(field.options)
    assert not [each for each in table["present"] if each in ("nan", "inf", "None")]
