"""Gain schedule: operating points, settings there, Ms between them, the schedule as code and as a table."""

import numpy as np
import streamlit as st

from pages.common.parts.foreign_text import told
from pages.common.parts.panel import show
from pages.common.parts.symbols import sentence
from pages.common.parts.units import with_plain_unit
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.studies.single import Study
from pages.common.take_home.code import not_compiled
from pages.common.take_home.operating_points import (
    points_of,
    schedule_code,
    schedule_csv,
    schedule_of,
    table_of,
    text_of,
)
from pages.common.take_home.written import LANGUAGES
from pages.common.words import number, translated, words
from simc_core import GainSchedule, margins_many
from simc_core.errors import SimcError
from simc_core.figures import schedule_figure
from simc_core.implementation.exports.schedule import WRITERS
from simc_core.implementation.gain_schedule import GAIN_OF_PLANT, TOO_HIGH
from simc_core.loops.loop import Loop
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.wording import said

HEIGHT = 280  # px
WHAT = {"model": said("the model, then tune"), "PB": said("1/Kc, τI and τD")}
PEAKS = {"linear": said("k linear between rows"), "exponential": said("k exponential between rows")}
EXAMPLE = "20  1  4  20\n50  2  3  15\n80  5  2  8"


def schedule(design: Design, present: Study) -> None:
    """Raises SimcError where the points make no schedule."""
    _points(design)
    design = state.design_now()
    if not design.home.points:
        st.info(
            words(
                "Where the plant changes with the operating point, settings follow a scheduling value: a row for each "
                "point, at least two."
            )
        )
        return
    made = schedule_of(design)
    _settings(made, design)
    _between(made)
    _files(made, design)


def _points(design: Design) -> None:
    """What is typed or pasted stays as it is, with the reason below it where it cannot be used."""
    text, points, why = state.memory("points", lambda: (text_of(design.home.points), design.home.points, ""))
    if points != design.home.points:  # changed elsewhere
        text, points, why = text_of(design.home.points), design.home.points, ""
        state.remember("points", (text, points, why))
    state.set_widget("points_text", text)
    st.text_area(
        words("Operating points: scheduling value, k, θ, τ1, and τ2 for PID"),
        key="points_text",
        height=130,
        placeholder=EXAMPLE,
        on_change=_take,
        help=words(
            "One a line, or pasted from a spreadsheet. Three numbers, value, k′, θ, for an integrating plant. "
            "Schedule on set point or load rather than PV."
        ),
    )
    if why:
        st.error(words("{why}. The points before stay in use.", why=told(why)))
    st.segmented_control(
        words("Between them"),
        list(WHAT),
        format_func=lambda what: translated(WHAT[what]),
        required=True,
        **state.bound("between"),
    )


def _take() -> None:
    if state.overtaken("points_text"):
        return
    text = state.widget("points_text") or ""
    try:
        points = points_of(text)
        state.change(points=points)
        why = ""
    except SimcError as error:
        points, why = state.value("points"), str(error)
    state.remember("points", (text, points, why))


def _settings(made: GainSchedule, design: Design) -> None:
    unit = design.sheet.time_unit
    judged = _judged(made)
    rows = []
    for x, controller, each in zip(made.values, made.rows, judged, strict=True):
        shown = {words("value"): number(x, 6)}
        for name, value in controller.settings.items():
            if name == "tau_D" and not any(row.settings["tau_D"] for row in made.rows):
                continue
            label = name.replace("tau_", "τ")
            shown[with_plain_unit(label, unit * name.startswith("tau"))] = number(value)
        rows.append(shown | {"Ms": number(each.Ms) if each.stable else words("not stable")})
    st.dataframe(rows, hide_index=True, width="stretch", height="content")


def _judged(made: GainSchedule) -> list[Margins]:
    return margins_many([Loop(model.plant, row) for model, row in zip(made.models, made.rows, strict=True)])


def _between(made: GainSchedule) -> None:
    peaks = {PEAKS[gain]: made.peaks(gain) for gain in GAIN_OF_PLANT}
    at_rows = np.array([each.Ms if each.stable else np.inf for each in _judged(made)])
    limit = TOO_HIGH * float(at_rows.max())
    figure = schedule_figure(peaks, (np.array(made.values), at_rows), limit, HEIGHT)
    show(figure, "schedule", words("Ms over the scheduling value, between the rows of the schedule"))
    for warning in made.warnings():
        st.warning(sentence(warning))


def _files(made: GainSchedule, design: Design) -> None:
    table = table_of(made)
    st.caption(
        words(
            "As a program has it: {n} rows of 1/Kp, τI, τD of the ideal form, straight lines between them; "
            "largest Ms {Ms}.",
            n=len(table.x),
            Ms=number(table.worst_Ms()),
        )
    )
    left, right = st.columns([3, 4], gap="small", vertical_alignment="bottom")
    chosen = design.home.language if design.home.language in WRITERS else None
    state.set_widget("schedule_language", chosen)
    left.selectbox(
        words("Language"),
        list(WRITERS),
        index=None,
        format_func=lambda key: translated(LANGUAGES[key].title),
        key="schedule_language",
        placeholder=words("Choose a language"),
        on_change=lambda: (
            state.overtaken("schedule_language")
            or (state.widget("schedule_language") and state.change(language=state.widget("schedule_language")))
        ),
    )
    right.download_button(
        words("Table as CSV"),
        schedule_csv(table, design.sheet),
        "schedule.csv",
        "text/csv",
        key="schedule_csv",
        on_click="ignore",
    )
    if chosen is None:
        return
    text = schedule_code(design)
    language = LANGUAGES[chosen]
    name = f"schedule_{language.file}"
    st.download_button(
        words("Download {file}", file=name), text, name, "text/plain", key="schedule_file", on_click="ignore"
    )
    if not language.compiled:
        st.warning(not_compiled(language))
    st.code(text, language=language.colours, height=360)
