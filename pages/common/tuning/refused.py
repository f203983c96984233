"""Where SIMC has no controller for a plant: the reason, what can be done, and the plant's open loop all the same."""

import math

import streamlit as st

from pages.common.parts.number_field import design_number
from pages.common.parts.panel import show
from pages.common.parts.refusals import explain_refusal
from pages.common.parts.rules_choice import rules_choice
from pages.common.tuning.widgets import structure
from simc_core import Loop, Plant
from simc_core.controllers.forms import IdealPid
from simc_core.errors import SimcError
from simc_core.figures import bode_figure, nyquist_figure
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.loop import frequency_response
from simc_core.sensitivity.margins import margins

HEIGHT = 420  # px


def choices() -> None:
    """All that may be the cause of a refusal stays to be chosen otherwise."""
    design_number("tau_c", "τc exactly", key="tau_c_exact", optional=True, placeholder="tight")
    structure()
    rules_choice()


def refused(plant: Plant, refusal: SimcError) -> None:
    """The refusal in words, and G itself over frequency."""
    with explain_refusal():
        raise refusal
    left, right = st.columns(2, gap="small")
    with left:
        st.markdown("**Bode diagram of the plant**")
        show(bode_figure(plant, height=HEIGHT), "plant_bode", "Bode diagram of the plant G")
    with right:
        st.markdown("**Nyquist curve of the plant**")
        alone = Loop(plant, IdealPid(1.0, math.inf))  # L = G
        curve = frequency_response(alone, omega_grid([alone.L]))
        figure = nyquist_figure([("G", curve)], margins(alone), HEIGHT)
        show(figure, "plant_nyquist", "Nyquist curve of the plant G")
        st.caption("This is L with a proportional controller of gain 1.")
