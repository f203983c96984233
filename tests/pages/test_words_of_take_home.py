"""Take home in a language of brackets: its tabs, boxes that take a design and boxes that do not; files for programs."""

import pytest

from pages.common.session.design import Design
from pages.common.studies.single import present_study
from pages.common.take_home.report.html import document
from pages.common.take_home.report.record import report
from pages.common.take_home.report.texts import markdown, settings_csv
from simc_core import BOXES, Plant
from simc_core.errors import BoxError
from simc_core.implementation.boxes.convert import from_box, to_box
from simc_core.wording import Text
from tests.pages.tools import run_page
from tests.pages.wrapped import BRACKETS, left_in_english, speak_brackets

LAG = Plant(1.0, 4.0, (20.0,))


@pytest.mark.parametrize(
    "asked",
    [
        {"box": "foxboro_ia", "sampling": "2", "unit": "s"},
        {"box": "abb_acs880", "rounding": "safe", "order": "2"},
        {"box": "omron_pidat", "plant": "exp(-s)", "PV_unit": "bar"},
        {"box": "slc500", "own": "ideal~2~5~1e6~0~1~0", "controller": "own"},
        {"box": "siemens_pid_compact", "own": "ideal~2~5~1~0.01~0.5~1", "controller": "own"},
    ],
)
def test_no_box_mixes(asked, monkeypatch):
    speak_brackets(monkeypatch)
    assert left_in_english(run_page("take_home", **asked)) == []


@pytest.mark.parametrize(
    ("view", "asked"),
    [
        ("Code", {}),
        ("Code", {"sampling": "1", "box": "simple_pid", "language": "scl"}),
        ("Schedule", {}),
        ("Schedule", {"points": "20~1~4~20!50~9~3~15!80~0.5~9~8", "language": "scl", "between": "PB"}),
        ("Schedule", {"points": "20~1~4~20!50~-2~3~15"}),
        ("Report", {"box": "omron_pidat", "sampling": "3", "u_min": "-1", "u_max": "3", "unit": "s"}),
    ],
)
def test_no_tab_of_take_home_mixes(view, asked, monkeypatch):
    speak_brackets(monkeypatch)
    app = run_page("take_home", view, "home_views", **asked)
    assert left_in_english(app) == []


def test_rows_that_make_no_schedule_are_refused_in_the_language(monkeypatch):
    speak_brackets(monkeypatch)
    app = run_page("take_home", "Schedule", "home_views")
    for typed in ("1 2 3", "1 2 3\n4 5", "1 2 3 4\n2 -2 3 4", "a 2 3\n4 5 6"):
        app.text_area(key="points_text").set_value(typed).run()
        assert len(app.error) == 1
        assert left_in_english(app) == []


def test_the_report_is_told_in_the_language_and_its_files_for_programs_are_not(monkeypatch):
    design = Design(plant=LAG, box="honeywell_udc")
    found = report(design, present_study(design), "https://simc.example")
    plain = markdown(found), settings_csv(found)
    speak_brackets(monkeypatch)
    printed = document(found)
    assert f'<html lang="{BRACKETS}">' in printed
    assert "⟦Controller settings⟧" in printed
    assert (markdown(found), settings_csv(found)) == plain
    assert "⟦" not in "".join(plain)


@pytest.mark.parametrize("key", BOXES)
def test_all_that_a_box_is_told_with_can_be_translated(key):
    box = BOXES[key]
    told = (*box.unread, *box.notes, *to_box(present_study(Design(plant=LAG)).controller, key, nearest=True).warnings)
    assert [text for text in told if not isinstance(text, Text)] == []
    with pytest.raises(BoxError) as refused:
        from_box(key, {})
    assert isinstance(refused.value.args[0], Text)
