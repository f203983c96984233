"""Other experiments: a set-point step under P control, a loop that oscillates, a relay test of the present plant."""

from collections.abc import Callable

import streamlit as st

from pages.common.parts import panel
from pages.common.parts.number_field import number_field
from pages.common.parts.sources import linked
from pages.common.parts.symbols import sentence, symbols
from pages.common.parts.units import time_text, unit_of
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.shell import header
from simc_core import Plant, SeriesPid, SimcError, checks, relay_test, retune_oscillation, setpoint_overshoot
from simc_core.figures.trend import relay_figure
from simc_core.notation import latex, number

OVERSHOOT = {  # field: label, check, unit
    "Kc0": ("Gain of the P controller", checks.gain, "OP/PV"),
    "setpoint": ("Step of the set point", checks.gain, "PV"),
    "peak": ("Change of PV at its first peak", checks.gain, "PV"),
    "lowest": ("Change of PV at the next minimum", checks.gain, "PV"),
    "peak_time": ("Time from the step to the peak", checks.positive_time, "time"),
}
OSCILLATION = {
    "Kc": ("Kc now", checks.gain, "OP/PV"),
    "tau_I": ("τI now", checks.positive_time, "time"),
    "period": ("Period of the oscillation", checks.positive_time, "time"),
    "theta": ("Dead time θ, if known", checks.positive_time, "time"),
}
RELAY = {
    "amplitude": ("OP up and down by", checks.gain, "OP"),
    "hysteresis": ("Hysteresis of PV", lambda name, value: checks.real(name, value, 0.0), "PV"),
}
HEIGHT = 300  # px
Fields = dict[str, tuple[str, Callable[[str, float], float], str]]


def show(design: Design) -> None:
    """One of the forms; none at first."""
    st.divider()
    titles = ["Set-point overshoot", "Loop that oscillates", "Relay test"]
    chosen = st.segmented_control("Another experiment", titles, key="experiment")
    if chosen == titles[0]:
        _overshoot(design)
    elif chosen == titles[1]:
        _oscillation(design)
    elif chosen == titles[2]:
        _relay(design)


def _numbers(form: str, fields: Fields, design: Design, optional: tuple[str, ...] = ()) -> dict[str, float]:
    """The numbers of a form that are there so far."""
    given: dict[str, float | None] = state.lasting(f"experiment_{form}", dict)
    places = st.columns(len(fields), gap="small", vertical_alignment="bottom")
    for place, (name, (label, check, unit)) in zip(places, fields.items(), strict=True):
        number_field(
            label,
            given.get(name),
            lambda value, label=label, check=check: None if value is None else check(label, value),
            lambda value, name=name: given.__setitem__(name, value),
            f"experiment_{form}_{name}",
            unit=unit_of(unit, design.sheet),
            optional=True,
            place=place,
            under=st.container(),
        )
    found = {name: value for name, value in given.items() if value is not None}
    missing = [label for name, (label, _, _) in fields.items() if name not in found and name not in optional]
    if missing:
        st.caption(f"Still needed: {', '.join(missing)}.")
        return {}
    return found


def _overshoot(design: Design) -> None:
    """[SS10]: with the loop under P control, one step of the set point with about 30 % overshoot."""
    st.caption(
        linked("Put the controller to P, make a step of the set point with about 30 % overshoot, and read off [SS10]:")
    )
    given = _numbers("overshoot", OVERSHOOT, design)
    if not given:
        return
    try:
        found = setpoint_overshoot(**given)
    except SimcError as error:
        st.error(sentence(_named(error, OVERSHOOT)))
        return
    plant = found.model.plant
    st.markdown(f"Overshoot {100 * found.overshoot:.3g} %. $\\displaystyle G(s) = {latex(plant)}$")
    _settings(found.controller.Kc, found.controller.tau_I, design)
    for line in found.advice:
        st.warning(sentence(line))
    if st.button("Tune this model", key="tune_overshoot"):
        _begin(plant, design)


def _oscillation(design: Design) -> None:
    """[SK98]: what the period of an oscillation says about the settings in the loop."""
    given = _numbers("oscillation", OSCILLATION, design, optional=("theta",))
    if not given:
        return
    try:
        now = SeriesPid(given["Kc"], given["tau_I"])
        found = retune_oscillation(now, given["period"], given.get("theta"))
    except SimcError as error:
        st.error(sentence(_named(error, OSCILLATION)))
        return
    st.info(sentence(found.advice))
    if found.controller != now:
        _settings(found.controller.Kc, found.controller.tau_I, design)


def _relay(design: Design) -> None:
    """The present plant under a relay, exactly; what the describing function makes of it."""
    st.caption("The present plant under a relay, simulated with its dead time exact.")
    given = _numbers("relay", RELAY, design, optional=("hysteresis",))
    if not given:
        return
    try:
        found = relay_test(design.plant, **given)
    except SimcError as error:
        st.error(sentence(_named(error, RELAY)))
        return
    figure = relay_figure(found.t, found.y, found.u, HEIGHT)
    alt = "Relay test: y oscillates, u switches between two levels"
    panel.show(figure, "relay", alt)
    rows = [
        {"quantity": "Ku", "describing function": number(found.Ku), "exact": number(found.Ku_exact)},
        {
            "quantity": "Pu",
            "describing function": time_text(found.Pu, design.sheet),
            "exact": time_text(found.Pu_exact, design.sheet),
        },
    ]
    st.dataframe(rows, hide_index=True, width="content")
    if found.model is not None:
        st.markdown(f"Fitted to this record: $\\displaystyle {latex(found.model)}$")


def _settings(Kc: float, tau_I: float, design: Design) -> None:
    unit = unit_of("OP/PV", design.sheet)
    st.markdown(f"$K_c$ = **{number(Kc)}** {unit}, $\\tau_I$ = **{time_text(tau_I, design.sheet)}**")


def _begin(plant: Plant, design: Design) -> None:
    sheet = design.sheet
    state.begin_loop(plant, mine=True)
    state.change(unit=sheet.time_unit, PV_unit=sheet.PV_unit, OP_unit=sheet.OP_unit)
    header.go("tuning")


def _named(error: SimcError, fields: Fields) -> str:
    """What the core refuses, with the fields called as on the page."""
    text = str(error)
    for name, (label, _, _) in fields.items():
        text = label + text.removeprefix(name) if text.startswith(f"{name} ") else text
    return symbols(text)
