"""Several loops: new, duplicate, switch, delete; nothing of one leaks into the next; what a browser keeps is joined."""

import time
from dataclasses import replace

import pytest

from pages.common.session import project, state
from pages.common.session.design import Design
from pages.common.session.loops import MOST_LOOPS, Entry, Loops
from pages.common.session.sheet import Sheet
from pages.common.session.state import ANSWERED
from pages.common.session.tuning import Tuning
from simc_core import InvalidParameter, Plant
from tests.pages.tools import address, run_page

HEATER = Design(Plant(2.2, 20.0, (180.0,)), Tuning(speed="1.5theta"), sheet=Sheet(tag="TIC-101", time_unit="s"))
LEVEL = Design(Plant(0.05, 2.0, integrators=1), sheet=Sheet(tag="LIC-7"))


def test_new_duplicate_switch_and_delete():
    loops = Loops((Entry(HEATER),)).added(LEVEL)
    assert loops.design == LEVEL
    assert loops.names == ["TIC-101", "LIC-7"]
    copy = loops.switched(0).duplicated()
    assert copy.design == replace(HEATER, sheet=replace(HEATER.sheet, tag="TIC-101 (copy)"))
    assert copy.removed().names == ["TIC-101", "LIC-7"]
    assert len(copy.ids) == 3


def test_the_last_loop_deleted_leaves_a_fresh_one():
    assert Loops((Entry(HEATER),)).removed().design == Design()


def test_more_loops_than_can_be_held_are_refused_with_the_way_out():
    full = Loops(tuple(Entry(HEATER) for _ in range(MOST_LOOPS)))
    with pytest.raises(InvalidParameter, match="delete one first"):
        full.added(LEVEL)


def test_loops_of_an_earlier_visit_come_back_and_a_link_is_one_more():
    kept, fresh = Loops((Entry(HEATER), Entry(LEVEL)), 1), Loops()
    assert fresh.joined(kept, opened=False) == kept
    with_link = Loops((Entry(Design(Plant(1.0, 1.0, (3.0,)))),)).joined(kept, opened=True)
    assert [entry.design.plant.lags for entry in with_link.entries] == [(180.0,), (), (3.0,)]
    assert with_link.current == 2
    assert Loops((Entry(HEATER),)).joined(kept, opened=True) == kept.switched(0)


def test_the_page_begins_another_loop_with_nothing_of_the_last_one():
    app = run_page("tuning", plant="2.2exp(-20s)/(180s+1)", tau_c="180", u_max="5")
    next(button for button in app.button if button.label == "New").click().run()
    assert not app.exception
    assert "tau_c" not in address(app)
    assert "u_max" not in address(app)
    time.sleep(ANSWERED)  # the page runs alone here: nobody tells that the run which chose the new loop has ended
    app.selectbox(key="loop").set_value(0).run()
    assert address(app)["tau_c"] == "180"


def test_another_loop_may_be_chosen_after_a_project_was_opened():
    """The file is still in its field: it is not opened again."""
    app = run_page("accuracy")
    file = project.dump(Loops((Entry(HEATER),)).added(LEVEL).switched(0)).encode()
    app.file_uploader(key="project_file").set_value(("loops.json", file, "application/json")).run()
    assert app.session_state["loops"].design == HEATER
    time.sleep(ANSWERED)
    app.selectbox(key="loop").set_value(1).run()
    assert app.session_state["loops"].design == LEVEL


def test_what_a_run_has_just_put_into_a_field_is_not_undone_by_a_report_from_before(monkeypatch):
    """A choice of speed puts its number into the field, and a message comes that still holds the former one."""
    monkeypatch.setattr(state, "monotonic", lambda: 0.0)  # all of it within ANSWERED
    app = run_page("tuning", "Figures", plant="2.2exp(-20s)/(180s+1)", tau_c="40")
    field = app.text_input(key="tau_c_exact")
    assert field.value == "40"
    app.button(key="multiple_1.5").click().run()
    assert address(app)["speed"] == "1.5theta"
    app.text_input(key="tau_c_exact").set_value("40").run()  # the same text as before
    assert address(app)["speed"] == "1.5theta"
    assert "tau_c" not in address(app)
