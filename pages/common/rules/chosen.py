"""The rule that was picked: a word on it, its responses beside the optimum, and what can be done with it."""

import streamlit as st

from pages.common.parts.panel import show
from pages.common.parts.refusals import explain_refusal
from pages.common.parts.sources import linked
from pages.common.parts.symbols import sentence
from pages.common.rules import remarks
from pages.common.rules.curves import PRESENT_NAME
from pages.common.rules.table import Question, best_beside, title_of
from pages.common.session import state
from pages.common.session.compared import OPTIMAL
from pages.common.session.design import MOST_PINS, Design
from pages.common.session.excitation import Excitation
from pages.common.shell import header
from pages.common.studies.single import Study, study_of_settings, time_responses
from pages.common.words import translated, typeset, words
from simc_core import RULES
from simc_core.controllers.forms import Controller
from simc_core.figures import input_figure, output_figure
from simc_core.notation import latex
from simc_core.studies.comparison import Row
from simc_core.wording import said

HEIGHT = 190  # px


def word(row: Row, question: Question) -> None:
    """Name and source, settings, what the rule was made for, and how it does here."""
    rule = RULES.get(row.key)
    title = f"**{translated(title_of(row))}**"
    st.markdown(f"{title}, {linked(translated(rule.source))}" if rule else title)
    if row.controller is None:
        st.info(sentence(row.refusal))
    else:
        law = typeset(latex(row.controller))
        st.markdown(
            words("$C(s) = {law}$, direct action", law=law)
            if row.controller.action == "direct"
            else words("$C(s) = {law}$, reverse action", law=law)
        )
    best = best_beside(question, row.kind, row.Mst) if row.Mst > 1 else None
    told = [
        translated(remarks.MADE_FOR[row.key]),
        remarks.here(row, best, question),
        remarks.robustness(row, question),
    ]
    if rule and not row.in_domain and row.controller is not None:
        told.append(words("Outside its domain: {domain}.", domain=sentence(rule.domain)))
    told.append(translated(remarks.IN_CIRCULATION.get(row.key, "")))
    st.markdown(" ".join(filter(None, told)))


def responses(row: Row, question: Question, design: Design, present: Study | None) -> None:
    """y and u of the rule, the optimum with the same peak, and my design."""
    if row.controller is None:
        return
    found = [(title_of(row), study_of_settings(question.plant, row.controller))]
    best = best_beside(question, row.kind, row.Mst) if row.Mst > 1 and row.key != OPTIMAL else None
    if best:
        found.append((said("best {kind}", kind=row.kind), study_of_settings(question.plant, best.controller)))
    if present:
        found.append((PRESENT_NAME, present))
    excitation = design.excitation if present else Excitation()
    names, records = zip(*found, strict=True)
    times = list(zip(names, time_responses(list(records), excitation), strict=True))
    stable = records[0].stable
    show(
        output_figure(times, HEIGHT, stable), "rules_y", words("Output y of the rule, of the optimum and of my design")
    )
    show(input_figure(times, HEIGHT, stable), "rules_u", words("Input u of the rule, of the optimum and of my design"))


def actions(row: Row, question: Question, design: Design) -> None:
    """Pin the rule to the tuning page, or take it over as the controller."""
    if row.controller is None:
        return
    own_plant = question.plant == design.plant
    full = len(design.pins) >= MOST_PINS
    pin, take = st.columns(2)
    pin.button(
        words("Pin") if not full else words("Pin ({n} of {most} used)", n=len(design.pins), most=MOST_PINS),
        key="rules_pin",
        width="stretch",
        disabled=full or not own_plant or row.controller in design.pins,
        help=words("Set it aside on the tuning page, to compare it with your design there."),
        on_click=lambda: state.change(pins=(*design.pins, row.controller)),
    )
    if take.button(
        words("Take over") if own_plant else words("Take over with this plant"),
        key="rules_take",
        width="stretch",
        type="primary",
        help=words("These settings become my settings on the tuning page.")
        if own_plant
        else words("These settings become my settings on the tuning page. The plant begins another loop."),
    ):
        with explain_refusal():
            _take(row.controller, question, own_plant)
            header.go("tuning")


def _take(controller: Controller, question: Question, own_plant: bool) -> None:
    if not own_plant:
        state.begin_loop(question.plant, mine=True)
    state.change(own=controller, controller="own")
