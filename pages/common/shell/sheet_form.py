"""The loop sheet in the sidebar, made when opened: tag, note, units, ranges. All of it may stay empty."""

import streamlit as st

from pages.common.parts.number_field import design_number
from pages.common.session import state
from pages.common.session.sheet import LONGEST, TIME_UNITS
from pages.common.session.time_unit import in_time_unit
from simc_core.errors import SimcError

SIGNALS = (("PV", "Measurement PV"), ("OP", "Output OP"))


def sheet_form() -> None:
    """The sheet, folded; what was typed in it is in the design."""
    sheet = st.expander("Loop sheet", key="sheet", on_change="rerun")
    if sheet.open:
        with sheet:
            _fields()


def _fields() -> None:
    """Fields of the sheet; another time unit converts the design and says so."""
    _text("tag", "Tag")
    state.set_widget("sheet_unit", state.value("unit"))
    st.selectbox(
        "Time unit",
        ["", *TIME_UNITS],
        format_func=lambda unit: unit or "not named",
        key="sheet_unit",
        on_change=_take_unit,
        help="Naming it the first time changes no number; another unit later converts all times.",
    )
    if said := state.memory("unit_said", str):
        st.caption(said)
    for signal, words in SIGNALS:
        name, unit = st.columns(2, gap="small")
        with name:
            _text(signal, words)
        with unit:
            _text(f"{signal}_unit", f"Unit of {signal}")
        for place, end in zip(st.columns(3, gap="small"), ("low", "high", "now"), strict=True):
            design_number(f"{signal}_{end}", f"{signal} {end}", optional=True, place=place)
    _text("note", "Note")


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
            "unit_said", f"Not converted, the unit stays {old}: in {new} a number would be out of bounds ({error})."
        )
        return
    converted = old and new and old != new
    state.remember(
        "unit_said", f"All times were converted from {old} to {new}: the loop is the same." * bool(converted)
    )
