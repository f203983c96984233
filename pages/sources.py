"""The publications behind the keys in brackets: full reference, what of each is in the program, its misprints."""

import streamlit as st

from pages.common.shell import header

header.show("sources")
st.markdown("#### Sources")
