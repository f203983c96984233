"""The figures of the cascade page: y1, y2, u and Nyquist side by side, on a narrow screen one at a time; Bode, |S|."""

import streamlit as st

from pages.common.parts.panel import Panel, field, show
from pages.common.parts.units import time_text
from pages.common.session import state
from pages.common.studies.cascade import CascadeStudy, frequency_responses, starts, time_responses
from pages.common.words import words
from simc_core.figures import (
    inner_output_figure,
    input_figure,
    nested_nyquist_figure,
    nested_sensitivity_figure,
    open_loop_figure,
    output_figure,
)
from simc_core.figures.curves import bode_curve, nested_bode_curve
from simc_core.sensitivity.margins import crossings

HEIGHT, TALL = 200, 400  # px


def panels(study: CascadeStudy) -> None:
    """y1, y2, u with the single loop behind them, and L of both loops."""
    curves = time_responses(study)
    stable = study.stability.verdict == "stable"
    judged = study.outer, study.inner
    field(
        (
            Panel("y1", "y₁", words("Output y1 after steps of r, d1, d2"), output_figure(curves, HEIGHT, stable)),
            Panel(
                "y2", "y₂", words("Inner output y2 and its set point r2"), inner_output_figure(curves, HEIGHT, stable)
            ),
            Panel("u", "u", words("Input u of Gb after steps of r, d1, d2"), input_figure(curves, HEIGHT, stable)),
            Panel(
                "nyquist",
                words("Nyquist"),
                words("Nyquist curves of both loops with the circles of their Ms"),
                nested_nyquist_figure(*frequency_responses(study), judged, HEIGHT),
            ),
        )
    )
    d1, d2 = (time_text(begins, state.design_now().sheet) for begins in starts(curves[0][1]))
    st.caption(
        words(
            "Unit steps: set point at t = 0, $d_1$ at the input of $G_a$ at t = {d1}, $d_2$ at the input of $G_b$ "
            "at t = {d2}. Dashed: one PID controller for $G_a G_b$, without the measurement of $y_2$. Both blocks "
            "with their exact dead times.",
            d1=d1,
            d2=d2,
        )
    )


def frequencies(study: CascadeStudy) -> None:
    """Bode diagrams of La and Lb with their margins, and |S| of both."""
    outer, inner = frequency_responses(study)
    loop = study.loop
    left, right = st.columns(2, gap="small")
    with left:
        st.markdown(words("**Outer loop**, $L_a = C_a G_a T_b$"))
        curve = nested_bode_curve(loop.outer_loop, outer.omega)
        figure = open_loop_figure([("La", curve)], study.outer, crossings(loop.outer_loop), TALL)
        show(figure, "bode_outer", words("Bode diagram of the outer loop, the inner one closed"))
    with right:
        st.markdown(words("**Inner loop**, $L_b = C_b G_b$"))
        curve = bode_curve(loop.inner_loop.L, inner.omega)
        figure = open_loop_figure([("Lb", curve)], study.inner, crossings(loop.inner_loop), TALL)
        show(figure, "bode_inner", words("Bode diagram of the inner loop"))
    st.markdown(words("**Sensitivities**, $S_a = 1/(1+L_a)$ and $S_b = 1/(1+L_b)$"))
    figure = nested_sensitivity_figure(outer, inner, (study.outer, study.inner), HEIGHT)
    show(figure, "sensitivities", words("Magnitude of both sensitivities over frequency"))
