"""Rules in a language of brackets: pictures, plants of all kinds, rules with and without settings."""

import pytest

from pages.common.rules.remarks import IN_CIRCULATION, KNOBS, MADE_FOR
from simc_core import RULES
from simc_core.wording import Text
from tests.pages.test_words import PLANTS
from tests.pages.tools import run_page
from tests.pages.wrapped import left_in_english, speak_brackets


@pytest.mark.parametrize(
    "asked",
    [
        {"compared_plant": "delay", "compared_Ms": "1.59", "compared_rule": "improved_simc-PI"},
        {
            "compared_kind": "PID",
            "compared_plant": "balanced",
            "compared_rule": "kuhn_fast-PID",
            "compared_tau_F": "0.2",
        },
        {"plant": PLANTS["unstable"], "compared_rule": "amigo-PI"},
        {"plant": PLANTS["two integrators"], "compared_rule": "optimal-PI", "compared_Ms": "1.2"},
        {"plant": PLANTS["not covered"]},
    ],
)
def test_no_comparison_of_rules_mixes(asked, monkeypatch):
    speak_brackets(monkeypatch)
    assert left_in_english(run_page("rules", **asked)) == []


def test_the_plane_of_settings_does_not_mix(monkeypatch):
    speak_brackets(monkeypatch)
    assert left_in_english(run_page("rules", "Kc and τI", "rules_picture", compared_plant="lag")) == []


def test_all_that_is_told_of_a_rule_can_be_translated():
    told = [*MADE_FOR.values(), *IN_CIRCULATION.values(), *KNOBS.values()]
    told += [text for rule in RULES.values() for text in (rule.title, rule.domain)]
    told += [rule.source for rule in RULES.values() if not rule.source.startswith("[")]
    assert [text for text in told if not isinstance(text, Text)] == []
