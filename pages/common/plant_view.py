"""What a plant is: facts in words and numbers, and its pictures."""

import streamlit as st
from simc_core.plant_step import plant_step

from simc_core import Plant
from simc_core.notation import latex, latex_number

GAINS = ("k", "k'", "k''", "k'''", "k''''")
SHOWN_ROOTS = 12


def facts(plant: Plant) -> None:
    """G(s) typeset, gain, dead time, poles and zeros."""
    st.latex(f"G(s) = {latex(plant)}")
    symbol = GAINS[plant.integrators]
    lines = [
        f"**{plant.kind.capitalize()}**",
        f"gain ${symbol} = {latex_number(plant.k)}$, dead time $\\theta = {latex_number(plant.theta)}$",
        f"poles {_roots(plant.poles)}",
        f"zeros {_roots(plant.zeros)}",
    ]
    st.markdown("  \n".join(lines))


def figures(plant: Plant) -> None:
    """Step response, pole-zero map and Bode diagram."""
    left, right = st.columns([3, 2])
    left.plotly_chart(plant_step_figure(plant_step(plant)), key="plant_step")
    right.plotly_chart(pole_zero_figure(plant), key="plant_map")
    st.plotly_chart(bode_figure(plant), key="plant_bode")


def _roots(roots) -> str:
    """Roots as mathematics; of a complex pair the upper one with ±."""
    if len(roots) == 0:
        return "none"
    shown = []
    for root in sorted(roots, key=lambda root: (abs(root), root.real)):
        if root.imag == 0:
            shown.append(latex_number(root.real + 0.0))
        elif root.imag > 0:
            shown.append(rf"{latex_number(root.real)} \pm {latex_number(root.imag)}i")
    more = f" and {len(shown) - SHOWN_ROOTS} more" if len(shown) > SHOWN_ROOTS else ""
    return "$" + r",\; ".join(shown[:SHOWN_ROOTS]) + "$" + more
