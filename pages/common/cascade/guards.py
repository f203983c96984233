"""What must not be overlooked in a cascade, each with what to do instead."""

from collections.abc import Iterator
from contextlib import contextmanager

import streamlit as st

from pages.common.cascade.readout import separation, trouble
from pages.common.parts.symbols import sentence, spoken, symbols
from pages.common.session import state
from pages.common.studies.cascade import CascadeStudy, sounder, speed_symbol
from simc_core.errors import NotReducible, SimcError
from simc_core.notation import number


def show(study: CascadeStudy) -> None:
    """Soundness as an error, notes of the design as warnings, the time scales where no note speaks of them."""
    with st.container(key="guards", gap="xsmall"):
        if not study.sound:
            _unsound(study)
        for note in study.design.notes:
            st.warning(sentence(note))
        if study.unsettled:
            st.warning(symbols(f"No IAE: {study.unsettled}"))
        if study.sound and (study.cascade.method == "synthesis" or study.separate):
            st.caption(separation(study))


def _unsound(study: CascadeStudy) -> None:
    """What is not stable, and slower loops that were tried, to click."""
    change = sounder(study)
    letter = speed_symbol(study.cascade)
    speeds = " and ".join(
        f"${letter}$ ({name.removeprefix('tau_c_')}) = {number(value)}" for name, value in change.items()
    )
    remedy = f"Take {speeds}: both loops are then stable." if change else "No slower loops were found that are stable."
    st.error(f"**{trouble(study)}**, so nothing is said of margins and metrics. *{remedy}*")
    if change:
        st.button(
            f"Take {spoken(speeds)}",
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
        st.warning(f"**This cannot be shown.** {sentence(str(error))}")


def offer_synthesis(refusal: SimcError) -> None:
    """Where SIMC has no rule for a block: the method that is made for it, to click."""
    cascade = state.cascade()
    unstable = cascade.primary.unstable_poles or cascade.secondary.unstable_poles
    if cascade.method == "simc" and (unstable or isinstance(refusal, NotReducible)):
        st.button(
            "Use direct synthesis",
            key="use_synthesis",
            type="primary",
            on_click=state.change,
            kwargs={"method": "synthesis", "tau_c_inner": None, "tau_c_outer": None},
        )
