"""The controller of a design as source text in a language. Pure: no streamlit."""

import re
from collections.abc import Mapping
from datetime import date
from fractions import Fraction
from types import MappingProxyType
from typing import NamedTuple

from pages.common.session.design import Design
from pages.common.session.sheet import Sheet
from pages.common.take_home.typed import seconds_of
from simc_core import export
from simc_core.controllers.forms import Controller
from simc_core.wording import said

NOT_IN_COMMENTS = re.compile(r"[^\w .,:+/%°-]")


class Language(NamedTuple):
    """title: on the page.   file: its name.   colours: for st.code, None for plain text.   compiled: here."""

    title: str
    file: str
    colours: str | None
    compiled: bool = True


LANGUAGES: Mapping[str, Language] = MappingProxyType(
    {
        "python": Language("Python", "simc_pid.py", "python"),
        "c": Language("C99", "simc_pid.c", "c"),
        "arduino": Language("Arduino", "simc_pid.ino", "arduino"),
        "st": Language(said("IEC 61131-3 Structured Text"), "FB_SimcPid.st", "pascal"),
        "scl": Language("Siemens SCL", "FB_SimcPid.scl", "pascal", compiled=False),
        "logix": Language("Rockwell Logix", "simc_pid_routine.txt", "pascal", compiled=False),
        "matlab": Language("MATLAB, Octave", "simc_pid.m", "matlab"),
        "python-control": Language("python-control", "simc_margins.py", "python"),
        "modelica": Language("Modelica", "SimcPid.mo", None),
    }
)


def written(design: Design, controller: Controller, made_from: Controller) -> str:
    """The controller, in seconds or minutes. made_from: the design behind it. Raises SimcError."""
    minutes = design.sheet.time_unit == "min"
    unit, seconds = ("min", Fraction(1)) if minutes else ("s", seconds_of(design.sheet))
    low, high = limits(design)
    given = {"u_min": low, "u_max": high}
    h, T_t = (None if time is None else time * seconds for time in (design.actuator.h, design.actuator.tracking_time))
    return export(
        controller.rescaled(seconds),
        design.home.language,
        h,
        design.actuator.law,
        **{name: value for name, value in given.items() if value is not None},
        tracking_time=T_t,
        plant=design.plant.rescaled(seconds),
        unit=unit,
        date=date.today().isoformat(),
        design=made_from.rescaled(seconds),
        about=about(design.sheet),
        delay_scans=design.actuator.delay_scans,
    )


def limits(design: Design) -> tuple[float | None, float | None]:
    """Limits of the output on its own scale, None for none: those of the actuator, else its range."""
    sheet, actuator = design.sheet, design.actuator
    found = []
    for limit, end in ((actuator.u_min, sheet.OP_low), (actuator.u_max, sheet.OP_high)):
        placed = limit is not None and (sheet.OP_now is not None or end is None)
        found.append(sheet.on_scale(limit) if placed else end)
    return found[0], found[1]


def about(sheet: Sheet) -> str:
    """Tag and units, without what could end a comment."""
    named = {"loop": sheet.tag, "PV in": sheet.PV_unit, "output in": sheet.OP_unit}
    return NOT_IN_COMMENTS.sub(" ", ", ".join(f"{name} {text}" for name, text in named.items() if text))
