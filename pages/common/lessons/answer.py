"""The answer of a lesson: the right choice, what was to be seen, and the printed numbers beside ours."""

import streamlit as st

from pages.common.lessons import progress
from pages.common.lessons.claims import checked, value_of
from pages.common.lessons.lesson import MOST_NUMBERS, Claim, Lesson, Printed
from pages.common.lessons.opened import Cases
from pages.common.lessons.texts import shown
from pages.common.parts.foreign_text import exact, told
from pages.common.words import number, numeral, translated, words
from simc_core.errors import SimcError
from simc_core.wording import counted


def answer(lesson: Lesson, letters: str) -> None:
    """The right choice, and what was to be seen."""
    st.markdown(f"**{shown(lesson, lesson.question)}**")
    right = lesson.right
    st.success(f"**{letters[right - 1]}. {shown(lesson, lesson.choices[right - 1])}**")
    chosen = progress.prediction(lesson)
    if chosen and chosen != right:
        st.caption(predicted(lesson, chosen, letters))
    st.markdown(shown(lesson, lesson.answer))
    if lesson.claims:
        cases = Cases(lesson)
        st.markdown(
            "\n".join(f"- {shown(lesson, claim.says)}{_doubt(lesson, claim, cases)}" for claim in lesson.claims)
        )


def predicted(lesson: Lesson, chosen: int, letters: str) -> str:
    """The choice that was made."""
    return words(
        "Predicted: {letter}. {choice}", letter=letters[chosen - 1], choice=shown(lesson, lesson.choices[chosen - 1])
    )


def _doubt(lesson: Lesson, claim: Claim, cases: Cases) -> str:
    """What does not hold of a claim of a file; those of the program are tested."""
    if lesson.own:
        return ""
    found = {check: checked(check, cases) for check in claim.checks}
    wrong = [
        f"{exact(check)} {told(outcome.fault)}"
        if outcome.fault
        else words("{check} is {found}", check=exact(check), found=number(outcome.left))
        for check, outcome in found.items()
        if not outcome.met
    ]
    return f" {words('**Does not hold here:** {wrong}', wrong='; '.join(wrong))}" if wrong else ""


def numbers(lesson: Lesson) -> None:
    """What was printed beside ours, four at a time."""
    if lesson.printed:
        _printed(lesson)
    if lesson.misprint:
        st.caption(words("Misprint: {misprint}", misprint=shown(lesson, lesson.misprint)))


def _printed(lesson: Lesson) -> None:
    """What the paper prints, and what the program computes now."""
    cases = Cases(lesson)
    few, more = lesson.printed[:MOST_NUMBERS], lesson.printed[MOST_NUMBERS:]
    _table(lesson, few, cases)
    if more:
        with st.expander(translated(counted("{n} more printed number", "{n} more printed numbers", len(more)))):
            _table(lesson, more, cases)


def _table(lesson: Lesson, rows: tuple[Printed, ...], cases: Cases) -> None:
    with st.container(key=f"printed_{rows[0].name}"):
        st.table(
            {
                words("quantity"): [shown(lesson, row.name) for row in rows],
                words("printed"): [numeral(row.value).replace("-", "−") for row in rows],
                words("here"): [_ours(row, cases) for row in rows],
                words("where", context="in a source"): [shown(lesson, row.where) for row in rows],
            }
        )
    for row in rows:
        if row.differs:
            st.caption(f"{shown(lesson, row.name)}: {shown(lesson, row.differs)}")


def _ours(row: Printed, cases: Cases) -> str:
    try:
        return number(value_of(row.of, cases)).replace("-", "−")
    except SimcError:
        return "–"
