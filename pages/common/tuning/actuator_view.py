"""The loop as it is built: limits of the actuator, noise, a sampled controller; and the mark that says so elsewhere."""

import math
from html import escape

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.parts.number_field import design_number
from pages.common.parts.panel import show
from pages.common.parts.refusals import explain_refusal
from pages.common.parts.units import time_text, unit_of, with_plain_unit, with_unit
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.session.sheet import Sheet
from pages.common.studies.single import Study
from pages.common.tuning.guards import proposal
from simc_core import Actuation, sampled_margins
from simc_core.errors import InvalidParameter, SimcError
from simc_core.figures import built_input_figure, built_output_figure
from simc_core.notation import number
from simc_core.studies.built_advice import error_integral, out_of_reach, protections_compared, sampling_not_in_tuning
from simc_core.studies.limit_cycle import LimitCycle
from simc_core.studies.with_actuator import AsBuilt, BuiltNumbers, as_built

VIEW = "As built"
HEIGHT = 330  # px
DIGITS = 3


def mark(design: Design, place: str) -> None:
    """Where the loop as built is not the linear one, say so. place: "wide", beside the view, or "narrow", above it."""
    if not design.actuator.on:
        return
    with st.container(key=f"mark_{place}"):
        st.markdown(
            f"**As built: {words(design)}.** Margins, metrics and curves are those of the linear loop, except under "
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


def words(design: Design) -> str:
    """What is not linear, in a few words."""
    actuator, sheet = design.actuator, design.sheet
    u, unit = sheet.u_name, with_unit("", sheet.OP_unit)
    low, high = (None if u is None else number(sheet.on_scale(u)) for u in (actuator.u_min, actuator.u_max))
    found = []
    if low is not None and high is not None:
        found.append(f"{u}{unit} limited to {low} … {high}")
    elif low is not None or high is not None:
        found.append(f"{u}{unit} limited to ≥ {low}" if high is None else f"{u}{unit} limited to ≤ {high}")
    found += [
        f"{label.lower()} {number(getattr(actuator, name))}{with_unit('', unit_of(unit, sheet))}"
        for name, (label, unit, _) in MECHANISM.items()
        if getattr(actuator, name)
    ]
    if actuator.noise:
        found.append(f"measurement noise {number(actuator.noise)}")
    if actuator.h:
        late = ", its output written one scan later" if actuator.delay_scans else ""
        found.append(f"sampled every {time_text(actuator.h, sheet)}{late}")
    return ", ".join(found)


def actuator_view(study: Study, design: Design) -> None:
    """Inputs on top; numbers; y and u as built over the linear loop."""
    _inputs(design)
    with st.container(key="built_guards", gap="xsmall"):
        reach(design)
        if study.tuned and (sampled := sampling_not_in_tuning(study.tuned, design.actuator.h)):
            proposal(sampled)
    with explain_refusal():
        with st.spinner("Simulating the loop as built"):
            found = as_built(study.loop, design.actuator.scenario(design.excitation))
        st.html(numbers_html(found, study, design.sheet))
        if found.numbers is not None and found.numbers.cycle:
            st.info(cycle_in_words(found.numbers.cycle, design.sheet))
        left, right = st.columns(2, gap="small")
        with left:
            show(built_output_figure(found, HEIGHT), "built_y", "Output y of the loop as built and of the linear loop")
        with right:
            show(built_input_figure(found, HEIGHT), "built_u", "Input u of the loop as built and of the linear loop")
        st.caption(explained(found, study, design))


def reach(design: Design) -> None:
    """Set points and loads that the limits of u do not allow."""
    sheet = design.sheet
    scenario = design.actuator.scenario(design.excitation)
    for item in out_of_reach(design.plant, scenario, sheet.u_name, sheet.OP_now or 0.0):
        proposal(item)


def _inputs(design: Design) -> None:
    fields, under = st.container(key="actuator_inputs"), st.container()
    with fields:
        _limit("Lowest", "u_min", design, under)
        _limit("Highest", "u_max", design, under)
        _number("Tracking time", "T_t", TRACKING, "automatic", unit="time", under=under)
        _number("Sampling of the controller", "sampling", SAMPLING, unit="time", under=under)
        for name, (label, unit, help_) in MECHANISM.items():
            _number(label, name, help_, "none" if name == "rate_limit" else None, unit=unit, under=under)
        _number("Noise (std. dev.)", "noise", NOISE, unit="PV", under=under)
        _number("Random seed", "seed", "The same number gives the same noise.", under=under)
    _range_of_OP(design)


LIMIT = (
    "What the actuator can do; empty for no limit. The loop starts from u = 0, which must be within. "
    "With OP now in the loop sheet, limits are on the scale of OP."
)
LIMIT_OF_OP = "What the actuator can do, on the scale of OP; empty for no limit. OP now must be within."
TRACKING = (
    "Anti-windup by back calculation: while u is at a limit, the integral is led back to it with this time constant. "
    r"Empty: $\sqrt{\tau_I \tau_D}$, or $\tau_I$ for PI [Åström and Hägglund 2006]."
)
SAMPLING = "The controller acts every so often and holds u in between; 0 for a continuous one."
MECHANISM = {  # label, unit, help
    "resolution": ("Resolution", "OP", "The output moves in steps of this size; 0 for none."),
    "dead_band": ("Dead band", "OP", "A positioner rests until the output is farther away than this; 0 for none."),
    "backlash": ("Backlash", "OP", "Play of the linkage: lost at every turn of direction; 0 for none."),
    "rate_limit": ("Fastest move", "OP/time", "Largest speed of the actuator; empty for no limit."),
}
NOISE = "Standard deviation of the measurement noise; a new value at each step of the controller."


def _number(
    label: str, name: str, help_: str, empty: str | None = None, *, unit: str = "", under: DeltaGenerator
) -> None:
    """A number of the actuator by its name in design.py; empty: what no number means, None where there must be one."""
    design_number(name, label, quantity=unit, optional=empty is not None, under=under, help=help_, placeholder=empty)


def _limit(word: str, name: str, design: Design, under: DeltaGenerator) -> None:
    """A limit of u, on the scale of OP where the operating point is known."""
    sheet, label = design.sheet, f"{word} {design.sheet.u_name}"

    def read(value: float | None) -> float | None:
        if value is None or sheet.OP_now is None:
            return value
        beyond = value > sheet.OP_now if name == "u_min" else value < sheet.OP_now
        if beyond:
            sign = "<=" if name == "u_min" else ">="
            raise InvalidParameter(f"{label} must be {sign} {sheet.OP_now:g}, which is OP now, found {value:g}")
        return sheet.off_scale(value)

    design_number(
        name,
        label,
        show=lambda u: None if u is None else sheet.on_scale(u),
        read=read,
        quantity="OP",
        optional=True,
        under=under,
        help=LIMIT if sheet.OP_now is None else LIMIT_OF_OP,
        placeholder="no limit",
    )


def _range_of_OP(design: Design) -> None:
    """The limits that the loop sheet tells, as a button where others are in use."""
    sheet, actuator = design.sheet, design.actuator
    if None in (sheet.OP_low, sheet.OP_high, sheet.OP_now):
        return
    limits = {"u_min": sheet.off_scale(sheet.OP_low), "u_max": sheet.off_scale(sheet.OP_high)}
    if (actuator.u_min, actuator.u_max) != tuple(limits.values()):
        st.button(
            with_unit(
                f"Limits as in the loop sheet: OP {number(sheet.OP_low)} to {number(sheet.OP_high)}", sheet.OP_unit
            ),
            key="range_of_OP",
            type="tertiary",
            icon=":material/arrow_forward:",
            on_click=state.change,
            kwargs=limits,
        )


def numbers_html(found: AsBuilt, study: Study, sheet: Sheet) -> str:
    """The strip of numbers; without them where the linear loop is not stable."""
    if found.numbers is None:
        return (
            '<div class="strip built alarm" role="status"><div class="first" style="grid-column: 1 / -1">'
            "<span>The linear loop is not stable: curves, but no numbers.</span></div></div>"
        )
    cells = "".join(
        f'<div title="{escape(hover)}"><small>{escape(label)}</small><b>{text}</b></div>'
        for label, text, hover in cells_of(found, found.numbers, study, sheet)
    )
    return f'<div class="strip built" role="status" aria-label="Numbers of the loop as built">{cells}</div>'


def cells_of(found: AsBuilt, numbers: BuiltNumbers, study: Study, sheet: Sheet) -> list[tuple[str, str, str]]:
    """label, text, and what it means."""
    cells = [("IAE: as built · linear", _pair(numbers.IAE, numbers.IAE_linear), "∫|r − y| over the time shown")]
    if found.actuation.limited or found.actuation.mechanical:
        cells += [
            (
                with_plain_unit(f"{sheet.u_name} requested", sheet.OP_unit),
                _range(numbers.u_asked, sheet),
                "smallest and largest value the controller asks for",
            ),
            (
                with_plain_unit(f"{sheet.u_name} applied", sheet.OP_unit),
                _range(numbers.u_given, sheet),
                "smallest and largest value the actuator gives",
            ),
        ]
    if found.actuation.limited:
        cells.append((with_plain_unit("Time at a limit", sheet.time_unit), number(numbers.limited, DIGITS), "in total"))
    if found.actuation.noise:
        both = _pair(numbers.noise_y, numbers.noise_u)
        cells.append(
            ("Noise on y · u (std. dev.)", both, "standard deviation of what the noise adds, over the time shown")
        )
    if found.actuation.h:
        cells.append(("Largest move of u", number(numbers.largest_move, DIGITS), "from one sample to the next"))
        cells += _sampled(study, found.actuation)
    return cells


def _sampled(study: Study, actuation: Actuation) -> list[tuple[str, str, str]]:
    """Ms and the phase margin beside those of the linear loop; nothing where the law does not exist."""
    try:
        sampled = sampled_margins(study.loop, actuation.h, actuation.law, actuation.delay_scans)
    except SimcError:
        return []
    if not sampled.stable:
        return [("Ms: sampled · linear", f"not stable · {number(study.margins.Ms, DIGITS)}", "")]
    return [
        ("Ms: sampled · linear", _pair(sampled.Ms, study.margins.Ms), "largest |S|, exact for the sampled controller"),
        ("PM [°]: sampled · linear", _pair(sampled.PM_deg, study.margins.PM_deg), "phase margin"),
    ]


def explained(found: AsBuilt, study: Study, design: Design) -> str:
    """What was simulated, in words."""
    begins = found.built.t[found.built.d != 0]
    actuator, asked = design.actuator, design.excitation
    lines = [
        f"Set point {number(asked.reached)} from t = 0"
        + (f", load {number(asked.disturbance)} from t = {time_text(begins[0], design.sheet)}." if len(begins) else ".")
    ]
    if found.actuation.limited and math.isfinite(found.T_t):
        lines.append(
            f"Tracking time $T_t$ = {time_text(found.T_t, design.sheet)}; dotted: the same without anti-windup."
        )
    if found.unprotected is not None and found.numbers is not None and not found.actuation.noise:
        both = {"with anti-windup": found.built, "without": found.unprotected}
        lines.append(protections_compared({name: error_integral(c.t, c.r, c.y) for name, c in both.items()}))
    if found.actuation.noise:
        lines.append(
            f"The noise takes a new value every {time_text(found.step, design.sheet)}, the step of the controller."
        )
    if found.actuation.h:
        allows = "allows" if study.tuning.h else "can allow"
        lines.append(f"The half rule {allows} for the sampling, h/2 in θ: half rule page.")
    if not actuator.on:
        lines.append("Nothing is limited yet: type a limit, a resolution, noise or a sampling period above.")
    return " ".join(lines)


def cycle_in_words(cycle: LimitCycle, sheet: Sheet) -> str:
    """A swing that the actuator keeps up: what it is, and what it is not."""
    swing = number(cycle.swing, DIGITS) + with_unit("", sheet.PV_unit)
    return (
        f"**Limit cycle:** y swings by {swing} from peak to peak, once in {time_text(cycle.period, sheet, DIGITS)}, "
        "and does not come to rest. It comes from the actuator and the integral action, not from the tuning. A finer "
        "actuator makes it smaller."
    )


def _pair(first: float, second: float) -> str:
    return f"{number(first, DIGITS)} · {number(second, DIGITS)}"


def _range(ends: tuple[float, float], sheet: Sheet) -> str:
    low, high = (number(sheet.on_scale(u), DIGITS) for u in ends)
    return f"{low} … {high}".replace("-", "−")
