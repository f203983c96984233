"""A button that saves an SVG as PNG. The browser does it: it has the letters, and no program has to be installed."""

from pathlib import Path

import streamlit as st

from pages.common.words import words

HERE = Path(__file__).parent
_component = st.components.v2.component(
    "simc_as_png",
    html='<button type="button"></button>',
    css=(HERE / "as_png.css").read_text(encoding="utf-8"),
    js=(HERE / "as_png.js").read_text(encoding="utf-8"),
)


def as_png(svg: str, name: str, key: str) -> None:
    """The button.

    Parameters
    ----------
    svg : str
        A picture with width and height.
    name : str
        Of the file.
    key : str
        Of the widget.
    """
    _component(key=key, data={"svg": svg, "file": name, "label": words("Figures as PNG")}, width="content")
