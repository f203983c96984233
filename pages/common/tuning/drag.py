"""What is dragged in the live view: tau_c, the settings, or the plant with the controller kept."""

import streamlit as st

from pages.common import live
from pages.common.session import state
from pages.common.studies.single import Study
from pages.common.tuning.source import change_in_words
from pages.common.words import translated, words
from simc_core.plants.plant import Plant
from simc_core.studies.retune import CHANGED_PLANT
from simc_core.wording import said

STILL = "still"
KNOBS = {
    "tau_c": "τc",
    "settings": said("Settings"),
    "plant": said("What if the plant changes"),
    STILL: said("Figures to export"),
}


def dragged() -> bool:
    """Whether there is an instrument with knobs; else the figures stand still."""
    return state.widget("drag") != STILL


def drag(plant: Plant, present: Study, behind: list[tuple[str, Study]]) -> str:
    """The choice of what is dragged, and its instrument; for STILL the caller draws.

    behind: designs that are drawn behind, by name.
    """
    offered = [name for name in KNOBS if name != "tau_c" or present.tuned]
    if state.widget("drag") not in offered:
        state.set_widget("drag", offered[0])
    chosen = st.segmented_control(
        words("Drag"),
        offered,
        required=True,
        format_func=lambda name: translated(KNOBS[name]),
        key="drag",
        persist_state="session",
        label_visibility="collapsed",
    )
    if chosen == "tau_c":
        live.tuning_instrument(plant, [(said("present"), present), *behind])
    elif chosen == "settings":
        live.hand_instrument(present, behind, settings=True)
    elif chosen == "plant":
        _what_if(present, behind)
    return chosen


def _what_if(present: Study, behind: list[tuple[str, Study]]) -> None:
    """The plant is dragged, the controller stays; nothing of the design changes unless that is asked for."""
    turned = live.hand_instrument(present, [(said("as designed"), present), *behind], settings=False)
    if turned.loop.plant == present.loop.plant:
        st.caption(
            words("The controller stays as it is. Drag the gain, the dead time or the largest time constant."),
        )
        return
    told, back, take = st.columns([6, 2, 2], vertical_alignment="center")
    change = change_in_words(present, turned, CHANGED_PLANT)
    told.markdown(words("**The settings are the same:** {change}", change=change))
    back.button(words("Back to the plant"), width="stretch", key="what_if_back", on_click=live.put_back)
    take.button(
        words("Make it the plant"),
        width="stretch",
        key="what_if_take",
        on_click=lambda: state.change(plant=turned.loop.plant),
    )
