"""What the program does, the way through it, and plants to begin with."""

import streamlit as st

from pages.common.parts.symbols import symbols
from pages.common.plant.view import size
from pages.common.session import state
from pages.common.shell import header
from simc_core.notation import latex
from simc_core.plants.examples import EXAMPLES

A_ROW = 3

header.show("home")
st.title("PI and PID tuning by SIMC, dead time exact")
st.markdown(
    "Enter the transfer function of a process, and the half rule reduces it to a model of first or second order, "
    "line by line. One number, the closed-loop time constant $\\tau_c$, then gives a controller in the form your "
    "control system uses. "
    "Every response, margin and peak is computed with exact dead time, and on the full plant, not on the model."
)
header.chain("home", key="way")
st.subheader("Begin with a plant from the literature")
for first in range(0, len(EXAMPLES), A_ROW):
    for column, example in zip(st.columns(A_ROW), EXAMPLES[first : first + A_ROW], strict=False):
        with column.container(border=True, height="stretch", vertical_alignment="distribute"):
            st.markdown(f"$\\displaystyle {size(example.plant)} {latex(example.plant)}$")
            st.caption(symbols(f"{example.note} {example.source}"))
            if st.button(example.name, key=f"example_{example.key}", width="stretch"):
                state.change(plant=example.plant)
                header.go("plant")
