"""Auto-tuning: the frequency response that the record shows, and settings for load or set point, damped or fast."""

from typing import Any

import streamlit as st

from pages.common.from_data import figure
from pages.common.from_data.send import plain_unit, send
from pages.common.from_data.work import Fits, Work, kept, nearly
from pages.common.parts.symbols import sentence
from simc_core import AutoTuned, Identified, Trend, auto_tune, frequency_band
from simc_core.figures.uncertain import band_bode_figure
from simc_core.notation import number

KINDS = ("PI", "PID")
PURPOSES = {"load": "Load", "setpoint": "Set point"}
HEIGHT = 330  # px


def show(work: Work, trend: Trend, fits: Fits, model: Identified) -> None:
    """Four settings with what they cost, one of which is taken; the response they rest on."""
    several = nearly(fits, model)
    kind = st.segmented_control("Controller", KINDS, default=KINDS[0], required=True, key="auto_kind")
    with st.spinner("Trying settings"):
        found, why = kept(fits, (model.structure, "auto", kind), lambda: auto_tune(several, kind))
    if found is None:
        st.warning(sentence(why))
    else:
        _offer(work, trend, fits, model, found)
    band, why = kept(fits, (model.structure, "band"), lambda: frequency_band(several))
    if band is None:
        st.caption(sentence(why))
        return
    alt = "Frequency response of the process with its 95 % band"
    figure.show(band_bode_figure(band, HEIGHT), trend, "figure_band", "frequency response", alt)
    nominal, low, high = band.omega_180
    said = ""
    if nominal == nominal and low == low:
        said = f" The phase passes −180° at {number(nominal)} ({number(low)} to {number(high)}) {_rate(trend)}."
    st.caption(f"Shaded: 95 % for all that the record leaves open.{said}")


def _offer(work: Work, trend: Trend, fits: Fits, model: Identified, found: tuple[AutoTuned, ...]) -> None:
    st.dataframe([_row(each, trend) for each in found], hide_index=True, width="stretch", height="content")
    st.caption(
        "Ms 95 %: not passed with 95 % for all that the record leaves open; its limit is 1.4 for damped and 2 for fast "
        "settings. IAE, overshoot and TV: unit steps on the model."
    )
    if any(each.balanced for each in found):
        st.caption("For the set point alone an integrating process needs no integral action; the load counts as much.")
    if len(found) < 4:
        st.caption("Settings that would pass their limit whatever the gain are left out: the record says too little.")
    names = {_name(each): each for each in found}
    with st.container(key="send_auto", horizontal=True, gap="small", vertical_alignment="bottom"):
        chosen = st.selectbox("Settings", list(names), key="auto_chosen")
        if st.button("Take them to the tuning page", type="primary", key="tune_auto"):
            send(work, trend, model, fits, own=names[chosen].controller)


def _name(each: AutoTuned) -> str:
    return f"{PURPOSES[each.purpose]}, {each.character}"


def _row(each: AutoTuned, trend: Trend) -> dict[str, Any]:
    unit = plain_unit(trend)
    time = f" [{unit}]" if unit else ""
    controller, setpoint, load = each.controller, each.performance.setpoint, each.performance.disturbance
    row = {"for": _name(each), "Kc": number(controller.Kc), f"τI{time}": number(controller.tau_I)}
    if controller.tau_D:
        row |= {f"τD{time}": number(controller.tau_D), f"τF{time}": number(controller.tau_F)}
    return row | {
        "Ms": number(each.Ms, 3),
        "Ms 95 %": number(each.Ms_high, 3),
        "IAE load": number(load.IAE, 3),
        "IAE set point": number(setpoint.IAE, 3),
        "overshoot": f"{100 * setpoint.overshoot:.0f} %",
        "TV": number(setpoint.TV, 3),
    }


def _rate(trend: Trend) -> str:
    unit = plain_unit(trend)
    return f"rad/{unit}" if unit else "rad per time unit"
