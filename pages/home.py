"""My plant in one field, everyday processes to begin with, and the examples of the papers."""

import streamlit as st

from pages.common.home.view import cards, my_plant, papers
from pages.common.shell import header
from pages.common.words import words
from simc_core.plants.examples import EVERYDAY

header.show("home")
st.title(words("PI and PID tuning by SIMC with exact dead time"))
my_plant()
st.header(words("Or begin with an everyday process"))
cards(EVERYDAY, "everyday")
papers()
