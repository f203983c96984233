"""The loop as it is built: limits of the actuator, noise, a sampled controller; and the mark that says so elsewhere."""

import math
from html import escape

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.parts import strip
from pages.common.parts.number_field import design_number
from pages.common.parts.panel import show
from pages.common.parts.refusals import explain_refusal
from pages.common.session import state
from pages.common.session.design import Actuator
from pages.common.studies.single import Study
from pages.common.tuning.guards import proposal
from simc_core.figures import built_input_figure, built_output_figure, palette
from simc_core.notation import number
from simc_core.studies.advice import Advice
from simc_core.studies.built_advice import error_integral, out_of_reach, protections_compared, sampling_not_in_tuning
from simc_core.studies.with_actuator import AsBuilt, BuiltNumbers, as_built

VIEW = "As built"
HEIGHT = 330  # px
DIGITS = 3
NARROW = "@media (max-width: 640px)"
STYLE = f"""<style>
.st-key-actuator_inputs {{display: grid; grid-template-columns: repeat(4, 1fr); gap: 0.25rem 0.75rem}}
.st-key-actuator_inputs label p {{white-space: nowrap}}
.strip.built {{grid-template-columns: repeat(auto-fit, minmax(9.5rem, 1fr))}}
{NARROW} {{.st-key-actuator_inputs, .strip.built {{grid-template-columns: 1fr 1fr}}}}
</style>"""
MARK = f"""<style>
[class*="st-key-mark_"] {{border-left: 4px solid {palette.ATTENTION}; padding-left: 0.6rem; gap: 0}}
[class*="st-key-mark_"] p {{font-size: 0.875rem; line-height: 1.35}}
.st-key-mark_narrow {{display: none}}
{NARROW} {{.st-key-mark_narrow {{display: flex}} .st-key-mark_wide {{display: none}}}}
</style>"""


def mark(actuator: Actuator, place: str) -> None:
    """Where the loop as built is not the linear one, say so. place: "wide", beside the view, or "narrow", above it."""
    if not actuator.on:
        return
    st.html(MARK)
    with st.container(key=f"mark_{place}"):
        st.markdown(
            f"**As built: {words(actuator)}.** Margins, metrics and curves are those of the linear loop, except under "
            f"*{VIEW}*."
        )
        if state.widget("views") != VIEW:
            st.button(
                ":blue[Open the loop as built]",
                key=f"open_built_{place}",
                type="tertiary",
                on_click=state.set_widget,
                args=("views", VIEW),
            )


def words(actuator: Actuator) -> str:
    """What is not linear, in a few words."""
    low, high = actuator.u_min, actuator.u_max
    found = []
    if low is not None and high is not None:
        found.append(f"u limited to [{number(low)}, {number(high)}]")
    elif low is not None or high is not None:
        found.append(f"u limited to ≥ {number(low)}" if high is None else f"u limited to ≤ {number(high)}")
    if actuator.noise:
        found.append(f"measurement noise {number(actuator.noise)}")
    if actuator.h:
        found.append(f"sampled every {number(actuator.h)}")
    return ", ".join(found)


def actuator_view(study: Study, actuator: Actuator) -> None:
    """Inputs on top; numbers; y and u as built over the linear loop."""
    st.html(strip.STYLE + STYLE)
    _inputs()
    with st.container(key="built_guards", gap="xsmall"):
        for item in guards_of(study, actuator):
            proposal(item)
    with explain_refusal():
        found = as_built(study.loop, actuator.scenario)
        st.html(numbers_html(found))
        left, right = st.columns(2, gap="small")
        with left:
            show(built_output_figure(found, HEIGHT), "built_y", "Output y of the loop as built and of the linear loop")
        with right:
            show(built_input_figure(found, HEIGHT), "built_u", "Input u of the loop as built and of the linear loop")
        st.caption(explained(found, study, actuator))


def guards_of(study: Study, actuator: Actuator) -> list[Advice]:
    """What must not be overlooked in the loop as built."""
    sampled = sampling_not_in_tuning(study.tuned, actuator.h) if study.tuned else None
    return [*out_of_reach(study.loop.plant, actuator.scenario), *([sampled] if sampled else [])]


def _inputs() -> None:
    fields, under = st.container(key="actuator_inputs"), st.container()
    with fields:
        _number("Lowest u", "u_min", LIMIT, "no limit", under=under)
        _number("Highest u", "u_max", LIMIT, "no limit", under=under)
        _number("Tracking time", "T_t", TRACKING, "automatic", under=under)
        _number("Sampling of the controller", "sampling", SAMPLING, under=under)
        _number("Measurement noise (std. dev.)", "noise", NOISE, under=under)
        _number("Random seed", "seed", "The same number gives the same noise.", under=under)
        _number("Set-point step", "r", HEIGHTS, under=under)
        _number("Load step", "d", HEIGHTS, under=under)


LIMIT = (
    "What the actuator can do, in the unit of u; empty for no limit. The loop starts from u = 0, which must be within."
)
TRACKING = (
    "Anti-windup by back calculation: while u is at a limit, the integral is led back to it with this time constant. "
    r"Empty: $\sqrt{\tau_I \tau_D}$, or $\tau_I$ for PI [Åström and Hägglund 2006]."
)
SAMPLING = "The controller acts every so often and holds u in between; 0 for a continuous one. In your time unit."
NOISE = "Standard deviation of the measurement noise, in the unit of y; a new value at each step of the controller."
HEIGHTS = "Height of the step. It matters where u has limits: twice the step is not twice the response."


def _number(label: str, name: str, help_: str, empty: str | None = None, *, under: DeltaGenerator) -> None:
    """A number of the actuator by its name in design.py; empty: what no number means, None where there must be one."""
    design_number(name, label, optional=empty is not None, under=under, help=help_, placeholder=empty)


def numbers_html(found: AsBuilt) -> str:
    """The strip of numbers; without them where the linear loop is not stable."""
    if found.numbers is None:
        return (
            '<div class="strip built alarm" role="status"><div class="first" style="grid-column: 1 / -1">'
            "<span>The linear loop is not stable: curves, but no numbers.</span></div></div>"
        )
    cells = "".join(
        f'<div title="{escape(hover)}"><small>{escape(label)}</small><b>{text}</b></div>'
        for label, text, hover in cells_of(found, found.numbers)
    )
    return f'<div class="strip built" role="status" aria-label="Numbers of the loop as built">{cells}</div>'


def cells_of(found: AsBuilt, numbers: BuiltNumbers) -> list[tuple[str, str, str]]:
    """label, text, and what it means."""
    cells = [("IAE: as built · linear", _pair(numbers.IAE, numbers.IAE_linear), "∫|r − y| over the time shown")]
    if found.actuation.limited:
        cells += [
            ("u requested", _range(numbers.u_asked), "smallest and largest value the controller asks for"),
            ("u applied", _range(numbers.u_given), "smallest and largest value the actuator gives"),
            ("Time at a limit", number(numbers.limited, DIGITS), "total, in your time unit"),
        ]
    if found.actuation.noise:
        both = _pair(numbers.noise_y, numbers.noise_u)
        cells.append(
            ("Noise on y · u (std. dev.)", both, "standard deviation of what the noise adds, over the time shown")
        )
    if found.actuation.h:
        cells.append(("Largest move of u", number(numbers.largest_move, DIGITS), "from one sample to the next"))
    return cells


def explained(found: AsBuilt, study: Study, actuator: Actuator) -> str:
    """What was simulated, in words."""
    begins = found.built.t[found.built.d != 0]
    lines = [
        f"Set-point step {number(actuator.setpoint)} at t = 0"
        + (f", load step {number(actuator.disturbance)} at t = {number(begins[0])}." if len(begins) else ".")
    ]
    if found.actuation.limited and math.isfinite(found.T_t):
        lines.append(f"Tracking time $T_t$ = {number(found.T_t)}; dotted: the same without anti-windup.")
    if found.unprotected is not None and found.numbers is not None and not found.actuation.noise:
        both = {"with anti-windup": found.built, "without": found.unprotected}
        lines.append(protections_compared({name: error_integral(c.t, c.r, c.y) for name, c in both.items()}))
    if found.actuation.noise:
        lines.append(f"The noise takes a new value every {number(found.step)}, the step of the controller.")
    if found.actuation.h:
        lines.append(
            "The half rule can allow for the sampling: its own h, on the half rule page "
            f"(now {number(study.tuning.h)}), adds h/2 to θ."
        )
    if not actuator.on:
        lines.append("Nothing is limited yet: type a limit, noise or a sampling period above.")
    return " ".join(lines)


def _pair(first: float, second: float) -> str:
    return f"{number(first, DIGITS)} · {number(second, DIGITS)}"


def _range(ends: tuple[float, float]) -> str:
    return f"{number(ends[0], DIGITS)} … {number(ends[1], DIGITS)}".replace("-", "−")
