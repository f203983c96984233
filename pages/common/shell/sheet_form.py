"""The loop sheet in the sidebar, made when opened: tag, note, units, ranges. All of it may stay empty."""

import streamlit as st

from pages.common.parts.number_field import design_number
from pages.common.session import state
from pages.common.session.sheet import LONGEST, TIME_UNITS
from pages.common.session.time_unit import in_time_unit
from pages.common.words import translated, words
from simc_core.errors import SimcError
from simc_core.wording import said

SIGNALS = (("PV", said("Measurement PV")), ("OP", said("Output OP")))

ENDS = {
    "low": said("{signal} low", signal="PV"),
    "high": said("{signal} high", signal="PV"),
    "now": said("{signal} now", signal="PV"),
}


def sheet_form() -> None:
    """The sheet, folded; what was typed in it is in the design."""
    sheet = st.expander(words("Loop sheet"), key="sheet", on_change="rerun")
    if sheet.open:
        with sheet:
            _fields()


def _fields() -> None:
    """Fields of the sheet; another time unit converts the design and says so."""
    _text("tag", words("Tag"))
    state.set_widget("sheet_unit", state.value("unit"))
    st.selectbox(
        words("Time unit"),
        ["", *TIME_UNITS],
        format_func=lambda unit: unit or words("not named"),
        key="sheet_unit",
        on_change=_take_unit,
        help=words("Naming it the first time changes no number; another unit later converts all times."),
    )
    if converted := state.memory("unit_said", str):
        st.caption(translated(converted))
    for signal, label in SIGNALS:
        name, unit = st.columns(2, gap="small")
        with name:
            _text(signal, translated(label))
        with unit:
            _text(f"{signal}_unit", words("Unit of {signal}", signal=signal))
        for place, (end, name) in zip(st.columns(3, gap="small"), ENDS.items(), strict=True):
            design_number(f"{signal}_{end}", translated(name.put(signal=signal)), optional=True, place=place)
    _text("note", words("Note"))


def _text(name: str, label: str) -> None:
    st.text_input(label, max_chars=LONGEST[name], **state.bound(name))


def _take_unit() -> None:
    if state.overtaken("sheet_unit"):
        return
    old, new = state.value("unit"), state.widget("sheet_unit")
    try:
        state.replace_design(in_time_unit(state.design_now(), new))
    except SimcError as error:
        state.remember(
            "unit_said",
            said(
                "Not converted, the unit stays {old}: in {new} a number would be out of bounds ({error}).",
                old=old,
                new=new,
                error=error,
            ),
        )
        return
    converted = old and new and old != new
    state.remember(
        "unit_said",
        said("All times were converted from {old} to {new}: the loop is the same.", old=old, new=new)
        if converted
        else "",
    )
