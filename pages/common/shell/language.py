"""The choice of the language, in the sidebar, where there are several; and what the browser is told of it."""

from pathlib import Path

import streamlit as st

from pages.common.session import state
from pages.common.words import language, words
from pages.common.words.catalogues import OFFERED

TAGS = {"sr": "sr-Latn", "no": "nb"}  # as browsers and screen readers have them, where that says more

_tell = st.components.v2.component(
    "simc_language",
    html="<span></span>",
    js=Path(__file__).with_name("language.js").read_text(encoding="utf-8"),
)


def language_menu() -> None:
    """Another language for this session; the design and what is typed stay."""
    if len(OFFERED) < 2:
        return
    state.set_widget("lang", language())
    st.selectbox(words("Language"), list(OFFERED), format_func=OFFERED.get, key="lang", on_change=_take)
    _tell(key="lang_told", data={"language": TAGS.get(language(), language())})


def _take() -> None:
    chosen = state.widget("lang")
    if chosen in OFFERED and not state.overtaken("lang"):
        state.speak(chosen)
