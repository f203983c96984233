"""Settings in the box: what is typed, what that makes, and what it does to the loop; and the way back."""

from dataclasses import replace
from html import escape

import streamlit as st

from pages.common.parts.copyable import copyable
from pages.common.parts.number_field import design_number, number_field
from pages.common.parts.panel import Panel, field
from pages.common.parts.symbols import sentence
from pages.common.parts.units import time_text
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.session.sheet import Sheet
from pages.common.studies.single import Study, judged_settings
from pages.common.take_home.proof import (
    AS_TYPED,
    DESIGN,
    SAMPLED,
    kicks,
    longest_period,
    responses,
    sampled,
    sampled_response,
    table,
)
from pages.common.take_home.remedies import remedies
from pages.common.take_home.typed import as_text, assumed, name_of, read_from, rows, typed_into
from pages.common.words import number, translated, words
from simc_core import BOXES, Typed
from simc_core.errors import BoxError, SimcError
from simc_core.figures import input_figure, output_figure
from simc_core.implementation.boxes.box import PV_FILTER, STRUCTURE
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.simulation import TimeResponse
from simc_core.wording import joined, said

HEIGHT = 260  # px
WITHOUT_KICK = said(
    "These settings differentiate the set point without a filter, which makes u infinite at a step. They were taken "
    "with c = 0, the derivative on PV: the same margins and the same load response."
)
LAWS = {"backward": said("backward"), "tustin": said("Tustin")}


def choose(design: Design) -> None:
    """Which box, rounded or not, and how often it samples."""
    state.set_widget("box", design.box or None)
    st.selectbox(
        words("What the settings are typed into"),
        list(BOXES),
        format_func=lambda key: translated(name_of(key)),
        index=None,
        placeholder=words("Choose a controller"),
        key="box",
        on_change=lambda: state.overtaken("box") or state.change(box=state.widget("box") or ""),
    )
    state.set_widget("rounded", design.home.rounding == "safe")
    st.toggle(
        words("Rounded to what can be typed"),
        key="rounded",
        on_change=lambda: (
            state.overtaken("rounded") or state.change(rounding="safe" if state.widget("rounded") else "none")
        ),
        help=words("On the safe side: gain down, τI up."),
    )
    places = st.columns(2, gap="small")
    design_number("sampling", words("Sampling period"), quantity="time", key="home_sampling", place=places[0])
    if design.actuator.h:
        state.set_widget("law", design.actuator.law)
        places[1].selectbox(
            words("Law of the box"),
            list(LAWS),
            format_func=lambda law: translated(LAWS[law]),
            key="law",
            on_change=lambda: state.overtaken("law") or state.change(law=state.widget("law")),
        )
        state.set_widget("scans", bool(design.actuator.delay_scans))
        st.toggle(
            words("Output written one scan later"),
            key="scans",
            on_change=lambda: state.overtaken("scans") or state.change(scans=int(state.widget("scans"))),
            help=words("A box that reads, computes, and writes at the end of its scan or at the next one."),
        )


def numbers(design: Design, present: Study) -> Typed:
    """What is typed. Raises SimcError where the box does not take the design."""
    found = typed_into(design.box, present.controller, design.sheet, design.home.rounding == "safe")
    shown = rows(design.box, found, design.sheet)
    st.caption(
        words("My settings, as this box has them:")
        if design.source == "own"
        else words("The settings by SIMC, as this box has them:")
    )
    st.html(_numbers_html(shown))
    copyable(as_text(shown), "typed")
    taken = assumed(design.sheet)
    if taken:
        st.info(words("The loop sheet does not tell it: {assumed}.", assumed=joined(taken)))
    return found


def refused(design: Design, present: Study, error: BoxError) -> None:
    """A number that the box does not take; the nearest that it does, and what the loop is with it."""
    st.error(words("**This box does not take the design.** {error}", error=sentence(str(error))))
    try:
        found = typed_into(design.box, present.controller, design.sheet, design.home.rounding == "safe", nearest=True)
        typed = judged_settings(design.plant, found.effective)
    except SimcError:  # the box has no form of it at all
        return
    with st.container(border=True):
        designed = number(present.margins.Ms)
        st.markdown(
            words(
                "With the nearest numbers that it takes, $M_s$ = {Ms}, {designed} as designed.",
                Ms=number(typed.margins.Ms),
                designed=designed,
            )
            if typed.stable
            else words(
                "With the nearest numbers that it takes, the loop is not stable, {designed} as designed.",
                designed=designed,
            )
        )
        copyable(as_text(rows(design.box, found, design.sheet)), "nearest")


def proof(design: Design, present: Study, found: Typed) -> None:
    """Design, typed and sampled side by side: margins and responses."""
    typed = judged_settings(design.plant, found.effective)
    columns = {DESIGN: present.margins, AS_TYPED: typed.margins}
    if design.actuator.h:
        columns |= _sampled(typed, design)
    lines = [
        {translated(name): translated(text) for name, text in line.items()}
        for line in table(columns, design.sheet.time_unit)
    ]
    st.dataframe(lines, hide_index=True, width="stretch", height="content")
    if design.actuator.h and typed.stable:
        _sampling(typed, design)
    _remedies(design, present, found)
    drawn, why = responses(present.loop, {DESIGN: present.loop, said("typed"): typed.loop}, design)
    if design.actuator.h and len(columns) == 3:
        drawn |= _sampled_response(present, typed, design)
    times = list(drawn.items())
    field(
        (
            Panel(
                "typed_y",
                "y",
                words("Output y of the design and as typed"),
                output_figure(times, HEIGHT, present.stable),
            ),
            Panel(
                "typed_u", "u", words("Input u of the design and as typed"), input_figure(times, HEIGHT, present.stable)
            ),
        )
    )
    for text in why:
        st.caption(sentence(text))


def notes(design: Design, found: Typed) -> None:
    """What differs from the design, what must be looked up, and where the law of the box was read."""
    box = BOXES[design.box]
    if found.warnings:
        st.warning("\n".join(f"- {sentence(warning)}" for warning in found.warnings))
    read_in = (
        words("Law as read in: {source}, a text of its maker.", source=box.source)
        if box.verified == "maker"
        else words("Law as read in: {source}, a text of a third party, not of its maker.", source=box.source)
    )
    st.html(f'<small class="source">{escape(read_in)}</small>')


def in_the_box_now(design: Design) -> None:
    """The way back: numbers that stand in the box become my settings."""
    box = BOXES[design.box]
    with st.expander(words("What is in the box now"), expanded=False):
        st.caption(words("Type what the box shows; it becomes *my settings* on the tuning page."))
        values: dict[str, float | None] = state.memory(f"box_{box.key}", dict)
        places = st.columns(min(len(box.fields), 3), gap="small")
        for i, (name, unit) in enumerate([*((each.name, each.unit) for each in box.fields), (PV_FILTER, "s")]):
            number_field(
                translated(name),
                values.get(name),
                lambda value: None,
                lambda value, name=name: values.__setitem__(name, value),
                f"box_{box.key}_{i}",
                unit=words("units") if unit == "units" else unit.replace("PV", design.sheet.PV_unit or "PV"),
                optional=True,
                place=places[i % len(places)],
            )
        action = st.segmented_control(
            words("Action"),
            ("reverse", "direct"),
            default="reverse",
            required=True,
            format_func=lambda action: translated(box.actions[action == "direct"]),
            key=f"box_{box.key}_action",
        )
        given: dict[str, float | str] = {name: value for name, value in values.items() if value is not None}
        structures = {name: name for name in box.structures}
        if structures:
            given[STRUCTURE] = st.selectbox(
                words("Structure"),
                list(box.structures),
                format_func=lambda name: translated(structures[name]),
                key=f"box_{box.key}_structure",
            )
        st.button(
            words("Use as my settings"), key="from_box", on_click=_take, args=(box.key, given, action, design.sheet)
        )
        why = state.memory(f"box_{box.key}_refused", str)
        if why:
            (st.info if why == WITHOUT_KICK else st.error)(sentence(why))


def _take(key: str, given: dict[str, float | str], action: str, sheet: Sheet) -> None:
    why = ""
    try:
        found = read_from(key, given, action, sheet)
        if kicks(found):  # which no page could draw
            found, why = replace(found, c=0.0), WITHOUT_KICK
        state.change(own=found, controller="own")
    except SimcError as error:
        why = str(error)
    state.remember(f"box_{key}_refused", why)


def _sampled_response(present: Study, typed: Study, design: Design) -> dict[str, TimeResponse]:
    """The loop as typed with the sampling period; none where that takes too many steps."""
    try:
        return {SAMPLED: sampled_response(present.loop, typed.loop, design)}
    except SimcError:
        return {}


def _remedies(design: Design, present: Study, found: Typed) -> None:
    """What filter and sampling of the box cost, made good again by a click."""
    try:
        offered = remedies(design, present, found)
    except SimcError:  # the law does not exist, which has been told
        return
    with st.container(horizontal=True, gap="small", key="remedies"):
        for i, remedy in enumerate(offered):
            st.button(translated(remedy.label), key=f"remedy_{i}", on_click=state.change, kwargs=remedy.change)


def _sampled(typed: Study, design: Design) -> dict[str, Margins]:
    """Margins with the sampling period, by the title of their column; none, and why, where the law does not exist."""
    try:
        return dict([sampled(typed.loop, design)])
    except SimcError as error:
        st.error(sentence(str(error)))
        return {}


def _sampling(typed: Study, design: Design) -> None:
    """Where sampling costs more than it should, up to which period it does not."""
    longest = longest_period(typed.loop, design.actuator.law, design.actuator.delay_scans)
    if design.actuator.h > longest:
        period = time_text(longest, design.sheet)
        st.warning(
            words(
                "Sampling is slow for this loop: take {period} or less, and $M_s$ rises by 5 % at most.", period=period
            )
        )


def _numbers_html(shown: list[dict[str, str]]) -> str:
    cells = "".join(
        "<div><small>{field}</small><b>{value}</b> <i>{unit}</i></div>".format(
            **{name: escape(translated(text)) for name, text in row.items()}
        )
        for row in shown
    )
    label = escape(words("What is typed into the box"))
    return f'<div class="typed" role="status" aria-label="{label}">{cells}</div>'
