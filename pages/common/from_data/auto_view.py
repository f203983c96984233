"""Auto-tuning: the frequency response that the record shows, and settings for load or set point, damped or fast."""

from typing import Any

import streamlit as st

from pages.common.from_data import figure
from pages.common.from_data.send import plain_unit, send
from pages.common.from_data.work import Fits, Work, kept, nearly
from pages.common.parts.symbols import sentence
from pages.common.words import number, translated, words
from simc_core import AutoTuned, FrequencyBand, Identified, Trend, auto_tune, frequency_band
from simc_core.figures.uncertain import band_bode_figure
from simc_core.wording import said

KINDS = ("PI", "PID")
NAMES = {
    ("load", "damped"): said("Load, damped"),
    ("load", "fast"): said("Load, fast"),
    ("setpoint", "damped"): said("Set point, damped"),
    ("setpoint", "fast"): said("Set point, fast"),
}
HEIGHT = 330  # px


def show(work: Work, trend: Trend, fits: Fits, model: Identified) -> None:
    """Four settings with what they cost, one of which is taken; the response they rest on."""
    several = nearly(fits, model)
    kind = st.segmented_control(words("Controller"), KINDS, default=KINDS[0], required=True, key="auto_kind")
    with st.spinner(words("Trying settings")):
        found, why = kept(fits, (model.structure, "auto", kind), lambda: auto_tune(several, kind))
    if found is None:
        st.warning(sentence(why))
    else:
        _offer(work, trend, fits, model, found)
    band, why = kept(fits, (model.structure, "band"), lambda: frequency_band(several))
    if band is None:
        st.caption(sentence(why))
        return
    alt = words("Frequency response of the process with its 95 % band")
    figure.show(band_bode_figure(band, HEIGHT), trend, "figure_band", "frequency response", alt)
    st.caption(words("Shaded: 95 % for all that the record leaves open.") + _crossing(band, trend))


def _crossing(band: FrequencyBand, trend: Trend) -> str:
    """Where the phase passes -180 degrees, where that is known."""
    nominal, low, high = band.omega_180
    if not (nominal == nominal and low == low):
        return ""
    unit = plain_unit(trend)
    passes = words(
        "The phase passes −180° at {nominal} ({low} to {high}) {unit}.",
        nominal=number(nominal),
        low=number(low),
        high=number(high),
        unit=f"rad/{unit}" if unit else words("rad per time unit"),
    )
    return f" {passes}"


def _offer(work: Work, trend: Trend, fits: Fits, model: Identified, found: tuple[AutoTuned, ...]) -> None:
    st.dataframe([_row(each, trend) for each in found], hide_index=True, width="stretch", height="content")
    st.caption(
        words(
            "Ms 95 %: not passed with 95 % for all that the record leaves open; its limit is 1.4 for damped and 2 for "
            "fast settings. IAE, overshoot and TV: unit steps on the model."
        )
    )
    if any(each.balanced for each in found):
        st.caption(
            words("For the set point alone an integrating process needs no integral action; the load counts as much.")
        )
    if len(found) < 4:
        st.caption(
            words("Settings that would pass their limit whatever the gain are left out: the record says too little.")
        )
    by_name = {_name(each): each for each in found}
    with st.container(key="send_auto", horizontal=True, gap="small", vertical_alignment="bottom"):
        chosen = st.selectbox(words("Settings"), list(by_name), format_func=translated, key="auto_chosen")
        if st.button(words("Take them to the tuning page"), type="primary", key="tune_auto"):
            send(work, trend, model, fits, own=by_name[chosen].controller)


def _name(each: AutoTuned) -> str:
    return NAMES[each.purpose, each.character]


def _row(each: AutoTuned, trend: Trend) -> dict[str, Any]:
    unit = plain_unit(trend)
    time = f" [{unit}]" if unit else ""
    controller, setpoint, load = each.controller, each.performance.setpoint, each.performance.disturbance
    row = {
        words("for", context="settings"): translated(_name(each)),
        "Kc": number(controller.Kc),
        f"τI{time}": number(controller.tau_I),
    }
    if controller.tau_D:
        row |= {f"τD{time}": number(controller.tau_D), f"τF{time}": number(controller.tau_F)}
    return row | {
        "Ms": number(each.Ms, 3),
        "Ms 95 %": number(each.Ms_high, 3),
        words("IAE load"): number(load.IAE, 3),
        words("IAE set point"): number(setpoint.IAE, 3),
        words("overshoot"): words("{share:.0f} %", share=100 * setpoint.overshoot),
        "TV": number(setpoint.TV, 3),
    }
