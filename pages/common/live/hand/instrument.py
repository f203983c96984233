"""Settings and plants that are dragged by hand: knobs, figures and panels; exact on release."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import streamlit as st

from pages.common.live import components
from pages.common.live.hand import table
from pages.common.session import state
from pages.common.studies.single import Study, study_of_settings
from simc_core.errors import SimcError

KEY = "live_hand"


@dataclass(slots=True)
class _Kept:
    """What the browser holds, and where its knobs are."""

    of: table.Subject | None = None
    name: str = ""
    message: bytes = b""
    values: dict[str, float] = field(default_factory=dict)


def hand_instrument(present: Study, behind: list[tuple[str, Study]], settings: bool) -> Study:
    """Knobs of the controller's settings (settings) or of the plant, its controller kept.

    behind: designs that are drawn behind, by name. Returns the study of where the knobs are.
    Settings that are dragged become my settings; a plant that is dragged is a question and changes nothing.
    """
    kept = state.memory(f"{KEY}_{settings}", _Kept)
    controller = present.controller
    if kept.of is None or kept.of.plant != present.loop.plant or not _turned_into(kept, controller):
        kept.of = table.Subject(present.loop.plant, controller, settings)
        kept.values = table.values_of(kept.of)
    of = kept.of
    on = table.bench(of, study_of_settings(of.plant, of.controller))
    name = table.name_of(of, on, behind)
    if kept.name != name:
        kept.name, kept.message = name, table.setup(of, on, present, behind, name)
    asked = components.hand(key=f"{KEY}_{settings}", data=kept.message, on_release_change=_released, args=(settings,))
    components.answer_if_unheard(asked, state.memory("live_answers", int), lambda release: _take(release, settings))
    answers = state.memory("live_answers", int)
    components.message(key=f"{KEY}_exact", data=table.exact(of, on, kept.values, name, answers))
    loop = of.at(kept.values)
    return study_of_settings(loop.plant, loop.controller)


def _turned_into(kept: _Kept, controller) -> bool:
    """Whether the controller is the one that the knobs make, so that their ranges may stay."""
    try:
        return kept.of.at(kept.values).controller == controller
    except SimcError:
        return False


def put_back() -> None:
    """The plant as it is."""
    kept = state.memory(f"{KEY}_False", _Kept)
    if kept.of is not None:
        kept.values = table.values_of(kept.of)


def _released(settings: bool) -> None:
    """The hand has let go."""
    _take(state.widget(f"{KEY}_{settings}")["release"], settings)


def _take(release: Mapping, settings: bool) -> None:
    state.remember("live_answers", int(release["n"]))
    kept = state.memory(f"{KEY}_{settings}", _Kept)
    try:
        values = table.allowed(kept.of, release["values"])
        loop = kept.of.at(values)
    except SimcError as error:
        st.toast(str(error))
        return
    kept.values = values
    if settings:
        state.change(own=loop.controller)
        state.change(controller="own")
