"""Two loops, one inside the other: design both, see what the inner one is good for."""

import streamlit as st

from pages.common import live
from pages.common.cascade import guards as cascade_guards
from pages.common.cascade import widgets as cascade_widgets
from pages.common.cascade.diagram import diagram
from pages.common.cascade.pairs import pairs_view
from pages.common.cascade.panels import frequencies, panels
from pages.common.cascade.readout import readout, sentence
from pages.common.cascade.settings import settings
from pages.common.cascade.windup import windup_view
from pages.common.parts.refusals import explain_refusal
from pages.common.parts.tabs import open_tab, tabs
from pages.common.shell import header
from pages.common.studies.cascade import CascadeStudy, attempt
from pages.common.words import words
from simc_core.wording import said


def instrument(present: CascadeStudy) -> None:
    """Sliders, figures and panels that follow the hand."""
    live.cascade_instrument(present.cascade)
    if present.sound:
        with st.container(key="told"):
            st.caption(sentence(present))


def figures(present: CascadeStudy) -> None:
    """The strip and the field of four."""
    readout(present)
    panels(present)


VIEWS = {
    said("Live"): instrument,
    said("Figures"): figures,
    said("Bode"): frequencies,
    said("Settings"): settings,
    said("Windup"): windup_view,
}
NAMES = (*VIEWS, said("Published pairs"))

design = header.show("cascade")
with st.spinner(words("Tuning both loops")):
    present, refusal = attempt(design.cascade)
picture = st.container()
with st.container(key="cascade"):
    controls, view = st.columns([4, 11], gap="medium")
with controls, st.container(key="decided"):
    cascade_widgets.blocks()
    cascade_widgets.method()
    cascade_widgets.loops(present, slider=open_tab(NAMES, "cascade_views") != "Live")
    form = cascade_widgets.form(present)
    if present is not None:
        cascade_guards.show(present)
with picture:
    if present is not None:
        diagram(present, form)
with view:
    if refusal is not None:
        with explain_refusal():
            raise refusal
        cascade_guards.offer_synthesis(refusal)
    *views, pairs = tabs(NAMES, "cascade_views")  # only the open one is made
    for tab, show in zip(views, VIEWS.values(), strict=True):
        if tab.open and present is not None:
            with tab, cascade_guards.viewed():
                show(present)
    if pairs.open:
        with pairs:
            pairs_view()
