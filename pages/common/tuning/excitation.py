"""What the figures show: heights, times and ramps of set point and load."""

import streamlit as st

from pages.common.parts.number_field import design_number
from pages.common.session.design import Design
from pages.common.words import number, translated, words
from simc_core.wording import joined, said

STEP = said("Height of its change. Margins and metrics are those of unit steps in any case.")
LOAD = joined((said("Height of the disturbance at the plant input, in the unit of OP."), STEP), " ")
LIMITED = said("Of the controller, as a change from where the loop rests; empty for none.")
LIMITS = (
    ("r_low", said("Lowest set point"), "PV"),
    ("r_high", said("Highest set point"), "PV"),
    ("r_rate", said("Fastest set point"), "PV/time"),
)
RAMP = said("Time in which it rises evenly to its height; 0 for a step at once.")


def excitation(design: Design) -> None:
    """What is shown, folded; its fields are made when it is opened."""
    folded = st.expander(words("Set point and load shown"), key="excitation", on_change="rerun")
    if folded.open:
        with folded:
            _fields(design)


def _fields(design: Design) -> None:
    """Heights and times; ramps where they tell more than steps: an integrating plant follows them with an error."""
    asked = design.excitation
    first, second, under = *st.columns(2, gap="small"), st.container()
    design_number("r", words("Set point step"), quantity="PV", place=first, under=under, help=translated(STEP))
    design_number("d", words("Load step"), quantity="OP", place=second, under=under, help=translated(LOAD))
    design_number(
        "d_time",
        words("Load begins at"),
        quantity="time",
        optional=True,
        under=under,
        placeholder=words("when r has settled"),
    )
    if design.plant.integrators or asked.setpoint_ramp or asked.disturbance_ramp:
        first, second, under = *st.columns(2, gap="small"), st.container()
        ramp = translated(RAMP)
        design_number("r_ramp", words("Set point over"), quantity="time", place=first, under=under, help=ramp)
        design_number("d_ramp", words("Load over"), quantity="time", place=second, under=under, help=ramp)
    with st.popover(words("Limits of the set point"), width="stretch"):
        for name, label, unit in LIMITS:
            design_number(
                name,
                translated(label),
                quantity=unit,
                optional=True,
                placeholder=words("none", context="no limit"),
                help=translated(LIMITED),
            )
    if asked.reached != asked.setpoint:
        st.caption(words("The set point stops at {r}, its limit.", r=number(asked.reached)))
