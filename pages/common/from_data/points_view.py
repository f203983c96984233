"""Operating points: the model that each move of OP shows by itself, and the gain schedule they make."""

import streamlit as st

from pages.common.from_data.send import plain_unit, send
from pages.common.from_data.work import Fits, Work, kept
from pages.common.parts.symbols import sentence
from pages.common.session.home import MOST_POINTS, Home, Point
from pages.common.words import number, words
from simc_core import Identified, OperatingPoint, SimcError, Trend, operating_points
from simc_core.identification.judgement.verdicts import disagree
from simc_core.wording import said

STRUCTURES = ("FOPDT", "SOPDT", "IPDT")  # of which a schedule can be made
BY = ("OP", "PV")
TITLE = said("Operating points")


def show(work: Work, trend: Trend, part: Trend, fits: Fits, model: Identified) -> None:
    """Models move by move, of all records that are here; a button takes them to the gain schedule."""
    structure = model.structure if model.structure in STRUCTURES else "FOPDT"
    with st.spinner(words("Fitting each move")):
        found, why = kept(fits, ("points", structure), lambda: operating_points(work.parts(part), structure))
    if found is None:
        st.warning(sentence(why))
        return
    st.dataframe([_row(each, trend) for each in found], hide_index=True, width="stretch", height="content")
    if len(found) < 2:
        st.caption(
            words(
                "One operating point. A gain schedule needs two or more: steps of OP at other levels, in this record "
                "or in other files that are added."
            )
        )
        return
    st.caption(words("Each move of OP by itself, up and back together. ±: 95 %."))
    for each in found:
        for why in disagree(each.identified.gains):
            st.warning(sentence(said("OP {OP}: {why}", OP=number(each.OP, 3), why=why)))
    with st.container(key="send_points", horizontal=True, gap="small", vertical_alignment="bottom"):
        by = st.segmented_control(words("Schedule on"), BY, default=BY[0], required=True, key="points_by")
        points, refused = _points(found, by)
        if st.button(words("To the gain schedule"), key="tune_points", type="primary", disabled=not points):
            send(work, trend, model, fits, points=points)
    if refused:
        st.warning(sentence(refused))


def _points(found: tuple[OperatingPoint, ...], by: str) -> tuple[tuple[Point, ...], str]:
    """Rows of the schedule in the order of their values; none, and why, where they make no schedule."""
    rows = [_point(each, each.OP if by == "OP" else each.PV) for each in found[:MOST_POINTS]]
    try:
        return Home(points=tuple(sorted(rows))).points, ""
    except SimcError as error:
        return (), said("These points make no schedule: {error}", error=str(error))


def _point(each: OperatingPoint, value: float) -> Point:
    p = each.identified.parameters
    gain = p.get("k", p.get("k_prime", 0.0))
    numbers = (value, gain, p["theta"], *(p[name] for name in ("tau1", "tau2") if name in p))
    return tuple(float(f"{each:.5g}") for each in numbers)


def _row(each: OperatingPoint, trend: Trend) -> dict[str, str]:
    unit = plain_unit(trend)
    time = f" [{unit}]" if unit else ""
    p, errors = each.identified.parameters, each.identified.standard_errors
    gain = "k" if "k" in p else "k_prime"
    row = {
        "OP": number(each.OP, 3),
        "PV": number(each.PV, 3),
        words("moves"): str(each.moves),
        gain.replace("_prime", "'"): number(p[gain]),
        "±": number(each.identified.estimate.half_width * errors[gain], 2),
        f"θ{time}": number(p["theta"], 3),
    }
    return row | {f"{label}{time}": number(p[name], 3) for name, label in (("tau1", "τ₁"), ("tau2", "τ₂")) if name in p}
