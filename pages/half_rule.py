"""The plant reduced to a model that SIMC has a rule for, told line by line, and whether the model is good enough."""

import streamlit as st

from pages.common.half_rule import view as reduction_view
from pages.common.parts.refusals import explain_refusal
from pages.common.session import state
from pages.common.shell import header
from pages.common.studies.single import study
from pages.common.words import words
from simc_core.studies.tuned import reduced

header.show("half_rule")
with explain_refusal():
    with st.container(key="stack_half_rule"):
        told, judged = st.columns(2, gap="medium")
    with told:
        reduction_view.choices()
        plant, tuning = state.plant(), state.tuning()
        with st.spinner(words("Reducing the plant")):
            reduction = reduced(plant, tuning.order, tuning.h, tuning.rules, tuning.tau_F)
        reduction_view.story(reduction)
    with judged:
        reduction_view.budget(reduction)
        reduction_view.candidates(reduction)
        with explain_refusal():  # a model may have no controller; its story is told all the same
            reduction_view.comparison(study(plant, tuning))
