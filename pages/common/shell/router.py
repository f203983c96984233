"""The main script: declares the pages and runs the one that was asked for."""

from pathlib import Path

import streamlit as st

from pages.common.session import state
from pages.common.shell import header
from pages.common.words import translated

PAGES = Path(__file__).parents[2]

state.begin_language()
pages = {
    name: st.Page(PAGES / f"{name}.py", title=header.title_of(name), url_path=name, default=name == "home")
    for name in header.TITLES
}
current = st.navigation(
    {translated(group): [pages[name] for name in titles] for group, titles in header.GROUPS.items()}
)
state.offer_pages(pages)
current.run()
state.run_ended()
