"""The page of many loops: a list read, tuned beside the page, browsed, opened, taken home."""

import threading
import time

import pytest

from pages.common.many_loops import job, source
from pages.common.many_loops.as_design import design_of
from pages.common.session import links
from simc_core import IdealPid, Plant, SeriesPid, read_list, tune_row
from simc_core.many.example import example
from tests.pages.tools import run_page, texts

PATIENCE = 60.0  # seconds for a process to begin on a busy machine


def ended(work: job.Job) -> job.Job:
    end = time.monotonic() + PATIENCE
    while work.going and time.monotonic() < end:
        time.sleep(0.05)
    assert not work.going
    return work


def test_without_a_list_the_page_says_what_to_do():
    app = run_page("many")
    assert "Drop a list" in app.info[0].value
    assert not app.error


def test_the_example_is_tuned_browsed_and_filtered():
    app = run_page("many")
    app.button(key="loops_example").click().run()
    ended(app.session_state["lasting_many"].job)
    app.run()
    shown = texts(app)
    assert "62 loops, 60 tuned, 2 refused" in shown
    table = app.dataframe[-1].value
    assert len(table) == 62
    assert list(table["loop"][-2:]) == ["TC-900", "FC-901"]
    assert table["now"][0] == "not stable"
    app.selectbox(key="loops_show").select("refused").run()
    assert list(app.dataframe[-1].value["loop"]) == ["TC-900", "FC-901"]
    app.text_input(key="loops_tag").set_value("900").run()
    assert list(app.dataframe[-1].value["loop"]) == ["TC-900"]
    app.text_input(key="loops_tag").set_value("nowhere").run()
    assert "No loop is like this." in texts(app)


def test_a_list_that_was_read_waits_for_the_button():
    app = run_page("many")
    app.session_state["lasting_many"] = source.Work("mine.csv", read_list(example().encode()))
    app.run()
    assert app.button(key="loops_begin").label == "Tune 62 loops"
    assert list(app.dataframe[0].value["taken as"])[:4] == ["tag", "k", "theta", "tau1"]


def test_a_list_that_is_none_says_why():
    app = run_page("many")
    app.session_state["lasting_many_refused"] = ("<b>.csv", "the list must have a column plant, found `x`")
    app.run()
    assert "was not read" in app.error[0].value
    assert "`<b>.csv`" in app.error[0].value


def test_a_job_can_be_stopped_and_keeps_what_is_there(monkeypatch):
    monkeypatch.setattr(job, "CHUNK", 1)
    work = job.Job([{"k": 1, "theta": 1, "tau1": 8}] * 5000, "")
    end = time.monotonic() + PATIENCE
    while not work.results and time.monotonic() < end:
        time.sleep(0.01)
    work.stop()
    ended(work)
    assert work.state == "stopped"
    assert 0 < len(work.results) < 5000


def test_one_list_at_a_time():
    """A second list waits for its turn, and can be stopped while it waits."""
    assert job.TURN.acquire(timeout=PATIENCE)
    try:
        second = job.Job([{"k": 1, "theta": 1, "tau1": 8}], "")
        time.sleep(0.3)
        assert second.state == "waiting"
        second.stop()
        assert ended(second).state == "stopped"
    finally:
        job.TURN.release()


def test_a_fault_of_the_program_is_a_state_not_a_thread_that_dies(monkeypatch):
    monkeypatch.setattr(job, "tune_many", lambda *_: 1 / 0)
    assert ended(job.Job([{}], "")).state == "failed"
    assert not [each for each in threading.enumerate() if each.name == "many loops"]


@pytest.mark.parametrize(
    ("row", "expected"),
    [
        ({"tag": "A", "k": 2, "theta": 3, "tau1": 9, "time_unit": "min"}, {"unit": "min", "tag": "A"}),
        ({"k": 2, "theta": 3, "tau1": 9, "Kc": 1, "tau_I": 5}, {"now": IdealPid(1, 5)}),
        ({"k": 2, "theta": 3, "tau1": 9, "kind": "PID", "tau_c": 7}, {"order": 2, "tau_c": 7.0}),
        ({"k": 2, "theta": 3, "tau1": 9, "pv_span": 50}, {"PV_low": 0.0, "PV_high": 50.0}),
        ({"k": 2, "theta": 3, "tau1": 9, "box": "no such box"}, {"box": ""}),
    ],
)
def test_a_row_as_a_design(row, expected):
    design = design_of(tune_row(row))
    assert design.plant == Plant(2, 3, (9,))
    for name, value in expected.items():
        assert links.get(design, name) == value
    again, ignored = links.decode(links.encode(design))
    assert again == design
    assert not ignored


def test_a_row_by_another_rule_takes_its_settings_along():
    result = tune_row({"k": 2, "theta": 3, "tau1": 9, "rule": "amigo"})
    design = design_of(result)
    assert design.source == "own"
    assert design.own == result.controller
    assert isinstance(design.own, IdealPid | SeriesPid)
