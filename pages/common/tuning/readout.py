"""The strip of figures that decide: Ms first and largest, its band in words and colour."""

import streamlit as st

from pages.common.parts.strip import STYLE, Reading, band_of, cell_html, hover, pair, percent, reading
from pages.common.studies.single import Study


def readout(study: Study) -> None:
    """The strip; for a loop that is not stable it says so and holds no numbers."""
    st.html(STYLE + strip_html(study))


def strip_html(study: Study) -> str:
    """The strip as HTML."""
    if not study.stable:
        return (
            '<div class="strip alarm" role="status"><div class="first" style="grid-column: 1 / -1">'
            "<b>Loop not stable</b><span>no margins and no metrics: they would mean nothing</span></div></div>"
        )
    band, words = band_of(study.margins.Ms)
    Ms = reading("Ms, peak of |S|", study.margins.Ms)
    first = (
        f'<div class="first" title="{hover(Ms)}"><small>{Ms.label}</small><b>{Ms.text}</b><span>{words}</span></div>'
    )
    cells = "".join(cell_html(cell) for cell in readings(study))
    return f'<div class="strip {band}" role="status" aria-label="Figures that decide">{first}{cells}</div>'


def readings(study: Study) -> list[Reading]:
    """All cells after Ms, row by row. The loop must be stable."""
    judged, metrics = study.margins, study.performance
    lower = judged.GM_lower > 0
    return [
        pair("GM lower · upper", judged.GM_lower, judged.GM) if lower else reading("Gain margin GM", judged.GM),
        reading("Phase margin PM", judged.PM_deg, "°"),
        reading("Delay margin", judged.delay_margin),
        reading("IAE set point", metrics.setpoint.IAE),
        reading("IAE load", metrics.disturbance.IAE),
        reading("Mt, peak of |T|", judged.Mt),
        pair("TV set point · load", metrics.setpoint.TV, metrics.disturbance.TV),
        percent("Overshoot", metrics.setpoint.overshoot),
        pair("Settling set point · load", metrics.setpoint.settling_time, metrics.disturbance.settling_time),
        reading("Peak of y, unit load", metrics.disturbance.peak),
    ]
