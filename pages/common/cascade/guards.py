"""What must not be overlooked in a cascade, each with what to do instead."""

from collections.abc import Iterator
from contextlib import contextmanager

import streamlit as st

from pages.common.cascade.readout import separation, trouble
from pages.common.parts.symbols import sentence, spoken, symbols
from pages.common.session import state
from pages.common.studies.cascade import CascadeStudy, sounder, speed_symbol
from pages.common.words import words
from simc_core.errors import NotReducible, SimcError
from simc_core.notation import number
from simc_core.wording import said

SPEED = {
    "tau_c_inner": said("{symbol} (inner) = {value}", symbol="", value=""),
    "tau_c_outer": said("{symbol} (outer) = {value}", symbol="", value=""),
}


def show(study: CascadeStudy) -> None:
    """Soundness as an error, notes of the design as warnings, the time scales where no note speaks of them."""
    with st.container(key="guards", gap="xsmall"):
        if not study.sound:
            _unsound(study)
        for note in study.design.notes:
            st.warning(sentence(note))
        if study.unsettled:
            st.warning(symbols(said("No IAE: {why}", why=study.unsettled)))
        if study.sound and (study.cascade.method == "synthesis" or study.separate):
            st.caption(separation(study))


def _unsound(study: CascadeStudy) -> None:
    """What is not stable, and slower loops that were tried, to click."""
    change = sounder(study)
    symbol = f"${speed_symbol(study.cascade)}$"
    speeds = [SPEED[name].put(symbol=symbol, value=number(value)) for name, value in change.items()]
    remedy = said("No slower loops were found that are stable.")
    if len(speeds) == 1:
        remedy = said("Take {speed}: both loops are then stable.", speed=speeds[0])
    elif speeds:
        remedy = said("Take {inner} and {outer}: both loops are then stable.", inner=speeds[0], outer=speeds[1])
    st.error(
        words(
            "**{trouble}**, so nothing is said of margins and metrics. *{remedy}*",
            trouble=trouble(study),
            remedy=remedy,
        )
    )
    if change:
        st.button(
            spoken(
                said("Take {inner} and {outer}", inner=speeds[0], outer=speeds[1])
                if len(speeds) > 1
                else said("Take {speed}", speed=speeds[0])
            ),
            key="remedy_unsound",
            type="tertiary",
            icon=":material/arrow_forward:",
            on_click=state.change,
            kwargs=change,
        )


@contextmanager
def viewed() -> Iterator[None]:
    """A SimcError raised inside is told in words, in place of the rest of one view; the design itself stands."""
    try:
        yield
    except SimcError as error:
        st.warning(words("**This cannot be shown.** {error}", error=sentence(str(error))))


def offer_synthesis(refusal: SimcError) -> None:
    """Where SIMC has no rule for a block: the method that is made for it, to click."""
    cascade = state.cascade()
    unstable = cascade.primary.unstable_poles or cascade.secondary.unstable_poles
    if cascade.method == "simc" and (unstable or isinstance(refusal, NotReducible)):
        st.button(
            words("Use direct synthesis"),
            key="use_synthesis",
            type="primary",
            on_click=state.change,
            kwargs={"method": "synthesis", "tau_c_inner": None, "tau_c_outer": None},
        )
