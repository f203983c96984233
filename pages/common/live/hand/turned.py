"""Where knobs of the hand, or a point of a plane, have been left: shown again as they are, and heard when they move."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import streamlit as st

from pages.common.live import components
from pages.common.live.hand import table
from pages.common.live.kit.held import Held
from pages.common.live.tuning.table import grid_around
from pages.common.session import state
from pages.common.session.excitation import Excitation
from pages.common.studies.single import Study, study_of_settings
from pages.common.words import translated
from simc_core.controllers.forms import Controller
from simc_core.errors import SimcError
from simc_core.loops.loop import Loop
from simc_core.plants.plant import Plant


@dataclass(slots=True)
class Turned(Held):
    """Also where the knobs are."""

    values: dict[str, float] = field(default_factory=dict)

    def put(self, subject: table.Subject) -> None:
        """The knobs are offered anew."""
        self.subject, self.values, self.end = subject, table.values_of(subject), None

    def stands_on(self, plant: Plant, controller: Controller | None) -> bool:
        """Whether the knobs, where they are, belong to these, so that their ranges may stay. None: any controller."""
        if self.subject is None or self.subject.plant != plant:
            return False
        return controller is None or self.loop.controller == controller

    @property
    def loop(self) -> Loop:
        """With the knobs where they are."""
        return self.subject.at(self.values)


def shown(
    name: str,
    key: str,
    behind: Sequence[tuple[str, Study]],
    excitation: Excitation,
    heard: Callable[[Mapping], None],
    more: Mapping[str, object] | None = None,
) -> None:
    """The instrument of that name, with the knobs that are held under the key; exact where they are.

    behind: designs drawn behind, by name.   heard: of a release; what it refuses is told.   more: of the setup.
    """

    def take(release: Mapping) -> None:
        try:
            heard(release)
        except SimcError as error:
            st.toast(translated(str(error)))

    held = state.memory(key, Turned)
    subject = held.subject
    first = subject.at(table.values_of(subject))
    grid = grid_around(first, [first.L], excitation, held.end)
    held.end = float(grid.t[-1])
    setup = table.setup_name(subject, grid, behind, more)
    message = held.message(
        name,
        setup,
        lambda: table.setup(subject, grid, study_of_settings(first.plant, first.controller), behind, setup, more),
    )
    answers = components.show(name, key, message, take)
    sheet = state.design_now().sheet
    exact = table.exact(subject, grid, held.values, setup, answers, sheet, name)
    components.message(key=f"{key}_exact", data=exact)


def moved(key: str, release: Mapping, mine: bool) -> None:
    """The knobs have come to rest. mine: what they turn becomes my settings. Raises InvalidParameter."""
    held = state.memory(key, Turned)
    values = table.allowed(held.subject, release.get("values"))
    loop = held.subject.at(values)
    held.values = values
    if mine:
        state.change(own=loop.controller, controller="own")
