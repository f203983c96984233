"""The controller, by SIMC with its one knob tau_c or by my settings, and what it does to the full plant."""

import streamlit as st

from pages.common.parts.refusals import explain_refusal
from pages.common.parts.tabs import tabs
from pages.common.plant.entry import plant_entry
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.shell import header
from pages.common.studies.single import Study, attempt, present_study, study
from pages.common.tuning import guards
from pages.common.tuning.actuator_view import actuator_view, mark, reach
from pages.common.tuning.drag import STILL, drag, dragged
from pages.common.tuning.excitation import excitation
from pages.common.tuning.model_error_view import model_error_view
from pages.common.tuning.panels import open_loop, panels
from pages.common.tuning.pinned import design_table, pin_button, pinned_studies
from pages.common.tuning.readout import readout
from pages.common.tuning.refused import choices, refused
from pages.common.tuning.source import NOW, change_in_words, in_the_plant_now, my_settings, source_control
from pages.common.tuning.views import AS_BUILT, KEY, LIVE, VIEWS, open_view, opened
from pages.common.tuning.widgets import settings, structure, tau_c_control
from pages.common.words import words
from simc_core.wording import said


def decide(design: Design, made: Study | None, present: Study | None) -> Study | None:
    """What is to be decided, and what it comes to. Returns the settings in the plant now, if they were told."""
    change = st.popover(words("Change the plant"), width="stretch", key="change_plant", on_change="rerun")
    if change.open:
        with change:
            plant_entry()
    source_control(made)
    if design.source == "own":
        my_settings(made)
    elif present is None:
        choices()
    else:
        tau_c_control(present, slider=not (opened() == LIVE and dragged()))
        structure()
    if present:
        settings(present)
        pin_button(present)
        guards.show(present)
    if opened() != AS_BUILT:
        reach(design)
    baseline = in_the_plant_now(design.plant, present)
    excitation(design)
    return baseline


def look(design: Design, present: Study, baseline: Study | None) -> None:
    """The views; only the open one is made."""
    if baseline:
        with st.container(key="told"):
            st.markdown(
                words("**Against the settings now:** {change}", change=change_in_words(baseline, present)),
            )
    behind = [*([(NOW, baseline)] if baseline else []), *pinned_studies(design.plant, design.pins)]
    studies = [(said("present"), present), *behind]
    instrument, bode, error, built, table = tabs(VIEWS, KEY)
    if instrument.open:
        with instrument:
            if drag(design.plant, present, behind) == STILL:
                readout(present)
                panels(studies, design.excitation)
    if bode.open:
        with bode:
            open_loop(studies)
    if error.open:
        with error:
            model_error_view(present, design)
    if built.open:
        with built:
            actuator_view(present, design)
    if table.open:
        with table:
            design_table(studies)
            guards.poles(present)


def open_asked(view: str) -> None:
    """The view that a link names; figures were a tab of their own."""
    if view == "figures":
        open_view(LIVE)
        state.set_widget("drag", STILL)
    for name in VIEWS:
        if view == name.lower():
            open_view(name)


design = header.show("tuning")
open_asked(state.asked_view())
with st.spinner(words("Tuning the loop")):
    made, refusal = attempt(lambda: study(design.plant, design.tuning))
    present = made
    if design.source == "own":
        present, refusal = attempt(lambda: present_study(design))
mark(design, "narrow")
with st.container(key="tuning"):
    controls, view = st.columns([4, 11], gap="medium")
baseline = None
with controls:
    mark(design, "wide")
    with st.container(key="decided"), explain_refusal():
        baseline = decide(design, made, present)
with view:
    if present is None:
        refused(design.plant, refusal)
    else:
        with explain_refusal():
            look(design, present, baseline)
