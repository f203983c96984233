"""The loop as it is built: limits of the actuator, noise, a sampled controller; and the mark that says so elsewhere."""

import math
from html import escape

import streamlit as st

from pages.common.parts.panel import show
from pages.common.parts.refusals import explain_refusal
from pages.common.parts.units import measured, time_text, unit_of, with_plain_unit, with_unit
from pages.common.session.design import Design
from pages.common.session.sheet import Sheet
from pages.common.studies.single import Study
from pages.common.tuning.actuator_inputs import MECHANISM, inputs
from pages.common.tuning.guards import proposal
from pages.common.tuning.views import AS_BUILT, open_view, opened
from pages.common.words import number, translated, words
from simc_core import Actuation, sampled_margins
from simc_core.errors import SimcError
from simc_core.figures import built_input_figure, built_output_figure
from simc_core.notation import number as core_number
from simc_core.studies.built_advice import error_integral, out_of_reach, protections_compared, sampling_not_in_tuning
from simc_core.studies.limit_cycle import LimitCycle
from simc_core.studies.with_actuator import AsBuilt, BuiltNumbers, as_built
from simc_core.wording import Text, joined, said

HEIGHT = 330  # px
DIGITS = 3


def mark(design: Design, place: str) -> None:
    """Where the loop as built is not the linear one, say so. place: "wide", beside the view, or "narrow", above it."""
    if not design.actuator.on:
        return
    with st.container(key=f"mark_{place}"):
        st.markdown(
            words(
                "**As built: {what}.** Margins, metrics and curves are those of the linear loop, except under "
                "*{view}*.",
                what=unlike_linear(design),
                view=AS_BUILT,
            )
        )
        if opened() != AS_BUILT:
            st.button(
                f":blue[{words('Open the loop as built')}]",
                key=f"open_built_{place}",
                type="tertiary",
                on_click=open_view,
                args=(AS_BUILT,),
            )


def unlike_linear(design: Design) -> Text:
    """What is not linear, in a few words."""
    actuator, sheet = design.actuator, design.sheet
    u = with_unit(sheet.u_name, sheet.OP_unit)
    low, high = (None if end is None else core_number(sheet.on_scale(end)) for end in (actuator.u_min, actuator.u_max))
    found = []
    if low is not None and high is not None:
        found.append(said("{u} limited to {low} … {high}", u=u, low=low, high=high))
    elif low is not None:
        found.append(said("{u} limited to ≥ {low}", u=u, low=low))
    elif high is not None:
        found.append(said("{u} limited to ≤ {high}", u=u, high=high))
    for name, each in MECHANISM.items():
        if value := getattr(actuator, name):
            size = joined((core_number(value), with_unit("", unit_of(each.unit, sheet))), "")
            found.append(each.told.put(size=size))
    if actuator.noise:
        found.append(said("measurement noise {noise}", noise=core_number(actuator.noise)))
    if actuator.h:
        h = measured(actuator.h, sheet.time_unit)
        found.append(
            said("sampled every {h}, its output written one scan later", h=h)
            if actuator.delay_scans
            else said("sampled every {h}", h=h)
        )
    return joined(found)


def actuator_view(study: Study, design: Design) -> None:
    """Inputs on top; numbers; y and u as built over the linear loop."""
    inputs(design)
    with st.container(key="built_guards", gap="xsmall"):
        reach(design)
        if study.tuned and (sampled := sampling_not_in_tuning(study.tuned, design.actuator.h)):
            proposal(sampled)
    with explain_refusal():
        with st.spinner(words("Simulating the loop as built")):
            found = as_built(study.loop, design.actuator.scenario(design.excitation))
        st.html(numbers_html(found, study, design.sheet))
        if found.numbers is not None and found.numbers.cycle:
            st.info(cycle_in_words(found.numbers.cycle, design.sheet))
        left, right = st.columns(2, gap="small")
        with left:
            alt = words("Output y of the loop as built and of the linear loop")
            show(built_output_figure(found, HEIGHT), "built_y", alt)
        with right:
            alt = words("Input u of the loop as built and of the linear loop")
            show(built_input_figure(found, HEIGHT), "built_u", alt)
        st.caption(explained(found, study, design))


def reach(design: Design) -> None:
    """Set points and loads that the limits of u do not allow."""
    sheet = design.sheet
    scenario = design.actuator.scenario(design.excitation)
    for item in out_of_reach(design.plant, scenario, sheet.u_name, sheet.OP_now or 0.0):
        proposal(item)


def numbers_html(found: AsBuilt, study: Study, sheet: Sheet) -> str:
    """The strip of numbers; without them where the linear loop is not stable."""
    if found.numbers is None:
        return (
            '<div class="strip built alarm" role="status"><div class="first" style="grid-column: 1 / -1">'
            f"<span>{words('The linear loop is not stable: curves, but no numbers.')}</span></div></div>"
        )
    cells = "".join(
        f'<div title="{escape(hover)}"><small>{escape(label)}</small><b>{text}</b></div>'
        for label, text, hover in cells_of(found, found.numbers, study, sheet)
    )
    label = words("Numbers of the loop as built")
    return f'<div class="strip built" role="status" aria-label="{label}">{cells}</div>'


def cells_of(found: AsBuilt, numbers: BuiltNumbers, study: Study, sheet: Sheet) -> list[tuple[str, str, str]]:
    """label, text, and what it means."""
    IAE = _pair(numbers.IAE, numbers.IAE_linear)
    cells = [(words("IAE: as built · linear"), IAE, words("∫|r − y| over the time shown"))]
    if found.actuation.limited or found.actuation.mechanical:
        cells += [
            (
                with_plain_unit(words("{u} requested", u=sheet.u_name), sheet.OP_unit),
                _range(numbers.u_asked, sheet),
                words("smallest and largest value the controller asks for"),
            ),
            (
                with_plain_unit(words("{u} applied", u=sheet.u_name), sheet.OP_unit),
                _range(numbers.u_given, sheet),
                words("smallest and largest value the actuator gives"),
            ),
        ]
    if found.actuation.limited:
        label = with_plain_unit(words("Time at a limit"), sheet.time_unit)
        cells.append((label, number(numbers.limited, DIGITS), words("in total")))
    if found.actuation.noise:
        both = _pair(numbers.noise_y, numbers.noise_u)
        cells.append(
            (
                words("Noise on y · u (std. dev.)"),
                both,
                words("standard deviation of what the noise adds, over the time shown"),
            )
        )
    if found.actuation.h:
        move = number(numbers.largest_move, DIGITS)
        cells.append((words("Largest move of u"), move, words("from one sample to the next")))
        cells += _sampled(study, found.actuation)
    return cells


def _sampled(study: Study, actuation: Actuation) -> list[tuple[str, str, str]]:
    """Ms and the phase margin beside those of the linear loop; nothing where the law does not exist."""
    try:
        sampled = sampled_margins(study.loop, actuation.h, actuation.law, actuation.delay_scans)
    except SimcError:
        return []
    if not sampled.stable:
        return [(words("Ms: sampled · linear"), f"{words('not stable')} · {number(study.margins.Ms, DIGITS)}", "")]
    Ms, PM = _pair(sampled.Ms, study.margins.Ms), _pair(sampled.PM_deg, study.margins.PM_deg)
    return [
        (words("Ms: sampled · linear"), Ms, words("largest |S|, exact for the sampled controller")),
        (words("PM [°]: sampled · linear"), PM, words("phase margin")),
    ]


def explained(found: AsBuilt, study: Study, design: Design) -> str:
    """What was simulated, in words."""
    begins = found.built.t[found.built.d != 0]
    actuator, asked = design.actuator, design.excitation
    r, d = number(asked.reached), number(asked.disturbance)
    lines = [words("Set point {r} from t = 0.", r=r)]
    if len(begins):
        t = time_text(begins[0], design.sheet)
        lines = [words("Set point {r} from t = 0, load {d} from t = {t}.", r=r, d=d, t=t)]
    if found.actuation.limited and math.isfinite(found.T_t):
        lines.append(
            words(
                "Tracking time $T_t$ = {time}; dotted: the same without anti-windup.",
                time=time_text(found.T_t, design.sheet),
            )
        )
    if found.unprotected is not None and found.numbers is not None and not found.actuation.noise:
        both = {said("with anti-windup"): found.built, said("without", context="anti-windup"): found.unprotected}
        compared = protections_compared({name: error_integral(c.t, c.r, c.y) for name, c in both.items()})
        lines.append(translated(compared))
    if found.actuation.noise:
        lines.append(
            words(
                "The noise takes a new value every {time}, the step of the controller.",
                time=time_text(found.step, design.sheet),
            )
        )
    if found.actuation.h:
        lines.append(
            words("The half rule allows for the sampling, h/2 in θ: half rule page.")
            if study.tuning.h
            else words("The half rule can allow for the sampling, h/2 in θ: half rule page.")
        )
    if not actuator.on:
        lines.append(words("Nothing is limited yet: type a limit, a resolution, noise or a sampling period above."))
    return " ".join(lines)


def cycle_in_words(cycle: LimitCycle, sheet: Sheet) -> str:
    """A swing that the actuator keeps up: what it is, and what it is not."""
    swing = number(cycle.swing, DIGITS) + with_unit("", sheet.PV_unit)
    return words(
        "**Limit cycle:** y swings by {swing} from peak to peak, once in {period}, and does not come to rest. It comes "
        "from the actuator and the integral action, not from the tuning. A finer actuator makes it smaller.",
        swing=swing,
        period=time_text(cycle.period, sheet, DIGITS),
    )


def _pair(first: float, second: float) -> str:
    return f"{number(first, DIGITS)} · {number(second, DIGITS)}"


def _range(ends: tuple[float, float], sheet: Sheet) -> str:
    low, high = (number(sheet.on_scale(u), DIGITS) for u in ends)
    return f"{low} … {high}".replace("-", "−")
