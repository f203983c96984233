"""A record in closed loop without OP: the controller that was in the loop is told, and OP computed from it."""

import math

import streamlit as st

from pages.common.from_data.understood import answer
from pages.common.from_data.work import Work
from pages.common.parts.foreign_text import told
from pages.common.parts.number_field import number_field
from pages.common.session import state
from pages.common.words import words
from simc_core import IdealPid, SimcError, checks

FIELDS = {"Kc": "Kc", "tau_I": "τI", "tau_D": "τD", "tau_F": "τF"}
TOLD = "from_data_controller"


def known_controller(work: Work) -> None:
    """Fields for the controller, where OP can be computed from it."""
    if not work.reading.computable:
        return
    st.markdown(words("**Closed loop, the controller known?** OP can be computed from it."))
    given: dict[str, float | None] = state.lasting(TOLD, dict)
    places = st.columns(len(FIELDS), gap="small", vertical_alignment="bottom")
    for place, (name, label) in zip(places, FIELDS.items(), strict=True):
        check = checks.gain if name == "Kc" else checks.optional_time
        number_field(
            label,
            given.get(name),
            lambda value, check=check, label=label: None if value is None else check(label, value),
            lambda value, name=name: given.__setitem__(name, value),
            f"loop_{name}",
            optional=True,
            place=place,
            under=st.container(),
        )
    st.caption(words("Ideal form, in the units and the time of the record; without τI there is no integral action."))
    st.button(
        words("Compute OP"), key="compute_op", on_click=_compute, args=(work, given), disabled=not given.get("Kc")
    )
    why = state.lasting("from_data_answer", str)
    if why and work.trend is None:
        st.error(told(why))


def _compute(work: Work, given: dict[str, float | None]) -> None:
    try:
        controller = IdealPid(
            given.get("Kc") or 0.0, given.get("tau_I") or math.inf, given.get("tau_D") or 0.0, given.get("tau_F") or 0.0
        )
    except SimcError as error:
        state.make_last("from_data_answer", str(error))
        return
    answer(work, "controller", controller)
