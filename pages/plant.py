"""Enter a plant and see what it is."""

import streamlit as st

from pages.common import header
from pages.common.plant_entry import plant_entry
from pages.common.plant_view import facts, figures

header.show("plant")
entry, view = st.columns([5, 8], gap="medium")
with entry:
    plant = plant_entry()
    facts(plant)
with view:
    figures(plant)
