"""All lessons: by subject or by paper, how far each has come, and one from a file."""

import streamlit as st

from pages.common.lessons import in_use, progress
from pages.common.lessons.lesson import Lesson
from pages.common.lessons.opened import check_designs
from pages.common.lessons.read import read_lesson
from pages.common.lessons.shelf import DATA, NO_PAPER, by_paper, by_subject
from pages.common.lessons.texts import named, shown
from pages.common.parts.foreign_text import exact, told
from pages.common.parts.sources import cited, linked
from pages.common.session import state
from pages.common.shell.lecture import lecture
from pages.common.words import translated, words
from simc_core.errors import SimcError
from simc_core.wording import said

ORDERS = {"subject": said("By subject"), "paper": said("By paper")}
EXAMPLE = DATA / "V1.toml"


def list_view() -> None:
    """The list."""
    lecture("lessons", instrument=False)
    if asked := state.place().get("lesson"):
        st.warning(words("There is no lesson {asked} here; these are there.", asked=exact(asked[:20])))
    with st.container(key="lesson_title"):
        st.markdown(f"# {words('Lessons')}")
    st.markdown(words("Play, predict, move, then see. Each takes five to ten minutes, alone or in a lecture hall."))
    order = st.segmented_control(
        words("Order", context="of a list"),
        list(ORDERS),
        format_func=lambda order: translated(ORDERS[order]),
        default="subject",
        required=True,
        key="lessons_order",
        persist_state="session",
        label_visibility="collapsed",
    )
    groups = by_paper() if order == "paper" else by_subject()
    for i, (title, found) in enumerate(groups.items()):
        if found:
            with st.container(key=f"lessons_{order}_{i}"):
                st.markdown(f"## {translated(title)}" if order == "subject" else f"**{linked(translated(title))}**")
            _cards(found, f"{order}_{i}")
    if progress.known():
        st.button(words("Forget my predictions"), key="progress_forget", on_click=progress.forget)
    _from_file()


def _cards(found: list[Lesson], name: str) -> None:
    with st.container(key=f"cards_{name}"):
        for lesson in found:
            with st.container(border=True, height="stretch", vertical_alignment="distribute", gap="xsmall"):
                source = (
                    f"{cited(lesson.source)} {shown(lesson, lesson.where)}" if lesson.source else translated(NO_PAPER)
                )
                st.markdown(" · ".join(filter(None, [source, progress.word(lesson)])))
                title = named(lesson, lesson.title)
                st.button(title, key=f"open_{lesson.id}", width="stretch", on_click=in_use.open_at, args=(lesson, 1))


def _from_file() -> None:
    """A lesson that somebody wrote."""
    with st.expander(words("A lesson of your own")):
        st.markdown(
            words(
                "A lesson is one text file: the question, the choices, the design as the fields of a link, the moves, "
                "what "
                "is claimed and what is printed. Download one, change it, open it here. All fields are told in "
                "*docs/lessons.md*."
            )
        )
        st.download_button(
            words("Download one to begin with"),
            EXAMPLE.read_bytes(),
            EXAMPLE.name,
            "application/toml",
            on_click="ignore",
        )
        upload = st.file_uploader(words("Open a lesson"), type="toml", key="lesson_file", max_upload_size=1)
        if upload is None:
            return
        try:
            lesson = read_lesson(upload.getvalue())
            check_designs(lesson)
        except SimcError as error:
            st.error(words("{name} was not opened: {error}", name=exact(upload.name), error=told(str(error))))
            return
        if state.lasting("lesson_opened", lambda: None) != upload.file_id:
            state.make_last("lesson_file", lesson)
            in_use.open_at(lesson, 1)
            state.make_last("lesson_opened", upload.file_id)
            st.rerun()
