"""The page Tuning in another language: its views, plants, settings of one's own, the loop as built, refusals."""

from dataclasses import replace

import pytest
from streamlit.testing.v1 import AppTest

from pages.common.session import links
from pages.common.session.actuator import Actuator
from pages.common.session.design import Design
from pages.common.session.sheet import Sheet
from pages.common.studies import measures
from pages.common.tuning.views import VIEWS
from simc_core import IController, IdealPid, Plant, SeriesPid
from tests.pages.test_uncertainty import DESIGN as IDENTIFIED
from tests.pages.test_words import PLANTS
from tests.pages.tools import run_page, unfold
from tests.pages.wrapped import left_in_english, speak_brackets

LAGS = Design(plant=Plant(2, 1, (10, 3, 1)))
FOLDED = ("excitation", "now", "change_plant", "literature")
MECHANICAL = Actuator(u_min=-0.2, u_max=0.3, resolution=0.01, dead_band=0.02, backlash=0.03, rate_limit=0.4)
SHEET = Sheet(time_unit="s", PV_unit="°C", OP_unit="%", OP_now=40.0, OP_low=0.0, OP_high=100.0)
OWN = {
    "not stable": replace(LAGS, own=IdealPid(20, 1, 0.5), now=SeriesPid(1, 10)),
    "slow oscillation": Design(plant=Plant(1, 0.1, (100,)), own=IdealPid(0.3, 1), now=IdealPid(1, 0.3)),
    "integrator": replace(LAGS, own=IController(0.02), form="series", now=IdealPid(0.2, 3)),
    "direct": Design(plant=Plant(-1, 1, (4,)), own=IdealPid(-0.2, 4, 1), form="series"),
}
BUILT = {
    "limits": (replace(LAGS, actuator=replace(MECHANICAL, noise=0.01, h=0.5, delay_scans=1))),
    "limits on the scale of OP": replace(LAGS, actuator=MECHANICAL, sheet=SHEET),
    "one limit": replace(LAGS, actuator=Actuator(u_max=0.1)),
    "limit cycle": replace(LAGS, actuator=Actuator(u_min=-0.4, resolution=0.2)),
    "sampled": replace(LAGS, actuator=Actuator(h=3.0)),
}
TUNINGS = {
    "fast": {"order": 2, "filter": 0.1, "tau_c": 0.1},
    "slow": {"tau_c": 100.0},
    "improved": {"rule": "improved_simc"},
    "iSIMC": {"rule": "isimc", "tau_c": 0.3},
}


def opened(design: Design, view: str = "Live") -> AppTest:
    return run_page("tuning", f"⟦{view}⟧", "views", **links.encode(design))


@pytest.fixture(autouse=True)
def brackets(monkeypatch):
    speak_brackets(monkeypatch)


@pytest.mark.parametrize("view", VIEWS)
def test_no_view_mixes(view):
    app = unfold(opened(replace(LAGS, pins=(LAGS.tuning, SeriesPid(2, 0.5)), now=SeriesPid(1, 10)), view), *FOLDED)
    assert left_in_english(app) == []


@pytest.mark.parametrize("plant", PLANTS)
def test_no_plant_brings_english(plant):
    for order in ("1", "2"):
        assert left_in_english(run_page("tuning", plant=PLANTS[plant], order=order)) == []


@pytest.mark.parametrize("tuning", TUNINGS)
def test_no_tuning_brings_english(tuning):
    design = replace(LAGS, tuning=replace(LAGS.tuning, **TUNINGS[tuning]))
    assert left_in_english(opened(design)) == []


@pytest.mark.parametrize("own", OWN)
def test_no_settings_of_ones_own_mix(own):
    for view in ("Live", "Compare"):
        assert left_in_english(opened(replace(OWN[own], source="own"), view)) == []


@pytest.mark.parametrize("knobs", ["settings", "plant", "still"])
def test_nothing_that_is_dragged_mixes(knobs):
    app = opened(LAGS)
    app.segmented_control(key="drag").set_value(knobs).run()
    assert not app.exception
    assert left_in_english(app) == []


@pytest.mark.parametrize("built", BUILT)
def test_no_loop_as_built_mixes(built):
    for view in ("Live", "As built"):
        assert left_in_english(opened(BUILT[built], view)) == []


def test_what_a_record_leaves_open_does_not_mix():
    assert left_in_english(opened(IDENTIFIED, "Model error")) == []
    differing = replace(
        IDENTIFIED, origin=replace(IDENTIFIED.origin, gains=(1.0, 2.5)), source="own", own=SeriesPid(3, 1)
    )
    assert left_in_english(opened(differing, "Model error")) == []


def test_no_further_number_mixes():
    app = opened(LAGS, "Compare")
    app.multiselect(key="measures").set_value(list(measures.MEASURES)).run()
    assert not app.exception
    assert left_in_english(app) == []


@pytest.mark.parametrize(("key", "typed"), [("widget_u_min", "50"), ("widget_u_max", "-3")])
def test_no_refusal_of_the_actuator_mixes(key, typed):
    for sheet in (Sheet(), SHEET):
        app = opened(replace(LAGS, sheet=sheet), "As built")
        app.text_input(key=key).set_value(typed).run()
        assert app.error
        assert left_in_english(app) == []


@pytest.mark.parametrize("typed", ["-3", "x"])
def test_no_refusal_of_a_setting_mixes(typed):
    app = opened(replace(LAGS, own=IdealPid(0.2, 4), source="own"))
    app.text_input(key="own_IdealPid_Kc").set_value(typed).run()
    assert app.error
    assert left_in_english(app) == []
