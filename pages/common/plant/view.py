"""What a plant is: facts in words and numbers, and its pictures."""

import streamlit as st

from pages.common.parts.formula import fitted
from pages.common.parts.panel import show
from simc_core import Plant
from simc_core.figures import bode_figure, plant_step_figure, pole_zero_figure
from simc_core.notation import latex_number
from simc_core.plants.step_response import plant_step

GAINS = ("k", "k'", "k''", "k'''", "k''''")
SHOWN_ROOTS = 12
HEIGHT, TALL = 280, 360  # px


def facts(plant: Plant) -> None:
    """G(s) typeset, gain, dead time, poles and zeros."""
    st.markdown(f"$G(s) = {fitted(plant)}$")
    symbol = GAINS[plant.integrators]
    lines = [
        f"**{plant.kind.capitalize()}**",
        f"gain ${symbol} = {latex_number(plant.k)}$, dead time $\\theta = {latex_number(plant.theta)}$",
        f"poles: {_roots(plant.poles)}",
        f"zeros: {_roots(plant.zeros)}",
    ]
    st.markdown("  \n".join(lines))


def figures(plant: Plant) -> None:
    """Step response, pole-zero map and Bode diagram."""
    left, right = st.columns([3, 2])
    for place, title, key, figure in (
        (left, "Step response", "plant_step", plant_step_figure(plant_step(plant), height=HEIGHT)),
        (right, "Poles and zeros", "plant_roots", pole_zero_figure(plant, HEIGHT)),
        (st.container(), "Bode diagram", "plant_bode", bode_figure(plant, height=TALL)),
    ):
        with place:
            st.markdown(f"**{title}**")
            show(figure, key, f"{title} of the plant")


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
