"""What must not be overlooked in a cascade, each with what to do instead."""

import streamlit as st

from pages.common import state
from pages.common.cascade_readout import separation, trouble
from pages.common.cascade_study import CascadeStudy
from pages.common.guards import STYLE
from pages.common.symbols import symbols


def show(study: CascadeStudy) -> None:
    """Notes of the design as warnings, soundness as an error, the time scales."""
    st.html(STYLE)
    with st.container(key="guards", gap="xsmall"):
        if not study.sound:
            st.error(f"**{trouble(study)}**, so nothing is said of margins and metrics. *Slow that loop down.*")
        for note in study.design.notes:
            st.warning(symbols(note[0].upper() + note[1:] if note[0].islower() and " " in note[:4] else note))
        if study.unsettled:
            st.warning(symbols(f"No IAE: {study.unsettled}"))
        st.caption(separation(study))


def offer_synthesis() -> None:
    """Where SIMC is asked for an unstable block: the method that is made for it, to click."""
    cascade = state.cascade()
    if cascade.method == "simc" and (cascade.primary.unstable_poles or cascade.secondary.unstable_poles):
        st.button(
            "Use direct synthesis",
            key="use_synthesis",
            type="primary",
            on_click=state.change,
            kwargs={"method": "synthesis", "tau_c_inner": None, "tau_c_outer": None},
        )
