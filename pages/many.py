"""Many loops: a list in, new settings, what they bring and a report out, the most urgent loop first."""

import streamlit as st

from pages.common.many_loops import results, source
from pages.common.shell import header

header.show("many")
with st.container(key="stack_many"):
    controls, shown = st.columns([4, 11], gap="medium")
with controls:
    work = source.choose()
    if work is not None:
        source.understood(work)
with shown:
    if work is None:
        source.empty()
    else:
        results.progress(work)
        results.browse(work)
