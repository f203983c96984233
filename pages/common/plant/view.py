"""What a plant is: facts in words and numbers, and its pictures."""

import streamlit as st

from pages.common.parts.formula import fitted
from pages.common.parts.panel import show
from pages.common.words import capitalised, translated, typeset, words
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
        f"**{capitalised(translated(plant.kind))}**",
        words(
            "gain ${symbol} = {k}$, dead time $\\theta = {theta}$",
            symbol=symbol,
            k=typeset(latex_number(plant.k)),
            theta=typeset(latex_number(plant.theta)),
        ),
        words("poles: {poles}", poles=_roots(plant.poles)),
        words("zeros: {zeros}", zeros=_roots(plant.zeros)),
    ]
    st.markdown("  \n".join(lines))


def figures(plant: Plant) -> None:
    """Step response, pole-zero map and Bode diagram."""
    left, right = st.columns([3, 2])
    step = plant_step_figure(plant_step(plant), height=HEIGHT)
    roots, bode = pole_zero_figure(plant, HEIGHT), bode_figure(plant, height=TALL)
    for place, title, alt, key, figure in (
        (left, words("Step response"), words("Step response of the plant"), "plant_step", step),
        (right, words("Poles and zeros"), words("Poles and zeros of the plant"), "plant_roots", roots),
        (st.container(), words("Bode diagram"), words("Bode diagram of the plant"), "plant_bode", bode),
    ):
        with place:
            st.markdown(f"**{title}**")
            show(figure, key, alt)


def _roots(roots) -> str:
    """Roots as mathematics; of a complex pair the upper one with ±."""
    if len(roots) == 0:
        return words("none", context="poles or zeros")
    shown = []
    for root in sorted(roots, key=lambda root: (abs(root), root.real)):
        if root.imag == 0:
            shown.append(latex_number(root.real + 0.0))
        elif root.imag > 0:
            shown.append(rf"{latex_number(root.real)} \pm {latex_number(root.imag)}i")
    roots = typeset("$" + r",\; ".join(shown[:SHOWN_ROOTS]) + "$")
    if len(shown) <= SHOWN_ROOTS:
        return roots
    return words("{roots} and {n} more", roots=roots, n=len(shown) - SHOWN_ROOTS)
