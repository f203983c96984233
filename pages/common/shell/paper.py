"""A page on paper: its link and the day as text, figures as wide as the sheet; styles are in style.css."""

from datetime import date
from pathlib import Path

import streamlit as st

from pages.common.session import state

_fit = st.components.v2.component(
    "simc_print", html="<span></span>", js=Path(__file__).with_name("print.js").read_text(encoding="utf-8")
)


def paper() -> None:
    """What only a printed page shows."""
    with st.container(key="on_paper"):
        st.text(f"{state.address()}\n{date.today():%Y-%m-%d}")
        _fit(key="fit_paper", data={})
