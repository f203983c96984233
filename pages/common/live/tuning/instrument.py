"""The instrument of the tuning page: one slider, tau_c."""

import math
from collections.abc import Mapping

import streamlit as st

from pages.common.live import components
from pages.common.live.kit.held import Held
from pages.common.live.tuning import table
from pages.common.parts.foreign_text import told
from pages.common.session import state
from pages.common.studies.single import Study
from pages.common.words import words
from simc_core.errors import InvalidParameter
from simc_core.numbers import read_number
from simc_core.plants.models import Model, UnstableDelay
from simc_core.plants.plant import Plant
from simc_core.rules.speed import times_theta
from simc_core.sensitivity.margins import margins
from simc_core.studies.tau_table import smallest
from simc_core.wording import said

KEY = "live"
SAME = 1e-12  # relative; one tau_c as a number and as a choice


def tuning_instrument(plant: Plant, studies: list[tuple[str, Study]]) -> None:
    """Slider, figures, panels and trade-off of the present design (first) with the pinned ones behind it."""
    present, pins = studies[0][1], studies[1:]
    held = state.memory(KEY, Held)
    subject = table.subject_of(plant, present, state.value("form"))
    design = state.design_now()
    grid = table.grid_of(subject, present, design.excitation, held.end_for(subject))
    held.subject, held.end = subject, float(grid.t[-1])
    name = table.table_name(subject, grid, pins)
    try:
        with st.spinner(words("Computing what the slider shows")):
            message = held.message("tuning", name, lambda: table.table(subject, grid, pins, name))
    except InvalidParameter as error:
        st.warning(
            words(
                "Nothing can be dragged here; *Bode of L* and *Compare* show this design. {why}.", why=told(str(error))
            )
        )
        return
    answers = components.show("tuning", KEY, message, _take)
    components.message(
        key=f"{KEY}_exact",
        data=table.exact(subject, grid, present, name, answers, design.sheet),
    )
    refused, why = state.memory("live_refusal", lambda: (None, ""))  # an error, told anew in another language
    if refused == subject:  # a refusal goes with what it was said of
        st.warning(told(why))


def _take(release: Mapping) -> None:
    """tau_c, or the Ms that tau_c is wanted for."""
    subject = state.memory(KEY, Held).subject
    state.remember("live_refusal", (None, ""))
    try:
        tau_c = release["tau_c"] if "tau_c" in release else _for_Ms(subject, release["Ms"])
        state.change(**as_choice(subject.model, tau_c))
    except InvalidParameter as error:
        state.remember("live_refusal", (subject, str(error)))


def as_choice(model: Model, tau_c: float) -> dict[str, float | str | None]:
    """The change of the design for a tau_c on the slider: a multiple of theta stays one when the plant changes."""
    if model.theta:
        speed = f"{tau_c / model.theta:.6g}theta"
        if math.isclose((times_theta(speed) or 0.0) * model.theta, tau_c, rel_tol=SAME):
            return {"tau_c": None, "speed": speed}
    return {"tau_c": tau_c}


def _for_Ms(subject: table.Subject, typed: str) -> float:
    """The smallest tau_c on the slider with Ms <= the number typed. Raises InvalidParameter where there is none."""
    limit = read_number("Ms", typed)
    if isinstance(subject.model, UnstableDelay):
        raise InvalidParameter(
            said("tau_c cannot be sought for an Ms here: the rule of an unstable pole knows one tau_c"),
        )
    low, high, *_ = table.bounds(subject)
    return smallest(lambda tau_c: margins(subject.loop(tau_c)).Ms, limit, low, high)
