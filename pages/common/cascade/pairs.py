"""The published pairs, designed now, beside what is printed."""

from collections.abc import Sequence
from time import monotonic

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.cascade.widgets import METHOD_NAMES
from pages.common.parts.quantities import QUANTITIES
from pages.common.parts.sources import linked
from pages.common.parts.symbols import symbols
from pages.common.words import number, numeral, translated, words
from simc_core.cascade.pairs import ROWS, Judged, judged
from simc_core.notation import plain

SETTINGS = ("k", "ki", "kd")

REDRAWN = 0.3  # seconds between two drawings of a table that fills


def pairs_view() -> None:
    """Two tables, peaks with IAE and settings, and the reason for every difference."""
    st.markdown(
        linked(
            words(
                "All pairs of [PSB], designed and evaluated now on the exact cascade. In brackets the printed number "
                "and how far ours is from it; without brackets, nothing is printed that we could compare with."
            )
        )
    )
    found = _as_they_come()
    st.markdown("\n".join(f"- **{names}**: {symbols(note)}" for note, names in notes(found).items()))
    st.markdown(words("**Settings**, parallel form $k + k_i/s + k_d s$"))
    st.dataframe([settings(each) for each in found], hide_index=True, width="stretch", height="content", key="settings")
    st.caption(words("Printed digits of Msa are those of the constraint."))


def _as_they_come() -> tuple[Judged, ...]:
    """All rows; while they are made, the table shows those that are there, and a bar how many are to come."""
    bar, table = st.empty(), st.empty()
    found: list[Judged] = []
    shown = monotonic()
    for row in ROWS:
        found.append(judged(row))
        if monotonic() - shown > REDRAWN and len(found) < len(ROWS):
            bar.progress(len(found) / len(ROWS), _progress(len(found)))
            _peaks(table, found)
            shown = monotonic()
    bar.empty()
    _peaks(table, found)
    return tuple(found)


def _progress(n: int) -> str:
    return words("{n} of {all} pairs designed and judged", n=n, all=len(ROWS))


def _peaks(place: DeltaGenerator, found: Sequence[Judged]) -> None:
    place.dataframe([indices(each) for each in found], hide_index=True, width="stretch", height="content")


def notes(found: tuple[Judged, ...]) -> dict[str, str]:
    """Why rows differ from the paper, or what they show, and the names of the rows it is said of."""
    gathered: dict[str, list[str]] = {}
    for each in found:
        gathered.setdefault(each.row.note, []).append(each.row.name)
    return {note: ", ".join(names) for note, names in gathered.items() if note}


def indices(each: Judged) -> dict[str, str]:
    """Peaks and IAE of a row."""
    printed = each.row.published
    return {
        words("pair"): each.row.name,
        "Msa": beside(each.outer.Ms, printed and printed.Msa),
        "Msb": beside(each.inner.Ms, printed and printed.Msb),
        "Mpa": beside(each.outer.Mt, printed and printed.Mpa),
        translated(QUANTITIES["IAE_d1"].label): beside(each.performance.disturbance.IAE, printed and printed.IAE_d1),
        translated(QUANTITIES["IAE_d2"].label): beside(each.performance.disturbance2.IAE, printed and printed.IAE_d2),
        "Ga": numeral(plain(each.row.blocks[0])),
        "Gb": numeral(plain(each.row.blocks[1])),
    }


def settings(each: Judged) -> dict[str, str]:
    """Settings of both controllers of a row."""
    printed = each.row.published
    row = {words("pair"): each.row.name, words("method"): translated(METHOD_NAMES[each.row.method])}
    for index, controller, values in (
        ("a", each.design.outer, printed and printed.outer),
        ("b", each.design.inner, printed and printed.inner),
    ):
        form = controller.to_parallel()
        for i, (name, value) in enumerate(zip(SETTINGS, (form.Kp, form.Ki, form.Kd), strict=True)):
            row[f"{name} {index}"] = beside(value, values and values[i])
    return row


def beside(ours: float, printed: float | None) -> str:
    """Ours, and in brackets what is printed with the difference in per cent."""
    if printed is None:
        return number(ours)
    if printed == 0:
        return f"{number(ours)} (0)" if ours == 0 else words("{ours} (printed 0)", ours=number(ours))
    per_cent = round(100 * (ours / printed - 1), 1) or 0.0  # not -0.0
    told = words("{ours} ({printed}, {per_cent:+.1f} %)", ours=number(ours), printed=number(printed), per_cent=per_cent)
    return told.replace("-", "−")
