"""Where the controller comes from: SIMC, or my settings; and the settings that are in the plant now."""

import math
from collections.abc import Callable
from dataclasses import replace

import streamlit as st

from pages.common.parts.number_field import number_field
from pages.common.parts.settings_text import ACTION_NAMED, FORMS_NAMED, UNITS
from pages.common.parts.sources import linked
from pages.common.parts.units import unit_of
from pages.common.session import state
from pages.common.studies.single import Study, study_of_settings
from pages.common.words import translated, words
from simc_core.controllers.forms import FORMS, Controller, IdealPid
from simc_core.errors import InvalidParameter, SimcError
from simc_core.plants.plant import Plant
from simc_core.rules.simc_family import FAMILY
from simc_core.studies.retune import NEW_SETTINGS, what_changes
from simc_core.wording import Text, said

OWN = "own"
SOURCES = {"simc": "SIMC", OWN: said("My settings")}
NAMES = {
    "simc": said("original", context="rule"),
    "improved_simc": said("improved", context="rule"),
    "isimc": "iSIMC",
}
LABELS = {"Kc": "Kc", "tau_I": "τI", "tau_D": "τD", "Kp": "Kp", "Ki": "Ki", "Kd": "Kd", "K_I": "KI", "tau_F": "τF"}
FIRST = IdealPid(1.0, 10.0)  # where there is nothing to take over
NOW = said("now")  # its name in figures, tables and legends


def source_control(made: Study | None) -> None:
    """SIMC or my settings. made: what SIMC gives, to be taken over; None where its rules end."""
    state.set_widget("controller_source", state.value("controller"))
    st.segmented_control(
        words("Controller from"),
        list(SOURCES),
        format_func=lambda name: translated(SOURCES[name]),
        required=True,
        key="controller_source",
        on_change=_choose,
        args=(made.controller if made else FIRST,),
    )
    if state.value("controller") != OWN:
        st.segmented_control(
            words("Rule"),
            FAMILY,
            format_func=lambda name: translated(NAMES[name]),
            required=True,
            help=linked(
                words(
                    "Original: PI or PID [SK03]. Improved, PI: $\\tau_1 + \\theta/3$ in place of $\\tau_1$, for "
                    "plants where dead time dominates [SG12]. iSIMC, PID: $\\tau_D = \\theta/3$, and $\\tau_c$ "
                    "down to $\\theta/2$ [GS18]. The later two are made from the first-order model."
                )
            ),
            **state.bound("rule"),
        )


def _choose(offered: Controller) -> None:
    if state.overtaken("controller_source"):
        return
    chosen = state.widget("controller_source")
    if chosen == OWN and state.value("own") is None:
        state.change(own=_shown_in_form(offered))
    state.change(controller=chosen)


def _shown_in_form(controller: Controller) -> Controller:
    form = state.value("form")
    return controller.in_form(form) if controller.has_form(form) else controller


def my_settings(made: Study | None) -> None:
    """Fields for my settings; an empty τI is a controller without integral action."""
    settings_fields(state.value("own"), "own", lambda changed: state.change(own=changed))
    if made:
        st.button(
            words("Take over the SIMC settings"),
            key="take_over",
            width="stretch",
            help=words("Copies what the rule gives for this plant into the fields, to be changed by hand."),
            on_click=lambda: state.change(own=_shown_in_form(made.controller)),
        )


def settings_fields(controller: Controller, key: str, take: Callable[[Controller], None]) -> None:
    """The settings of a controller as number fields, in its own form: sizes of gains, and the action beside them."""
    _action(controller, key, take)
    names = [*controller.SETTINGS, *controller.OPTIONAL]
    for row in (names[:3], names[3:]):
        places = st.columns(3, gap="small") if row else ()
        for name, place in zip(row, places, strict=False):
            _field(controller, name, f"{key}_{type(controller).__name__}_{name}", take, place)


def _field(controller: Controller, name: str, key: str, take: Callable, place) -> None:
    sign = -1.0 if name.startswith("K") and controller.action == "direct" else 1.0
    value = sign * getattr(controller, name)
    optional = name == "tau_I"

    def changed(number: float | None) -> Controller:
        if number is not None and number < 0 and name in MAIN:
            raise InvalidParameter(
                said("{name} must be > 0, found {number:g}: its sign is the action", name=LABELS[name], number=number)
            )
        return replace(controller, **{name: math.inf if number is None else sign * number})

    number_field(
        LABELS.get(name, name),
        None if math.isinf(value) else value,
        changed,
        lambda number: take(changed(number)),
        key,
        unit=unit_of(UNITS.get(name, ""), state.design_now().sheet),
        optional=optional,
        place=place,
        help=translated(HELP[name]) if name in HELP else None,
        placeholder=words("none", context="no integral action") if optional else None,
    )


def _action(controller: Controller, key: str, take: Callable[[Controller], None]) -> None:
    """Direct or reverse, the switch of a control system: the sign of all gains together."""
    key = f"{key}_action"

    def turn() -> None:
        if not state.overtaken(key) and state.widget(key) != controller.action:
            take(
                replace(
                    controller, **{name: -getattr(controller, name) for name in controller.SETTINGS if name[0] == "K"}
                )
            )

    state.set_widget(key, controller.action)
    st.segmented_control(
        words("Action"),
        list(ACTION_NAMED),
        format_func=lambda action: translated(ACTION_NAMED[action]),
        required=True,
        key=key,
        on_change=turn,
        help=translated(ACTION),
    )


MAIN = ("Kc", "Kp", "K_I")
ACTION = said("Reverse: the output falls when PV rises, as a plant with k > 0 needs. Direct: for k < 0.")
HELP = {
    "tau_I": said("Integral time. Empty: no integral action, a P or PD controller."),
    "tau_D": said("Derivative time, 0 for none."),
    "tau_F": said("Filter over the whole controller, 1/(τF s + 1)."),
    "b": said("Set-point weight of the proportional action: it sees b r − y."),
    "c": said("Set-point weight of the derivative action: 0 acts on the measurement alone, 1 on the error."),
}


def in_the_plant_now(plant: Plant, present: Study | None) -> Study | None:
    """The baseline: fields for it, and its study around this plant; None where none was told."""
    now = state.value("now")
    folded = st.expander(words("In the plant now"), key="now", on_change="rerun")
    if folded.open:
        with folded:
            _now_fields(now, present)
    if now is None:
        return None
    try:
        return study_of_settings(plant, now)
    except SimcError as error:
        st.caption(words("The settings in the plant now do not suit this plant: {error}", error=str(error)))
        return None


def _now_fields(now: Controller | None, present: Study | None) -> None:
    if now is None:
        st.caption(words("Settings that are in your controller today, to see what a change brings and costs."))
        offered = present.controller if present else FIRST
        st.button(words("Enter them"), key="now_begin", on_click=lambda: state.change(now=_shown_in_form(offered)))
        return
    settings_fields(now, "now", lambda changed: state.change(now=changed))
    st.button(words("Forget them"), key="now_end", on_click=lambda: state.change(now=None))


def change_in_words(before: Study, after: Study, new: str = NEW_SETTINGS) -> Text:
    """What going from one loop to another brings and costs; new: what is new in the second, as of what_changes."""
    return what_changes((before.margins, before.performance), (after.margins, after.performance), new)


def form_control() -> None:
    """The form in which settings are shown; choosing another one rewrites my settings in it, where they have it."""
    state.set_widget("widget_form", state.value("form"))
    st.segmented_control(
        words("Form"),
        FORMS,
        format_func=lambda form: translated(FORMS_NAMED[form]),
        label_visibility="collapsed",
        required=True,
        key="widget_form",
        on_change=_take_form,
    )


def _take_form() -> None:
    if state.overtaken("widget_form"):
        return
    form, own = state.widget("widget_form"), state.value("own")
    state.change(form=form)
    if state.value("controller") == "own" and own.has_form(form):
        state.change(own=own.in_form(form))
