"""What was understood of the file, and what can be changed about it."""

import streamlit as st

from pages.common.from_data.work import Work
from pages.common.parts.foreign_text import exact, told
from pages.common.parts.number_field import number_field
from pages.common.session import state
from pages.common.words import translated, words
from simc_core import SimcError, checks
from simc_core.identification.experiments.known_controller import COMPUTED
from simc_core.identification.reading.questions import Question
from simc_core.identification.reading.roles import ROLES
from simc_core.wording import said

NONE = "none"
UNITS = ("s", "ms", "min", "h")
MEANING = {
    "PV": said("Column of PV, the measurement."),
    "OP": said("Column of OP, the controller output."),
    "SP": said("Column of SP, the set point."),
}
ASKED = {
    "day_first": said("Day first"),
    "decimal": said("Decimal"),
}
CHOICES = {
    NONE: said("none", context="column of a file"),
    "day first": said("day first"),
    "month first": said("month first"),
}


def show(work: Work) -> None:
    """Sentences, roles, and a field for each question."""
    reading = work.reading
    questions = {question.name: question for question in reading.questions}
    if not work.example:
        st.markdown(exact(work.name))
    with st.container(key="roles"):
        for role in ROLES:
            _role(work, role)
        _time_unit(work, questions)
    for name in ("period", "day_first", "decimal"):
        if name in questions:
            _question(work, questions[name])
    if len(work.table.sheets) > 1:
        _pick(work, "sheet", words("Sheet of the file"), list(work.table.sheets), work.how.get("sheet"))
    notes = [told(question.text) for question in reading.questions if question.assumed]
    if notes:
        st.info(words("Not certain, please check:") + "\n\n" + "\n".join(f"- {note}" for note in notes))
    why = state.lasting("from_data_answer", str)
    if why and work.trend is not None:
        st.error(told(why))
    if "controller" in work.how and work.trend is not None:
        st.warning(told(COMPUTED))
    with st.expander(words("What was understood")):
        st.markdown("\n".join(f"- {told(translated(sentence).rstrip('.'))}" for sentence in reading.understood))


def _role(work: Work, role: str) -> None:
    found = work.reading.roles.get(role, "")
    names = list(work.reading.signals)
    choices = names if role != "SP" else [NONE, *names]
    _pick(work, role, role, choices, found or (NONE if role == "SP" else None), translated(MEANING[role]))


def _time_unit(work: Work, questions: dict[str, Question]) -> None:
    if "time_unit" in questions or "time_unit" in work.how:
        _pick(work, "time_unit", words("Time is in"), list(UNITS), work.how.get("time_unit", "s"))


def _question(work: Work, question: Question) -> None:
    if question.name == "period":
        number_field(
            words("Seconds from one row to the next"),
            work.how.get("period"),
            lambda value: checks.real(said("It"), value, 1e-9, 1e9),
            lambda value: answer(work, "period", value),
            "period",
        )
        return
    st.caption(told(question.text))
    _pick(work, question.name, translated(ASKED[question.name]), list(question.choices), question.assumed)


def _pick(work: Work, name: str, label: str, choices: list[str], now: str | None, about: str | None = None) -> None:
    key = f"reading_{name}"
    state.set_widget(key, now if now in choices else None)
    st.selectbox(
        label,
        choices,
        index=None if now not in choices else 0,
        format_func=lambda choice: translated(CHOICES.get(choice, choice)),
        key=key,
        help=about,
        placeholder=translated(CHOICES[NONE]),
        on_change=_take,
        args=(work, name, key),
    )


def _take(work: Work, name: str, key: str) -> None:
    if state.overtaken(key):
        return
    given = state.widget(key)
    if given is not None:
        answer(work, name, given)


def answer(work: Work, name: str, given: object) -> None:
    """Callback: understand the file with this answer, or say why not."""
    why = ""
    try:
        if name in ROLES:
            roles = {role: column or None for role, column in work.reading.roles.items() if role in ROLES}
            other = next((role for role in ROLES if roles.get(role) == given and role != name), None)
            if other is not None:  # they change places
                roles[other] = roles.get(name)
            roles[name] = None if given == NONE else str(given)
            work.answer("columns", {role: column for role, column in roles.items() if column or role == "SP"})
        else:
            work.answer(name, given == "day first" if name == "day_first" else given)
        state.change(begin=None, end=None, bad=(), structure="")
    except SimcError as error:
        why = str(error)
    state.make_last("from_data_answer", why)
