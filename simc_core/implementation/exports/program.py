"""What all languages say: the law as statements, the numbers in it, and the header above.

A statement is a name and an expression of + - * / and brackets, which every language here reads alike. The law is that
of controllers/discrete.py; around it come what a running program needs:

    gains changed on line   I takes up what Kp had said, so that u goes on from where it is
    manual                  I follows u_manual, so that u goes on from there when it ends
    u_ff                    is added before the limits
"""

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

from simc_core import checks
from simc_core.controllers.discrete import law_for, scans
from simc_core.controllers.forms import Controller, ParallelPid
from simc_core.controllers.tracking import tracking_time as usual_tracking_time
from simc_core.errors import InvalidParameter
from simc_core.implementation.sampled_margins import sampled_margins
from simc_core.loops.loop import Loop
from simc_core.notation import number, plain
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins import margins
from simc_core.wording import said

UNITS = ("s", "min")
NO_LIMIT = 1e38  # what stands for an infinite limit: within the range of single precision
INPUTS = ("r", "y", "u_manual", "u_ff")
SETTINGS = ("Kp", "Ki", "Kd", "b", "c", "h", "a", "g", "pull", "u_min", "u_max")
CHANGEABLE = ("Kp", "Ki", "Kd", "u_min", "u_max")  # may be written at any time
STATE = ("Kp_before", "y_before", "r_before", "yF", "rF", "dy", "dr", "I", "v", "u")
MEANING = {
    "Kp": "gain",
    "Ki": "integral gain, 1/time",
    "Kd": "derivative gain, time",
    "b": "set-point weight of P",
    "c": "set-point weight of D",
    "h": "sampling period",
    "a": "of the filter",
    "g": "of the filter",
    "pull": "h/tracking time",
    "u_min": "limits of u",
    "u_max": "",
}
Statement = tuple[str, str]

START: tuple[Statement, ...] = (
    ("Kp_before", "Kp"),
    ("y_before", "y"),
    ("r_before", "r"),
    ("yF", "y"),
    ("rF", "r"),
    ("dy", "0.0"),
    ("dr", "0.0"),
    ("I", "0.0"),
    ("v", "0.0"),
    ("u", "0.0"),
)
GAINS: tuple[Statement, ...] = (("I", "I + (Kp_before - Kp)*(b*rF - yF)"), ("Kp_before", "Kp"))
FILTERS: dict[str, tuple[Statement, ...]] = {
    "backward": (
        ("y_before", "yF"),
        ("r_before", "rF"),
        ("yF", "a*yF + (1.0 - a)*y"),
        ("rF", "a*rF + (1.0 - a)*r"),
        ("dy", "(yF - y_before)/h"),
        ("dr", "(rF - r_before)/h"),
    ),
    "tustin": (
        ("e_before", "rF - yF"),
        ("yF", "a*yF + g*(y + y_before)"),
        ("rF", "a*rF + g*(r + r_before)"),
        ("dy", "a*dy + 2.0*g/h*(y - y_before)"),
        ("dr", "a*dr + 2.0*g/h*(r - r_before)"),
        ("y_before", "y"),
        ("r_before", "r"),
    ),
    "tustin, no filter": (("e_before", "rF - yF"), ("yF", "y"), ("rF", "r"), ("dy", "0.0"), ("dr", "0.0")),
}
INTEGRAL: dict[str, Statement] = {
    "backward": ("I", "I + h*Ki*(rF - yF) + pull*(u - v)"),
    "tustin": ("I", "I + h/2.0*Ki*(rF - yF + e_before) + pull*(u - v)"),
}
OUTPUT: Statement = ("v", "Kp*(b*rF - yF) + I + Kd*(c*dr - dy) + u_ff")
MANUAL: tuple[Statement, ...] = (("v", "u"), ("I", "u - u_ff - Kp*(b*rF - yF)"))
REMARK = re.compile(r"[\w .,:+/%°-]{0,200}")  # nothing that could end a comment


@dataclass(frozen=True, slots=True)
class Program:
    """What is written down, in any language.

    header: lines without comment signs.   values: of SETTINGS.   law, filtered: which statements.   plant: None if
    it is not known.   single: numbers of 32 bits where the language has them.
    """

    header: tuple[str, ...]
    values: dict[str, float]
    law: str
    filtered: bool
    pid: ParallelPid
    h: float
    unit: str
    plant: Plant | None
    single: bool

    @property
    def filters(self) -> tuple[Statement, ...]:
        """Statements of the filters and the slopes."""
        return FILTERS["tustin, no filter" if self.law == "tustin" and not self.filtered else self.law]

    @property
    def automatic(self) -> tuple[Statement, ...]:
        """Statements of I and v."""
        return INTEGRAL[self.law], OUTPUT

    @property
    def local(self) -> tuple[str, ...]:
        """Names that are needed within one sample only."""
        return ("e_before",) if self.law == "tustin" else ()


def program(
    controller: Controller,
    h: float,
    law: str,
    u_min: float,
    u_max: float,
    tracking_time: float | None,
    plant: Plant | None,
    unit: str,
    date: str,
    single: bool,
    design: Controller | None,
    about: str,
    delay_scans: int,
) -> Program:
    """The checked program. Raises InvalidParameter."""
    pid, h = controller.to_parallel(), checks.positive_time("h", h)
    law_for(law, pid, h)
    u_min, u_max = _limits(u_min, u_max)
    if tracking_time is not None and tracking_time != math.inf:
        tracking_time = checks.positive_time("tracking_time", tracking_time)
    checks.one_of("unit", unit, UNITS)
    for name, text in (("date", date), ("about", about)):
        if not REMARK.fullmatch(text):
            raise InvalidParameter(
                said(
                    "{name} may have letters, digits, blanks and . , : + / % ° -, found {text!r}",
                    name=name,
                    text=text[:40],
                )
            )
    if tracking_time is None and not pid.Kp and plant is None:
        raise InvalidParameter(said("tracking_time or plant must be given for pure integral action, found neither"))
    k, integrators = (plant.k, plant.integrators) if plant else (1.0, 0)
    T_t = tracking_time or usual_tracking_time(controller, k, integrators)
    filters = {"backward": (pid.tau_F / (pid.tau_F + h), 0.0)}
    filters["tustin"] = ((2 * pid.tau_F - h) / (2 * pid.tau_F + h), h / (2 * pid.tau_F + h))
    values = dict(zip(SETTINGS, (pid.Kp, pid.Ki, pid.Kd, pid.b, pid.c, h, *filters[law]), strict=False))
    values |= {"pull": min(h / T_t, 1.0), "u_min": u_min, "u_max": u_max}
    late = scans("delay_scans", delay_scans)
    header = _header(controller, h, law, plant, unit, date, design or controller, about, late)
    return Program(header, values, law, pid.tau_F > 0, pid, h, unit, plant, single)


def _limits(u_min: float, u_max: float) -> tuple[float, float]:
    """Limits on the output's own scale, where 0 need not be between them: 4 to 20 mA."""
    low = -NO_LIMIT if u_min == -math.inf else checks.real("u_min", u_min, -NO_LIMIT, NO_LIMIT)
    high = NO_LIMIT if u_max == math.inf else checks.real("u_max", u_max, -NO_LIMIT, NO_LIMIT)
    if not low < high:
        raise InvalidParameter(said("u_max must be > u_min = {low:g}, found {high:g}", low=low, high=high))
    return low, high


def _header(
    controller: Controller,
    h: float,
    law: str,
    plant: Plant | None,
    unit: str,
    date: str,
    design: Controller,
    about: str,
    delay_scans: int,
) -> tuple[str, ...]:
    lines = [f"PID controller, law {law}, called every h = {h!r} {unit}"]
    lines += [f"for     {about}"] if about else []
    lines += [f"design  {design!r}"]
    lines += [f"typed   {controller!r}"] if controller != design else []
    lines += [f"time    in {unit}; gains in units of output over units of PV"]
    if plant:
        loop = Loop(plant, controller)
        peaks = {"as designed": margins(Loop(plant, design)).Ms}
        peaks |= {"as typed": margins(loop).Ms} if controller != design else {}
        late = f", the output written {delay_scans} scan{'s' * (delay_scans > 1)} later" if delay_scans else ""
        peaks |= {f"sampled{late}": sampled_margins(loop, h, law, delay_scans).Ms}
        lines += [f"plant   {plain(plant)}"]
        lines += ["Ms      " + ", ".join(f"{number(Ms)} {which}" for which, Ms in peaks.items())]
    lines += [f"made    {date} by SIMC" if date else "made by SIMC"]
    lines += ["Start it in manual with u_manual = the output the plant is at.", "Gains may be changed at any time."]
    return tuple(line.replace("–", "not stable") for line in lines)


def rewritten(expression: str, names: dict[str, str]) -> str:
    """`expression` with its names replaced."""
    return re.sub(r"[A-Za-z_]\w*", lambda found: names.get(found[0], found[0]), expression)


def written(statements: Iterable[Statement], form: str, names: dict[str, str], indent: str = "") -> list[str]:
    """Lines of `form`, a format of {name} and {value}."""
    return [
        indent + form.format(name=names.get(name, name), value=rewritten(value, names)) for name, value in statements
    ]
