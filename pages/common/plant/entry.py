"""Entering a plant: one line of text, parameters, a step test, a table of factors, polynomials, or an example.

All describe the same plant; what is being typed is kept as draft.py says.
"""

from collections.abc import Iterable
from functools import partial

import pandas as pd
import streamlit as st

from pages.common.plant import rows as entries
from pages.common.plant.draft import Draft, dead_time_field, draft_of, gain_field, outcome, take, text_field
from pages.common.plant.number_form import show as numbers
from pages.common.plant.parameters import PARAMETERS
from pages.common.plant.step_test import FACTS, STEP_TEST
from pages.common.session import state
from pages.common.words import translated, words
from simc_core import Plant, parse_plant
from simc_core.notation import plain
from simc_core.plants.examples import EXAMPLES
from simc_core.wording import said

TEXT, NUMBERS, STEP, FACTORS = said("Text"), "k, θ, τ", said("Step test"), said("Factors")
POLYNOMIALS, LITERATURE = said("Polynomials"), said("Examples")
WAYS = (TEXT, NUMBERS, STEP, FACTORS, POLYNOMIALS, LITERATURE)


def plant_entry(name: str = "plant", title: str = "") -> Plant:
    """Widgets to enter the plant called `name` in design.py (plant, Ga or Gb). Returns the last good one."""
    first = state.memory(f"{name}_first_way", lambda: STEP if state.value(FACTS[name]) else WAYS[0])
    way = st.segmented_control(
        title or words("Enter the plant as"),
        WAYS,
        format_func=translated,
        default=first,
        required=True,
        key=f"{name}_way",
        persist_state="session",
    )
    show = {
        TEXT: _text,
        NUMBERS: partial(numbers, PARAMETERS),
        STEP: partial(numbers, STEP_TEST),
        FACTORS: _factors,
        POLYNOMIALS: _polynomials,
        LITERATURE: _examples,
    }
    show[way](name)
    return state.value(name)


def _text(name: str) -> None:
    draft = draft_of(name, "text", lambda plant: {"text": plain(plant)}, lambda fields: parse_plant(fields["text"]))
    text_field(
        name,
        "text",
        draft,
        "text",
        words("Transfer function"),
        help=words(
            "As on paper: (1-2s)/((10s+1)(6s+1)(s+1)), exp(-3s)/((6s+1)(4s+1)), 2 e^{-0.5s}/(s(3s+1)^2), "
            "1/(s^2+0.6s+1). A decimal comma is understood, and what MATLAB, Python or LaTeX print: tf([1 "
            "2],[1 3 2]), a fraction over three lines, k=2, tau=10, theta=3."
        ),
    )
    outcome(draft)


def _polynomials(name: str) -> None:
    def start(plant: Plant) -> dict:
        num, den = entries.polynomials_of(plant)
        return {"num": num, "den": den, "theta": plant.theta}

    draft = draft_of(name, "polynomials", start, lambda fields: entries.plant_of_polynomials(**fields))
    how = words("Coefficients in descending powers of s, separated by blanks: 1 3 2 is s² + 3s + 2.")
    text_field(name, "polynomials", draft, "num", words("Numerator"), help=how)
    text_field(name, "polynomials", draft, "den", words("Denominator"), help=how)
    dead_time_field(name, "polynomials", draft)
    outcome(draft)


def _factors(name: str) -> None:
    def start(plant: Plant) -> dict:
        return {"k": plant.k, "theta": plant.theta, "rows": entries.rows_of(plant)}

    def read(fields: dict) -> Plant:
        edits = state.widget(_table_key(name, draft)) or {}
        return entries.plant_of_rows(fields["k"], fields["theta"], entries.edited(fields["rows"], edits))

    draft = draft_of(name, "factors", start, read)
    (gain, delay), under = st.columns(2), st.container()
    gain_field(name, "factors", draft, place=gain, under=under)
    dead_time_field(name, "factors", draft, place=delay, under=under)
    if state.widget(_table_key(name, draft)) is None:  # not on the last page shown, its edits are lost: a fresh one
        draft.version += 1
        draft.fields["rows"] = entries.rows_of(draft.plant)
    st.data_editor(
        _frame(draft.fields["rows"]),
        key=_table_key(name, draft),
        num_rows="dynamic",
        hide_index=True,
        width="stretch",
        on_change=take,
        args=(name, draft),
        column_config={
            "factor": st.column_config.SelectboxColumn(
                words("Factor"), options=entries.FACTORS, format_func=translated, width=170
            ),
            "tau": st.column_config.TextColumn("τ", width=70),
            "zeta": st.column_config.TextColumn("ζ", width=60),
        },
    )
    st.caption(words("τ < 0: unstable pole, or a zero in the right half plane. ζ for pairs only."))
    outcome(draft)


def _examples(name: str) -> None:
    titles = [example.name for example in EXAMPLES]
    key = f"{name}_example"
    here = next((i for i, example in enumerate(EXAMPLES) if example.plant == state.value(name)), None)
    state.set_widget(key, None if here is None else titles[here])
    st.selectbox(
        words("From the literature"),
        titles,
        format_func=translated,
        key=key,
        placeholder=words("Choose one"),
        on_change=_take_example,
        args=(name, key),
    )
    if here is not None:
        st.caption(translated(EXAMPLES[here].source))


def _take_example(name: str, key: str) -> None:
    if state.overtaken(key):
        return
    chosen = state.widget(key)
    plant = next(example.plant for example in EXAMPLES if example.name == chosen)
    state.change(**{name: plant})


def _table_key(name: str, draft: Draft) -> str:
    return f"{name}_table_{draft.version}"


def _frame(rows: Iterable[dict]) -> pd.DataFrame:
    return pd.DataFrame(list(rows), columns=["factor", "tau", "zeta"], dtype=object)
