"""The instrument of the cascade page: one slider for each loop."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import streamlit as st

from pages.common.live import components
from pages.common.live.cascade import table as cascade_table
from pages.common.live.cascade.table import LOOPS
from pages.common.live.kit.shared_tables import TABLES
from pages.common.session import state
from pages.common.session.design import Cascade
from pages.common.studies.cascade import study

KEY = "live_cascade"


@dataclass(slots=True)
class _Kept:
    """What the browser holds: the end of the time axis, and messages by the name of what they tell."""

    rest: Cascade | None = None
    end: float | None = None
    messages: dict[str, tuple[str, bytes]] = field(default_factory=dict)

    def made(self, what: str, name: str, make: Callable[[], bytes]) -> bytes:
        """The message of this name; made where the one that is kept has another."""
        if self.messages.get(what, ("",))[0] != name:
            self.messages[what] = (name, TABLES.get(f"{what} {name}", make))
        return self.messages[what][1]


def cascade_instrument(cascade: Cascade) -> None:
    """Sliders, figures and panels of the cascade. Exact numbers go first, tables follow: nobody waits for a table.

    Raises SimcError, in words, where there is no design.
    """
    present = study(cascade)
    of = cascade_table.subject(present)
    kept = state.memory(KEY, _Kept)
    on = cascade_table.bench(present, kept.end if kept.rest == of.rest else None)
    kept.rest, kept.end = of.rest, float(on.t[-1])
    setup = kept.made("setup", cascade_table.setup_name(of, on), lambda: cascade_table.setup(of, on))
    with st.container(gap=None):
        answers = state.memory(f"{KEY}_answers", int)
        asked = components.cascade(key=KEY, data=setup, on_release_change=_released)
        components.answer_if_unheard(asked, answers, _take)
        components.message(key=f"{KEY}_exact", data=cascade_table.exact(of, on, present, answers))
        for loop in LOOPS:
            name = cascade_table.table_name(of, on, loop)
            table = kept.made(loop, name, lambda loop=loop: cascade_table.table(of, on, loop, _pause))
            components.message(key=f"{KEY}_{loop}", data=table)


def _pause() -> None:
    """Reading the session lets Streamlit end this run where the user has already moved on."""
    state.widget(KEY)


def _released() -> None:
    """The hand has let go."""
    _take(state.widget(KEY)["release"])


def _take(release: Mapping) -> None:
    """The speed of one loop. What the other one was while it moved, it stays."""
    state.remember(f"{KEY}_answers", int(release["n"]))
    of = cascade_table.subject(study(state.cascade()))
    loop = next(each for each in LOOPS if each in release)
    changes = {f"tau_c_{loop}": release[loop], f"Ms_{loop}": None}
    if loop == "inner" and not of.follows:
        changes |= {"tau_c_outer": of.outer, "Ms_outer": None}
    state.change(**changes)
