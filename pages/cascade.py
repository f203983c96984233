"""Two loops, one inside the other: design both, see what the inner one is good for."""

import streamlit as st

from pages.common import cascade_guards, cascade_widgets, guards, header
from pages.common.cascade_diagram import diagram
from pages.common.cascade_pairs import pairs_view
from pages.common.cascade_panels import frequencies, panels
from pages.common.cascade_readout import readout
from pages.common.cascade_settings import settings
from pages.common.cascade_study import attempt
from pages.common.cascade_windup import windup_view

VIEWS = ("Figures", "Bode", "Settings", "Windup", "Paper's pairs")

design = header.show("cascade")
present, refusal = attempt(design.cascade)
picture = st.container()
with st.container(key="cascade"):
    controls, view = st.columns([4, 11], gap="medium")
with controls:
    cascade_widgets.blocks()
    cascade_widgets.method()
    cascade_widgets.loops(present)
    form = cascade_widgets.form(present)
    if present is not None:
        cascade_guards.show(present)
with picture:
    if present is not None:
        diagram(present, form)
with view:
    if refusal is not None:
        with guards.spoken():
            raise refusal
        cascade_guards.offer_synthesis()
    curves, bode, numbers, limits, pairs = st.tabs(
        VIEWS, key="cascade_views", on_change="rerun"
    )  # only the open one is made
    if pairs.open:
        with pairs:
            pairs_view()
    if present is not None:
        if curves.open:
            with curves:
                readout(present)
                panels(present)
        if bode.open:
            with bode:
                frequencies(present)
        if numbers.open:
            with numbers:
                settings(present)
        if limits.open:
            with limits, guards.spoken():
                windup_view(present)
