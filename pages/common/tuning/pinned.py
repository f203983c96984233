"""Designs set aside and compared with the present one: pinning, names, the table."""

import math
from dataclasses import replace

import streamlit as st

from pages.common.parts.settings_text import ACTION_NAMED, sizes
from pages.common.parts.settings_text import UNITS as SETTING_UNITS
from pages.common.parts.units import unit_of, with_plain_unit
from pages.common.session import state
from pages.common.session.design import MOST_PINS
from pages.common.session.tuning import Tuning
from pages.common.studies import measures
from pages.common.studies.single import Study, study, study_of_settings
from pages.common.tuning.source import LABELS
from pages.common.words import number, translated, words
from simc_core.controllers.forms import FORMS, Controller, IController
from simc_core.errors import SimcError
from simc_core.plants.plant import Plant
from simc_core.wording import said

LETTERS = "ABCD"
SETTINGS = {
    "series": ("Kc", "tau_I", "tau_D"),
    "ideal": ("Kc", "tau_I", "tau_D"),
    "parallel": ("Kp", "Ki", "Kd"),
}
CONTROLLER, KIND_OF_ACTION = said("controller"), said("action")
GM_LOWER = said("GM, lower limit")
JUDGED = (
    *("Ms", "Mt", "GM", GM_LOWER, said("PM, degrees"), said("delay margin")),
    *(said("IAE, set point"), said("IAE, load"), said("TV, set point"), said("TV, load")),
    *(said("overshoot, %"), said("settling, set point"), said("settling, load")),
)

UNITS = {
    **dict.fromkeys(("τc", "τF", "delay margin", "settling, set point", "settling, load"), "time"),
    **dict.fromkeys(("IAE, set point", "IAE, load"), "PV time"),
    **dict.fromkeys(("TV, set point", "TV, load"), "OP"),
    **{LABELS[name]: unit for name, unit in SETTING_UNITS.items()},
}


def pinned_studies(plant: Plant, pins: tuple[Tuning | Controller, ...]) -> list[tuple[str, Study]]:
    """The pinned designs, around the present plant; one that this plant does not allow is named and left out."""
    found = []
    for letter, pin in zip(LETTERS, pins, strict=False):
        try:
            found.append((letter, study(plant, pin) if isinstance(pin, Tuning) else study_of_settings(plant, pin)))
        except SimcError as error:
            st.caption(
                words("Pinned design {letter} does not suit this plant: {error}", letter=letter, error=str(error)),
            )
    return found


def pin_button(present: Study) -> None:
    """Set the present design aside, with its tau_c as a number, so that it stays what it was."""
    pins = state.value("pins")
    full = len(pins) >= MOST_PINS
    pin, clear = st.columns(2)
    pin.button(
        words("Pin (4 of 4 used)") if full else words("Pin as {letter}", letter=LETTERS[len(pins)]),
        key="pin",
        disabled=full,
        width="stretch",
        help=words(
            "Set this design aside and compare it with the next one: overlaid in the figures, and in the table."
        ),
        on_click=_pin,
        args=(pins, present),
    )
    clear.button(
        words("Unpin all"),
        key="unpin",
        disabled=not pins,
        width="stretch",
        on_click=state.change,
        kwargs={"pins": ()},
    )


def design_table(studies: list[tuple[str, Study]]) -> None:
    """One column a design, present first, in a form that all have; a loop that is not stable has no figures."""
    form, sheet = common_form([each.controller for _, each in studies], state.value("form")), state.design_now().sheet
    place = st.container()
    more = st.multiselect(
        words("More numbers"),
        list(measures.MEASURES),
        format_func=measures.told,
        key="measures",
        persist_state="session",
        placeholder=translated(measures.EXAMPLES),
        help=translated(measures.MEANINGS),
    )
    columns = {name: facts(each, form) | _further(each, more) for name, each in studies}
    units = UNITS | {label: measures.MEASURES[label].unit for label in more}
    integral = [LABELS["K_I"]] * any(isinstance(each.controller, IController) for _, each in studies)
    settings = *map(LABELS.get, SETTINGS[form]), *integral
    rows = [
        {
            "quantity": translated(
                with_plain_unit(measures.NAMES.get(label, label), unit_of(units.get(label, ""), sheet))
            )
        }
        | {translated(name): each.get(label, "–") for name, each in columns.items()}
        for label in (CONTROLLER, KIND_OF_ACTION, "τc", *settings, "τF", "b", *JUDGED, *more)
    ]
    wide = {"quantity": st.column_config.TextColumn(words("quantity"), width="medium")}
    place.dataframe(
        rows, hide_index=True, width="content", height="content", row_height=27, column_config=wide, key="designs"
    )
    pins = state.value("pins")
    if not pins:
        st.caption(
            words("Pin a design to compare it with the next: up to four, overlaid in the figures and listed here.")
        )
    with st.container(horizontal=True):
        for i in range(len(pins)):
            left = pins[:i] + pins[i + 1 :]
            st.button(
                words("Unpin {letter}", letter=LETTERS[i]),
                key=f"unpin_{i}",
                on_click=state.change,
                kwargs={"pins": left},
            )


def _further(each: Study, labels: list[str]) -> dict[str, str]:
    """The measures that were chosen, a dash where there is none."""
    if not each.stable or not labels:
        return {}
    known = measures.Measured(each.loop, each.margins, each.performance)
    return {label: number(value) for label, value in measures.values(known, labels).items()}


def common_form(controllers: list[Controller], asked: str) -> str:
    """The form asked for where all have it, else the first one they all have."""
    return next(form for form in (asked, *FORMS[1:]) if all(each.has_form(form) for each in controllers))


def facts(each: Study, form: str) -> dict[str, str]:
    """What the table says of a design by its labels, four significant digits."""
    controller = each.controller
    parts = controller.to_parallel()
    kind = "PID" if parts.Kd else "PI" if parts.Kp else "I"
    tau_c = math.nan if each.tau_c is None else each.tau_c
    told = {CONTROLLER: kind, KIND_OF_ACTION: translated(ACTION_NAMED[controller.action]), "τc": number(tau_c)}
    told |= {LABELS[name]: number(value) for name, value in sizes(controller.in_form(form)).items()}
    told |= {"τF": number(parts.tau_F), "b": number(parts.b)}
    if not each.stable:
        return told | {JUDGED[0]: words("not stable")}
    judged, metrics = each.margins, each.performance
    judgement = (
        *(judged.Ms, judged.Mt, judged.GM, judged.GM_lower, judged.PM_deg, judged.delay_margin),
        *(metrics.setpoint.IAE, metrics.disturbance.IAE, metrics.setpoint.TV, metrics.disturbance.TV),
        *(100 * metrics.setpoint.overshoot, metrics.setpoint.settling_time, metrics.disturbance.settling_time),
    )
    told |= dict(zip(JUDGED, map(number, judgement), strict=True))
    return told if judged.GM_lower else told | {GM_LOWER: words("none", context="no limit")}


def _pin(pins: tuple[Tuning | Controller, ...], present: Study) -> None:
    pin = replace(present.tuning, tau_c=present.tau_c, speed="") if present.tuned else present.controller
    if pin not in pins:
        state.change(pins=(*pins, pin))
