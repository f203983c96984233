"""The field for my plant, and examples to click."""

import streamlit as st

from pages.common.parts.formula import fitted
from pages.common.parts.refusals import explain_refusal, unread
from pages.common.parts.sources import linked
from pages.common.parts.symbols import symbols
from pages.common.session import state
from pages.common.shell import header
from pages.common.words import translated, words
from simc_core import SimcError, parse_plant
from simc_core.plants.examples import EXAMPLES, Example
from simc_core.plants.plant import Plant


def my_plant() -> None:
    """A transfer function as text, and from there straight to its tuning."""
    with st.form("my_plant", border=True):
        text, button = st.columns([5, 1], vertical_alignment="bottom")
        typed = text.text_input(
            words("Your process as a transfer function, time constants in your own unit"),
            placeholder="2.2 exp(-20s)/(180s+1)",
            key="home_plant",
        )
        tune = button.form_submit_button(words("Tune"), type="primary", width="stretch")
    st.caption(
        words(
            "Dead time exact, negative gain, integrators and unstable poles included; a decimal comma is "
            "understood. Without a transfer function: *Plant* takes gain, dead time and time constants one "
            "by one, *From data* a recorded step test."
        )
    )
    if tune:
        try:
            plant = parse_plant(typed)
        except SimcError as error:
            unread(error)
        else:
            with explain_refusal():
                _begin(plant, mine=True)


def cards(examples: tuple[Example, ...], name: str) -> None:
    """Examples as cards, each with its transfer function; a click begins a loop with it."""
    with st.container(key=f"cards_{name}"):
        for example in examples:
            with st.container(border=True, height="stretch", vertical_alignment="distribute"):
                st.markdown(f"${fitted(example.plant)}$")
                st.caption(linked(f"{symbols(example.note)} {symbols(example.source)}"))
                if st.button(translated(example.name), key=f"example_{example.key}", width="stretch"):
                    with explain_refusal():
                        _begin(example.plant, mine=False)


def papers() -> None:
    """The examples of the papers, by name."""
    folded = st.expander(words("Examples of the papers"), key="papers", on_change="rerun")
    if folded.open:
        with folded:
            cards(EXAMPLES, "papers")


def _begin(plant: Plant, mine: bool) -> None:
    """A loop of its own for this plant: what belongs to another plant stays there."""
    state.begin_loop(plant, mine)
    header.go("tuning")
