"""A lesson, step by step: play, question, moves, answer, numbers. The figure stands beside the text."""

import streamlit as st

from pages.common.lessons import in_use, progress
from pages.common.lessons.answer import answer, numbers, predicted
from pages.common.lessons.lesson import MOVING, Lesson
from pages.common.lessons.shelf import after
from pages.common.lessons.stage import stage
from pages.common.lessons.texts import named, shown
from pages.common.parts.formula import fitted
from pages.common.parts.refusals import explain_refusal
from pages.common.parts.sources import cited
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.shell.lecture import lecture
from pages.common.words import translated, words
from simc_core.wording import said

LETTERS = "ABCDE"
QUESTION = 2
PLAY, ASK = said("Play", context="step of a lesson"), said("Question", context="step of a lesson")
ANSWER, NUMBERS = said("Answer", context="step of a lesson"), said("Numbers", context="step of a lesson")


def lesson_view(lesson: Lesson) -> None:
    """The step that the address names."""
    step = in_use.step_now(lesson)
    lecture("lessons", step != QUESTION and lesson.move_at(step).shows in MOVING)
    _title(lesson, step)
    with explain_refusal():
        in_use.arrive(lesson, step)
        _step(lesson, step, state.design_now())


def _step(lesson: Lesson, step: int, design: Design) -> None:
    if step == QUESTION:
        with st.container(key="lesson_question"):
            about(lesson, design)
            _question(lesson)
            _way(lesson, step)
        return
    with st.container(key="stack_lesson"):
        text, figure = st.columns([4, 8], gap="medium")
    with text:
        about(lesson, design)
        _told(lesson, step)
        _way(lesson, step)
    with figure, explain_refusal():
        stage(lesson, lesson.move_at(step), design, lesson.numbers if step > lesson.answer_at else ())


def about(lesson: Lesson, design: Design) -> None:
    """The plant, typeset."""
    if lesson.move_at(1).shows == "trend":
        return
    with st.container(key="lesson_plant"):
        if lesson.subject == "cascade":
            blocks = design.cascade.primary, design.cascade.secondary
            for name, block in zip("ab", blocks, strict=True):
                st.markdown(f"$G_{name}(s) = {fitted(block)}$")
        else:
            st.markdown(f"$G(s) = {fitted(design.plant)}$")


def _title(lesson: Lesson, step: int) -> None:
    with st.container(key="lesson_title", horizontal=True, vertical_alignment="center", gap="small"):
        st.button(words("All lessons"), key="lesson_close", icon=":material/arrow_back:", on_click=in_use.close)
        st.markdown(f"# {named(lesson, lesson.title)}", width="content")
        if lesson.source:
            st.markdown(f"{cited(lesson.source)} {shown(lesson, lesson.where)}", width="content")
        st.caption(_place(lesson, step), width="content")


def _place(lesson: Lesson, step: int) -> str:
    """The step by its name, and where it stands."""
    named = {1: PLAY, QUESTION: ASK, lesson.answer_at: ANSWER, lesson.answer_at + 1: NUMBERS}
    name = translated(named[step]) if step in named else words("Move {i}", i=step - QUESTION)
    return words("{name}, step {step} of {steps}", name=name, step=step, steps=lesson.steps)


def _question(lesson: Lesson) -> None:
    """The question alone, and the choices: one is pressed before anything moves."""
    st.markdown(f"## {named(lesson, lesson.question)}")
    chosen = progress.prediction(lesson)
    for i, choice in enumerate(lesson.choices, start=1):
        st.button(
            f"**{LETTERS[i - 1]}**  {named(lesson, choice)}",
            key=f"choice_{i}",
            type="primary" if i == chosen else "secondary",
            width="stretch",
            on_click=progress.predict,
            args=(lesson, i),
        )


def _told(lesson: Lesson, step: int) -> None:
    """What the step says."""
    if step >= lesson.answer_at:
        progress.seen(lesson)
        answer(lesson, LETTERS) if step == lesson.answer_at else numbers(lesson)
        return
    if step > QUESTION:
        st.markdown(f"**{shown(lesson, lesson.question)}**")
        if chosen := progress.prediction(lesson):
            st.caption(predicted(lesson, chosen, LETTERS))
    with st.container(key="lesson_text"):
        st.markdown(shown(lesson, lesson.move_at(step).text))


def _way(lesson: Lesson, step: int) -> None:
    """Back, on, and what was moved back to where it was."""
    with st.container(key="lesson_way", horizontal=True, vertical_alignment="center", gap="small"):
        if step > 1:
            st.button(words("Back"), key="lesson_back", shortcut="b", on_click=in_use.open_at, args=(lesson, step - 1))
        if step < lesson.steps:
            waits = step == QUESTION and not progress.prediction(lesson)
            st.button(
                words("Go on without a prediction") if waits else words("Next"),
                key="lesson_next",
                type="secondary" if waits else "primary",
                shortcut="n",
                on_click=in_use.open_at,
                args=(lesson, step + 1),
            )
        elif following := after(lesson):
            st.button(
                words("Next lesson: {title}", title=named(following, following.title)),
                key="lesson_after",
                type="primary",
                on_click=in_use.open_at,
                args=(following, 1),
            )
        if step != QUESTION and lesson.move_at(step).shows in MOVING:
            st.button(
                words("Put back"),
                key="lesson_put_back",
                shortcut="z",
                help=words("What was moved goes back to where this step began."),
                on_click=in_use.put_back,
                args=(lesson, step),
            )
