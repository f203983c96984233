"""The strip of figures that decide a cascade: both peaks first, then margins, IAE beside those of a single loop."""

import math

import streamlit as st

from pages.common.parts.quantities import QUANTITIES
from pages.common.parts.strip import Reading, cell_html, gain_margin, peak_html, reading
from pages.common.parts.symbols import symbols
from pages.common.studies.cascade import CascadeStudy, speed_symbol, verdict
from pages.common.words import number, translated, words
from simc_core.cascade.by_simc import SEPARATE
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.wording import Text, said

STEPS = ("IAE_setpoint", "IAE_d1", "IAE_d2")


def readout(study: CascadeStudy) -> None:
    """The strip and whether the inner loop pays; of a cascade that is not sound it holds no numbers."""
    st.html(strip_html(study))
    if study.sound:
        st.caption(sentence(study))


def strip_html(study: CascadeStudy) -> str:
    """The strip as HTML: a row for the outer loop, one for the inner."""
    if not study.sound:
        return (
            '<div class="strip alarm" role="status"><div class="first" style="grid-column: 1 / -1">'
            f"<b>{translated(trouble(study))}</b><span>{words('margins and IAE do not exist')}</span></div></div>"
        )
    rows = [
        peak_html(reading("Ms_outer", study.outer.Ms), study.outer.Ms)
        + "".join(map(cell_html, [*_margins(study.outer), *_IAE(study)])),
        peak_html(reading("Ms_inner", study.inner.Ms), study.inner.Ms)
        + "".join(map(cell_html, [*_margins(study.inner), *_IAE_single(study)])),
    ]
    label = words("Figures that decide")
    return f'<div class="strip two" role="status" aria-label="{label}">{"".join(rows)}</div>'


def trouble(study: CascadeStudy) -> Text:
    """What is wrong with a cascade that is not sound."""
    if study.stability.verdict != "stable":
        return said("Cascade not stable")
    return said("Inner loop not stable on its own")


def sentence(study: CascadeStudy) -> str:
    """Whether the inner loop pays, with every number that speaks for or against it."""
    found = verdict(study)
    if found is None:
        why = study.no_single or study.unsettled
        return words("No comparison with a single loop: {why}.", why=symbols(why))
    return symbols(found.text)


def separation(study: CascadeStudy) -> str:
    """How far apart the loops are in time, in words."""
    found = {"symbol": speed_symbol(study.cascade), "ratio": number(study.separation), "enough": SEPARATE}
    if study.cascade.method == "synthesis":
        return words(
            "Time scales: outer ${symbol}$ / inner ${symbol}$ = **{ratio}**. The outer design knows the closed inner "
            "loop, so the two need not be far apart.",
            **found,
        )
    if study.separate:
        return words(
            "Time scales: outer ${symbol}$ / inner ${symbol}$ = **{ratio}** ≥ {enough:g}. The loops separate: to the "
            "outer one the inner one is fast.",
            **found,
        )
    return words(
        "Time scales: outer ${symbol}$ / inner ${symbol}$ = **{ratio}** < {enough:g}. The loops work at the same speed "
        "and feel one another.",
        **found,
    )


def _margins(judged: Margins) -> list[Reading]:
    return [gain_margin(judged), reading("PM_deg", judged.PM_deg), reading("delay_margin", judged.delay_margin)]


def _IAE(study: CascadeStudy) -> list[Reading]:
    return [reading(name, value) for name, value in zip(STEPS, _values(study.performance), strict=True)]


def _IAE_single(study: CascadeStudy) -> list[Reading]:
    values = _values(study.single.performance if study.single else None)
    return [
        reading(name, value, words("{figure}, one loop", figure=QUANTITIES[name].label))
        for name, value in zip(STEPS, values, strict=True)
    ]


def _values(found) -> tuple[float, float, float]:
    if found is None:
        return (math.nan,) * 3
    return found.setpoint.IAE, found.disturbance.IAE, found.disturbance2.IAE
