"""PI settings as a point in their plane: dragged, it takes the responses along; released, it becomes my settings."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import streamlit as st

from pages.common.live import components
from pages.common.live.hand import table
from pages.common.live.hand.instrument import Turned
from pages.common.live.tuning.table import grid_around
from pages.common.session import state
from pages.common.session.excitation import Excitation
from pages.common.studies.single import Study, study_of_settings
from simc_core.controllers.forms import IdealPid
from simc_core.errors import SimcError
from simc_core.plants.plant import Plant

KEY = "live_plane"


@dataclass(frozen=True, slots=True)
class Ground:
    """What the point stands on.

    plane: what is drawn there, as panel.js has it.   Kc, tau_I: limits of the sizes.   mine: whether this is the plant
    of the design, so that a release becomes its settings; else the point is a question, and nobody's.
    """

    plant: Plant
    controller: IdealPid
    mine: bool
    Kc: tuple[float, float]
    tau_I: tuple[float, float]
    plane: Mapping[str, object]


def plane_instrument(
    ground: Ground, behind: list[tuple[str, Study]], excitation: Excitation, picked: Callable[[str], None]
) -> None:
    """The plane with its point, and the responses beside it. behind: designs that are drawn behind, by name.

    picked: hears of a rule that was clicked.
    """
    held = state.memory(KEY, Turned)
    if not _stands_on(held, ground):
        held.subject = table.Subject(
            ground.plant, ground.controller, True, (("Kc", *ground.Kc), ("tau_I", *ground.tau_I))
        )
        held.values = table.values_of(held.subject)
        held.end = None
    subject = held.subject
    first = subject.at(table.values_of(subject))
    grid = grid_around(first, [first.L], excitation, held.end)
    held.end = float(grid.t[-1])
    more = {"plane": ground.plane, "moves_settings": ground.mine}
    name = table.setup_name(subject, grid, behind, more)
    message = held.message(
        "plane",
        name,
        lambda: table.setup(subject, grid, study_of_settings(first.plant, first.controller), behind, name, more),
    )
    answers = components.show("plane", KEY, message, lambda release: _take(release, ground.mine, picked))
    components.message(
        key=f"{KEY}_exact",
        data=table.exact(subject, grid, held.values, name, answers, state.design_now().sheet, "plane"),
    )


def _stands_on(held: Turned, ground: Ground) -> bool:
    """Whether the point, where it is, belongs here, so that its range may stay."""
    if held.subject is None or held.subject.plant != ground.plant:
        return False
    return not ground.mine or held.subject.at(held.values).controller == ground.controller


def _take(release: Mapping, mine: bool, picked: Callable[[str], None]) -> None:
    """The point has come to rest, or a rule was clicked."""
    held = state.memory(KEY, Turned)
    try:
        if "pick" in release:
            picked(str(release["pick"]))
            return
        values = table.allowed(held.subject, release["values"])
        loop = held.subject.at(values)
    except SimcError as error:
        st.toast(str(error))
        return
    held.values = values
    if mine:
        state.change(own=loop.controller, controller="own")
