"""The controller as source text in a language."""

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType

from simc_core import checks
from simc_core.controllers.forms import Controller
from simc_core.implementation.exports.c import arduino, c
from simc_core.implementation.exports.matlab import matlab
from simc_core.implementation.exports.modelica import modelica
from simc_core.implementation.exports.program import Program, program
from simc_core.implementation.exports.python import python
from simc_core.implementation.exports.python_control import python_control
from simc_core.implementation.exports.structured_text import logix, scl, structured_text
from simc_core.plants.plant import Plant

LANGUAGES: Mapping[str, Callable[[Program], str]] = MappingProxyType(
    {
        "python": python,
        "c": c,
        "st": structured_text,
        "scl": scl,
        "logix": logix,
        "matlab": matlab,
        "python-control": python_control,
        "arduino": arduino,
        "modelica": modelica,
    }
)


def export(
    controller: Controller,
    language: str,
    h: float,
    law: str = "backward",
    u_min: float = -math.inf,
    u_max: float = math.inf,
    tracking_time: float | None = None,
    plant: Plant | None = None,
    unit: str = "s",
    date: str = "",
    single: bool = False,
    design: Controller | None = None,
    about: str = "",
    delay_scans: int = 0,
) -> str:
    """The sampled controller as source text; it does what `simulate` does with the same h and law.

    Parameters
    ----------
    controller : SeriesPid, IdealPid, ParallelPid or IController
        What is written down.
    language : {"python", "c", "st", "scl", "logix", "matlab", "python-control", "arduino", "modelica"}
        "st" is Structured Text of IEC 61131-3, "scl" and "logix" are its dialects of Siemens and Rockwell, "matlab" is
        for Octave too, "python-control" a script with the margins.
    h : float
        Sampling period, in the time unit of the controller.
    law : {"backward", "tustin"}
        See controllers/discrete.py.
    u_min, u_max : float
        Limits of the output, on its own scale.
    tracking_time : float, optional
        Of the anti-windup. None: the usual one, sqrt(tau_I tau_D), or tau_I without derivative action.
    plant : Plant, optional
        For Ms in the header, and for the languages that simulate the loop.
    unit : {"s", "min"}
        Time unit of the controller.
    date : str
        For the header.
    single : bool
        32-bit numbers, in "c", "st" and "scl"; "logix" has no others here.
    design : Controller, optional
        What `controller` was made from, where that is read back from a box: the header tells both.
    about : str
        A line for the header: the tag of the loop, the units of PV and output.
    delay_scans : int
        Sampling periods after which the output reaches the plant, for Ms in the header; the program itself is the same.

    Returns
    -------
    str
        Source text.

    Raises
    ------
    InvalidParameter
        A number is beyond its bounds, or something is missing that the language needs.

    Examples
    --------
    >>> from simc_core import SeriesPid, export
    >>> scope = {}
    >>> exec(export(SeriesPid(4, 8), "python", h=0.1), scope)
    >>> pid = scope["Pid"]()
    >>> round(pid.step(r=1.0, y=0.0), 6)  # Kc (1 + h/tau_I)
    4.05
    """
    return LANGUAGES[checks.one_of("language", language, LANGUAGES)](
        program(controller, h, law, u_min, u_max, tracking_time, plant, unit, date, single, design, about, delay_scans)
    )
