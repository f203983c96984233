"""A gain schedule as source text, beside the controller of export.py: a table, a search, straight lines, gains."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from simc_core import checks
from simc_core.implementation.exports.program import UNITS, Statement, written
from simc_core.implementation.exports.structured_text import NOT_COMPILED, comment, literal
from simc_core.implementation.schedule_table import ScheduleTable
from simc_core.notation import number

COLUMNS = ("x_at", "band_at", "tau_I_at", "tau_D_at")
LOCAL = ("part", "band", "tau_I", "tau_D")
GAINS: tuple[Statement, ...] = (("Kp", "1.0/band"), ("Ki", "Kp/tau_I"), ("Kd", "Kp*tau_D"))


def export_schedule(table: ScheduleTable, language: str, unit: str = "s", single: bool = False) -> str:
    """What sets the gains of an exported controller from a scheduling value; call it before each sample.

    Parameters
    ----------
    table : ScheduleTable
        The settings.
    language : {"python", "c", "arduino", "st", "scl", "logix", "matlab", "modelica"}
        "c" and "arduino" are the same, behind the functions of the controller; "logix" is a routine before its own.
    unit : {"s", "min"}
        Time unit of the table.
    single : bool
        32-bit numbers in "st" and "scl"; "c" has those of the controller, "logix" no others.

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
    checks.one_of("language", language, WRITERS)
    checks.one_of("unit", unit, UNITS)
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
    return [indent + form.format(name=name, value=value) for name, value in _lines(at)]


def _lines(at: Callable[[str, str], str], part: str = "part") -> list[Statement]:
    return [
        (name, f"{at(column, 'i')} + {part}*({at(column, 'i + 1')} - {at(column, 'i')})")
        for name, column in zip(LOCAL[1:], COLUMNS[1:], strict=True)
    ]


def _part(at: Callable[[str, str], str], x: str = "x") -> str:
    return f"({x} - {at('x_at', 'i')})/({at('x_at', 'i + 1')} - {at('x_at', 'i')})"


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
    lines = [*comment(header), "FUNCTION_BLOCK FB_SimcSchedule"]
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


def _scl(table: ScheduleTable, header: list[str], single: bool) -> str:
    def at(name: str, row: str) -> str:
        return f"#{name}[{row.replace('i', '#i')}]"

    n, real, form = len(table.x), "Real" if single else "LReal", "    #{name} := {value};"
    lines = [*comment((*header, NOT_COMPILED.format("TIA Portal"))), 'FUNCTION_BLOCK "FB_SimcSchedule"']
    lines += ["{ S7_Optimized_Access := 'TRUE' }", "VERSION : 0.1"]
    lines += ["VAR_INPUT", f"    x : {real};", "END_VAR", "VAR_OUTPUT"]
    lines += [f"    {name} : {real};" for name in ("Kp", "Ki", "Kd")]
    lines += ["END_VAR", "VAR"]
    lines += [
        f"    {name} : Array[0..{n - 1}] of {real} := [{', '.join(map(literal, values))}];"
        for name, values in _columns(table).items()
    ]
    lines += ["END_VAR", "VAR_TEMP", *(f"    {name} : {real};" for name in LOCAL), "    i : Int;", "END_VAR", "BEGIN"]
    lines += ["    #i := 0;", f"    WHILE (#i < {n - 2}) AND (#x > #x_at[#i + 1]) DO", "        #i := #i + 1;"]
    lines += ["    END_WHILE;", f"    #part := LIMIT(MN := 0.0, IN := {_part(at, '#x')}, MX := 1.0);"]
    lines += [form.format(name=name, value=value) for name, value in _lines(at, "#part")]
    own = {name: f"#{name}" for name in ("band", "tau_I", "tau_D", "Kp", "Ki", "Kd")}
    return "\n".join([*lines, *written(GAINS, "    {name} := {value};", own), "END_FUNCTION_BLOCK", ""])


def _logix(table: ScheduleTable, header: list[str], single: bool) -> str:
    def at(name: str, row: str) -> str:
        return f"{name}[{row}]"

    n, form = len(table.x), "{name} := {value};"
    told = [
        *header,
        NOT_COMPILED.format("Studio 5000"),
        "Run it before the routine of the controller, whose gains it sets.",
    ]
    told += [f"REAL[{n}] tags: {', '.join(COLUMNS)}.", f"REAL tags: x, Kp, Ki, Kd, {', '.join(LOCAL)}."]
    told += ["DINT tags: i.", "BOOL tags: tabled; set tabled to 0 in the first scan."]
    lines = [*comment(told), "IF NOT tabled THEN"]
    lines += [
        f"    {name}[{i}] := {literal(value)};"
        for name, values in _columns(table).items()
        for i, value in enumerate(values)
    ]
    lines += ["    tabled := 1;", "END_IF;", "i := 0;", f"WHILE (i < {n - 2}) AND (x > x_at[i + 1]) DO"]
    lines += ["    i := i + 1;", "END_WHILE;", form.format(name="part", value=_part(at))]
    lines += ["IF part < 0.0 THEN", "    part := 0.0;", "END_IF;", "IF part > 1.0 THEN", "    part := 1.0;", "END_IF;"]
    return "\n".join([*lines, *_between(form, at, ""), *written(GAINS, form, {}), ""])


def _modelica(table: ScheduleTable, header: list[str], single: bool) -> str:
    def at(name: str, row: str) -> str:
        return f"{name}[{row}]"

    n, form = len(table.x), "{name} := {value};"
    lines = [*(f"// {line}" for line in header), "// Its outputs are the inputs Kp, Ki, Kd of SimcPid."]
    lines += ["block SimcSchedule", '  input Real x "scheduling value";']
    lines += [f"  output Real {name};" for name in ("Kp", "Ki", "Kd")]
    lines += ["protected"]
    lines += [
        f"  parameter Real {name}[{n}] = {{{', '.join(map(repr, values))}}};"
        for name, values in _columns(table).items()
    ]
    lines += [*(f"  Real {name};" for name in LOCAL), "  Integer i;", "algorithm", "  i := 1;"]
    lines += [f"  while i < {n - 1} and x > x_at[i + 1] loop", "    i := i + 1;", "  end while;"]
    lines += [f"  part := min(max({_part(at)}, 0.0), 1.0);", *_between(form, at, "  ")]
    return "\n".join([*lines, *written(GAINS, form, {}, "  "), "end SimcSchedule;", ""])


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
WRITERS: Mapping[str, Writer] = MappingProxyType(
    {
        "python": _python,
        "c": _c,
        "arduino": _c,
        "st": _st,
        "scl": _scl,
        "logix": _logix,
        "matlab": _matlab,
        "modelica": _modelica,
    }
)
