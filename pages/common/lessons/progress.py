"""Which lessons were begun, what was predicted, and which are done: kept in the browser, nowhere else."""

import json
from pathlib import Path

import streamlit as st

from pages.common.lessons.lesson import Lesson
from pages.common.lessons.shelf import lessons
from pages.common.session import state
from pages.common.words import words

LARGEST = 20_000  # characters
_storage = st.components.v2.component(
    "simc_progress",
    html="<span></span>",
    js=Path(__file__).with_name("progress.js").read_text(encoding="utf-8"),
)
Known = dict[str, list]  # id: [the choice, counted from 1, 0 for none; whether the answer was seen]


def known() -> Known:
    """What this session knows."""
    return state.lasting("progress", dict)


def prediction(lesson: Lesson) -> int:
    """The choice that was made, 0 for none."""
    choice = known().get(_key(lesson), [0, False])[0]
    return choice if choice <= len(lesson.choices) else 0


def predict(lesson: Lesson, choice: int) -> None:
    """Make a choice."""
    known()[_key(lesson)] = [choice, known().get(_key(lesson), [0, False])[1]]


def seen(lesson: Lesson) -> None:
    """The answer was seen."""
    known()[_key(lesson)] = [prediction(lesson), True]


def word(lesson: Lesson) -> str:
    """How far it has come, in a word; empty for not begun."""
    if _key(lesson) not in known():
        return ""
    choice, done = known()[_key(lesson)]
    if not done:
        return words("begun")
    return words("✓ predicted") if choice == lesson.right else words("done")


def _key(lesson: Lesson) -> str:
    """A lesson of a file may have the id of one of the program's, and is not kept."""
    return lesson.id if lesson.own else f"file {lesson.id}"


def forget() -> None:
    """Begin anew."""
    known().clear()
    state.make_last("progress_forget", True)


def keep() -> None:
    """Ask the browser once what it keeps; after that tell it."""
    if not state.lasting("progress_asked", bool):
        _storage(key="progress", data={"ask": True}, on_kept_change=_take)
        return
    mine = {key: value for key, value in known().items() if key in lessons()}
    _storage(key="progress", data={"mine": mine, "forget": state.lasting("progress_forget", bool) and not mine})


def _take() -> None:
    state.make_last("progress_asked", True)
    for key, (choice, done) in read(str(state.widget("progress")["kept"]["text"])).items():
        mine = known().get(key, [0, False])  # a link may have opened an answer before the browser told
        known()[key] = [mine[0] or choice, mine[1] or done]


def read(text: str) -> Known:
    """What a browser kept, as far as it can be understood."""
    try:
        content = json.loads(text) if 0 < len(text) <= LARGEST else {}
    except (ValueError, RecursionError):
        return {}
    if not isinstance(content, dict):
        return {}
    return {key: value for key, value in content.items() if key in lessons() and _possible(lessons()[key], value)}


def _possible(lesson: Lesson, value) -> bool:
    match value:
        case [int(choice), bool()]:
            return 0 <= choice <= len(lesson.choices)
    return False
