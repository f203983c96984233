"""Model error at a glance: what the controller does to plants a little different from the one it was made for."""

import math

import numpy as np
import streamlit as st

from pages.common.parts.in_sight import in_sight
from pages.common.parts.panel import show
from pages.common.parts.symbols import symbols
from pages.common.parts.units import time_text
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.session.excitation import Excitation
from pages.common.session.sheet import Sheet
from pages.common.studies.single import Study
from pages.common.tuning.measured_error_view import measured_error_view
from pages.common.words import number, numeral, translated, words
from simc_core.figures.robustness import band_figure, bundle_figure
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.loop import Loop
from simc_core.plants.models import UnstableDelay
from simc_core.simulation import simulate
from simc_core.simulation.horizon import times
from simc_core.studies.plant_family import Robustness, robustness
from simc_core.wording import said

HEIGHT = 420  # px
POINTS = 400
LONGEST = 1.0  # seconds of processor for the responses; a lightly damped plant may take 0.15 each
ERRORS = (said("From the record"), said("In per cent"))


def model_error_view(study: Study, design: Design) -> None:
    """What the record leaves open, of a plant that was identified; else, and on request, changes in per cent."""
    if design.uncertainty:
        chosen = st.segmented_control(
            words("Errors"), ERRORS, format_func=translated, default=ERRORS[0], required=True, key="errors"
        )
        if chosen == ERRORS[0]:
            measured_error_view(study, design)
            return
    _changed(study, design.excitation)


def _changed(study: Study, excitation: Excitation) -> None:
    """A change in per cent to choose; worst Ms with its corner, exact limits, and both bundles."""
    percent = st.slider(
        words("Change of k, θ and τ₁, each up or down by"),
        5,
        80,
        20,
        5,
        format="%d %%",
        key="change",
        help=words("$\\tau_1$ is the slowest lag. All corners, and a Latin hypercube of 24 plants between them."),
    )
    with st.spinner(words("Trying changed plants")):
        found = robustness(study.loop, percent / 100)
    st.markdown(summary(study, found, percent))
    begins, t_end = times(study.loop, excitation.scenario())
    nominal = simulate(study.loop, excitation.scenario(disturbance_time=begins, t_end=t_end))
    asked = excitation.scenario(disturbance_time=begins, t_end=t_end, t=np.linspace(0.0, t_end, POINTS))
    cases = (*found.corners, *found.samples)
    drawn = in_sight(cases, words("Simulating changed plants"), LONGEST)
    family = [simulate(case.loop, asked) for case in drawn]
    worst = simulate(found.worst.loop, asked)
    omega = omega_grid([study.loop.L])
    left, right = st.columns(2, gap="small")
    with left:
        figure = bundle_figure(nominal, family, worst, HEIGHT)
        show(figure, "bundle", words("Outputs y of the changed plants"))
        if len(family) < len(cases):
            st.caption(
                words(
                    "{drawn} of {n} changed plants are drawn: their responses take long to compute. $M_s$ and the "
                    "limits are of all.",
                    drawn=len(family),
                    n=len(cases),
                )
            )
    with right:
        figure = band_figure(found, study.loop.L(1j * omega), omega, HEIGHT)
        show(figure, "band", words("Nyquist curves of the changed plants"))


def summary(study: Study, found: Robustness, percent: int) -> str:
    """Worst case and exact limits in words."""
    worst, lines = found.worst_corner, []
    free = study.tuned and not isinstance(study.model, UnstableDelay)  # whose rule knows one tau_c
    if worst.stable:
        lines.append(
            words(
                "Worst $M_s$ at ±{percent} %: **{Ms}**, worst corner {corner}.",
                percent=percent,
                Ms=number(found.worst.Ms),
                corner=symbols(worst.name),
            )
        )
    else:
        lost = words(
            "**Not stable in {lost} of {n} corners** at ±{percent} %, among them {corner}.",
            lost=sum(not case.stable for case in found.corners),
            n=len(found.corners),
            percent=percent,
            corner=symbols(worst.name),
        )
        remedy = words("Increase $\\tau_c$.")
        lines.append(f"{lost} *{remedy}*" if free else lost)
    if study.stable:
        lines.append(limits(study.loop, found, state.design_now().sheet))
    return "  \n".join(lines)


def limits(loop: Loop, found: Robustness, sheet: Sheet) -> str:
    """The exact largest changes of k and of theta, each alone."""
    gain_high, gain_low, delay = words("gain any higher"), words("any lower"), words("dead time any longer")
    if math.isfinite(found.k_high):
        gain_high = words("gain up to {times} times", times=number(found.k_high))
    if found.k_low:
        gain_low = words("down to {times} times", times=number(found.k_low))
    if math.isfinite(found.theta_more):
        delay = words("dead time up to {time} longer", time=time_text(found.theta_more, sheet))
        if theta := loop.plant.theta:
            delay += f" ({numeral(f'{100 * found.theta_more / theta:.3g}')} %)"
    return words(
        "One at a time, exact: {gain_high}, or {gain_low}; {delay}.",
        gain_high=gain_high,
        gain_low=gain_low,
        delay=delay,
    )
