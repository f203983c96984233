"""The controller as source text, to read and to download."""

import math

import streamlit as st

from pages.common.parts.units import time_text
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.studies.single import Study
from pages.common.take_home.proof import longest_period
from pages.common.take_home.typed import SECONDS, assumed, typed_into
from pages.common.take_home.written import LANGUAGES, Language, limits, written
from pages.common.words import translated, words
from simc_core.notation import number as core_number
from simc_core.wording import said

WHOSE = {"design": said("the design"), "typed": said("what is typed into the box")}


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
        words("Download {file}", file=language.file),
        text,
        language.file,
        "text/plain",
        key="code_file",
        on_click="ignore",
    )
    if not language.compiled:
        st.warning(not_compiled(language))
    st.caption(_what_it_knows(design))
    st.code(text, language=language.colours, height=560)


def _choose(design: Design) -> None:
    places = st.columns([3, 4], gap="small", vertical_alignment="bottom")
    places[0].selectbox(
        words("Language"),
        list(LANGUAGES),
        format_func=lambda key: translated(LANGUAGES[key].title),
        **state.bound("language"),
    )
    if design.box:
        places[1].segmented_control(
            words("Settings of"),
            list(WHOSE),
            format_func=lambda whose: translated(WHOSE[whose]),
            required=True,
            **state.bound("exported"),
        )


def _period(design: Design, present: Study) -> None:
    """Without a sampling period there is no code; one that costs little is offered."""
    period = longest_period(present.loop, design.actuator.law, design.actuator.delay_scans)
    if not math.isfinite(period):
        st.info(words("A program acts every so often: type the sampling period of yours."))
        return
    time = time_text(period, design.sheet)
    st.info(
        words(
            "A program acts every so often: type the sampling period of yours. Up to {time}, $M_s$ rises by 5 % "
            "at most.",
            time=time,
        )
    )
    st.button(words("Take {time}", time=time), key="take_period", on_click=state.change, kwargs={"sampling": period})


def _what_it_knows(design: Design) -> str:
    none = said("none", context="limit of the output")
    low, high = (none if value is None else core_number(value) for value in limits(design))
    told = words("The law that the simulation uses. Limits of the output: {low} to {high}.", low=low, high=high)
    return " ".join([told, words("Times are taken as seconds.")]) if SECONDS in assumed(design.sheet) else told


def not_compiled(language: Language) -> str:
    """A warning."""
    return words(
        "Not compiled: no tool for {language} was at hand. Check it in yours before use.", language=language.title
    )
