"""The plant reduced to a model that SIMC has a rule for, told line by line, and whether the model is good enough."""

import streamlit as st

from pages.common import guards, header, reduction_view
from pages.common.study import study

design = header.show("half_rule")
with guards.spoken():
    told, judged = st.columns([1, 1], gap="medium")
    with told:
        reduction_view.choices()
        present = study(design.plant, design.tuning)
        reduction_view.story(present.reduction)
    with judged:
        reduction_view.budget(present.reduction)
        reduction_view.candidates(present.reduction)
        reduction_view.comparison(present)
