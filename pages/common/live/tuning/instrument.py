"""The instrument of the tuning page: one slider, tau_c."""

from collections.abc import Mapping

import streamlit as st

from pages.common.live import components
from pages.common.live.kit.held import Held
from pages.common.live.tuning import table
from pages.common.parts.foreign_text import told
from pages.common.session import state
from pages.common.studies.single import Study
from simc_core.errors import InvalidParameter
from simc_core.numbers import read_number
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins import margins
from simc_core.studies.tau_table import smallest

KEY = "live"


def tuning_instrument(plant: Plant, studies: list[tuple[str, Study]]) -> None:
    """Slider, figures, panels and trade-off of the present design (first) with the pinned ones behind it."""
    present, pins = studies[0][1], studies[1:]
    held = state.memory(KEY, Held)
    subject = table.subject_of(plant, present, state.value("form"))
    grid = table.grid_of(subject, present, held.end_for(subject))
    held.subject, held.end = subject, float(grid.t[-1])
    name = table.table_name(subject, grid, pins)
    message = held.message("tuning", name, lambda: table.table(subject, grid, pins, name))
    answers = components.show(components.tuning, KEY, message, _take)
    components.message(
        key=f"{KEY}_exact",
        data=table.exact(subject, grid, present, name, answers, state.design_now().sheet),
    )
    if refusal := state.memory("live_refusal", str):
        st.warning(refusal)


def _take(release: Mapping) -> None:
    """tau_c, or the Ms that tau_c is wanted for."""
    state.remember("live_refusal", "")
    try:
        state.change(tau_c=release["tau_c"] if "tau_c" in release else _for_Ms(release["Ms"]))
    except InvalidParameter as error:
        state.remember("live_refusal", told(str(error)))


def _for_Ms(typed: str) -> float:
    """The smallest tau_c on the slider with Ms <= the number typed. Raises InvalidParameter where there is none."""
    limit = read_number("Ms", typed)
    subject = state.memory(KEY, Held).subject
    low, high, *_ = table.bounds(subject.model)
    return smallest(lambda tau_c: margins(subject.loop(tau_c)).Ms, limit, low, high)
