"""Which set of rules the half rule follows for zeros."""

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.parts.sources import linked
from pages.common.session import state
from pages.common.words import words

NAMES = {"2003": "2003: T1–T3", "1998": "1998"}


def rules_choice(place: DeltaGenerator | None = None) -> None:
    """The choice between both sets."""
    (place or st).segmented_control(
        words("Rules for zeros"),
        list(NAMES),
        format_func=NAMES.get,
        help=linked(
            words(
                "2003: rules T1 to T3 [SK03 sect. 2.2]. 1998: the simpler, older form [SK98]: small zeros are "
                "subtracted from the delay, a large one is cancelled."
            )
        ),
        **state.bound("rules"),
    )
