"""Windup between the loops: what a limited actuator does to a cascade, with and without protection."""

from functools import lru_cache, partial

import numpy as np
import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.parts.number_field import number_field
from pages.common.parts.panel import show
from pages.common.session import state
from pages.common.studies.cascade import CascadeStudy, starts, time_responses
from pages.common.words import number, translated, words
from simc_core import checks
from simc_core.checks import LARGEST_GAIN
from simc_core.figures import inner_setpoint_figure, input_figure, output_figure
from simc_core.loops.nested import CascadeLoop
from simc_core.simulation import NestedResponse
from simc_core.simulation.nested_windup import limited
from simc_core.studies.built_advice import error_integral, protections_compared
from simc_core.wording import said

HEIGHT = 300  # px
KEPT = 8
NAMES = {"both": said("both protected"), "inner": said("inner only"), "none": said("no protection")}
SHARE = 0.4  # of what u asks for beyond its final value: limits that bite, for a start
EXPLAINED = said(
    "While u is at a limit the inner loop cannot follow, and both controllers go on integrating an error they cannot "
    "remove. Back calculation stops the inner one; the outer one stops too, and takes over without a bump, when it is "
    "led back to the set point that the inner loop could have followed, $r_2 + e/K_b$, $e$ what the limit takes away."
)


def windup_view(study: CascadeStudy) -> None:
    """Limits on u to choose; y1, u and r2 after a set-point step for the three protections."""
    st.markdown(translated(EXPLAINED))
    if not study.sound:
        st.info(words("This is shown for sound cascades: mend the loops first."))
        return
    lowest, highest = usual_limits(study)
    low, high, _ = st.columns([1, 1, 3], vertical_alignment="bottom")
    under = st.container()
    u_min = _limit("u_min", words("Lowest u"), lowest, (-LARGEST_GAIN, 0.0), low, under)
    u_max = _limit("u_max", words("Highest u"), highest, (0.0, LARGEST_GAIN), high, under)
    limits = lowest if u_min is None else u_min, highest if u_max is None else u_max
    with st.spinner(words("Simulating three ways")):
        curves = family(study.loop, *limits, t_end=starts(time_responses(study)[0][1])[0])
    show(output_figure(curves, HEIGHT), "windup_y", words("Output y1 with a limited u, three protections"))
    left, right = st.columns(2, gap="small")
    with left:
        show(input_figure(curves, HEIGHT), "windup_u", words("Limited input u, three protections"))
    with right:
        show(inner_setpoint_figure(curves, HEIGHT), "windup_r2", words("Inner set point r2, three protections"))
    st.caption(translated(protections_compared({name: error_integral(c.t, c.r, c.y) for name, c in curves})))
    st.caption(
        words(
            "Unit step of the set point from rest, u between {low} and {high}. Deviations from the working point, so "
            "that the limits enclose 0.",
            low=number(limits[0], 3),
            high=number(limits[1], 3),
        )
    )


def _limit(
    name: str,
    label: str,
    usual: float,
    bounds: tuple[float, float],
    place: DeltaGenerator,
    under: DeltaGenerator,
) -> float | None:
    """A limit of u to type, for this view alone; None while the field is empty."""

    def check(value: float | None) -> None:
        if value is not None:
            checks.real(label, value, *bounds)

    value = state.memory(name, lambda: None)
    take = partial(state.remember, name)
    number_field(label, value, check, take, name, optional=True, place=place, under=under, placeholder=number(usual, 2))
    return value


def usual_limits(study: CascadeStudy) -> tuple[float, float]:
    """Limits that the linear cascade exceeds after a set-point step, two digits: where u ends, and SHARE beyond."""
    response = time_responses(study)[0][1]
    u = response.u[response.t < starts(response)[0]]
    final = float(u[-1])
    ends = [final + SHARE * (float(end) - final) for end in (u.min(), u.max())]
    return min(_rounded(ends[0]), 0.0), max(_rounded(ends[1]), 0.0)


@lru_cache(maxsize=KEPT)
def family(loop: CascadeLoop, u_min: float, u_max: float, t_end: float) -> tuple[tuple[str, NestedResponse], ...]:
    """The three protections, the best first. Raises InvalidParameter."""
    return tuple((name, limited(loop, u_min, u_max, key, t_end=t_end)) for key, name in NAMES.items())


def _rounded(value: float) -> float:
    return float(np.format_float_scientific(value, precision=1)) if value else 0.0
