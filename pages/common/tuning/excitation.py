"""What the figures show: heights, times and ramps of set point and load."""

import streamlit as st

from pages.common.parts.number_field import design_number
from pages.common.session.design import Design

STEP = "Height of its change. Margins and metrics are those of unit steps in any case."
LOAD = "Height of the disturbance at the plant input, in the unit of OP. " + STEP
RAMP = "Time in which it rises evenly to its height; 0 for a step at once."


def excitation(design: Design) -> None:
    """Fields for it; ramps where they tell more than steps: an integrating plant follows them with an error."""
    asked = design.excitation
    with st.expander("Set point and load shown"):
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
