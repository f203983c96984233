"""The instrument of the cascade page: one slider for each loop."""

from collections.abc import Mapping

import streamlit as st

from pages.common.live import components
from pages.common.live.cascade import table as cascade_table
from pages.common.live.cascade.table import LOOPS
from pages.common.live.kit.held import Held
from pages.common.session import state
from pages.common.session.cascade import Cascade
from pages.common.studies.cascade import study
from pages.common.words import translated
from simc_core.wording import said

KEY = "live_cascade"
SLOW = {
    ("inner",): said(
        "Curves come when the slider of the inner loop is released: this cascade takes too long to compute for them "
        "to follow it."
    ),
    ("outer",): said(
        "Curves come when the slider of the outer loop is released: this cascade takes too long to compute for them "
        "to follow it."
    ),
    ("inner", "outer"): said(
        "Curves come when the slider of the inner or the outer loop is released: this cascade takes too long to "
        "compute for them to follow it."
    ),
}


def cascade_instrument(cascade: Cascade) -> None:
    """Sliders, figures and panels of the cascade. Exact numbers go first, tables follow: nobody waits for a table.

    Raises SimcError, in words, where there is no design.
    """
    present = study(cascade)
    held = state.memory(KEY, Held)
    subject = cascade_table.subject_of(present)
    grid = cascade_table.grid_of(present, held.end_for(subject.rest))
    held.subject, held.end = subject.rest, float(grid.t[-1])
    name = cascade_table.setup_name(subject, grid)
    setup = held.message("setup", name, lambda: cascade_table.setup(subject, grid))
    with st.container(gap=None):
        answers = components.show("cascade", KEY, setup, _take)
        components.message(
            key=f"{KEY}_exact",
            data=cascade_table.exact(subject, grid, present, answers, state.design_now().sheet),
        )
        slow = []
        for loop in LOOPS:
            name = cascade_table.table_name(subject, grid, loop)
            table = held.message(loop, name, lambda loop=loop: cascade_table.table(subject, grid, loop, _pause))
            if table:
                components.message(key=f"{KEY}_{loop}", data=table)
            else:
                slow.append(loop)
        if slow:
            st.caption(translated(SLOW[tuple(slow)]))


def _pause() -> None:
    """Reading the session lets Streamlit end this run where the user has already moved on."""
    state.widget(KEY)


def _take(release: Mapping) -> None:
    """The speed of one loop. What the other one was while it moved, it stays."""
    subject = cascade_table.subject_of(study(state.cascade()))
    loop = next(each for each in LOOPS if each in release)
    changes = {f"tau_c_{loop}": release[loop], f"Ms_{loop}": None}
    if loop == "inner" and not subject.follows:
        changes |= {"tau_c_outer": subject.outer, "Ms_outer": None}
    state.change(**changes)
