"""A gain schedule as source text, beside the controller of export.py: a table, a search, straight lines, gains."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from simc_core.errors import InvalidParameter
from simc_core.implementation.exports.program import Statement, written
from simc_core.implementation.exports.structured_text import literal
from simc_core.implementation.schedule_table import ScheduleTable
from simc_core.notation import number

COLUMNS = ("x_at", "band_at", "tau_I_at", "tau_D_at")
GAINS: tuple[Statement, ...] = (("Kp", "1.0/band"), ("Ki", "Kp/tau_I"), ("Kd", "Kp*tau_D"))


def export_schedule(table: ScheduleTable, language: str, unit: str = "s", single: bool = False) -> str:
    """What sets the gains of an exported controller from a scheduling value; call it before each sample.

    Parameters
    ----------
    table : ScheduleTable
        The settings.
    language : {"python", "c", "st", "matlab"}
        "c" is for Arduino too, behind the functions of the controller.
    unit : {"s", "min"}
        Time unit of the table.
    single : bool
        32-bit numbers in "st"; "c" has those of the controller.

    Returns
    -------
    str
        Source text.

    Examples
    --------
    >>> from simc_core import FirstOrderDelay, GainSchedule, ScheduleTable, SeriesPid, export, export_schedule
    >>> schedule = GainSchedule((20, 80), (FirstOrderDelay(1, 4, 20), FirstOrderDelay(5, 2, 8)), between="PB")
    >>> scope = {}
    >>> exec(export(SeriesPid(2.5, 20), "python", h=0.1) + export_schedule(ScheduleTable(schedule), "python"), scope)
    >>> pid = scope["Pid"]()
    >>> scope["schedule"](pid, 50.0)
    >>> round(pid.Kp, 6)
    0.689655
    """
    if language not in WRITERS:
        raise InvalidParameter(f"language must be one of {', '.join(WRITERS)} for a schedule, found {language!r}")
    if unit not in ("s", "min"):
        raise InvalidParameter(f"unit must be s or min, found {unit!r}")
    return WRITERS[language](table, _header(table, unit), single)


def _header(table: ScheduleTable, unit: str) -> list[str]:
    return [
        f"Gain schedule of {len(table.x)} rows, times in {unit}: band = 1/Kp, tau_I, tau_D of the ideal form",
        f"one filter for all of them, tau_F = {table.tau_F!r} {unit}",
        f"largest Ms between the rows {number(table.worst_Ms())}".replace("∞", "infinite: not stable"),
        "Schedule on set point or load rather than PV; filter it, and limit its rate.",
    ]


def _columns(table: ScheduleTable) -> dict[str, tuple[float, ...]]:
    return dict(zip(COLUMNS, (table.x, table.band, table.tau_I, table.tau_D), strict=True))


def _between(form: str, at: Callable[[str, str], str], indent: str) -> list[str]:
    """Straight lines: part of the way from row i to the next, at(name, row)."""
    return [
        indent + form.format(name=name, value=f"{at(column, 'i')} + part*({at(column, 'i + 1')} - {at(column, 'i')})")
        for name, column in zip(("band", "tau_I", "tau_D"), COLUMNS[1:], strict=True)
    ]


def _part(at: Callable[[str, str], str]) -> str:
    return f"(x - {at('x_at', 'i')})/({at('x_at', 'i + 1')} - {at('x_at', 'i')})"


def _python(table: ScheduleTable, header: list[str], single: bool) -> str:
    def at(name: str, row: str) -> str:
        return f"{name}[{row}]"

    form = "{name} = {value}"
    lines = ["", "", "def schedule(pid, x):", '    """', *(f"    {line}" for line in header), '    """']
    lines += [f"    {name} = ({', '.join(map(repr, values))})" for name, values in _columns(table).items()]
    lines += ["    i = 0", f"    while i < {len(table.x) - 2} and x > x_at[i + 1]:", "        i = i + 1"]
    lines += [f"    part = min(max({_part(at)}, 0.0), 1.0)", *_between(form, at, " " * 4)]
    return "\n".join([*lines, *written(GAINS, form, _of("pid."), " " * 4), ""])


def _c(table: ScheduleTable, header: list[str], single: bool) -> str:
    def at(name: str, row: str) -> str:
        return f"{name}[{row}]"

    n, form = len(table.x), "{name} = {value};"
    lines = ["", "/*", *(f" * {line}" for line in header), " */", "void pid_schedule(Pid *pid, PID_REAL x)", "{"]
    lines += [
        f"    static const PID_REAL {name}[{n}] = {{{', '.join(map(repr, values))}}};"
        for name, values in _columns(table).items()
    ]
    lines += ["    int i = 0;", "    PID_REAL part, band, tau_I, tau_D;"]
    lines += [f"    while (i < {n - 2} && x > x_at[i + 1]) i = i + 1;", f"    part = {_part(at)};"]
    lines += ["    part = part < 0.0 ? 0.0 : part > 1.0 ? 1.0 : part;", *_between(form, at, " " * 4)]
    return "\n".join([*lines, *written(GAINS, form, _of("pid->"), " " * 4), "}", ""])


def _st(table: ScheduleTable, header: list[str], single: bool) -> str:
    def at(name: str, row: str) -> str:
        return f"{name}[{row}]"

    n, real, form = len(table.x), "REAL" if single else "LREAL", "{name} := {value};"
    lines = ["(*", *(f"   {line}" for line in header), "*)", "FUNCTION_BLOCK FB_SimcSchedule"]
    lines += ["VAR_INPUT", f"    x : {real}; (* scheduling value *)", "END_VAR", "VAR_OUTPUT"]
    lines += [f"    {name} : {real};" for name in ("Kp", "Ki", "Kd")]
    lines += ["END_VAR", "VAR"]
    lines += [
        f"    {name} : ARRAY[0..{n - 1}] OF {real} := [{', '.join(map(literal, values))}];"
        for name, values in _columns(table).items()
    ]
    lines += [f"    part, band, tau_I, tau_D : {real};", "    i : INT;", "END_VAR", "", "i := 0;"]
    lines += [f"WHILE (i < {n - 2}) AND (x > x_at[i + 1]) DO", "    i := i + 1;", "END_WHILE;"]
    lines += [f"part := LIMIT(0.0, {_part(at)}, 1.0);", *_between(form, at, "")]
    return "\n".join([*lines, *written(GAINS, form, {}), "END_FUNCTION_BLOCK", ""])


def _matlab(table: ScheduleTable, header: list[str], single: bool) -> str:
    def at(name: str, row: str) -> str:
        return f"{name}({row})"

    form = "{name} = {value};"
    lines = ["function pid = simc_schedule(pid, x)", *(f"% {line}" for line in header)]
    lines += [f"{name} = [{', '.join(map(repr, values))}];" for name, values in _columns(table).items()]
    lines += ["i = 1;", f"while i < {len(table.x) - 1} && x > x_at(i + 1)", "    i = i + 1;", "end"]
    lines += [f"part = min(max({_part(at)}, 0), 1);", *_between(form, at, "")]
    return "\n".join([*lines, *written(GAINS, form, _of("pid.")), "end", ""])


def _of(prefix: str) -> dict[str, str]:
    return {name: f"{prefix}{name}" for name, _ in GAINS}


Writer = Callable[[ScheduleTable, list[str], bool], str]
WRITERS: Mapping[str, Writer] = MappingProxyType({"python": _python, "c": _c, "st": _st, "matlab": _matlab})
