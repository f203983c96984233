"""Where SIMC has no controller for a plant: the reason, what can be done, and the plant's open loop all the same."""

import streamlit as st

from pages.common.parts.number_field import design_number
from pages.common.parts.panel import show
from pages.common.parts.refusals import explain_refusal
from pages.common.parts.rules_choice import rules_choice
from pages.common.session import state
from pages.common.tuning.source import FIRST
from pages.common.tuning.widgets import structure
from pages.common.words import words
from simc_core import Plant
from simc_core.errors import SimcError
from simc_core.figures import bode_figure, plant_nyquist_figure

HEIGHT = 420  # px


def choices() -> None:
    """All that may be the cause of a refusal stays to be chosen otherwise."""
    design_number(
        "tau_c",
        words("τc, exact"),
        quantity="time",
        key="tau_c_exact",
        optional=True,
        placeholder=words("tight"),
    )
    structure()
    rules_choice()


def refused(plant: Plant, refusal: SimcError) -> None:
    """The refusal in words, what is possible all the same, and G itself over frequency."""
    with explain_refusal():
        raise refusal
    if state.value("controller") != "own":
        st.button(
            words("Close the loop with settings of my own"),
            key="own_instead",
            type="tertiary",
            icon=":material/arrow_forward:",
            on_click=state.change,
            kwargs={"own": state.value("own") or FIRST, "controller": "own"},
        )
    left, right = st.columns(2, gap="small")
    with left:
        st.markdown(f"**{words('Bode diagram of the plant')}**")
        show(bode_figure(plant, height=HEIGHT), "plant_bode", words("Bode diagram of the plant G"))
    with right:
        st.markdown(f"**{words('Nyquist curve of the plant')}**")
        show(plant_nyquist_figure(plant, HEIGHT), "plant_nyquist", words("Nyquist curve of the plant G"))
        st.caption(words("This is L with a proportional controller of gain 1."))
