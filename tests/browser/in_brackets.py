"""The app with a second language, in brackets, for `streamlit run`: see tests/pages/wrapped.py."""

import sys
from pathlib import Path

import streamlit as st

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from pages.common.words import catalogues  # noqa: E402
from server import middleware  # noqa: E402
from tests.pages.wrapped import BRACKETS, Brackets  # noqa: E402

catalogues.OFFERED[BRACKETS] = "in brackets"
catalogues._read = lambda language: Brackets()
app = st.App(ROOT / "pages" / "common" / "shell" / "router.py", middleware=middleware())
