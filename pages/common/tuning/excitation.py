"""What the figures show: heights, times and ramps of set point and load."""

import streamlit as st

from pages.common.parts.number_field import design_number
from pages.common.session.design import Design
from simc_core.notation import number

STEP = "Height of its change. Margins and metrics are those of unit steps in any case."
LOAD = "Height of the disturbance at the plant input, in the unit of OP. " + STEP
LIMITED = "Of the controller, as a change from where the loop rests; empty for none."
LIMITS = (
    ("r_low", "Lowest set point", "PV"),
    ("r_high", "Highest set point", "PV"),
    ("r_rate", "Fastest set point", "PV/time"),
)
RAMP = "Time in which it rises evenly to its height; 0 for a step at once."


def excitation(design: Design) -> None:
    """What is shown, folded; its fields are made when it is opened."""
    folded = st.expander("Set point and load shown", key="excitation", on_change="rerun")
    if folded.open:
        with folded:
            _fields(design)


def _fields(design: Design) -> None:
    """Heights and times; ramps where they tell more than steps: an integrating plant follows them with an error."""
    asked = design.excitation
    first, second, under = *st.columns(2, gap="small"), st.container()
    design_number("r", "Set point step", quantity="PV", place=first, under=under, help=STEP)
    design_number("d", "Load step", quantity="OP", place=second, under=under, help=LOAD)
    design_number(
        "d_time", "Load begins at", quantity="time", optional=True, under=under, placeholder="when r has settled"
    )
    if design.plant.integrators or asked.setpoint_ramp or asked.disturbance_ramp:
        first, second, under = *st.columns(2, gap="small"), st.container()
        design_number("r_ramp", "Set point over", quantity="time", place=first, under=under, help=RAMP)
        design_number("d_ramp", "Load over", quantity="time", place=second, under=under, help=RAMP)
    with st.popover("Limits of the set point", width="stretch"):
        for name, label, unit in LIMITS:
            design_number(name, label, quantity=unit, optional=True, placeholder="none", help=LIMITED)
    if asked.reached != asked.setpoint:
        st.caption(f"The set point stops at {number(asked.reached)}, its limit.")
