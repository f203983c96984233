"""The main script: declares the pages and runs the one that was asked for."""

from pathlib import Path

import streamlit as st

from pages.common.session import state
from pages.common.shell import header

PAGES = Path(__file__).parents[2]

pages = {
    name: st.Page(PAGES / f"{name}.py", title=title, url_path=name, default=name == "home")
    for name, title in header.TITLES.items()
}
current = st.navigation({group: [pages[name] for name in titles] for group, titles in header.GROUPS.items()})
state.offer_pages(pages)
current.run()
state.run_ended()
