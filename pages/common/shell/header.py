"""The line on top of every page, and the sidebar: what is being worked on, where we are, how to take it along."""

from functools import partial

import streamlit as st

from pages.common.parts.copyable import copyable
from pages.common.parts.foreign_text import exact, told
from pages.common.parts.structures import told_of
from pages.common.parts.units import time_text
from pages.common.session import project, state
from pages.common.session.design import Design
from pages.common.shell.language import language_menu
from pages.common.shell.lecture import lecture, offer
from pages.common.shell.loops_menu import loops_menu
from pages.common.shell.paper import paper
from pages.common.shell.sheet_form import sheet_form
from pages.common.shell.styles import styles
from pages.common.words import translated, typeset, words
from simc_core.notation import latex
from simc_core.plants.plant import Plant
from simc_core.wording import said

GROUPS = {
    said("Start"): {"home": said("Home")},
    said("Model"): {"plant": said("Plant"), "from_data": said("From data"), "half_rule": said("Half rule")},
    said("Tune"): {"tuning": said("Tuning"), "rules": said("Rules"), "cascade": said("Cascade")},
    said("Use"): {"take_home": said("Take home"), "many": said("Many loops")},
    said("Learn"): {"lessons": said("Lessons"), "accuracy": said("Accuracy"), "sources": said("Sources")},
}
TITLES = {name: title for group in GROUPS.values() for name, title in group.items()}
EMBEDDED = (  # the line begins beside the button that opens the sidebar
    "<style>[data-testid=stMainBlockContainer] { padding: 0.5rem 1rem } [data-testid=stHeader] { background: none }"
    ".st-key-line { padding-left: 2.5rem }</style>"
)
CHAIN = ("plant", "half_rule", "tuning", "cascade")
NO_LOOP = ("lessons", "sources")  # pages that are about no loop of one's own
BESIDE = {"lessons": ("lesson", "step"), "sources": ("source",)}  # parameters of a page beside those of the design


def title_of(place: str) -> str:
    """What a page is called, in the language in use."""
    return translated(TITLES[place])


def go(place: str) -> None:
    """Open another page with the present design; alone, without the router, show the present one again."""
    page = state.page(place)
    if page is None:
        st.rerun()
    st.switch_page(page, query_params=state.parameters())


def show(place: str) -> Design:
    """Page settings, the line on top, notices and the sidebar. `place` is a key of TITLES. Returns the design."""
    embedded = bool(st.context.is_embedded)  # in a page of a course, which has little room
    st.set_page_config(
        page_title=f"{title_of(place)} · SIMC",
        page_icon="🎚️",
        layout="wide",
        initial_sidebar_state="collapsed" if embedded else "auto",
    )
    st.html(styles() + (EMBEDDED if embedded else ""))
    design = state.begin(BESIDE.get(place, ()))
    if place not in NO_LOOP:
        _line(place, design)
    paper()
    if place != "lessons":  # each step of a lesson is another thing to show: lessons/view.py
        lecture(place)
    _notices()
    with st.sidebar:
        loops_menu()
        sheet_form()
        _take_along(place)
        language_menu()
    return design


def _line(place: str, design: Design) -> None:
    """What is being worked on."""
    with st.container(key="line", horizontal=True, vertical_alignment="center", gap="medium"):
        if place != "home":  # which has a title of its own
            named = "unseen" if place in CHAIN else ""  # the chain marks it for the eye
            st.html(f'<h1 class="{named}">{title_of(place)}</h1>', width="content")
        if tag := design.sheet.tag:
            st.markdown(exact(tag), width="content")
        if place == "cascade":
            _block("G_a", design.cascade.primary)
            _block("G_b", design.cascade.secondary)
        else:
            _block("G", design.plant)
            theta = time_text(design.plant.theta, design.sheet)
            about = told_of(design.origin) if design.origin else None
            st.caption(f"{translated(design.plant.kind)}, $\\theta$ = {theta}", width="content", help=about)
        if place in CHAIN and not st.context.is_embedded:
            chain(place)


def chain(place: str, key: str = "chain") -> None:
    """Plant > Half rule > Tuning > Cascade, to click, with the present place marked."""
    with st.container(key=key, horizontal=True, vertical_alignment="center", gap="xsmall", width="content"):
        for i, name in enumerate(CHAIN):
            if i:
                st.markdown(":gray[›]", width="content")
            page = state.page(name)
            if name == place:
                st.markdown(f"**:blue[{title_of(name)}]**", width="content")
            elif page is None:
                st.markdown(title_of(name), width="content")
            else:
                st.page_link(page, label=title_of(name), query_params=state.parameters())


def _block(name: str, plant: Plant) -> None:
    st.markdown(f"${name}(s) = {typeset(latex(plant))}$", width="content")


def _notices() -> None:
    ignored = state.ignored()
    if not ignored:
        return
    lines = "\n".join(
        words("- {given} was ignored: {why}", given=exact(notice.given), why=told(notice.why)) for notice in ignored
    )
    with st.container(horizontal=True, vertical_alignment="center"):
        st.warning(
            words("These parts of the link were not understood; the rest was taken.\n\n{lines}", lines=lines),
            width="stretch",
        )
        st.button(words("Dismiss"), on_click=state.dismiss_ignored)


def _take_along(place: str) -> None:
    st.caption(words("Share link: this page and design"))
    copyable(state.address(), "address_text")
    offer()
    content = partial(project.dump, state.loops())  # made when asked for: nothing is stored that runs replace
    st.download_button(
        words("Save project"), content, "simc-project.json", "application/json", width="stretch", on_click="ignore"
    )
    upload = st.file_uploader(words("Open project"), type="json", key="project_file", max_upload_size=1)
    if upload is not None:
        _open(upload, place)


def _open(upload, place: str) -> None:
    """Take the design of a file, once; a wrong file changes nothing and says why."""
    if state.lasting("opened", lambda: None) != upload.file_id:
        state.make_last("opened", upload.file_id)
        loops, why = project.load(upload.getvalue())
        state.make_last("refused", why)
        if loops is not None:
            state.take_loops(loops)
            if place == "home":
                go("tuning")
            st.rerun()
    why = state.lasting("refused", str)
    if why:
        st.error(words("{name} was not opened, nothing changed: {why}", name=exact(upload.name), why=told(why)))
    else:
        st.caption(words("Opened: {name}. Its loops are in the list above.", name=exact(upload.name)))
