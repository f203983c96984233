"""Entry point: `streamlit run app.py`.

The main script is the router, which lies outside the folder that holds pages/. Otherwise Streamlit would
serve the files in pages/ on its own when the first request of a fresh process is a deep link.
"""

import os
from pathlib import Path

import streamlit as st

from server import middleware

# Before numpy is loaded: with many sessions, threads of the linear algebra only wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

app = st.App(Path(__file__).parent / "pages" / "common" / "shell" / "router.py", middleware=middleware())
