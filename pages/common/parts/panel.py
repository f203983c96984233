"""Figures on a page: one, or a field of panels two by two, on a narrow screen the chosen one alone."""

from collections.abc import Callable
from dataclasses import dataclass

import streamlit as st

from pages.common.parts.figure_words import in_words
from pages.common.parts.large import large
from pages.common.parts.ready_figure import ReadyFigure
from pages.common.parts.told_figure import told_figure
from pages.common.parts.units import axes_named
from pages.common.session import state
from pages.common.session.lecture import lecturing
from pages.common.words import words
from simc_core.figures import Figure, config


@dataclass(frozen=True, slots=True)
class Panel:
    """A figure of the field. key: for styles and the file it is saved as; label: on the switch of a narrow screen."""

    key: str
    label: str
    alt: str
    figure: Figure


def field(found: tuple[Panel, ...]) -> None:
    """Panels two by two; on a narrow screen the one that is chosen."""
    labels = [panel.label for panel in found]
    chosen = st.segmented_control(
        words("Panel"),
        labels,
        default=labels[0],
        required=True,
        key="panel",
        label_visibility="collapsed",
        width="stretch",
    )
    st.html(_style([panel.key for panel in found], labels.index(chosen)))
    with st.container(key="panels"):
        for panel in found:
            with st.container(key=f"panel_{panel.key}"):
                show(panel.figure, panel.key, panel.alt)


def show(figure: Figure, key: str, alt: str, picked: Callable[[str], None] | None = None) -> None:
    """A figure with hover, zoom and SVG export.   picked: called with the key of the widget when a point is clicked.

    alt: what it shows, to which the numbers are added for those who do not see it.
    """
    name = f"figure_{key}"
    pick = {"on_select": lambda: picked(name), "selection_mode": "points"} if picked else {}
    named = told_figure(axes_named(figure, state.design_now().sheet))
    if lecturing():
        named = large(named)
    st.plotly_chart(ReadyFigure(named), key=name, config=config(key), alt=in_words(alt, named), **pick)


def _style(keys: list[str], chosen: int) -> str:
    """Two by two on a wide screen; on a narrow one the panel chosen alone, and the choice in sight."""
    hidden = ", ".join(f".st-key-panel_{key}" for i, key in enumerate(keys) if i != chosen)
    return f"<style>@container page (max-width: 640px) {{{hidden} {{display: none}}}}</style>"
