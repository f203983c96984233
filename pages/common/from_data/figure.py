"""A figure of a record: axes in its units, and numbers in words for those who do not see it."""

from typing import Any

import streamlit as st

from pages.common.parts.figure_words import in_words
from pages.common.parts.ready_figure import ReadyFigure
from pages.common.parts.told_figure import told_figure
from pages.common.parts.units import filled
from simc_core import Trend
from simc_core.figures import config
from simc_core.figures.palette import Figure

LONGEST_UNIT = 16  # characters on an axis


def show(found: Figure, trend: Trend, key: str, name: str, alt: str, **pick: Any) -> None:
    """Draw it.   key: of the widget; name: of the file it is saved as; alt: what it shows; pick: what a drag does."""
    found = told_figure(in_units(found, trend))
    st.plotly_chart(ReadyFigure(found), key=key, config=config(name), alt=in_words(alt, found), **pick)


def in_units(found: Figure, trend: Trend) -> Figure:
    """Axes with the units of the record, which are foreign text: plain signs alone."""
    units = {"time unit": trend.units.get("t"), "unit of y": trend.units.get("y"), "unit of u": trend.units.get("u")}
    plain = {
        place: "".join(c for c in unit if c.isalnum() or c in "%°/·⁻²³ ()")[:LONGEST_UNIT]
        for place, unit in units.items()
        if unit
    }
    for name, axis in found["layout"].items():
        if name[1:5] == "axis":
            axis["title"]["text"] = filled(axis["title"]["text"], plain)
    return found
