"""Where in which lesson one is, and the loop that lessons use: those of one's own work stay as they are."""

from contextlib import suppress
from dataclasses import replace

import streamlit as st

from pages.common.lessons.lesson import Lesson, Move
from pages.common.lessons.opened import design_of
from pages.common.lessons.shelf import lessons
from pages.common.session import state
from pages.common.session.design import Design
from simc_core.errors import InvalidParameter

TAG = "Lesson "
FILE = "file"  # the place of a lesson that was opened from a file, which no link opens elsewhere


def lesson_now() -> Lesson | None:
    """The lesson that the address names; None for the list of them, or for one that is not there."""
    asked = state.place().get("lesson", "")
    return state.lasting("lesson_file", lambda: None) if asked == FILE else lessons().get(asked)


def step_now(lesson: Lesson) -> int:
    """The step that the address names, counted from 1; the nearest one that there is."""
    asked = state.place().get("step", "1")
    return min(max(int(asked), 1), lesson.steps) if asked.isdecimal() and len(asked) < 4 else 1


def open_at(lesson: Lesson, step: int) -> None:
    """Go to a step of a lesson, with what stands there at first; where the list of loops is full, `arrive` says so."""
    with suppress(InvalidParameter):
        put_back(lesson, step)
    state.go_to_place(lesson=lesson.id if lesson.own else FILE, step=str(step))


def close() -> None:
    """To the list of lessons. The loop of the lesson stays in the list of loops."""
    state.go_to_place()


def put_back(lesson: Lesson, step: int) -> None:
    """What stands there at first, whatever was moved. Raises InvalidParameter where the list of loops is full."""
    design = at_first(lesson, lesson.move_at(step))
    state.place_stands_for(design)
    loops = state.loops()
    mine = next((i for i, name in enumerate(loops.names) if name.startswith(TAG)), None)
    if mine is not None:
        state.take_loops(loops.switched(mine).with_design(design))
    elif loops.design == Design():
        state.take_loops(loops.with_design(design))
    else:
        state.add_loop(design)
    _arrived(lesson, step)


def at_first(lesson: Lesson, move: Move | None) -> Design:
    """The design of a move, under the name of the lesson."""
    design = design_of(lesson, (move or lesson.play).case)
    return replace(design, sheet=replace(design.sheet, tag=f"{TAG}{lesson.id}"))


def arrive(lesson: Lesson, step: int) -> None:
    """Open what a link, or another way to this place, asks for; what was moved here stays.

    A link that holds a design too has been moved, and is taken as it is.
    Raises InvalidParameter where the list of loops is full.
    """
    at = state.lasting("lesson_at", lambda: None)
    state.place_stands_for(at_first(lesson, lesson.move_at(step)))
    fresh = at is None and state.design_now().sheet.tag == f"{TAG}{lesson.id}"
    here = at is not None and at[:2] == (lesson.id, step) and (at[2] == _loop() or at[3] == state.design_now())
    if fresh or here:
        _arrived(lesson, step)
        return
    put_back(lesson, step)
    st.rerun()


def _arrived(lesson: Lesson, step: int) -> None:
    state.make_last("lesson_at", (lesson.id, step, _loop(), state.design_now()))


def _loop() -> str:
    loops = state.loops()
    return loops.entries[loops.current].id
