"""Designs set aside and compared with the present one: pinning, names, the table."""

import math

import streamlit as st

from pages.common import state
from pages.common.design import MOST_PINS, Tuning
from pages.common.study import Study, study
from simc_core.errors import SimcError
from simc_core.notation import number
from simc_core.plant import Plant

LETTERS = "ABCD"


def pinned_studies(plant: Plant, pins: tuple[Tuning, ...]) -> list[tuple[str, Study]]:
    """The pinned designs, round the present plant; one that this plant does not allow is named and left out."""
    found = []
    for letter, tuning in zip(LETTERS, pins, strict=False):
        try:
            found.append((letter, study(plant, tuning)))
        except SimcError as error:
            st.caption(f"Pinned design {letter} does not suit this plant: {error}")
    return found


def pin_button(tuning: Tuning, tau_c: float) -> None:
    """Set the present design aside, with its tau_c as a number, so that it stays what it was."""
    pins = state.value("pins")
    full = len(pins) >= MOST_PINS
    pin, clear = st.columns(2)
    pin.button(
        f"Pin as {LETTERS[len(pins)]}" if not full else "Four pinned",
        key="pin",
        disabled=full,
        width="stretch",
        help="Set this design aside and compare it with the next one: overlaid in the figures, and in the table.",
        on_click=_pin,
        args=(pins, tuning, tau_c),
    )
    clear.button(
        "Unpin all", key="unpin", disabled=not pins, width="stretch", on_click=state.change, kwargs={"pins": ()}
    )


def design_table(studies: list[tuple[str, Study]]) -> None:
    """One row a design, present first; a loop that is not stable has no figures."""
    st.dataframe([row(name, each) for name, each in studies], hide_index=True, width="stretch", key="designs")
    pins = state.value("pins")
    if not pins:
        st.caption("Pin a design to compare it with the next: up to four, overlaid in the figures and listed here.")
    with st.container(horizontal=True):
        for i in range(len(pins)):
            left = pins[:i] + pins[i + 1 :]
            st.button(f"Unpin {LETTERS[i]}", key=f"unpin_{i}", on_click=state.change, kwargs={"pins": left})


def row(name: str, each: Study) -> dict[str, str]:
    """A line of the table, four significant digits."""
    settings = each.controller.to_parallel()
    facts = {
        "design": name,
        "type": "PID" if settings.Kd else "PI" if settings.Kp else "I",
        "τc": number(each.tau_c),
        "Kp": number(settings.Kp),
        "Ki": number(settings.Ki),
        "Kd": number(settings.Kd),
        "b": number(settings.b),
    }
    if not each.stable:
        return facts | {"Ms": "not stable"}
    judged, metrics = each.margins, each.performance
    values = {
        "Ms": judged.Ms,
        "Mt": judged.Mt,
        "GM": judged.GM,
        "PM °": judged.PM_deg,
        "delay margin": judged.delay_margin,
        "IAE set point": metrics.setpoint.IAE,
        "IAE load": metrics.disturbance.IAE,
        "TV set point": metrics.setpoint.TV,
        "TV load": metrics.disturbance.TV,
        "overshoot %": 100 * metrics.setpoint.overshoot,
        "settling": metrics.setpoint.settling_time,
    }
    return facts | {label: "∞" if math.isinf(value) else number(value) for label, value in values.items()}


def _pin(pins: tuple[Tuning, ...], tuning: Tuning, tau_c: float) -> None:
    present = Tuning(tuning.order, tuning.h, tau_c, tuning.b, tuning.filter, tuning.rules)
    if present not in pins:
        state.change(pins=(*pins, present))
