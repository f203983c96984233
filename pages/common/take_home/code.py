"""The controller as source text, to read and to download."""

import math

import streamlit as st

from pages.common.parts.units import time_text
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.studies.single import Study
from pages.common.take_home.proof import longest_period
from pages.common.take_home.typed import assumed, typed_into
from pages.common.take_home.written import LANGUAGES, limits, written
from simc_core.notation import number

WHOSE = {"design": "the design", "typed": "what is typed into the box"}


def code(design: Design, present: Study) -> None:
    """Language, whose settings, the text. Raises SimcError where it cannot be written."""
    _choose(design)
    if not design.actuator.h:
        _period(design, present)
        return
    controller = present.controller
    if design.box and design.home.exported == "typed":
        controller = typed_into(design.box, controller, design.sheet, design.home.rounding == "safe").effective
    text = written(design, controller, present.controller)
    language = LANGUAGES[design.home.language]
    st.download_button(
        f"Download {language.file}", text, language.file, "text/plain", key="code_file", on_click="ignore"
    )
    if not language.compiled:
        st.warning(f"Not compiled: no tool for {language.title} was at hand. Check it in yours before use.")
    st.caption(_what_it_knows(design))
    st.code(text, language=language.colours, height=560)


def _choose(design: Design) -> None:
    places = st.columns([3, 4], gap="small", vertical_alignment="bottom")
    places[0].selectbox(
        "Language", list(LANGUAGES), format_func=lambda key: LANGUAGES[key].title, **state.bound("language")
    )
    if design.box:
        places[1].segmented_control(
            "Settings of", list(WHOSE), format_func=WHOSE.get, required=True, **state.bound("exported")
        )


def _period(design: Design, present: Study) -> None:
    """Without a sampling period there is no code; one that costs little is offered."""
    period = longest_period(present.loop, design.actuator.law, design.actuator.delay_scans)
    if not math.isfinite(period):
        st.info("A program acts every so often: type the sampling period of yours.")
        return
    st.info(
        "A program acts every so often: type the sampling period of yours. "
        f"Up to {time_text(period, design.sheet)}, $M_s$ rises by 5 % at most."
    )
    st.button(
        f"Take {time_text(period, design.sheet)}", key="take_period", on_click=state.change, kwargs={"sampling": period}
    )


def _what_it_knows(design: Design) -> str:
    low, high = ("none" if value is None else number(value) for value in limits(design))
    told = f"The law that the simulation uses. Limits of the output: {low} to {high}."
    taken = [what for what in assumed(design.sheet) if what.startswith("times")]
    return " ".join([told, *(f"{what[0].upper()}{what[1:]}." for what in taken)])
