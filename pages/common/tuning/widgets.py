"""What the user decides on the tuning page. Each function shows its widget; the design in `state` is the result."""

import math
from html import escape

import streamlit as st

from pages.common import live
from pages.common.parts.copyable import copyable
from pages.common.parts.number_field import design_number
from pages.common.parts.scales import nearest
from pages.common.parts.settings_text import ACTION_NAMED, ACTIONS, UNITS, as_text, form_shown, sizes
from pages.common.parts.settings_text import structure as formula
from pages.common.parts.sources import linked
from pages.common.parts.units import time_text, unit_of
from pages.common.session import state
from pages.common.session.sheet import Sheet
from pages.common.session.tuning import KINDS
from pages.common.studies.single import Study
from pages.common.tuning.source import LABELS, form_control
from pages.common.words import number, translated, typeset, words
from simc_core.controllers.forms import Controller
from simc_core.notation import latex
from simc_core.plants.models import Model, UnstableDelay
from simc_core.rules.simc import default_tau_c
from simc_core.rules.simc_family import multiples_of, presets_of, usual_tau_c
from simc_core.studies.advice import slowest_useful
from simc_core.wording import said

STEPS_PER_DECADE = 20
SAME = 1e-9  # relative; one tau_c typed and chosen
NO_FORM = {  # asked and shown
    ("series", "ideal"): said("This controller has no series form: shown in the ideal one."),
    ("series", "parallel"): said("This controller has no series form: shown in the parallel one."),
    ("ideal", "parallel"): said("This controller has no ideal form: shown in the parallel one."),
    ("parallel", "ideal"): said("This controller has no parallel form: shown in the ideal one."),
}
SHORTEST, LONGEST = -1, 2  # decades of tau_c/theta on the slider


def tau_c_control(study: Study, slider: bool = True) -> None:
    """tau_c: slider, logarithmic and relative to theta, exact number beside it, presets below.

    slider=False: without it, where the live instrument has one.
    """
    model, tau_c = study.model, study.tau_c
    if isinstance(model, UnstableDelay):
        st.markdown(f"$\\tau_c = \\theta$ = **{time_text(tau_c, state.design_now().sheet)}**")
        st.caption(linked(words("For an unstable pole the rule knows this choice alone [SK98 eq. 23-24].")))
        st.caption(model_in_use(model))
        return
    place = st.container()
    if slider:
        slide, place = st.columns([5, 3], vertical_alignment="bottom", gap="small")
        with slide:
            _slider(model, tau_c)
    design_number(
        "tau_c",
        words("τc, exact"),
        show=lambda value: value or tau_c,
        quantity="time",
        key="tau_c_exact",
        place=place,
        under=st.container(),
    )
    _presets(study)


def _slider(model: Model, tau_c: float) -> None:
    scale, unit = (model.theta, "θ") if model.theta else (default_tau_c(model), "")
    ratios = [10 ** (i / STEPS_PER_DECADE) for i in range(SHORTEST * STEPS_PER_DECADE, LONGEST * STEPS_PER_DECADE + 1)]
    state.set_widget("tau_c_slider", nearest(ratios, tau_c / scale))
    st.select_slider(
        words("Closed-loop time constant τc"),
        ratios,
        format_func=lambda ratio: f"{number(ratio, 3)} {unit}".strip(),
        help=linked(
            words(
                r"The closed-loop time constant $\tau_c$ is the one tuning knob of SIMC: small is fast, large is "
                r"robust and gentle on the input [SK03 sect. 3.3]. $\tau_c = \theta$ is tight."
            )
        ),
        key="tau_c_slider",
        on_change=_slid,
        args=(model, scale),
    )


def _slid(model: Model, scale: float) -> None:
    if state.overtaken("tau_c_slider"):
        return
    state.change(**live.as_choice(model, state.widget("tau_c_slider") * scale))


def structure() -> None:
    """PI or PID, set-point weight, derivative filter."""
    row = st.container(horizontal=True, vertical_alignment="bottom", gap="xsmall", key="structure")
    if state.value("rule") == "simc":
        row.segmented_control(
            words("Controller"),
            KINDS,
            help=words("PI takes the first-order model, PID the second-order one."),
            **state.bound("order", show=lambda order: KINDS[order - 1], read=lambda shown: KINDS.index(shown) + 1),
        )
    under = st.container()
    design_number(
        "b",
        "b",
        place=row,
        under=under,
        width=54,
        help=words(
            "Set-point weight: the proportional action sees $b\\,r - y$. Less than 1 softens set-point steps; "
            "stability and load response stay as they are."
        ),
    )
    design_number(
        "filter",
        "τF/τD",
        place=row,
        under=under,
        width=60,
        help=words("Derivative filter, 0 for none. It acts inside the loop: margins are computed with it."),
    )


def settings(study: Study) -> None:
    """The controller in the form chosen, typeset, and as text to copy with all its digits."""
    asked = state.value("form")
    form_control()
    form = form_shown(study.controller, asked)
    if form != asked:
        st.caption(translated(NO_FORM[asked, form]))
    shown, sheet = study.controller.in_form(form), state.design_now().sheet
    st.markdown(f"$C(s) = {formula(shown, form)}$")
    st.html(settings_html(shown, sheet))
    copyable(as_text(study.controller, form, sheet), "settings_text")


def settings_html(controller: Controller, sheet: Sheet) -> str:
    """The settings as one types them, large: sizes with units, and the action."""
    cells = [
        f"<div><small>{escape(LABELS[name])}</small><b>{number(value)}</b> {escape(unit_of(UNITS[name], sheet))}</div>"
        for name, value in sizes(controller).items()
        if math.isfinite(value)
    ]
    action = controller.action
    cells.append(
        f'<div class="action" title="{translated(ACTIONS[action])}"><small>{words("action")}</small>'
        f"<b>{translated(ACTION_NAMED[action])}</b></div>"
    )
    return f'<div class="settings" role="group" aria-label="{words("Settings")}">{"".join(cells)}</div>'


def _presets(study: Study) -> None:
    """Multiples of theta, and the named choices of the literature; each says its tau_c."""
    with st.container(key="multiples"):
        for factor, value in multiples_of(study.tuning.rule, study.model).items():
            name = "θ" if factor == 1 else f"{number(factor)} θ"
            usual = math.isclose(value, usual_tau_c(study.tuning.rule, study.model), rel_tol=SAME)
            _choice(f"multiple_{factor:g}", name, value, study, "" if usual else f"{factor:g}theta")
    folded = st.expander(words("Choices of the literature"), key="literature", on_change="rerun")
    if folded.open:
        with folded, st.container(key="presets"):
            for name, value in presets_of(study.tuning.rule, study.model).items():
                _choice(f"preset_{name}", name, value, study, "" if name == "tight" else name)
    st.caption(model_in_use(study.model))


def _choice(key: str, name: str, value: float, study: Study, speed: str) -> None:
    """A button for one choice of tau_c, which stays when the plant changes; one slower than the plant says so."""
    slow = value > slowest_useful(study.loop.plant, study.model) * (1 + SAME)
    told, time = number(value, 3), time_text(value, state.design_now().sheet)
    st.button(
        words("{name}: {tau_c} (slow)", name=name, tau_c=told) if slow else f"{translated(name)}: {told}",
        key=key,
        width="stretch",
        help=words("τc = {time}: slower than the plant alone, or than 8 θ for an integrating one", time=time)
        if slow
        else f"τc = {time}",
        type="primary" if math.isclose(value, study.tau_c, rel_tol=SAME) else "secondary",
        on_click=state.change,
        kwargs={"tau_c": None, "speed": speed},
    )


def model_in_use(model: Model) -> str:
    """Which theta is meant: that of the model, not the plant's dead time."""
    theta = time_text(model.theta, state.design_now().sheet)
    return words(
        "Model in use: ${model}$. θ = {theta} is its effective dead time.", model=typeset(latex(model)), theta=theta
    )
