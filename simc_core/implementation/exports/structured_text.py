"""A function block in Structured Text of IEC 61131-3."""

from collections.abc import Iterable

from simc_core.implementation.exports.program import (
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
CHANGEABLE = ("Kp", "Ki", "Kd", "u_min", "u_max")  # inputs: may be written at any time


def structured_text(program: Program) -> str:
    """FUNCTION_BLOCK FB_SimcPid, in LREAL, or REAL."""
    real = "REAL" if program.single else "LREAL"

    def declared(names: Iterable[str]) -> list[str]:
        return [
            f"    {name} : {real} := {_literal(program.values[name])};"
            + (f" (* {MEANING[name]} *)" if MEANING[name] else "")
            for name in names
        ]

    lines = ["(*", *(f"   {line}" for line in program.header), "*)", "FUNCTION_BLOCK FB_SimcPid", "VAR_INPUT"]
    lines += [f"    r : {real}; (* set point *)", f"    y : {real}; (* measurement *)", "    manual : BOOL;"]
    lines += [f"    u_manual : {real};", f"    u_ff : {real}; (* added before the limits *)", *declared(CHANGEABLE)]
    lines += ["END_VAR", "VAR_OUTPUT", f"    u : {real};", "END_VAR", "VAR"]
    lines += declared(name for name in SETTINGS if name not in CHANGEABLE)
    lines += [f"    {name} : {real};" for name in (*STATE[:-1], *program.local)]
    lines += ["    started : BOOL;", "END_VAR", ""]
    lines += ["IF NOT started THEN", *written(START, FORM, {}, " " * 4), "    started := TRUE;", "END_IF;"]
    lines += written((*GAINS, *program.filters), FORM, {})
    lines += ["IF manual THEN", "    u := LIMIT(u_min, u_manual, u_max);", *written(MANUAL, FORM, {}, " " * 4), "ELSE"]
    lines += [*written(program.automatic, FORM, {}, " " * 4), "    u := LIMIT(u_min, v, u_max);", "END_IF;"]
    return "\n".join([*lines, "END_FUNCTION_BLOCK", ""])


def _literal(value: float) -> str:
    """A constant with a decimal point, as the standard wants it."""
    text = repr(float(value)).upper()
    if "E" in text and "." not in text:
        text = text.replace("E", ".0E")
    return text
