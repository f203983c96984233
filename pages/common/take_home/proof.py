"""Margins of the design, as typed and as sampled, side by side. Pure: no streamlit."""

import math
from collections.abc import Mapping
from functools import lru_cache

from pages.common.parts.units import measured, with_plain_unit
from pages.common.session.design import Design
from simc_core import Actuation, Loop, TimeResponse, longest_sampling_period, sampled_margins, simulate
from simc_core.controllers.forms import Controller
from simc_core.errors import SimcError
from simc_core.notation import number, rounded_down
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.simulation.horizon import times
from simc_core.wording import Text, said

QUANTITY = said("quantity")
DESIGN, AS_TYPED, SAMPLED = said("design"), said("as typed"), said("sampled")  # columns and curves
ROWS = {  # of Margins: label; delay_margin in the time unit
    "Ms": "Ms",
    "Mt": "Mt",
    "GM": said("gain margin"),
    "PM_deg": said("phase margin [°]"),
    "delay_margin": said("delay margin"),
}


def sampled(loop: Loop, design: Design) -> tuple[Text, Margins]:
    """Title and margins with the sampling period of the design. Raises SimcError where its law does not exist."""
    h = design.actuator.h
    title = said("sampled every {time}", time=measured(h, design.sheet.time_unit))
    return title, sampled_margins(loop, h, design.actuator.law, design.actuator.delay_scans)


def sampled_response(first: Loop, loop: Loop, design: Design, built: Actuation | None = None) -> TimeResponse:
    """y and u with the sampling period, over the horizon of the loop `first`; built: with more than that."""
    begins, t_end = times(first, design.excitation.scenario())
    actuator = design.actuator
    actuation = built or Actuation(h=actuator.h, law=actuator.law, delay_scans=actuator.delay_scans)
    return simulate(loop, design.excitation.scenario(disturbance_time=begins, t_end=t_end, actuation=actuation))


def responses(first: Loop, loops: Mapping[str, Loop], design: Design) -> tuple[dict[str, TimeResponse], list[Text]]:
    """y and u of each loop over the horizon of `first`, by name; and why some are not there."""
    begins, t_end = times(first, design.excitation.scenario())
    asked = design.excitation.scenario(disturbance_time=begins, t_end=t_end)
    found, why = {}, []
    for name, loop in loops.items():
        try:
            found[name] = simulate(loop, asked)
        except SimcError as error:
            why.append(not_drawn(name, loop, error))
    return found, why


def not_drawn(name: str, loop: Loop, error: SimcError) -> Text:
    """Why a response is missing, in words."""
    if kicks(loop.controller):
        return said(
            "The response {name} is not drawn: its derivative acts on the set point without a filter, so a "
            "set-point step makes u infinite. Its margins and its load response are those of a derivative on PV. "
            "With the sampling period of the box it is drawn as the box does it.",
            name=name,
        )
    return said("The response {name} is not drawn: {error}", name=name, error=str(error))


def kicks(controller: Controller) -> bool:
    """Whether a set-point step makes u infinite."""
    form = controller.to_parallel()
    return bool(form.Kd and form.c and not form.tau_F)


@lru_cache(maxsize=16)  # a fifth of a second, asked for by warnings, remedies and reports
def longest_period(loop: Loop, law: str, scans: int) -> float:
    """The sampling period that costs 5 % of Ms, rounded down; infinite where none does, nan where there is none."""
    try:
        longest = longest_sampling_period(loop, law, scans)
    except SimcError:
        return math.nan
    return rounded_down(longest) if math.isfinite(longest) else longest


def table(columns: Mapping[str, Margins], time_unit: str) -> list[dict[str, str]]:
    """A line for each of ROWS, with what it is under QUANTITY; what is to be translated still can."""
    names = [with_plain_unit(label, time_unit * (name == "delay_margin")) for name, label in ROWS.items()]
    texts = {title: _column(judged) for title, judged in columns.items()}
    return [{QUANTITY: name} | {title: column[i] for title, column in texts.items()} for i, name in enumerate(names)]


def _column(judged: Margins) -> list[str]:
    if not judged.stable:
        return [said("not stable")] * len(ROWS)
    return [
        said("no limit") if math.isinf(value) else number(value) for value in (getattr(judged, name) for name in ROWS)
    ]
