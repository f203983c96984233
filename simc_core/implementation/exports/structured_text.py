"""Structured Text of IEC 61131-3: a function block; and the same body as SCL and as a Logix routine."""

from collections.abc import Callable, Iterable

from simc_core.implementation.exports.program import (
    CHANGEABLE,
    GAINS,
    MANUAL,
    MEANING,
    SETTINGS,
    START,
    STATE,
    Program,
    written,
)

FORM = "{name} := {value};"
NOT_COMPILED = "NOT COMPILED: no {} was at hand. Check it there before use."
OTHERS = ("r", "y", "manual", "started", "u_manual", "u_ff", "e_before")
OF_SIEMENS = {name: f"#{name}" for name in (*SETTINGS, *STATE, *OTHERS)}


def structured_text(program: Program) -> str:
    """FUNCTION_BLOCK FB_SimcPid, in LREAL, or REAL."""
    lines = [*comment(program.header), "FUNCTION_BLOCK FB_SimcPid", *_declarations(program, "REAL", "LREAL"), ""]
    return "\n".join([*lines, *_body(program, {}, _by_function), "END_FUNCTION_BLOCK", ""])


def scl(program: Program) -> str:
    """The block as an external source for TIA Portal."""
    lines = [*comment((*program.header, NOT_COMPILED.format("TIA Portal"))), 'FUNCTION_BLOCK "FB_SimcPid"']
    lines += ["{ S7_Optimized_Access := 'TRUE' }", "VERSION : 0.1", *_declarations(program, "Real", "LReal"), "BEGIN"]
    return "\n".join([*lines, *_body(program, OF_SIEMENS, _siemens_limit), "END_FUNCTION_BLOCK", ""])


def logix(program: Program) -> str:
    """A routine without declarations, which Logix keeps apart, and without functions, which it does not have."""
    tags = ("r", "y", "u_manual", "u_ff", *SETTINGS, *STATE, *program.local)
    header = [*program.header, NOT_COMPILED.format("Studio 5000"), "Call it every h in a periodic task."]
    header += [f"REAL tags: {', '.join(tags)}.", "BOOL tags: manual, started; set started to 0 in the first scan."]
    settings = [f"    {name} := {literal(program.values[name])};" for name in SETTINGS]
    return "\n".join([*comment(header), *_body(program, {}, _by_comparing, settings), ""])


def comment(lines: Iterable[str]) -> list[str]:
    """A comment of these lines."""
    return ["(*", *(f"   {line}" for line in lines), "*)"]


def _declarations(program: Program, single: str, double: str) -> list[str]:
    real = single if program.single else double

    def declared(names: Iterable[str]) -> list[str]:
        return [
            f"    {name} : {real} := {literal(program.values[name])};"
            + (f" (* {MEANING[name]} *)" if MEANING[name] else "")
            for name in names
        ]

    lines = [
        "VAR_INPUT",
        f"    r : {real}; (* set point *)",
        f"    y : {real}; (* measurement *)",
        "    manual : BOOL;",
    ]
    lines += [f"    u_manual : {real};", f"    u_ff : {real}; (* added before the limits *)", *declared(CHANGEABLE)]
    lines += ["END_VAR", "VAR_OUTPUT", f"    u : {real};", "END_VAR", "VAR"]
    lines += declared(name for name in SETTINGS if name not in CHANGEABLE)
    lines += [f"    {name} : {real};" for name in (*STATE[:-1], *program.local)]
    return [*lines, "    started : BOOL;", "END_VAR"]


def _body(
    program: Program, names: dict[str, str], limited: Callable[[str], list[str]], first: Iterable[str] = ()
) -> list[str]:
    """limited: lines that put a value between the limits into u.   first: lines of the first call."""
    started, manual = (names.get(name, name) for name in ("started", "manual"))
    lines = [f"IF NOT {started} THEN", *first, *written(START, FORM, names, " " * 4), f"    {started} := TRUE;"]
    lines += ["END_IF;", *written((*GAINS, *program.filters), FORM, names)]
    lines += [f"IF {manual} THEN", *limited("u_manual"), *written(MANUAL, FORM, names, " " * 4), "ELSE"]
    return [*lines, *written(program.automatic, FORM, names, " " * 4), *limited("v"), "END_IF;"]


def _by_function(name: str) -> list[str]:
    return [f"    u := LIMIT(u_min, {name}, u_max);"]


def _siemens_limit(name: str) -> list[str]:
    return [f"    #u := LIMIT(MN := #u_min, IN := #{name}, MX := #u_max);"]


def _by_comparing(name: str) -> list[str]:
    lines = [f"    u := {name};"]
    for sign, limit in (("<", "u_min"), (">", "u_max")):
        lines += [f"    IF u {sign} {limit} THEN", f"        u := {limit};", "    END_IF;"]
    return lines


def literal(value: float) -> str:
    """A constant with a decimal point, as the standard wants it."""
    text = repr(float(value)).upper()
    if "E" in text and "." not in text:
        text = text.replace("E", ".0E")
    return text
