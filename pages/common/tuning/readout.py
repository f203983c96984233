"""The strip of figures that decide: Ms first and largest, its band in words and colour."""

import streamlit as st

from pages.common.parts.strip import Reading, cell_html, gain_margin, pair, peak_html, reading
from pages.common.studies.single import Study
from pages.common.words import words


def readout(study: Study) -> None:
    """The strip; for a loop that is not stable it says so and holds no numbers."""
    st.html(strip_html(study))


def strip_html(study: Study) -> str:
    """The strip as HTML."""
    if not study.stable:
        return (
            '<div class="strip alarm" role="status"><div class="first" style="grid-column: 1 / -1">'
            f"<b>{words('Not stable')}</b><span>{words('margins and IAE do not exist')}</span></div></div>"
        )
    first = peak_html(reading("Ms", study.margins.Ms), study.margins.Ms)
    cells = "".join(cell_html(cell) for cell in readings(study))
    label = words("Figures that decide")
    return f'<div class="strip" role="status" aria-label="{label}">{first}{cells}</div>'


def readings(study: Study) -> list[Reading]:
    """All cells after Ms, row by row. The loop must be stable."""
    judged, metrics = study.margins, study.performance
    TV = metrics.setpoint.TV, metrics.disturbance.TV
    settling = metrics.setpoint.settling_time, metrics.disturbance.settling_time
    return [
        gain_margin(judged),
        reading("PM_deg", judged.PM_deg),
        reading("delay_margin", judged.delay_margin),
        reading("IAE_setpoint", metrics.setpoint.IAE),
        reading("IAE_disturbance", metrics.disturbance.IAE),
        reading("Mt", judged.Mt),
        pair(words("TV set point · load"), ("TV_setpoint", "TV_disturbance"), TV),
        reading("overshoot", metrics.setpoint.overshoot),
        pair(words("Settling set point · load"), ("settling_setpoint", "settling_disturbance"), settling),
        reading("peak_disturbance", metrics.disturbance.peak),
    ]
