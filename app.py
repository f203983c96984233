"""Entry point: `streamlit run app.py`.

The main script is the router, which lies outside the folder that holds pages/. Otherwise Streamlit would
serve the files in pages/ on its own when the first request of a fresh process is a deep link.
"""

from pathlib import Path

import streamlit as st

app = st.App(Path(__file__).parent / "pages" / "common" / "router.py")
