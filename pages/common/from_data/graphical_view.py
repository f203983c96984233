"""What is read off a step by hand, beside the fit: why one does not do so."""

import streamlit as st

from pages.common.parts.symbols import sentence
from simc_core import Identified, NotIdentifiable, SimcError, Trend, graphical_methods, half_rule, margins, simc
from simc_core.loops.loop import Loop
from simc_core.notation import number
from simc_core.plants.models import FirstOrderDelay

CITED = {"two-point": "Smith 1972", "tangent": "Ziegler and Nichols 1942", "areas": "Åström and Hägglund 1995"}


def graphical(part: Trend, model: Identified) -> None:
    """Two-point, tangent and areas, and what Ms their settings have on the fitted plant."""
    with st.expander("Read off by hand: two-point, tangent, areas"):
        try:
            found = graphical_methods(part)
        except NotIdentifiable as error:
            st.caption(sentence(str(error)) + ".")
            return
        st.dataframe([_row(*each, model) for each in found.items()], hide_index=True, width="stretch", height="content")
        st.caption(
            "From the first move of OP. Ms: of the PI settings by SIMC with τc = θ of "
            "that method, on the plant that was fitted."
        )


def _row(method: str, read: FirstOrderDelay, model: Identified) -> dict[str, str]:
    return {
        "method": f"{method} ({CITED[method]})",
        "k": number(read.k),
        "θ": number(read.theta),
        "τ₁": number(read.tau1),
        "Ms": _Ms(read, model),
    }


def _Ms(read: FirstOrderDelay, model: Identified) -> str:
    """Of the PI settings of this reading on the plant that was fitted."""
    try:
        judged = margins(Loop(model.plant, simc(half_rule(read.plant).model)))
    except SimcError:
        return "no settings"
    return number(judged.Ms, 3) if judged.stable else "not stable"
