"""The instrument of the tuning page: one slider, tau_c."""

from collections.abc import Mapping
from dataclasses import dataclass

import streamlit as st

from pages.common.live import components
from pages.common.live.kit.shared_tables import TABLES
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
    of = table.subject(plant, present, state.value("form"))
    kept = state.memory("live_table", lambda: _Kept(of))
    on = table.bench(of, present, kept.horizon if kept.of == of else None)
    name = table.name_of(of, on, pins)
    if kept.name != name:  # a release must not make the table again
        message = TABLES.get(name, lambda: table.table(of, on, pins, name))
        kept = _Kept(of, float(on.t[-1]), name, message)
        state.remember("live_table", kept)
    asked = components.tuning(key=KEY, data=kept.message, on_release_change=_released)
    components.answer_if_unheard(asked, state.memory("live_answers", int), _take)
    refusal, answers = state.memory("live_refusal", str), state.memory("live_answers", int)
    components.message(key=f"{KEY}_exact", data=table.exact(of, on, present, name, answers))
    if refusal:
        st.warning(refusal)


@dataclass(frozen=True, slots=True)
class _Kept:
    """The table the browser holds."""

    of: table.Subject
    horizon: float | None = None
    name: str = ""
    message: bytes = b""


def _released() -> None:
    """The hand has let go."""
    _take(state.widget(KEY)["release"])


def _take(release: Mapping) -> None:
    """tau_c, or the Ms that tau_c is wanted for."""
    state.remember("live_answers", int(release["n"]))
    state.remember("live_refusal", "")
    try:
        state.change(tau_c=release["tau_c"] if "tau_c" in release else _for_Ms(release["Ms"]))
    except InvalidParameter as error:
        state.remember("live_refusal", told(str(error)))


def _for_Ms(typed: str) -> float:
    """The smallest tau_c on the slider with Ms <= the number typed. Raises InvalidParameter where there is none."""
    limit = read_number("Ms", typed)
    of = state.memory("live_table", lambda: None).of
    low, high, *_ = table.bounds(of.model)
    return smallest(lambda tau_c: margins(of.loop(tau_c)).Ms, limit, low, high)
