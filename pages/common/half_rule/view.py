"""The reduction told and judged: steps with their equations, the budget, other dead times, the error in numbers."""

import math

import streamlit as st

from pages.common.parts.number_field import design_number
from pages.common.parts.panel import show
from pages.common.parts.rules_choice import rules_choice
from pages.common.parts.sources import linked
from pages.common.parts.symbols import sentence, symbols
from pages.common.parts.tabs import tabs
from pages.common.parts.units import time_text, with_plain_unit
from pages.common.session import state
from pages.common.studies.single import Study
from pages.common.words import number, translated, typeset, words
from simc_core.figures import bode_figure, budget_figure, model_error_figure, plant_step_figure
from simc_core.notation import latex, latex_number
from simc_core.reduction.model_error import ModelError, model_error
from simc_core.reduction.records import Reduction
from simc_core.wording import Text, said

HEIGHT, TALL = 260, 400  # px
COMPARED = said("Step response"), said("Bode"), said("Error over frequency")
ORDERS = {1: "1 (PI)", 2: "2 (PID)"}
FAST = said(
    "**Made for fast control.** The model keeps the beginning of the response, not its steady state: the rules for "
    "zeros hold at the frequencies of the tight loop. The tuning page judges the loop around the full plant"
)
VERDICTS = {
    "good": (st.success, said("**Good enough.** The error uses at most half of what this loop can bear")),
    "usable": (
        st.info,
        said("**Usable.** Stability is guaranteed; the response will differ visibly from the model's"),
    ),
    "not certain": (
        st.warning,
        said(
            "**Not guaranteed.** The model error exceeds the bound; the bound is sufficient, not necessary: the tuning "
            "page judges the loop around the full plant"
        ),
    ),
}


def choices() -> None:
    """Order, sampling period, set of rules; what theta allows for."""
    row = st.container(horizontal=True, vertical_alignment="bottom", gap="medium")
    row.segmented_control(words("Order of the model"), list(ORDERS), format_func=ORDERS.get, **state.bound("order"))
    design_number(
        "sampling",
        words("Sampling period"),
        quantity="time",
        key="half_rule_sampling",
        place=row,
        under=st.container(),
        width=170,
        help=words("Of a digital controller, the same on all pages; 0: continuous."),
    )
    rules_choice(row)
    with st.container(horizontal=True, vertical_alignment="center", gap="medium"):
        design = state.design_now()
        if design.actuator.h:
            _allowed(
                "h",
                said("Half the sampling period counts as dead time: {time}", time=_half(design.actuator.h)),
                design.actuator.h,
            )
        if design.tuning.tau_F:
            _allowed(
                "tau_F",
                said("Half the filter time of the box counts as dead time: {time}", time=_half(design.tuning.tau_F)),
                design.tuning.tau_F,
            )


def _half(time: float) -> str:
    return time_text(time / 2, state.design_now().sheet)


def _allowed(name: str, label: Text, time: float) -> None:
    """Whether theta allows for a time; on, it is that time."""
    key = f"allowed_{name}"
    state.set_widget(key, bool(state.value(name)))
    st.checkbox(
        translated(label),
        key=key,
        on_change=lambda: state.overtaken(key) or state.change(**{name: time if state.widget(key) else 0.0}),
    )


def story(reduction: Reduction) -> None:
    """What was done, and what is to be noted of it."""
    steps(reduction)
    for note in reduction.notes:
        st.info(sentence(note))


def steps(reduction: Reduction) -> None:
    """What was done, in order, each line with its equation."""
    st.latex(typeset(f"G(s) \\approx {latex(reduction.model)}"))
    with st.container(border=True, key="story"):
        for i, step in enumerate(reduction.steps, start=1):
            st.markdown(f"{i}. {symbols(step.text)}" + (f"  \n   ${typeset(step.equation)}$" if step.equation else ""))
    st.caption(linked(words("[SK03 eq. 10-11 and rules T1-T3; V06 eq. 15-17]")))


def budget(reduction: Reduction) -> None:
    """A bar per lag, zero and dead time: what became of it."""
    st.markdown(words("**Where each time constant goes**"))
    show(budget_figure(reduction), "budget", words("What became of every lag, zero and dead time"))


def candidates(reduction: Reduction) -> None:
    """Other self-consistent dead times, and why this one."""
    if len(reduction.candidates) < 2:
        return
    st.markdown(words("**More than one effective dead time satisfies the rules**"))
    none = words("none", context="load error")
    st.dataframe(
        [
            {
                with_plain_unit("θ", state.design_now().sheet.time_unit): number(each.theta),
                words("Ms, tight loop around the plant"): number(each.Ms)
                if math.isfinite(each.Ms)
                else words("no stable loop"),
                words("load error at Ms = 1.6"): number(each.load_error, 3) if math.isfinite(each.load_error) else none,
                words("taken"): words("chosen") if each.chosen else "",
            }
            for each in reduction.candidates
        ],
        hide_index=True,
        width="content",
    )
    st.caption(
        words(
            "Chosen: the θ > 0 whose SIMC loop around the full plant has the least load error $\\tau_I/K_c$ "
            "at Ms = 1.6; where no loop has that Ms, the smallest θ with Ms ≤ 2 at τc = θ."
        )
    )


def comparison(study: Study) -> None:
    """Reduced against full model: over time, over frequency, and in numbers."""
    compared = model_error(study.loop.plant, study.model, study.controller)
    step, bode, error = tabs(COMPARED, "comparison")  # only the open one is made
    if step.open:
        with step:
            figure = plant_step_figure(compared.step, compared.model_step, HEIGHT)
            show(figure, "steps", words("Step responses of plant and model"))
    if bode.open:
        with bode:
            show(
                bode_figure(study.loop.plant, study.model.plant, TALL),
                "bodes",
                words("Bode diagrams of plant and model"),
            )
    if error.open:
        with error:
            figure = model_error_figure(compared.omega, compared.error, compared.bound, HEIGHT)
            show(figure, "error", words("Relative model error"))
            st.caption(
                linked(
                    words(
                        "The loop designed on the model $G_r$ is stable around $G$ where $|G - G_r|/|G_r| < 1/|T|$ at "
                        "all frequencies, with $T$ of the model's loop [RMS86 eq. 10]."
                    )
                )
            )
    numbers(compared)


def numbers(compared: ModelError) -> None:
    """The error as numbers, and what they mean."""
    unit = state.design_now().sheet.time_unit
    frequency = f" rad/{unit}" if unit else ""
    values = {
        "difference": number(compared.step_difference, 3),
        "share": number(100 * compared.step_fraction, 3),
        "time": f"$t = {typeset(latex_number(compared.step_time, 3))}${unit and ' '}{unit}",
    }
    if math.isnan(compared.step_fraction):
        st.markdown(words("Largest difference of the step responses **{difference}**, at {time}.", **values))
    else:
        st.markdown(
            words("Largest difference of the step responses **{difference}**, {share} % of $k$, at {time}.", **values)
        )
    place, verdict = VERDICTS[compared.verdict]
    if compared.error[0] >= 1:
        verdict = FAST
    if math.isnan(compared.used):
        place(words("{verdict}: the loop around the model itself is not stable.", verdict=verdict))
        return
    told = words(
        "{verdict}: at worst {error} = {used} at {place}, limit 1 [RMS86 eq. 10].",
        verdict=verdict,
        error=r"$|G - G_r|\,|T|/|G_r|$",
        used=number(compared.used, 3),
        place=f"$\\omega = {typeset(latex_number(compared.omega_used, 3))}${frequency}",
    )
    place(linked(told))
