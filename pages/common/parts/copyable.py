"""A text with a button that copies it. st.code does this too, and loads 0.6 MB of syntax colours to show plain text."""

from pathlib import Path

import streamlit as st

from pages.common.words import words

HERE = Path(__file__).parent
_component = st.components.v2.component(
    "simc_copyable",
    html='<div class="copyable"><pre tabindex="0"></pre><button type="button">Copy</button></div>',
    css=(HERE / "copyable.css").read_text(encoding="utf-8"),
    js=(HERE / "copyable.js").read_text(encoding="utf-8"),
)


def copyable(text: str, key: str) -> None:
    """Show a text that can be copied.

    Parameters
    ----------
    text : str
        Any text, shown as it is.
    key : str
        Name of the widget, its own on the page.
    """
    _component(key=key, data={"text": text, "copy": words("Copy"), "copied": words("Copied")})
