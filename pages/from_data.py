"""From a file or a paste to a model one can trust, and on to its tuning."""

import streamlit as st

from pages.common.from_data import (
    auto_view,
    experiments,
    loop_view,
    models_view,
    points_view,
    record_view,
    source,
    tuning_view,
    understood,
)
from pages.common.from_data.graphical_view import graphical
from pages.common.parts.foreign_text import told
from pages.common.parts.symbols import sentence
from pages.common.parts.tabs import tabs
from pages.common.shell import header
from pages.common.words import words
from simc_core.wording import said

WAYS = (said("How fast may the loop be?"), said("Auto-tuning"), points_view.TITLE)

design = header.show("from_data")
with st.container(key="stack_from_data"):
    controls, shown = st.columns([4, 11], gap="medium")
with controls:
    work = source.choose(design)
    if work is not None:
        understood.show(work)
        source.beside(work, design)
with shown:
    if work is None:
        source.empty()
    elif work.trend is None:
        st.error(sentence(told(work.refusal)))
        loop_view.known_controller(work)
    else:
        trend = work.trend
        figure = st.container()
        record_view.choose_part(trend, design)
        record_view.bad_pieces(trend, design)
        part, why = work.part(design.record)
        fits = models_view.fits_of(work, part, design, why)
        model = models_view.chosen_of(fits, design)
        with figure:
            record_view.figure(trend, design, part, model)
        if part is None or model is None:
            st.error(words("**No model.** {why}", why=sentence(fits.why)))
        else:
            models_view.ranking(fits, model, trend)
            models_view.card(model, trend, work.names())
            speed, auto, points = tabs(WAYS, "ways")
            if speed.open:
                with speed:
                    tuning_view.show(work, trend, fits, model)
            if auto.open:
                with auto:
                    auto_view.show(work, trend, fits, model)
            if points.open:
                with points:
                    points_view.show(work, trend, part, fits, model)
            graphical(part, model)
experiments.show(design)
