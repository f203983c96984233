"""The list of loops in the sidebar, and the browser's own storage, where they stay from one visit to the next."""

from pathlib import Path

import streamlit as st

from pages.common.session import state
from pages.common.session.design import Design
from pages.common.session.kept import asked_browser, join_kept, to_keep
from pages.common.session.loops import MOST_LOOPS
from pages.common.words import translated, words

_storage = st.components.v2.component(
    "simc_storage",
    html="<span></span>",
    js=Path(__file__).with_name("storage.js").read_text(encoding="utf-8"),
)


def loops_menu() -> None:
    """Choose a loop, begin another one, duplicate or delete the one in use."""
    loops = state.loops()
    state.set_widget("loop", loops.current)
    st.selectbox(
        words("Loop"),
        range(len(loops.entries)),
        format_func=lambda i: translated(loops.names[i]),
        key="loop",
        on_change=_switch,
    )
    full = len(loops.entries) >= MOST_LOOPS
    with st.container(horizontal=True, gap="xsmall"):
        st.button(words("New"), key="loop_new", disabled=full, help=words("Begin another loop."), on_click=_add)
        st.button(
            words("Duplicate"),
            key="loop_duplicate",
            disabled=full,
            help=words("A copy of this loop to change."),
            on_click=_duplicate,
        )
        st.button(words("Delete"), key="loop_delete", help=words("Delete this loop from the list."), on_click=_delete)
    keep()


def keep() -> None:
    """Ask the browser once what it keeps; after that tell it."""
    if not asked_browser():
        _storage(key="storage", data={"ask": True}, on_kept_change=_take_kept)
        return
    mine, known = to_keep()
    _storage(key="storage", data={"mine": mine, "known": known}, on_kept_change=_take_kept)


def _take_kept() -> None:
    join_kept(str(state.widget("storage")["kept"]["text"]))


def _switch() -> None:
    chosen = state.widget("loop")
    if state.overtaken("loop") or not isinstance(chosen, int):  # the browser told a name that has changed meanwhile
        return
    state.take_loops(state.loops().switched(chosen))


def _add() -> None:
    state.take_loops(state.loops().added(Design()))


def _duplicate() -> None:
    state.take_loops(state.loops().duplicated())


def _delete() -> None:
    state.take_loops(state.loops().removed())
