"""What is typed in one way of entering a plant, before it is a plant.

A draft that is a plant becomes the plant at once; one that is not stays as typed with the reason below it, and the
last good plant stays too. A plant that comes from elsewhere (another way, an example, a link, a file) replaces it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.parts.number_field import number_field
from pages.common.parts.refusals import unread
from pages.common.parts.symbols import symbols
from pages.common.session import state
from pages.common.words import words
from simc_core import Plant, checks, read_back
from simc_core.errors import SimcError


@dataclass(slots=True)
class Draft:
    """read: from the fields to a plant.   plant: the last good one.   version: counts fresh fields."""

    plant: Plant
    fields: dict
    read: Callable[[dict], Plant]
    error: SimcError | None = None
    version: int = field(default=0)


def draft_of(name: str, way: str, start: Callable[[Plant], dict], read: Callable[[dict], Plant]) -> Draft:
    """The draft of this way for the plant called `name`, made anew if the plant has changed elsewhere."""
    plant = state.value(name)
    draft = state.memory(f"{name}_{way}", lambda: Draft(plant, start(plant), read))
    if draft.plant != plant:
        draft.plant, draft.fields, draft.error, draft.version = plant, start(plant), None, draft.version + 1
    return draft


def take(name: str, draft: Draft) -> None:
    """Callback: the fields have changed."""
    try:
        plant = draft.read(draft.fields)
    except SimcError as error:
        draft.error = error
    else:
        draft.plant, draft.error = plant, None
        state.change(**{name: plant})


def text_field(name: str, way: str, draft: Draft, part: str, label: str, **options) -> None:
    """A text that is part of the draft; it is read when typing pauses."""
    key = f"{name}_{way}_{part}"
    state.set_widget(key, draft.fields[part])
    st.text_input(label, key=key, live="400ms", on_change=_take_text, args=(name, draft, part, key), **options)


def gain_field(name: str, way: str, draft: Draft, **places: DeltaGenerator) -> None:
    """The gain k. places: place and under of the number field."""
    _number(name, way, draft, "k", words("Gain k"), checks.gain, places)


def dead_time_field(name: str, way: str, draft: Draft, **places: DeltaGenerator) -> None:
    """The dead time theta. places: place and under of the number field."""
    _number(name, way, draft, "theta", words("Dead time θ"), checks.optional_time, places)


def outcome(draft: Draft) -> None:
    """What was read, in words, so that a slip is seen at once; or what is wrong, and which plant stays in use."""
    understood = symbols(read_back(draft.plant))
    if draft.error is None:
        st.caption(words("Read: {understood}.", understood=understood))
        return
    unread(draft.error)
    st.caption(words("Until this can be read, the previous plant is used: {understood}.", understood=understood))


def _number(name: str, way: str, draft: Draft, part: str, label: str, check: Callable, places: dict) -> None:
    def use(value: float) -> None:
        draft.fields[part] = value
        take(name, draft)

    number_field(label, draft.fields[part], lambda value: check(label, value), use, f"{name}_{way}_{part}", **places)


def _take_text(name: str, draft: Draft, part: str, key: str) -> None:
    if state.overtaken(key):
        return
    draft.fields[part] = state.widget(key) or ""
    take(name, draft)
