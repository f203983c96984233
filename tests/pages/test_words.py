"""Pages in another language: nothing stays in English, links keep the language, numbers have its decimal sign."""

from pathlib import Path

import pytest
import streamlit
from fontTools.ttLib import TTFont

from pages.common.plant.entry import WAYS
from pages.common.words import catalogues, number, translated, typeset, words
from simc_core.notation import number as core_number
from simc_core.wording import Text, counted, joined, said
from tests.pages.tools import address, copyables, run_app, run_page, unfold
from tests.pages.wrapped import BRACKETS, left_in_english, offer_brackets, outside, speak_brackets

PAGES = sorted(path.stem for path in catalogues.LOCALE.parent.glob("*.py") if path.stem != "__init__")
PLANTS = {
    "lags": "exp(-3s)/((6s+1)(4s+1)(2s+1))",
    "zeros": "(6s+1)(3s+1) exp(-0.3s)/((10s+1)(8s+1)(s+1))",
    "integrating": "-0.5(1-2s) exp(-s)/(s(4s+1)(4s+1))",
    "unstable": "exp(-0.2s)/((20s-1)(s+1))",
    "pairs": "(s^2+0.5s+1)/((9s^2+9s+1)(2s+1)(s^2+0.5s+1))",
    "oscillating": "exp(-s)/(16s^2+2.4s+1)",
    "unstable, too long": "exp(-9s)/((10s-1)(3s+1))",
    "unstable, order 2": "exp(-s)/((10s-1)(6s+1))",
    "unstable, no dead time": "1/(10s-1)",
    "two integrators": "exp(-s)/s^2",
    "dead time": "2.5 exp(-1.5s)",
    "not covered": "1/(s^3(s+1))",
}


@pytest.mark.parametrize("page", PAGES)
def test_no_page_mixes(page, monkeypatch):
    speak_brackets(monkeypatch)
    app = unfold(run_page(page), "sheet")
    assert left_in_english(app) == []


@pytest.mark.parametrize("plant", PLANTS)
def test_no_plant_brings_english_to_its_pages(plant, monkeypatch):
    speak_brackets(monkeypatch)
    assert left_in_english(run_page("plant", plant=PLANTS[plant])) == []
    for rules in ("2003", "1998"):
        found = run_page("half_rule", plant=PLANTS[plant], rules=rules, sampling="0.5", unit="min", tau_F="0.4")
        assert left_in_english(found) == []
    assert left_in_english(run_page("half_rule", plant=PLANTS[plant], order="2")) == []


@pytest.mark.parametrize("way", ["k, θ, τ", "Step test", "Factors", "Polynomials", "Examples"])
def test_no_way_of_entering_a_plant_mixes(way, monkeypatch):
    speak_brackets(monkeypatch)
    app = run_page("plant")
    app.segmented_control(key="plant_way").set_value(WAYS[WAYS.index(way)]).run()  # which knows its language
    assert not app.exception
    assert left_in_english(app) == []


@pytest.mark.parametrize("view", ["Bode", "Error over frequency"])
def test_no_comparison_mixes(view, monkeypatch):
    speak_brackets(monkeypatch)
    assert left_in_english(run_page("half_rule", f"⟦{view}⟧", "comparison")) == []


@pytest.mark.parametrize(
    "typed",
    ["1/(s+", "", "2 s e", "k/(Ts+1)", "tf([1],[0])", "1/(s+1) + exp(-s)/(s+1)", "ss(1,2,3,4)", "exp(3s)/(s+1)"],
)
def test_no_refusal_mixes(typed, monkeypatch):
    speak_brackets(monkeypatch)
    app = run_page("plant")
    app.text_input(key="plant_text_text").set_value(typed).run()
    assert not app.exception
    assert left_in_english(app) == []


@pytest.mark.parametrize("typed", ["1,234.5,6", "abc", "1e-", "", "50 %", "2 min", "1/0", "1e99"])
def test_no_refusal_of_a_number_mixes(typed, monkeypatch):
    speak_brackets(monkeypatch)
    app = run_page("half_rule")
    app.text_input(key="half_rule_sampling").set_value(typed).run()
    assert app.error
    assert left_in_english(app) == []


def test_no_part_of_a_link_that_is_not_understood_mixes(monkeypatch):
    speak_brackets(monkeypatch)
    app = run_page("plant", order="3", tau_c="-1", rules="2020", pins="1~2", facts="x", lang="tlh", own="series~1")
    assert len(app.warning) == 1
    assert left_in_english(app) == []


def test_a_link_opens_a_language_and_pages_keep_it(monkeypatch):
    offer_brackets(monkeypatch)
    app = run_app(lang=BRACKETS, plant="1/(s+1)")
    assert address(app)["lang"] == BRACKETS
    assert app.title[0].value.startswith("⟦")
    app = run_page("half_rule", lang=BRACKETS)
    assert address(app)["lang"] == BRACKETS
    assert "lang=xx" in copyables(app)[0]


def test_a_language_is_chosen_where_there_are_several(monkeypatch):  # the choice itself: tests/browser/test_language.py
    offered = ["English", "čeština", "norsk", "srpski", "русский", "Deutsch"]
    assert run_page("half_rule").selectbox(key="lang").options == offered
    for language in set(catalogues.OFFERED) - {catalogues.ENGLISH}:
        monkeypatch.delitem(catalogues.OFFERED, language)
    assert not [box for box in run_page("half_rule").selectbox if box.key == "lang"]


@pytest.mark.parametrize("font", ["SourceSansVF-Upright", "SourceSansVF-Italic", "SourceCodeVF-Upright"])
def test_the_fonts_have_the_letters_of_all_languages(font):
    [file] = (Path(streamlit.__file__).parent / "static" / "static" / "media").glob(f"{font}.*.woff2")
    russian = "".join(map(chr, range(ord("А"), ord("я") + 1))) + "Ёё"
    letters = russian + "áčďéěíňóřšťúůýžćđåæøäöüßθτω−≤≥·„“«»"
    assert set(map(ord, letters + letters.upper().replace("SS", ""))) <= set(TTFont(file).getBestCmap())


def test_english_is_not_named_in_an_address_and_others_are_refused():
    app = run_page("plant", lang="en")
    assert "lang" not in address(app)
    assert not app.warning
    app = run_page("plant", lang="tlh", order="2")
    assert "lang" not in address(app)
    assert address(app)["order"] == "2"
    assert "`lang = tlh` was ignored: the languages are en" in app.warning[0].value


def test_numbers_have_the_decimal_sign_of_the_language(monkeypatch):
    assert (number(0.5), words("{x:.2f}", x=0.5), typeset("0.5 s")) == ("0.5", "0.50", "0.5 s")
    speak_brackets(monkeypatch)
    assert (number(0.5), words("{x:.2f}", x=0.5), typeset("0.5 s + 1.25")) == ("0,5", "⟦0,50⟧", "0{,}5 s + 1{,}25")
    inner = counted("{n} lag of {tau}", "{n} lags of {tau}", 2, tau=core_number(1.5))
    assert translated(said("{a} in {b}", a=inner, b="2.5")) == "⟦⟦2 lags of 1,5⟧ in 2.5⟧"
    assert translated(joined([said("a"), core_number(0.5), "b"])) == "⟦a⟧, 0,5, b"


def test_what_is_no_text_of_ours_stays_as_it_is(monkeypatch):
    speak_brackets(monkeypatch)
    assert translated("P-101 1.5") == "P-101 1.5"
    assert isinstance(said("x"), Text)


def test_what_is_outside_brackets_is_seen():
    assert outside("⟦a ⟦b⟧ c⟧").strip() == ""
    assert outside("$x \\text{and}$ `code` ⟦a⟧ left **:blue[over]** ⟦b⟧").split() == ["left", "**", "over]**"]


@pytest.mark.parametrize("view", ["Figures", "Bode", "Settings", "Windup", "Published pairs"])
def test_no_view_of_a_cascade_mixes(view, monkeypatch):
    speak_brackets(monkeypatch)
    app = run_page("cascade", f"⟦{view}⟧", "cascade_views", filter_outer="zero")
    assert left_in_english(unfold(app, "enter_Gb")) == []


SYNTHESIS = {"method": "synthesis"}
CASCADES = {
    "synthesis": {**SYNTHESIS, "unit": "min", "inner": "PI", "Ms_inner": "1.7"},
    "one speed is to blame": {**SYNTHESIS, "tau_c_inner": "0.05", "tau_c_outer": "10", "Gb": "exp(-s)/(3s+1)"},
    "both speeds are": {
        "tau_c_inner": "0.14",
        "tau_c_outer": "0.3",
        "Ga": "exp(-s)/(0.4s+1)",
        "Gb": "0.4exp(-9s)/(1.9s+1)",
    },
    "Kd of the wrong sign": {**SYNTHESIS, "Ga": "exp(-0.25s)/s", "Gb": "exp(-0.5s)/((s+1)(2s+1))"},
    "long dead time": {**SYNTHESIS, "Ga": "exp(-s)/(s+1)^2", "Gb": "exp(-0.1s)/(0.1s+1)"},
    "no SIMC": {"Gb": "exp(-s)/(20s-1)"},
    "far apart": {"tau_c_outer": "30", "form": "series", "tau_c_inner": "0.05"},
    "Ms not met": {**SYNTHESIS, "Ga": "-1.5exp(-3s)/(1-10s)", "Gb": "2exp(-s)/(s+1)"},
}


@pytest.mark.parametrize("cascade", CASCADES)
def test_no_cascade_mixes(cascade, monkeypatch):
    speak_brackets(monkeypatch)
    assert left_in_english(run_page("cascade", **CASCADES[cascade])) == []
