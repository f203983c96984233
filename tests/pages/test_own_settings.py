"""My settings, those in the plant now, and a plant that is dragged: nothing of it is made by SIMC."""

import pytest

from pages.common.live.hand import table
from pages.common.session import links
from pages.common.session.design import Design
from pages.common.studies.single import present_study, study_of_settings
from simc_core import IController, IdealPid, InvalidParameter, ParallelPid, Plant, SeriesPid, margins

from .tools import address, copyables, run_page, texts

HEATER = "2.2exp(-20s)/(180s+1)"
NOW = "ideal~1.2~240~0~0~1~0"


def strip(app):
    (html,) = [item.proto.body for item in app.get("html") if '<div class="strip' in item.proto.body]
    return html


def test_my_settings_are_what_is_judged():
    """Ideal PI Kc 1.2, tau_I 240 on the heater: load IAE is tau_I/Kc = 200, since e does not change sign."""
    app = run_page("tuning", "Figures", plant=HEATER, own=NOW, controller="own")
    assert ">200<" in strip(app)
    assert ">1.289<" in strip(app)  # faults.md a1, by python-control too
    assert "τc, exact" not in [field.label for field in app.text_input]


def test_simc_settings_are_taken_over_and_changed_by_hand():
    app = run_page("tuning", "Figures", plant=HEATER, form="ideal")
    app.button_group(key="controller_source").set_value("own").run()
    assert address(app)["controller"] == "own"
    assert links.settings_of(address(app)["own"]).Kc == pytest.approx(180 / 88)
    field = next(field for field in app.text_input if field.label == "Kc")
    field.set_value("1,5").run()  # a decimal comma
    assert links.settings_of(address(app)["own"]).Kc == 1.5
    field = next(field for field in app.text_input if field.label == "τI")
    field.set_value("").run()
    assert links.settings_of(address(app)["own"]).tau_I == float("inf")
    assert not app.exception


def test_my_settings_stay_in_the_form_they_were_typed_in_until_another_is_chosen():
    """Ideal 2, 9, 2 is series with f = (1 + sqrt(1 - 8/9))/2 = 2/3: Kc 4/3, tau_I 6, tau_D 3 [SG12 eq. 5.7]."""
    app = run_page("tuning", "Figures", plant=HEATER, own="ideal~2~9~2~0~1~0", controller="own")
    assert address(app)["own"] == "ideal~2~9~2~0~1~0"
    app.segmented_control(key="widget_form").set_value("ideal").run()
    app.segmented_control(key="widget_form").set_value("series").run()
    series = links.settings_of(address(app)["own"])
    assert (series.Kc, series.tau_I, series.tau_D) == pytest.approx((4 / 3, 6.0, 3.0))
    fields = {field.label: float(field.value) for field in app.text_input if field.label in ("Kc", "τI", "τD")}
    assert fields == pytest.approx({"Kc": 4 / 3, "τI": 6.0, "τD": 3.0})  # no field shows the form of before


def test_a_design_stands_against_the_settings_in_the_plant_now():
    app = run_page("tuning", "Figures", plant=HEATER, now=NOW)
    assert "Load IAE 2.6 times smaller" in texts(app)
    assert "Ms 1.29 → 1.6" in texts(app)


def test_the_action_is_that_of_the_sign_of_the_gain():
    assert SeriesPid(2.0, 3.0).action == ParallelPid(0, 0.1, 0).action == "reverse"
    assert IController(-2.0).action == IdealPid(-1.0, 5.0).action == "direct"


def test_a_negative_gain_is_shown_as_its_size_and_direct_action():
    """-1.5 exp(-4s)/(20s+1): Kc = 20/(-1.5 * 8) = -1.667, and nobody types a minus into a control system."""
    units = {"unit": "min", "OP_unit": "%", "PV_unit": "°C"}
    app = run_page("tuning", "Bode of L", plant="-1.5 exp(-4s)/(20s+1)", **units)
    (text,) = [text for text in copyables(app) if " = " in text]
    assert text == "Kc = 1.666666667 %/°C\ntau_I = 20 min\ntau_D = 0 min\naction = direct"
    (shown,) = [item.proto.body for item in app.get("html") if 'class="settings"' in item.proto.body]
    assert "<b>1.667</b> %/°C" in shown
    assert "<b>direct</b>" in shown


def test_my_settings_are_typed_as_sizes_with_an_action():
    app = run_page(
        "tuning", "Bode of L", plant="-2.2exp(-20s)/(180s+1)", own="ideal~-1.2~240~0~0~1~0", controller="own"
    )
    assert app.text_input("own_IdealPid_Kc").value == "1.2"
    app.text_input("own_IdealPid_Kc").set_value("2").run()
    assert address(app)["own"] == "ideal~-2~240~0~0~1~0"
    app.text_input("own_IdealPid_Kc").set_value("-3").run()
    assert "must be > 0, found −3: its sign is the action" in app.error[0].value
    app.segmented_control("own_action").set_value("reverse").run()
    assert address(app)["own"] == "ideal~2~240~0~0~1~0"


def test_times_and_gains_have_the_units_of_the_loop_sheet():
    units = {"unit": "min", "OP_unit": "%", "PV_unit": "°C"}
    app = run_page("tuning", "Compare", plant=HEATER, **units)
    table = next(frame.value for frame in app.dataframe if "present" in frame.value)
    assert {"τc [min]", "Kc [%/°C]", "IAE, load [°C min]", "TV, load [%]"} <= set(table.iloc[:, 0])
    assert app.text_input("tau_c_exact").label == "τc, exact [min]"
    assert "θ = 20 min is its effective dead time" in texts(app)


def test_own_settings_of_every_form_can_be_judged_and_pinned():
    for controller in (SeriesPid(1, 5), IdealPid(1, 5, 1, 0.1), ParallelPid(1, 0.2, 1, 0.1), IController(0.05)):
        own = links.settings_text(controller)
        app = run_page("tuning", "Compare", plant="2exp(-s)/(5s+1)", own=own, controller="own")
        assert not app.exception
        app.button(key="pin").click().run()
        assert address(app)["pins"] == own


def test_knobs_keep_the_sign_of_a_gain_and_their_bounds():
    subject = table.Subject(Plant(-1.5, 4.0, (20.0, 3.0)), SeriesPid(-1.2, 20.0), settings=True)
    assert {knob["name"]: knob["value"] for knob in table.knobs(subject)} == {"Kc": 1.2, "tau_I": 20.0, "tau_D": 0.0}
    assert subject.at({"Kc": 2.0, "tau_I": 30.0, "tau_D": 1.0}).controller == SeriesPid(-2.0, 30.0, 1.0)
    with pytest.raises(InvalidParameter, match="Kc must be within"):
        table.allowed(subject, {"Kc": 1e6})
    with pytest.raises(InvalidParameter, match="found many"):
        table.allowed(subject, {"Kc": "many"})


def test_a_plant_that_is_dragged_keeps_its_controller():
    """Dead time + 30 % with the settings kept: the delay margin falls by just these 6."""
    design = Design(Plant(2.2, 20.0, (180.0,)))
    present = present_study(design)
    subject = table.Subject(design.plant, present.controller, settings=False)
    turned = subject.at({"k": 2.2, "theta": 26.0, "tau1": 180.0})
    assert turned.controller == present.controller
    assert margins(turned).delay_margin == pytest.approx(present.margins.delay_margin - 6.0, rel=1e-9)
    assert study_of_settings(turned.plant, turned.controller).tau_c is None


def test_a_proportional_controller_has_margins_but_no_integrals_and_the_reason_is_true():
    app = run_page("tuning", "Figures", plant=HEATER, own="ideal~1.2~inf~0~0~1~0", controller="own")
    assert not app.exception
    assert "keeps an offset" in strip(app)
    assert "stability limit" not in strip(app)
