"""Enter a plant and see what it is."""

import streamlit as st

from pages.common.plant.entry import plant_entry
from pages.common.plant.view import facts, figures
from pages.common.shell import header

header.show("plant")
with st.container(key="stack_plant"):
    entry, view = st.columns([5, 8], gap="medium")
with entry:
    plant = plant_entry()
    facts(plant)
with view:
    figures(plant)
