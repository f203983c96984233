"""What is read off a step by hand, beside the fit: why one does not do so."""

import streamlit as st

from pages.common.parts.symbols import sentence
from pages.common.words import number, translated, words
from simc_core import Identified, NotIdentifiable, SimcError, Trend, by_hand, margins, simc
from simc_core.identification.graphical import ByHand
from simc_core.loops.loop import Loop
from simc_core.reduction.half_rule import reduced_model
from simc_core.wording import said

METHODS = {
    "two-point": said("two-point (Smith 1972)"),
    "tangent": said("tangent (Ziegler and Nichols 1942)"),
    "areas": said("areas (Åström and Hägglund 1995)"),
}


def graphical(part: Trend, model: Identified) -> None:
    """Two-point, tangent and areas, and what Ms their settings have on the fitted plant."""
    folded = st.expander(words("Read off by hand: two-point, tangent, areas"), key="by_hand", on_change="rerun")
    if folded.open:
        with folded:
            _table(part, model)


def _table(part: Trend, model: Identified) -> None:
    try:
        found = by_hand(part)
    except NotIdentifiable as error:
        st.caption(sentence(str(error)) + ".")
        return
    st.dataframe([_row(each, model) for each in found], hide_index=True, width="stretch", height="content")
    st.caption(
        words(
            "From the move of OP with the longest rest after it. Last column: the PI settings by SIMC with τc = θ of "
            "that method, on the plant that was fitted."
        )
    )


def _row(each: ByHand, model: Identified) -> dict[str, str]:
    return {
        words("method"): translated(METHODS[each.method]),
        "k": number(each.model.k),
        "θ": number(each.model.theta),
        "τ₁": number(each.model.tau1),
        "Ms": _Ms(each, model),
    }


def _Ms(each: ByHand, model: Identified) -> str:
    try:
        reduced = reduced_model(each.model.plant)
        judged = margins(Loop(model.plant, simc(reduced, each.model.theta or None)))
    except SimcError:
        return words("no settings")
    return number(judged.Ms, 3) if judged.stable else words("not stable")
