"""From the model to its tuning: how fast the loop may be for what is known of the plant, and the way there."""

import streamlit as st

from pages.common.from_data.work import Work
from pages.common.parts.refusals import explain_refusal
from pages.common.session import state
from pages.common.session.record import PARAMETERS, Origin
from pages.common.session.sheet import LONGEST, TIME_UNITS
from pages.common.shell import header
from simc_core import Identified, Trend, checks


def show(work: Work, trend: Trend, part: Trend, model: Identified) -> None:
    """The button that begins a loop with the plant."""
    if st.button("Tune this model", type="primary", key="tune"):
        _send(work, trend, part, model, None)


def _plain(unit: str) -> str:
    return unit if unit in TIME_UNITS else ""


def _send(work: Work, trend: Trend, part: Trend, model: Identified, tau_c: float | None) -> None:
    """A loop of its own with this plant, its units and where it comes from."""
    errors = tuple(min(model.standard_errors[name], checks.LARGEST_GAIN) for name in PARAMETERS[model.structure])
    chosen = state.design_now().record
    with explain_refusal():
        state.begin_loop(model.plant, mine=True)
        plant = state.plant()
        origin = Origin(plant, model.structure, errors, min(model.fit, 1.0), int(part.t.size), work.name)
        units = {
            "unit": _plain(trend.units.get("t", "")),
            "PV_unit": trend.units.get("y", "")[: LONGEST["PV_unit"]],
            "OP_unit": trend.units.get("u", "")[: LONGEST["OP_unit"]],
            "PV": trend.names.get("y", "")[: LONGEST["PV"]],
            "OP": trend.names.get("u", "")[: LONGEST["OP"]],
        }
        kept = {name: getattr(chosen, name) for name in ("example", "structure", "begin", "end", "bad")}
        state.change(origin=origin, **units, **kept, **({"tau_c": tau_c} if tau_c else {}))
        header.go("tuning")
