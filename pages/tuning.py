"""One knob, tau_c: the controller it gives, and what that controller does to the full plant."""

import streamlit as st

from pages.common import live
from pages.common.parts.refusals import explain_refusal
from pages.common.session import state
from pages.common.shell import header
from pages.common.studies.single import study
from pages.common.tuning import guards
from pages.common.tuning.actuator_view import actuator_view, mark
from pages.common.tuning.model_error_view import model_error_view
from pages.common.tuning.panels import open_loop, panels
from pages.common.tuning.pinned import design_table, pin_button, pinned_studies
from pages.common.tuning.readout import readout
from pages.common.tuning.widgets import settings, structure, tau_c_control

VIEWS = ("Live", "Figures", "Bode of L", "Model error", "Actuator", "Compare")

design = header.show("tuning")
with explain_refusal():
    present = study(design.plant, design.tuning)
    mark(design.actuator, "narrow")
    with st.container(key="tuning"):
        controls, view = st.columns([4, 11], gap="medium")
    with controls:
        mark(design.actuator, "wide")
        tau_c_control(present, slider=state.widget("views", VIEWS[0]) != VIEWS[0])
        structure()
        settings(present)
        pin_button(design.tuning, present.tau_c)
        guards.show(present)
    with view:
        studies = [("present", present), *pinned_studies(design.plant, design.pins)]
        instrument, figures, bode, error, built, table = st.tabs(
            VIEWS, key="views", on_change="rerun"
        )  # only the open one is made
        if instrument.open:
            with instrument:
                live.tuning_instrument(design.plant, studies)
        if figures.open:
            with figures:
                readout(present)
                panels(studies)
        if bode.open:
            with bode:
                open_loop(studies)
        if error.open:
            with error:
                model_error_view(present)
        if built.open:
            with built:
                actuator_view(present, design.actuator)
        if table.open:
            with table:
                design_table(studies)
                guards.poles(present)
