"""The pages Lessons and Sources without a browser."""

import pytest

from pages.common.lessons import progress
from pages.common.lessons.in_use import TAG
from pages.common.lessons.lesson import LONGEST
from pages.common.lessons.shelf import DATA, after, by_subject, lessons
from pages.common.parts.sources import cited, linked
from pages.common.session.loops import MOST_LOOPS
from simc_core.published.sources import SOURCES

from .tools import address, copyables, run_page, texts

V1 = lessons()["V1"]
SHOWN = ("V1", "S8", "V2", "N1", "N2", "N5", "R1", "P01a")  # each kind of figure at least once


def press(app, key):
    app.button(key=key).click().run()
    assert not app.exception
    return app


def loops(app):
    return app.session_state["loops"]


def test_the_list_names_every_lesson_by_subject_and_by_paper():
    app = run_page("lessons")
    for order in ("subject", "paper"):
        app.segmented_control(key="lessons_order").set_value(order).run()
        assert {f"open_{each}" for each in lessons()} <= {button.key for button in app.button}
    assert loops(app).design.sheet.tag == ""  # nothing is opened yet


@pytest.mark.parametrize("lesson", SHOWN)
def test_every_step_of_a_lesson_opens_by_its_link(lesson):
    for step in range(1, lessons()[lesson].steps + 1):
        app = run_page("lessons", lesson=lesson, step=str(step))
        assert not app.error
        assert f"step {step} of {lessons()[lesson].steps}" in texts(app)
        assert loops(app).design.sheet.tag == f"{TAG}{lesson}"


def test_from_play_to_the_numbers_with_a_prediction():
    app = press(run_page("lessons"), "open_V1")
    assert address(app)["lesson"] == "V1"
    assert V1.question not in texts(app)
    press(app, "lesson_next")
    assert V1.question in texts(app)
    assert app.button(key="lesson_next").label == "Go on without a prediction"
    press(app, "choice_1")
    assert app.button(key="lesson_next").label == "Next"
    for _ in V1.moves:
        press(app, "lesson_next")
        assert f"Predicted: A. {V1.choices[0]}" in texts(app)
        assert V1.answer not in texts(app)
        assert V1.claims[0].says not in texts(app)
    press(app, "lesson_next")
    assert V1.answer in texts(app)
    assert all(claim.says in texts(app) for claim in V1.claims)
    assert [item.value for item in app.success] == [f"**B. {V1.choices[1]}**"]
    press(app, "lesson_next")
    assert [len(table.value) for table in app.table] == [4, 1]
    assert app.table[0].value["printed"].tolist() == ["0.57", "8", "1.38", "2.73"]
    assert app.table[0].value["here"].tolist() == ["0.5714", "8", "1.375", "2.727"]
    press(app, "lesson_after")
    assert "step 1 of" in texts(app)
    assert address(app)["lesson"] != "V1"
    press(app, "lesson_close")
    assert "lesson" not in address(app)
    assert "done" in texts(app)


def test_one_lesson_leads_to_the_next_until_all_were_seen():
    seen = [next(iter(by_subject().values()))[0]]
    while (following := after(seen[-1])) is not None:
        seen.append(following)
    assert len(seen) == len({each.id for each in seen}) == len(lessons())


def test_ones_own_loop_stays_as_it_is_and_all_lessons_share_one_loop():
    app = run_page("lessons", plant="7/(3s+1)")
    mine = loops(app).design
    press(app, "open_V1")
    press(app, "lesson_close")
    press(app, "open_S3")
    tags = [entry.design.sheet.tag for entry in loops(app).entries]
    assert tags == ["", f"{TAG}S3"]
    assert loops(app).entries[0].design == mine


def test_an_address_is_short_until_something_is_moved():
    app = press(run_page("lessons"), "open_V1")
    assert address(app) == {"lesson": "V1", "step": "1"}
    (link,) = copyables(app)
    assert link.endswith("?lesson=V1&step=1")
    assert address(run_page("lessons", lesson="V1", step="3")) == {"lesson": "V1", "step": "3"}


def test_what_was_moved_is_put_back_and_a_link_with_a_design_keeps_it():
    app = run_page("lessons", lesson="V1", step="3", tag="Lesson V1", plant=V1.design["plant"], tau_c="9")
    assert loops(app).design.tuning.tau_c == 9
    press(app, "lesson_put_back")
    assert loops(app).design.tuning.tau_c is None
    assert address(app) == {"lesson": "V1", "step": "3"}


@pytest.mark.parametrize(("step", "found"), [("0", 1), ("99", 7), ("-1", 1), ("x", 1), ("٣", 3), ("9" * 30, 1)])
def test_a_step_that_there_is_not_is_the_nearest_one(step, found):
    assert f"step {found} of 7" in texts(run_page("lessons", lesson="V1", step=step))


def test_a_lesson_that_there_is_not_is_said_and_shown_exactly():
    app = run_page("lessons", lesson="**x**")
    assert [item.value for item in app.warning] == ["There is no lesson `**x**` here; these are there."]


def upload(app, name, content):
    app.file_uploader(key="lesson_file").set_value((name, content, "application/toml")).run()
    assert not app.exception
    return app


def test_a_lesson_of_a_file_opens_and_its_text_is_no_markup():
    foreign = (DATA / "V1.toml").read_text().replace("Three lags and a dead time", "# <b>x</b> $y$ [a](b)")
    app = upload(run_page("lessons"), "mine.toml", foreign.encode())
    assert address(app)["lesson"] == "file"
    heading = next(item.value for item in app.markdown if "<b>" in item.value)
    assert heading == "# `# <b>x</b> $y$ [a](b)`"


def test_a_file_with_the_id_of_another_lesson_has_predictions_of_its_own():
    app = press(press(run_page("lessons"), "open_V1"), "lesson_next")
    press(press(app, "choice_3"), "lesson_close")
    fewer = (DATA / "V1.toml").read_text().replace(', "It falls to a quarter"]', "]").encode()
    press(upload(app, "mine.toml", fewer), "lesson_next")
    assert app.button(key="lesson_next").label == "Go on without a prediction"
    press(app, "lesson_next")
    assert "Predicted" not in texts(app)


def test_a_claim_of_a_file_that_does_not_hold_is_marked():
    wrong = (DATA / "V1.toml").read_bytes().replace(b"IAE_load(PI) = 14.6", b"IAE_load(PI) = 41.6")
    app = upload(run_page("lessons"), "mine.toml", wrong)
    for _ in range(5):
        press(app, "lesson_next")
    assert texts(app).count("Does not hold here") == 1
    assert "**Does not hold here:** `IAE_load(PI) = 41.6` is 14.59" in texts(app)


def test_where_the_list_of_loops_is_full_a_lesson_says_so_and_shows_nothing_else():
    app = run_page("lessons", plant="7/(3s+1)")
    full = loops(app)
    while len(full.entries) < MOST_LOOPS:
        full = full.added(full.design)
    app.session_state["loops"] = full
    app.query_params.update({"lesson": "V1", "step": "3"})
    app.run()
    assert "delete one first" in app.error[0].value
    assert V1.moves[0].text not in texts(app)
    press(app, "lesson_close")
    press(app, "open_V1")  # from the list too
    assert "delete one first" in app.error[0].value


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"id = 3", "id must be a text"),
        (b"x", "the file is no TOML"),
        (b"a" * 40_000, "a lesson has at most 30000 bytes"),
        ((DATA / "V1.toml").read_bytes().replace(b"exp(-3s)", b"exp(3s)"), "design: plant"),
        ((DATA / "V1.toml").read_bytes().replace(b"Move tau_c", b"M" * (LONGEST["text"] + 1)), "play: text must have"),
    ],
)
def test_what_is_wrong_with_a_file_is_said_and_nothing_opens(content, said):
    app = upload(run_page("lessons"), "*bad*.toml", content)
    (error,) = app.error
    assert "`*bad*.toml` was not opened" in error.value
    assert said in error.value.replace("`", "")
    assert "lesson" not in address(app)


def test_what_a_browser_kept_is_taken_as_far_as_it_is_understood():
    assert progress.read('{"V1": [2, true], "S3": [9, true], "X": [1, true], "S1": "no"}') == {"V1": [2, True]}
    for text in ("", "[]", "{", "[" * 10_000, '{"V1": [2, true]}' + " " * progress.LARGEST):
        assert progress.read(text) == {}


def test_sources_tell_each_publication_and_the_one_that_was_asked_for_first():
    app = run_page("sources", source="V06")
    found = [item.value for item in app.markdown if item.value.startswith("**[")]
    assert len(found) == len(SOURCES)
    assert found[0].startswith(r"**[\[V06\]]")
    assert "Equation numbers 19 and 20" in texts(app)
    assert "[The wrong way first](lessons?lesson=V2&step=1)" in texts(app)


def test_a_key_in_brackets_leads_to_its_source_with_its_full_name_on_hover():
    link = f'[V06](sources?source=V06 "{SOURCES["V06"]}")'
    assert cited("V06") == rf"\[{link}\]"
    assert linked("as in [V06 eq. 7; SK98], not [no]").startswith(rf"as in \[{link} eq. 7; [SK98](sources?source=SK98 ")
    assert linked("as in [V06 eq. 7], not [no]").endswith(r"\], not [no]")
