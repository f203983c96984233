"""Tuning rules on one plant, as published or at equal robustness, beside the best that is possible."""

import streamlit as st

from pages.common.parts.refusals import explain_refusal
from pages.common.rules import chosen, view
from pages.common.rules.table import question_of
from pages.common.session import state
from pages.common.shell import header
from pages.common.studies.single import attempt, present_study
from pages.common.words import words

design = header.show("rules")
view.open_asked(state.asked_view())
with explain_refusal():
    view.ask(design)
    design = state.design_now()
    question = question_of(design)
    present = attempt(lambda: present_study(design))[0] if question.plant == design.plant else None
    rows = view.table(question)
    row = view.chosen_of(rows, design)
    which = view.which_picture()
    if which == view.PICTURES[1]:
        view.plane(question, rows, row, present, design)
    with st.container(key="stack_rules"):
        left, right = st.columns(2, gap="medium")
    if which == view.PICTURES[0]:
        with left:
            view.trade_off(question, rows, row, present)
    with right if which == view.PICTURES[0] else left:
        if row is None:
            st.info(words("No rule has settings for this plant."))
        else:
            chosen.word(row, question)
            chosen.actions(row, question, design)
    if row is not None:
        with right:
            chosen.responses(row, question, design, present)
