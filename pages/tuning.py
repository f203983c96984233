"""One knob, tau_c: the controller it gives, and what that controller does to the full plant."""

import streamlit as st

from pages.common import live
from pages.common.parts.refusals import explain_refusal
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.shell import header
from pages.common.studies.single import Study, attempt
from pages.common.tuning import guards
from pages.common.tuning.actuator_view import actuator_view, mark
from pages.common.tuning.model_error_view import model_error_view
from pages.common.tuning.panels import open_loop, panels
from pages.common.tuning.pinned import design_table, pin_button, pinned_studies
from pages.common.tuning.readout import readout
from pages.common.tuning.refused import choices, refused
from pages.common.tuning.widgets import settings, structure, tau_c_control

VIEWS = ("Live", "Figures", "Bode of L", "Model error", "Actuator", "Compare")


def decide(design: Design, present: Study) -> None:
    """What is to be decided, and what it comes to."""
    tau_c_control(present, slider=state.widget("views", VIEWS[0]) != VIEWS[0])
    structure()
    settings(present)
    pin_button(design.tuning, present.tau_c)
    guards.show(present)


def look(design: Design, present: Study) -> None:
    """The views; only the open one is made."""
    studies = [("present", present), *pinned_studies(design.plant, design.pins)]
    instrument, figures, bode, error, built, table = st.tabs(VIEWS, key="views", on_change="rerun")
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


design = header.show("tuning")
present, refusal = attempt(design.plant, design.tuning)
mark(design.actuator, "narrow")
with st.container(key="tuning"):
    controls, view = st.columns([4, 11], gap="medium")
with controls:
    mark(design.actuator, "wide")
    if present is None:
        choices()
    else:
        with explain_refusal():
            decide(design, present)
with view:
    if present is None:
        refused(design.plant, refusal)
    else:
        with explain_refusal():
            look(design, present)
