"""A function for MATLAB and Octave."""

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

NAMES = {name: f"pid.{name}" for name in (*SETTINGS, *STATE)}
FORM = "{name} = {value};"


def matlab(program: Program) -> str:
    """simc_pid.m: pid = simc_pid() is a controller, pid = simc_pid(pid, r, y) one sample, with the output in pid.u."""
    values = [
        f"    pid.{name} = {program.values[name]!r};" + (f"  % {MEANING[name]}" if MEANING[name] else "")
        for name in SETTINGS
    ]
    lines = ["function pid = simc_pid(pid, r, y, manual, u_manual, u_ff)", *(f"% {line}" for line in program.header)]
    lines += ["% pid = simc_pid() is a controller; pid = simc_pid(pid, r, y) is one sample, its output pid.u"]
    lines += ["if nargin == 0", *values, "    pid.started = false;", "    return", "end"]
    lines += [
        "if nargin < 4",
        "    manual = false;",
        "    u_manual = 0;",
        "end",
        "if nargin < 6",
        "    u_ff = 0;",
        "end",
    ]
    lines += ["if ~pid.started", *written(START, FORM, NAMES, " " * 4), "    pid.started = true;", "end"]
    lines += written((*GAINS, *program.filters), FORM, NAMES)
    lines += ["if manual", "    pid.u = min(max(u_manual, pid.u_min), pid.u_max);"]
    lines += [*written(MANUAL, FORM, NAMES, " " * 4), "else", *written(program.automatic, FORM, NAMES, " " * 4)]
    return "\n".join([*lines, "    pid.u = min(max(pid.v, pid.u_min), pid.u_max);", "end", "end", ""])
