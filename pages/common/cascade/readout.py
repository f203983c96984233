"""The strip of figures that decide a cascade: both peaks first, then margins, IAE beside those of a single loop."""

import math

import streamlit as st

from pages.common.parts.strip import DIGITS, STYLE, Reading, band_of, cell_html, hover, reading
from pages.common.parts.symbols import symbols
from pages.common.studies.cascade import CascadeStudy, speed_symbol, verdict
from simc_core.cascade.design import SEPARATE
from simc_core.figures import palette
from simc_core.notation import number
from simc_core.sensitivity.margins import Margins

SHORT = {"calm": "calm (≤ 1.6)", "attention": "attention (≤ 2.0)", "alarm": "alarm (> 2.0)"}
MORE_STYLE = f"""<style>
.strip.two {{grid-template-columns: 1.45fr 0.75fr 0.75fr 0.9fr repeat(3, 1fr); border-left: none}}
.strip.two .first {{grid-row: auto}} .strip.two .first b {{font-size: 1.6rem; line-height: 1.1}}
.strip.two .calm {{--band: {palette.CALM}}} .strip.two .attention {{--band: {palette.ATTENTION}}}
.strip.two .alarm {{--band: {palette.ALARM}}}
@media (max-width: 640px) {{
  .strip.two {{grid-template-columns: repeat(3, 1fr)}} .strip.two .first {{grid-column: 1 / -1}}
}}
</style>"""
STEPS = ("r", "d₁", "d₂")


def readout(study: CascadeStudy) -> None:
    """The strip and whether the inner loop pays; of a cascade that is not sound it holds no numbers."""
    st.html(STYLE + MORE_STYLE + strip_html(study))
    if study.sound:
        st.caption(sentence(study))


def strip_html(study: CascadeStudy) -> str:
    """The strip as HTML: a row for the outer loop, one for the inner."""
    if not study.sound:
        return (
            '<div class="strip alarm" role="status"><div class="first" style="grid-column: 1 / -1">'
            f"<b>{trouble(study)}</b><span>no margins and no metrics: they would mean nothing</span></div></div>"
        )
    rows = [
        _first("Msa, outer loop", study.outer) + "".join(map(cell_html, [*_margins(study.outer), *_IAE(study)])),
        _first("Msb, inner loop", study.inner) + "".join(map(cell_html, [*_margins(study.inner), *_IAE_single(study)])),
    ]
    return f'<div class="strip two" role="status" aria-label="Figures that decide">{"".join(rows)}</div>'


def trouble(study: CascadeStudy) -> str:
    """What is wrong with a cascade that is not sound."""
    if study.stability.verdict != "stable":
        return "Cascade not stable"
    return "Inner loop not stable on its own"


def sentence(study: CascadeStudy) -> str:
    """Whether the inner loop pays, with every number that speaks for or against it."""
    found = verdict(study)
    if found is None:
        why = study.no_single or study.unsettled
        return f"No comparison with a single loop: {symbols(why)}."
    return symbols(found.text)


def separation(study: CascadeStudy) -> str:
    """How far apart the loops are in time, in words."""
    symbol = speed_symbol(study.cascade)
    ratio = f"Time scales: outer ${symbol}$ / inner ${symbol}$ = **{number(study.separation, DIGITS)}**"
    if study.cascade.method == "synthesis":
        return f"{ratio}. The outer design knows the closed inner loop, so the two need not be far apart."
    if study.separate:
        return f"{ratio} ≥ {SEPARATE:g}. The loops separate: to the outer one the inner one is fast."
    return f"{ratio} < {SEPARATE:g}. The loops work at the same speed and feel one another."


def _first(label: str, judged: Margins) -> str:
    cell = reading(label, judged.Ms)
    band, _ = band_of(round(judged.Ms, 6))  # an Ms of 2 that was asked for and met is not above 2
    return (
        f'<div class="first {band}" title="{hover(cell)}"><small>{label}</small><b>{cell.text}</b>'
        f"<span>{SHORT[band]}</span></div>"
    )


def _margins(judged: Margins) -> list[Reading]:
    gain = reading("Gain margin", judged.GM)
    if judged.GM_lower > 0:
        text = f"{number(judged.GM_lower, DIGITS)} · {number(judged.GM, DIGITS)}"
        gain = Reading("GM low · high", text, f"{judged.GM_lower:.10g} · {judged.GM:.10g}")
    return [gain, reading("Phase margin", judged.PM_deg, "°"), reading("Delay margin", judged.delay_margin)]


def _IAE(study: CascadeStudy) -> list[Reading]:
    return [_metric(f"IAE {step}", value) for step, value in zip(STEPS, _values(study.performance), strict=True)]


def _IAE_single(study: CascadeStudy) -> list[Reading]:
    found = study.single.performance if study.single else None
    return [_metric(f"IAE {step}, one loop", value) for step, value in zip(STEPS, _values(found), strict=True)]


def _values(found) -> tuple[float, float, float]:
    if found is None:
        return (math.nan,) * 3
    return found.setpoint.IAE, found.disturbance.IAE, found.disturbance2.IAE


def _metric(label: str, value: float) -> Reading:
    return Reading(label, "–", "none") if math.isnan(value) else reading(label, value)
