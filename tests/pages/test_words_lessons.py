"""Lessons and sources in another language; texts of the program's lessons are in the catalogue, a teacher's are not."""

import tomllib

import pytest

from pages.common.lessons.shelf import DATA, lessons
from pages.common.words import extraction
from tests.pages.test_lessons_page import press, upload
from tests.pages.tools import run_page, texts
from tests.pages.wrapped import left_in_english, speak_brackets

# Fields of a lesson whose texts nobody sees: names, numbers, expressions, fields of a link.
UNSEEN = {
    *("id", "subject", "source", "numbers", "design", "case", "shows", "view", "panels", "behind", "checks"),
    *("of", "value"),
}


def seen(node, name=""):
    """All texts in a file, but for those of unseen fields and of the links of cases."""
    if isinstance(node, dict):
        for inner, value in node.items():
            if inner == "cases":
                yield from (case["name"] for case in value.values() if "name" in case)
            elif inner not in UNSEEN:
                yield from seen(value, inner)
    elif isinstance(node, list):
        for value in node:
            yield from seen(value, name)
    elif isinstance(node, str):
        yield node


def test_all_that_a_reader_sees_of_a_lesson_is_in_the_catalogue():
    for path in DATA.glob("*.toml"):
        text = path.read_text(encoding="utf-8")
        found = {message.one for message in extraction.in_lesson(text, path.name)}
        assert {each for each in seen(tomllib.loads(text)) if any(c.isalpha() for c in each)} <= found, path.name


def test_sources_of_lessons_of_the_list_do_not_mix(monkeypatch):
    speak_brackets(monkeypatch)
    app = run_page("lessons", lesson="none")
    assert left_in_english(app) == []
    app.segmented_control(key="lessons_order").set_value("paper").run()
    assert left_in_english(app) == []


@pytest.mark.parametrize(
    ("lesson", "step"),
    [
        *(("V1", step) for step in range(2, 8)),
        ("I3", 2),
        ("N1", 3),
        ("N5", 3),
        ("P01a", 3),
        ("P01a", 5),
        ("V2", 3),
        ("N2", 3),
    ],
)
def test_no_step_of_a_lesson_mixes(lesson, step, monkeypatch):
    speak_brackets(monkeypatch)
    assert left_in_english(run_page("lessons", lesson=lesson, step=str(step))) == []


def test_a_number_among_the_choices_has_the_decimal_sign(monkeypatch):
    speak_brackets(monkeypatch)
    app = run_page("lessons", lesson="I3", step="2")
    assert app.button(key="choice_1").label.endswith("0,4")


def test_a_lesson_of_a_file_stays_as_it_is_and_what_we_say_of_it_does_not(monkeypatch):
    speak_brackets(monkeypatch)
    wrong = (DATA / "V1.toml").read_bytes().replace(b"IAE_load(PI) = 14.6", b"IAE_lod(PI) = 14.6")
    app = upload(run_page("lessons"), "mine.toml", wrong)
    assert f"# {lessons()['V1'].title}" in texts(app)
    for _ in range(5):
        press(app, "lesson_next")
    assert "`IAE_lod(PI) = 14.6` `⟦there` is no quantity `IAE_lod⟧`" in texts(app)
    assert "⟦**Does not hold here:** " in texts(app)


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ('id = "V1"', "id = 3"),
        ('id = "V1"', "id"),
        ("right = 2", "right = 9"),
        ("right = 2", 'right = "x"'),
        ("exp(-3s)", "exp(3s)"),
        ('value = "8"', 'value = "eight"'),
        ('panels = ["y", "u"]', 'panels = ["z"]'),
        ('title = "', 'x = 1\ntitle = "'),
        ("Move tau_c", "M" * 40_000),
    ],
)
def test_no_refusal_of_a_file_mixes(right, wrong, monkeypatch):
    speak_brackets(monkeypatch)
    app = upload(run_page("lessons"), "bad.toml", (DATA / "V1.toml").read_text().replace(right, wrong).encode())
    assert len(app.error) == 1
    assert left_in_english(app) == []
