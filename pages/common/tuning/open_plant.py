"""What can be seen of a plant that no controller has been made for: its step response and its Bode diagram."""

import streamlit as st

from pages.common.parts.panel import show
from simc_core.figures import bode_figure, plant_step_figure
from simc_core.plants.plant import Plant
from simc_core.plants.step_response import plant_step

HEIGHT, TALL = 260, 360  # px


def open_plant(plant: Plant) -> None:
    """The plant alone, and the way on."""
    st.caption("The plant alone. *My settings* closes the loop with a controller of your own.")
    show(plant_step_figure(plant_step(plant), height=HEIGHT), "open_step", "Step response of the plant alone")
    show(bode_figure(plant, height=TALL), "open_bode", "Bode diagram of the plant alone")
