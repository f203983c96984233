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
from pages.common.words import number, translated, typeset, words
from simc_core import Plant, SeriesPid, SimcError, checks, relay_test, retune_oscillation, setpoint_overshoot
from simc_core.figures.trend import relay_figure
from simc_core.notation import latex
from simc_core.wording import Text, renamed, said

OVERSHOOT = {  # field: label, check, unit
    "Kc0": (said("Gain of the P controller"), checks.gain, "OP/PV"),
    "setpoint": (said("Step of the set point"), checks.gain, "PV"),
    "peak": (said("Change of PV at its first peak"), checks.gain, "PV"),
    "lowest": (said("Change of PV at the next minimum"), checks.gain, "PV"),
    "peak_time": (said("Time from the step to the peak"), checks.positive_time, "time"),
}
OSCILLATION = {
    "Kc": (said("Kc now"), checks.gain, "OP/PV"),
    "tau_I": (said("τI now"), checks.positive_time, "time"),
    "period": (said("Period of the oscillation"), checks.positive_time, "time"),
    "theta": (said("Dead time θ, if known"), checks.positive_time, "time"),
}
RELAY = {
    "amplitude": (said("OP up and down by"), checks.gain, "OP"),
    "hysteresis": (said("Hysteresis of PV"), lambda name, value: checks.real(name, value, 0.0), "PV"),
}
TITLES = [said("Set-point overshoot"), said("Loop that oscillates"), said("Relay test")]
HEIGHT = 300  # px
Fields = dict[str, tuple[str, Callable[[str, float], float], str]]


def show(design: Design) -> None:
    """One of the forms; none at first."""
    st.divider()
    chosen = st.segmented_control(words("Another experiment"), TITLES, format_func=translated, key="experiment")
    if chosen == TITLES[0]:
        _overshoot(design)
    elif chosen == TITLES[1]:
        _oscillation(design)
    elif chosen == TITLES[2]:
        _relay(design)


def _numbers(form: str, fields: Fields, design: Design, optional: tuple[str, ...] = ()) -> dict[str, float]:
    """The numbers of a form that are there so far."""
    given: dict[str, float | None] = state.lasting(f"experiment_{form}", dict)
    places = st.columns(len(fields), gap="small", vertical_alignment="bottom")
    for place, (name, (label, check, unit)) in zip(places, fields.items(), strict=True):
        called = translated(label)
        number_field(
            called,
            given.get(name),
            lambda value, called=called, check=check: None if value is None else check(called, value),
            lambda value, name=name: given.__setitem__(name, value),
            f"experiment_{form}_{name}",
            unit=unit_of(unit, design.sheet),
            optional=True,
            place=place,
            under=st.container(),
        )
    found = {name: value for name, value in given.items() if value is not None}
    missing = [
        translated(label) for name, (label, _, _) in fields.items() if name not in found and name not in optional
    ]
    if missing:
        st.caption(words("Still needed: {fields}.", fields=", ".join(missing)))
        return {}
    return found


def _overshoot(design: Design) -> None:
    """[SS10]: with the loop under P control, one step of the set point with about 30 % overshoot."""
    st.caption(
        linked(
            words(
                "Put the controller to P, make a step of the set point with about 30 % overshoot, and read off [SS10]:"
            )
        )
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
    st.markdown(
        words(
            "Overshoot {share:.3g} %. {plant}",
            share=100 * found.overshoot,
            plant=f"$\\displaystyle G(s) = {typeset(latex(plant))}$",
        )
    )
    _settings(found.controller.Kc, found.controller.tau_I, design)
    for line in found.advice:
        st.warning(sentence(line))
    if st.button(words("Tune this model"), key="tune_overshoot"):
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
    st.caption(words("The present plant under a relay, simulated with its dead time exact."))
    given = _numbers("relay", RELAY, design, optional=("hysteresis",))
    if not given:
        return
    try:
        found = relay_test(design.plant, **given)
    except SimcError as error:
        st.error(sentence(_named(error, RELAY)))
        return
    figure = relay_figure(found.t, found.y, found.u, HEIGHT)
    alt = words("Relay test: y oscillates, u switches between two levels")
    panel.show(figure, "relay", alt)
    columns = [
        (words("quantity"), "Ku", "Pu"),
        (words("describing function"), number(found.Ku), time_text(found.Pu, design.sheet)),
        (words("exact"), number(found.Ku_exact), time_text(found.Pu_exact, design.sheet)),
    ]
    st.dataframe({name: cells for name, *cells in columns}, hide_index=True, width="content")
    if found.model is not None:
        st.markdown(words("Fitted to this record: {model}", model=f"$\\displaystyle {typeset(latex(found.model))}$"))


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
    if isinstance(text, Text):
        return symbols(renamed(text, {name: label for name, (label, _, _) in fields.items()}))
    return symbols(text)
