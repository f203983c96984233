"""Tabs whose names are translated: the open one stays open in another language."""

from collections.abc import Sequence

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.session import state
from pages.common.words import translated


def tabs(names: Sequence[str], key: str) -> Sequence[DeltaGenerator]:
    """st.tabs under these names, of which only the open one is to be made."""
    labels = [translated(name) for name in names]
    if state.widget(key) not in (None, *labels):
        state.set_widget(key, translated(open_tab(names, key)))
    made = st.tabs(labels, key=key, on_change="rerun")
    state.make_last(f"tab_{key}", open_tab(names, key))
    return made


def open_tab(names: Sequence[str], key: str) -> str:
    """The name of the open one in English, before it is made too."""
    shown = state.widget(key)
    found = (name for name in names if shown in (name, translated(name)))
    return next(found, None) or state.lasting(f"tab_{key}", lambda: names[0])
