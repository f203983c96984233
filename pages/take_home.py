"""The settings as they are typed or compiled into the controller at home, and proof that it behaves as designed."""

import streamlit as st

from pages.common.parts.refusals import explain_refusal
from pages.common.parts.tabs import tabs
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.shell import header
from pages.common.studies.single import Study, present_study
from pages.common.take_home import view as take_home
from pages.common.take_home.code import code
from pages.common.take_home.report_view import report_view
from pages.common.take_home.schedule import schedule
from pages.common.take_home.way_out import way_out
from pages.common.words import words
from simc_core.errors import BoxError, FormError
from simc_core.wording import said

VIEWS = (said("Settings"), said("Code"), said("Schedule"), said("Report"))


def in_the_box(design: Design, present: Study) -> None:
    """What is typed, the proof, what to mind; or what can be done where the box has no such form."""
    if not design.box:
        st.info(
            words(
                "Choose what you type the settings into. Forms, units, ranges and filters differ: the same three "
                "numbers are another controller in another box."
            )
        )
        return
    try:
        found = take_home.numbers(design, present)
    except FormError as error:
        way_out(design, present, error)
        return
    except BoxError as error:
        take_home.refused(design, present, error)
        return
    take_home.proof(design, present, found)
    take_home.notes(design, found)


design = header.show("take_home")
with explain_refusal():
    with st.spinner(words("Tuning the loop")):
        present = present_study(design)
    with st.container(key="stack_take_home"):
        controls, shown = st.columns([4, 11], gap="medium")
    with controls:
        take_home.choose(design)
        design = state.design_now()
        if design.box:
            take_home.in_the_box_now(design)
    with shown:
        for view, show in zip(tabs(VIEWS, "home_views"), (in_the_box, code, schedule, report_view), strict=True):
            if view.open:
                with view, explain_refusal():
                    show(design, present)
