"""Take home: the numbers typed into a box, proof beside them, and the way back to my settings."""

import json
import re

import numpy as np
import pytest

from pages.common.session import links
from pages.common.studies.single import present_study
from pages.common.take_home.written import LANGUAGES, written
from simc_core import BOXES
from tests.pages.tools import address, copyables, run_page, texts

PLANT = "exp(-3s)/((6s+1)(4s+1)(2s+1))"  # [V06] example 1: Kc 0.5714, tau_I 8


def typed(app) -> str:
    """All that is written as HTML on the page."""
    return " ".join(str(block.proto) for block in app.get("html"))


def test_without_a_box_the_page_says_what_to_choose():
    app = run_page("take_home", plant=PLANT)
    assert not app.exception
    assert "Choose what you type" in app.info[0].value


def test_a_proportional_band_and_minutes_per_repeat():
    """Kc 4/7 is a band of 175 %, tau_I 8 s are 0.1333 min."""
    app = run_page("take_home", plant=PLANT, unit="s", box="honeywell_udc")
    assert not app.exception
    text = typed(app)
    assert "175" in text
    assert "0.14" in text  # minutes, to two digits and up
    assert "reverse" in text.lower()
    assert address(app)["box"] == "honeywell_udc"


@pytest.mark.parametrize("key", list(BOXES))
def test_every_box_is_shown_or_refuses_in_words(key):
    app = run_page("take_home", plant=PLANT, unit="min", box=key, order="2", filter="0.1")
    assert not app.exception
    assert app.dataframe or app.error


def test_sampling_stands_beside_the_continuous_loop():
    app = run_page("take_home", plant=PLANT, unit="s", box="matlab_pid", sampling="2")
    assert not app.exception
    assert list(app.dataframe[0].value.columns) == ["quantity", "design", "as typed", "sampled every 2 s"]


def test_numbers_in_the_box_become_my_settings():
    app = run_page("take_home", plant=PLANT, unit="s", box="honeywell_udc")
    fields = {each.label.split(" [")[0]: each for each in app.text_input}
    fields["PB"].set_value("50").run()
    fields = {each.label.split(" [")[0]: each for each in app.text_input}
    fields["RSET"].set_value("0,5").run()
    app.button(key="from_box").click().run()
    assert address(app)["controller"] == "own"
    own = address(app)["own"].split("~")
    assert float(own[1]) == pytest.approx(2.0)
    assert float(own[2]) == pytest.approx(30.0)
    assert "My settings, as this box has them" in texts(app)


PLANTS = {
    "integrating": "0.5 exp(-2s)/s",
    "double integrating": "exp(-s)/s^2",
    "unstable": "2 exp(-s)/(10s-1)",
    "oscillating": "exp(-s)/(4s^2+0.8s+1)",
    "pure dead time": "exp(-2s)",
    "negative gain": "-3 exp(-1.5s)/(12s+1)",
}


@pytest.mark.parametrize("key", ["honeywell_udc", "logix_pid_independent", "deltav_series", "matlab_pid"])
@pytest.mark.parametrize("plant", PLANTS.values(), ids=PLANTS.keys())
def test_all_kinds_of_plants_are_shown_or_refused_in_words(plant, key):
    app = run_page("take_home", plant=plant, unit="min", box=key, sampling="0.1")
    assert not app.exception
    assert app.dataframe or app.error


@pytest.mark.parametrize("key", [key for key, box in BOXES.items() if box.form != "parallel"][::9])
@pytest.mark.parametrize("sign", [1, -1])
def test_pure_integral_action_becomes_a_PI_where_a_box_needs_one(key, sign):
    """e^{-s}: K_I = 1/2. Of K_I (s/3 + 1) e^{-s}/s, |S| on a grid is the Ms that is told; its load error is 1/K_I."""
    app = run_page("take_home", plant=f"{sign} exp(-s)", unit="min", box=key)
    assert "Pure integral action" in app.error[0].value
    s = 1j * np.linspace(1e-3, 30, 200_000)
    peak = np.max(1 / np.abs(1 + 0.5 * (s / 3 + 1) * np.exp(-s) / s))
    told = re.search(r"M_s\$ = ([0-9.]+) instead of 1.59", texts(app))
    assert float(told[1]) == pytest.approx(peak, rel=1e-3)
    assert peak < 1.59
    for name in re.search("take it as it is: (.*); and more", texts(app))[1].split("; "):
        assert name in {box.title for box in BOXES.values() if box.form == "parallel"}
    app.button(key="take_pi").click().run()
    assert not app.error
    assert app.dataframe
    form, Kc, tau_I, *_ = address(app)["own"].split("~")
    assert (form, float(Kc), float(tau_I)) == ("ideal", pytest.approx(sign / 6), pytest.approx(1 / 3))


def test_a_PID_that_no_series_box_has_is_sent_to_one_that_has_it():
    app = run_page("take_home", plant="exp(-s)/(4s^2+0.8s+1)", box="deltav_series")
    assert "has no numbers for this controller" in app.error[0].value
    assert "Boxes that take it as it is: " in texts(app)
    assert not [each for each in app.button if each.key == "take_pi"]


def test_a_negative_gain_makes_a_direct_acting_box():
    app = run_page("take_home", plant=PLANTS["negative gain"], unit="s", box="honeywell_udc")
    (typed,) = (text for text in copyables(app) if "PB = " in text)
    assert "action = direct" in typed
    assert "PB = -" not in typed


def test_the_sampling_period_that_is_named_is_short_enough():
    app = run_page("take_home", plant=PLANT, unit="s", box="matlab_pid", sampling="6")
    (warning,) = (each.value for each in app.warning if "Sampling is slow" in each.value)
    named = re.search(r"take ([0-9.]+) s or less", warning)[1]
    app.text_input(key="home_sampling").set_value(named).run()
    assert not [each for each in app.warning if "Sampling is slow" in each.value]
    continuous, sampled = (float(app.dataframe[0].value.iloc[0, column]) for column in (2, 3))
    assert sampled == pytest.approx(1.05 * continuous, rel=0.01)


def test_what_a_form_needs_is_told_in_the_unit_of_the_page():
    """tau_I 2 min < 4 tau_D 4 min: no series form, in minutes as on the page and not in seconds."""
    own = "ideal~1~2~1~0.1~1~0"
    app = run_page("take_home", plant="exp(-s)/(5s+1)", unit="min", own=own, controller="own", box="deltav_series")
    assert "= 4, found" in app.error[0].value
    assert not app.exception


def test_a_refusal_of_one_box_is_not_told_under_another():
    app = run_page("take_home", plant=PLANT, unit="s", box="honeywell_udc")
    app.button(key="from_box").click().run()
    assert "must be given" in app.error[0].value
    app.selectbox(key="box").set_value("matlab_pid").run()
    assert not app.error


def code_of(app) -> str:
    (block,) = app.get("code")
    return block.value


def in_code(**given):
    return run_page("take_home", "Code", "home_views", **{"plant": PLANT, "unit": "s", "sampling": "0.5"} | given)


@pytest.mark.parametrize("language", sorted(LANGUAGES))
def test_every_language_is_written_and_offered_as_a_file(language):
    app = in_code(language=language, PV_unit="°C", tag="TIC-101 */", u_min="-40", u_max="60", OP_now="40")
    text = code_of(app)
    assert "exp(-3 s)/((6 s + 1) (4 s + 1) (2 s + 1))" in text
    assert "loop TIC-101" in text
    assert "*/," not in text
    assert f"Download {LANGUAGES[language].file}" in [each.proto.label for each in app.get("download_button")]
    assert any("Not compiled" in each.value for each in app.warning) == (language in ("scl", "logix"))
    if language != "python-control":
        assert "100.0" in text


@pytest.mark.parametrize(("unit", "seconds"), [("", 1.0), ("s", 1.0), ("min", 1.0), ("h", 3600.0), ("ms", 1e-3)])
def test_the_code_of_every_time_unit_runs(unit, seconds):
    """tau_I is 8 of the unit; of the first error 1 the integral takes h Kc/tau_I. Minutes stay minutes."""
    design, _ = links.decode({"plant": PLANT, "sampling": "0.1"} | ({"unit": unit} if unit else {}))
    controller = present_study(design).controller
    text, scope = written(design, controller, controller), {}
    assert f"h = {0.1 * seconds!r} {'min' if unit == 'min' else 's'}" in text
    exec(text, scope)
    pid = scope["Pid"]()
    pid.step(0.0, 0.0)
    assert pid.step(1.0, 0.0) == pytest.approx(4 / 7 * (1 + 0.1 / 8), rel=1e-9)


def test_the_code_of_what_is_typed_tells_both():
    app = in_code(box="honeywell_udc", exported="typed")
    assert "as designed" in code_of(app)
    assert "as typed" in code_of(app)
    app.selectbox(key="widget_language").set_value("c").run()
    assert address(app)["language"] == "c"
    assert "pid_step" in code_of(app)


def test_without_a_sampling_period_one_is_offered_that_costs_5_per_cent():
    app = in_code(sampling="0")
    assert not app.get("code")
    app.button(key="take_period").click().run()
    assert 0.5 < float(address(app)["sampling"]) < 2
    designed, sampled = re.search(r"Ms +([0-9.]+) as designed, ([0-9.]+) sampled", code_of(app)).groups()
    assert 1.03 < float(sampled) / float(designed) <= 1.05


def test_what_cannot_be_written_is_told_and_the_choice_stays():
    app = in_code(language="arduino")
    assert "u_min and u_max must be given for an Arduino" in texts(app).replace("$u_{min}$", "u_min").replace(
        "$u_{max}$", "u_max"
    )
    assert app.selectbox(key="widget_language").value == "arduino"


P0 = {"plant": "exp(-s)/((10s+1)(3s+1))", "order": "2", "unit": "s"}


def Ms_of(app, column) -> float:
    return float(app.dataframe[0].value.iloc[0][column])


def remedy(app, words):
    return next(button for button in app.button if button.label.startswith(words))


def test_retuned_with_half_the_filter_of_the_box_Ms_is_what_was_promised():
    """Filter tau_D/8 = 0.375: Ms 1.9142; with theta + tau_F/2 the settings are 4.2105, 9.5, 3 and Ms 1.6787."""
    app = run_page("take_home", **P0, box="deltav_series")
    assert Ms_of(app, "as typed") == 1.914
    assert Ms_of(app, "design") == 1.609  # without a filter
    button = remedy(app, "Retune with θ + τF/2")
    assert button.label.endswith("Ms 1.68")
    button.click().run()
    assert Ms_of(app, "design") == Ms_of(app, "as typed") == 1.679
    (typed,) = (text for text in copyables(app) if "RESET" in text)
    numbers = dict(re.findall(r"(\w+) = ([0-9.]+)", typed))
    assert float(numbers["GAIN"]) == pytest.approx(80 / 19, rel=1e-6)
    assert (float(numbers["RESET"]), float(numbers["RATE"])) == (9.5, 3)
    assert not [each for each in app.button if each.label.startswith("Retune")]
    assert {"tau_F": "0.375", "filter": "0.125"}.items() <= address(app).items()


@pytest.mark.parametrize("words", ["Retune with θ + τF/2 + h/2", "Retune with θ + h/2", "Sample every"])
def test_a_remedy_does_what_its_button_says(words):
    app = run_page("take_home", **P0, box="deltav_series", sampling="0.2")
    assert Ms_of(app, "sampled every 0.2 s") == 2.184
    button = remedy(app, words)
    promised = float(button.label.split("Ms ")[1])
    button.click().run()
    assert Ms_of(app, app.dataframe[0].value.columns[-1]) == pytest.approx(promised, abs=5e-3)


def test_sampling_allowed_for_keeps_Ms():
    """FOPDT 8, 1 sampled at 0.2 and tuned with theta + h/2: Ms 1.601 (a continuous design has 1.5905)."""
    app = run_page("take_home", plant="exp(-s)/(8s+1)", unit="s", box="matlab_pid", sampling="0.2")
    assert Ms_of(app, "sampled every 0.2 s") == 1.691
    remedy(app, "Retune with θ + h/2").click().run()
    assert Ms_of(app, "sampled every 0.2 s") == pytest.approx(1.601, abs=5e-4)


def test_what_a_box_does_not_take_comes_with_the_nearest_and_its_peak():
    """tau_I 8000 s on a scale that ends at 3000 s; the nearest is 3000 s: Ms by an independent sweep of |1/(1 + L)|."""
    app = run_page("take_home", plant="exp(-1000s)/(9000s+1)", unit="s", box="panasonic_fp")
    assert "Ti of FP PID must be from 1 to 30000 s" in app.error[0].value
    assert "the nearest is 30000" in app.error[0].value
    omega = np.geomspace(1e-6, 1e-1, 200_000)
    s = 1j * omega
    (typed,) = (text for text in copyables(app) if "Kp = " in text)
    Kp = 0.1 * float(re.search(r"Kp = ([0-9.]+)", typed)[1])
    assert "Ti = 30000" in typed
    L = Kp * (1 + 1 / (3000 * s)) * np.exp(-1000 * s) / (9000 * s + 1)
    told = re.search(r"\$M_s\$ = ([0-9.]+)", texts(app))[1]
    assert float(told) == pytest.approx(np.max(np.abs(1 / (1 + L))), rel=6e-4)


def test_my_settings_are_not_retuned():
    app = run_page(
        "take_home", **P0, box="deltav_series", own="series~5~8~3~0.375~1~0", controller="own", sampling="0.2"
    )
    assert not [each for each in app.button if each.label.startswith("Retune")]
    assert remedy(app, "Sample every")


def test_an_output_written_one_scan_later_costs_a_period_of_dead_time():
    """FOPDT 8, 1 under PI 4, 8 sampled at 0.2: Ms 1.6908, one scan later 1.898 [a program of its own]."""
    app = run_page("take_home", plant="exp(-s)/(8s+1)", unit="s", box="matlab_pid", sampling="0.2")
    assert Ms_of(app, "sampled every 0.2 s") == pytest.approx(1.6908, abs=5e-4)
    app.toggle(key="scans").set_value(True).run()
    assert Ms_of(app, "sampled every 0.2 s") == pytest.approx(1.898, abs=1e-3)
    assert address(app)["scans"] == "1"
    figure = json.loads(app.get("plotly_chart")[0].proto.spec)
    assert {"design", "typed", "sampled"} <= {trace["name"] for trace in figure["data"]}


def test_a_box_that_kicks_without_a_filter_shows_all_but_that_response():
    """OSCAT has D on e and no filter; Ms of the unfiltered design is 1.6089 [a program of its own]."""
    app = run_page("take_home", plant="exp(-s)/((10s+1)(3s+1))", order="2", unit="s", box="oscat_ctrl_pid")
    assert Ms_of(app, "as typed") == pytest.approx(1.6089, abs=5e-4)
    assert any("set-point step makes" in each.value for each in app.caption)
    figure = json.loads(app.get("plotly_chart")[0].proto.spec)
    assert {trace["name"] for trace in figure["data"]} & {"design", "typed"} == {"design"}


def test_what_is_read_from_a_box_that_kicks_is_taken_without_the_kick():
    """PB 20, RSET 0.5, RATE 0.2 of a UDC in PID-A: Kc 5, tau_I 30 s, tau_D 12 s, D on the error."""
    app = run_page("take_home", **P0, box="honeywell_udc")
    for i, text in enumerate(("20", "0.5", "0.2")):
        app.text_input(key=f"box_honeywell_udc_{i}").set_value(text).run()
    app.button(key="from_box").click().run()
    own = address(app)["own"].split("~")
    assert (own[0], *map(float, own[1:4]), own[-1]) == ("ideal", 5, 30, 12, "0")
    assert any("the derivative on PV" in each.value for each in app.info)
    assert not app.error


def test_a_filter_of_the_measurement_comes_back_with_the_settings_of_a_box():
    """PB 20, RSET 0.5 of a UDC behind a filter of 3 s: Kc 5, tau_I 30 s, tau_F 3 s."""
    app = run_page("take_home", **P0, box="honeywell_udc")
    for i, text in ((0, "20"), (1, "0.5"), (3, "3")):
        app.text_input(key=f"box_honeywell_udc_{i}").set_value(text).run()
    app.button(key="from_box").click().run()
    assert list(map(float, address(app)["own"].split("~")[1:5])) == [5, 30, 0, 3]
