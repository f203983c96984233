"""What the user decides on the cascade page. Each function shows its widgets; the design in `state` is the result."""

from dataclasses import replace

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.parts.number_field import design_number
from pages.common.parts.scales import nearest
from pages.common.parts.settings_text import FORMS_NAMED, form_shown
from pages.common.parts.sources import linked
from pages.common.parts.units import time_text
from pages.common.plant.entry import plant_entry
from pages.common.session import state
from pages.common.session.cascade import METHODS, Cascade
from pages.common.session.tuning import KINDS
from pages.common.studies.cascade import USUAL_MS, CascadeStudy, of_row, scale, speed_symbol
from pages.common.words import number, translated, words
from simc_core.cascade.design import HIGHEST_MS, LOWEST_MS
from simc_core.cascade.pairs import ROWS, PairRow
from simc_core.controllers.forms import FORMS
from simc_core.wording import Text, said

BLOCKS = (
    ("Ga", said("Ga primary"), said("Enter the primary block Ga"), said("Enter the primary block Ga as")),
    ("Gb", said("Gb secondary"), said("Enter the secondary block Gb"), said("Enter the secondary block Gb as")),
)
METHOD_NAMES = {"simc": "SIMC", "synthesis": said("Direct synthesis")}
SPEED_LETTERS = {"simc": "τc", "synthesis": "λ"}
LOOPS = {"outer": said("Outer loop"), "inner": said("Inner loop")}
SPEED_OF = {
    "outer": said("{symbol} of the outer loop", symbol=""),
    "inner": said("{symbol} of the inner loop", symbol=""),
}
EXACT_OF = {
    "outer": said("{symbol} of the outer loop, exact", symbol=""),
    "inner": said("{symbol} of the inner loop, exact", symbol=""),
}
FILTER_OF = {
    "outer": said("Derivative filter of the outer loop: $\\tau_F = \\lambda/N$."),
    "inner": said("Derivative filter of the inner loop: $\\tau_F = \\lambda/N$."),
}
NOT_IN_FORM = {
    "series": said("${C}$ has no series form: shown in the {shown} one.", C="", shown=""),
    "ideal": said("${C}$ has no ideal form: shown in the {shown} one.", C="", shown=""),
    "parallel": said("${C}$ has no parallel form: shown in the {shown} one.", C="", shown=""),
}
SPEEDS = [10 ** (i / 20) for i in range(-40, 21)]  # of a slider, in units of the loop's own times
PEAKS = [1.05 + 0.05 * i for i in range(80)]


def blocks() -> None:
    """Ga and Gb, each folded away; or a design of the paper."""
    with st.container(horizontal=True, gap="xsmall", key="blocks"):
        for name, label, enter, enter_as in BLOCKS:
            folded = st.popover(translated(label), help=translated(enter), key=f"enter_{name}", on_change="rerun")
            if folded.open:
                with folded:
                    plant_entry(name, translated(enter_as))
                    st.button(
                        words("Take G of the other pages"),
                        key=f"take_{name}",
                        on_click=state.change,
                        kwargs={name: state.plant()},
                    )
    titles = {_title(row): of_row(row) for row in ROWS}
    here = next((title for title, cascade in titles.items() if cascade == state.cascade()), None)
    state.set_widget("pair", here)
    st.selectbox(
        words("From the literature [PSB]"),
        list(titles),
        format_func=translated,
        key="pair",
        placeholder=words("Published pairs (Prelić et al.)"),
        label_visibility="collapsed",
        help=words(
            "The ten process pairs of Prelić, Šekara and Bošković, with the designs they print; PI or PID outside, Ms "
            "inside · outside."
        ),
        on_change=_take_pair,
    )


def method() -> None:
    """SIMC or direct synthesis, and the set-point weight of the outer controller."""
    state.set_widget("method", state.value("method"))
    row, under = (
        st.container(horizontal=True, vertical_alignment="bottom", gap="xsmall", key="method_row"),
        st.container(),
    )
    with row:
        st.segmented_control(
            words("Method"),
            METHODS,
            format_func=lambda method: translated(METHOD_NAMES[method]),
            key="method",
            on_change=_take_method,
            help=linked(
                words(
                    "SIMC: half rule and $\\tau_c$, inner loop first, then the outer one on what it sees [SK03]. "
                    "Direct synthesis: a Maclaurin expansion of the controller that gives a wanted response, for "
                    "integrating and unstable blocks too [PSB]."
                )
            ),
        )
        design_number(
            "b_outer",
            "b",
            width=58,
            under=under,
            help=words(
                "Set-point weight of the outer controller: its proportional action sees $b\\,r - y_1$. Less than 1 "
                "softens set-point steps; stability and the response to $d_1$, $d_2$ stay as they are."
            ),
        )


def loops(study: CascadeStudy | None, slider: bool = True) -> None:
    """PI or PID, and tau_c (lambda) or Ms, of both loops. slider=False: where a live instrument has them."""
    for loop in LOOPS:
        with st.container(key=f"loop_{loop}", gap="xsmall"):
            _loop(loop, study, slider)


def form(study: CascadeStudy | None) -> str:
    """The form in which the diagram shows settings; says which controller has none in it."""
    st.segmented_control(
        words("Settings in the diagram"),
        FORMS,
        format_func=lambda each: translated(FORMS_NAMED[each]),
        **state.bound("form"),
    )
    chosen = state.value("form")
    for name, controller in (("a", study.loop.outer), ("b", study.loop.inner)) if study else ():
        shown = form_shown(controller, chosen)
        if shown != chosen:
            st.caption(translated(NOT_IN_FORM[chosen].put(C=f"C_{name}", shown=FORMS_NAMED[shown])))
    return chosen


def _loop(loop: str, study: CascadeStudy | None, slider: bool) -> None:
    cascade = state.cascade()
    asked = _asked(cascade, loop)
    filtered = cascade.method == "synthesis" and getattr(cascade, loop) == "PID"
    row, under = st.container(horizontal=True, vertical_alignment="bottom", gap="xsmall"), st.container()
    with row:
        st.segmented_control(translated(LOOPS[loop]), KINDS, **state.bound(loop))
        key = f"{loop}_by"
        state.set_widget(key, asked)
        st.segmented_control(
            words("speed from"),
            ("auto", "tau_c", "Ms"),
            format_func={"auto": words("auto"), "tau_c": SPEED_LETTERS[cascade.method], "Ms": "Ms"}.get,
            key=key,
            on_change=_take_asked,
            args=(loop, key, study),
            help=_meaning(cascade),
        )
        if filtered:
            _filter(loop, under)
    if asked != "auto":
        _knob(loop, asked, study, slider)
    if study is not None:
        st.caption(_outcome(loop, asked, study))
    if filtered and loop == "outer":
        _cancel()


def _meaning(cascade: Cascade) -> str:
    if cascade.method == "simc":
        return words(
            "auto: $\\tau_c = \\theta$ of the reduced model, tight. $M_s$: the smallest $\\tau_c$ with that peak."
        )
    return words(
        "auto: $M_s$ = {usual:g}. $M_s$: the smallest $\\lambda$ with a stable loop and that peak.", usual=USUAL_MS
    )


def _outcome(loop: str, asked: str, study: CascadeStudy) -> str:
    """What the choice comes to."""
    symbol = speed_symbol(study.cascade)
    time = time_text(study.speeds[loop == "outer"], state.design_now().sheet)
    if not study.sound:
        return f"${symbol}$ = {time}"
    Ms = number(getattr(study, loop).Ms)
    by_peak = asked == "Ms" or (asked == "auto" and study.cascade.method == "synthesis")
    if by_peak:
        return words("$M_s$ = {Ms} needs ${symbol}$ = {time}", Ms=Ms, symbol=symbol, time=time)
    return words("${symbol}$ = {time} gives $M_s$ = {Ms}", Ms=Ms, symbol=symbol, time=time)


def _knob(loop: str, asked: str, study: CascadeStudy | None, slider: bool) -> None:
    """Slider and exact number for what is asked of the loop."""
    name = f"{asked}_{loop}"
    unit = scale(state.cascade(), loop) if asked == "tau_c" else 1.0
    stops = SPEEDS if asked == "tau_c" else PEAKS
    symbol = SPEED_LETTERS[state.cascade().method] if asked == "tau_c" else "Ms"
    place = st.container()
    if slider:
        slide, place = st.columns([5, 3], vertical_alignment="bottom", gap="small")
        slide.select_slider(
            translated(SPEED_OF[loop].put(symbol=symbol)),
            stops,
            format_func=lambda stop: number(stop * unit, 3),
            label_visibility="collapsed",
            **state.bound(
                name,
                show=lambda value: nearest(stops, value / unit),
                read=lambda stop: stop * unit,
                key=f"{name}_slider",
            ),
        )
    design_number(
        name,
        translated(EXACT_OF[loop].put(symbol=symbol)),
        quantity="time" if asked == "tau_c" else "",
        key=f"{name}_exact",
        place=place,
        under=st.container(),
        label_visibility="collapsed",
    )


def _filter(loop: str, under: DeltaGenerator) -> None:
    """tau_F of a PID by direct synthesis: lambda/N, or outside what cancels the inner zero."""
    if loop == "inner" or state.value("filter_outer") == "N":
        design_number(
            f"N_{loop}",
            "N",
            under=under,
            width=56,
            help=translated(FILTER_OF[loop]),
        )


def _cancel() -> None:
    st.checkbox(
        words("τF cancels the inner zero"),
        help=linked(words("$\\tau_F = \\eta_1$ of the inner loop in place of $\\lambda/N$; for $K_d \\leq 0$ [PSB].")),
        **state.bound(
            "filter_outer",
            show=lambda value: value == "zero",
            read=lambda checked: "zero" if checked else "N",
        ),
    )


def _asked(cascade: Cascade, loop: str) -> str:
    if getattr(cascade, f"tau_c_{loop}") is not None:
        return "tau_c"
    return "auto" if getattr(cascade, f"Ms_{loop}") is None else "Ms"


def _take_asked(loop: str, key: str, study: CascadeStudy | None) -> None:
    """Begin with what the loop has now."""
    if state.overtaken(key):
        return
    asked, cascade = state.widget(key), state.cascade()
    if asked is None:
        return
    speed, peak = scale(cascade, loop), USUAL_MS
    if study is not None:
        speed = study.speeds[loop == "outer"]
        peak = min(max(getattr(study, loop).Ms, LOWEST_MS), HIGHEST_MS) if study.sound else USUAL_MS
    state.change(
        **{f"tau_c_{loop}": speed if asked == "tau_c" else None, f"Ms_{loop}": peak if asked == "Ms" else None}
    )


def _take_method() -> None:
    """A lambda is not a tau_c: what was given as one does not stay as the other."""
    if state.overtaken("method"):
        return
    chosen = state.widget("method")
    if chosen is not None and chosen != state.value("method"):
        state.change(method=chosen, tau_c_inner=None, tau_c_outer=None)


def _take_pair() -> None:
    chosen = next((row for row in ROWS if _title(row) == state.widget("pair")), None)
    if chosen is not None:
        state.replace_design(replace(state.design_now(), cascade=of_row(chosen)))


def _title(row: PairRow) -> Text:
    if row.method == "simc":
        return said("Pair {pair}, SIMC", pair=row.pair)
    return said(
        "Pair {name}, {kind}, Ms {inner:g} · {outer:g}",
        name=row.name,
        kind=row.outer,
        inner=row.Ms_inner,
        outer=row.Ms_outer,
    )
