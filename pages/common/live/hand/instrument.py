"""Settings and plants that are dragged by hand: knobs, figures and panels; exact on release."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import streamlit as st

from pages.common.live import components
from pages.common.live.hand import table
from pages.common.live.kit.held import Held
from pages.common.live.tuning.table import grid_around
from pages.common.session import state
from pages.common.studies.single import Study, study_of_settings
from simc_core.controllers.forms import Controller
from simc_core.errors import SimcError

KEYS = {True: "live_settings", False: "live_plant"}


@dataclass(slots=True)
class Turned(Held):
    """Also where the knobs are."""

    values: dict[str, float] = field(default_factory=dict)


def hand_instrument(present: Study, behind: list[tuple[str, Study]], settings: bool) -> Study:
    """Knobs of the controller's settings, or of the plant with its controller kept.

    behind: designs that are drawn behind, by name. Returns the study of where the knobs are.
    Settings that are dragged become my settings; a plant that is dragged is a question and changes nothing.
    """
    key = KEYS[settings]
    held = state.memory(key, Turned)
    if not _stands_for(held, present, settings):
        held.subject = table.Subject(present.loop.plant, present.controller, settings)
        held.values = table.values_of(held.subject)
        held.end = None
    subject = held.subject
    first = subject.at(table.values_of(subject))
    design = state.design_now()
    grid = grid_around(first, [first.L], design.excitation, held.end)
    held.end = float(grid.t[-1])
    name = table.setup_name(subject, grid, behind)
    message = held.message("hand", name, lambda: table.setup(subject, grid, present, behind, name))
    answers = components.show("hand", key, message, lambda release: _take(release, settings))
    components.message(
        key=f"{key}_exact",
        data=table.exact(subject, grid, held.values, name, answers, design.sheet),
    )
    loop = subject.at(held.values)
    return study_of_settings(loop.plant, loop.controller)


def _stands_for(held: Turned, present: Study, settings: bool) -> bool:
    """Whether the knobs, where they are, belong to this design, so that their ranges may stay."""
    if held.subject is None or held.subject.plant != present.loop.plant:
        return False
    controller: Controller = held.subject.at(held.values).controller if settings else held.subject.controller
    return controller == present.controller


def put_back() -> None:
    """The plant as it is."""
    held = state.memory(KEYS[False], Turned)
    if held.subject is not None:
        held.values = table.values_of(held.subject)


def _take(release: Mapping, settings: bool) -> None:
    """The knobs have come to rest."""
    held = state.memory(KEYS[settings], Turned)
    try:
        values = table.allowed(held.subject, release["values"])
        loop = held.subject.at(values)
    except SimcError as error:
        st.toast(str(error))
        return
    held.values = values
    if settings:
        state.change(own=loop.controller, controller="own")
