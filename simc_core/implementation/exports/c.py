"""C99: a struct and two functions; and the same in an Arduino sketch."""

import math
from collections.abc import Iterable

from simc_core.errors import InvalidParameter
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
from simc_core.implementation.single_precision import dead_error
from simc_core.wording import said

NAMES = {name: f"pid->{name}" for name in (*SETTINGS, *STATE)}
FORM = "{name} = {value};"
LONGEST_PERIOD = 4000.0  # seconds that micros() can measure


def c(program: Program) -> str:
    """`pid_init` and `pid_step`. Numbers are of type PID_REAL, double unless it is defined as float."""
    return "\n".join([*_comment(program.header), "", *_functions(program), ""])


def arduino(program: Program) -> str:
    """A sketch. Raises InvalidParameter: no limits, a period that micros() cannot measure."""
    seconds = program.h * {"s": 1.0, "min": 60.0}[program.unit]
    u_min, u_max = program.values["u_min"], program.values["u_max"]
    if not -1e30 < u_min < u_max < 1e30:
        raise InvalidParameter(said("u_min and u_max must be given for an Arduino, which has to scale its output"))
    if not 1e-4 <= seconds <= LONGEST_PERIOD:
        raise InvalidParameter(
            said(
                "h must be from 0.0001 to {longest_period:g} s for an Arduino, found {seconds:g} s",
                longest_period=LONGEST_PERIOD,
                seconds=seconds,
            )
        )
    dead = dead_error(max(abs(u_min), abs(u_max)), program.pid.Ki, program.h, single=True)
    header = [*program.header, "double has 32 bits on an AVR: with I at its largest an error below"]
    header += [f"{dead:.2g} does not move the integral any more"] if math.isfinite(dead) else ["nothing is integrated"]
    return "\n".join([*_comment(header), "", *_functions(program), "", *_sketch(seconds), ""])


def _comment(lines: Iterable[str]) -> list[str]:
    return ["/*", *(f" * {line}" for line in lines), " */"]


def _functions(program: Program) -> list[str]:
    values = [
        f"    pid->{name} = {_literal(program.values[name])};" + (f"  /* {MEANING[name]} */" if MEANING[name] else "")
        for name in SETTINGS
    ]
    limited = "{0} < pid->u_min ? pid->u_min : {0} > pid->u_max ? pid->u_max : {0}"
    lines = ["#ifndef PID_REAL", f"#define PID_REAL {'float' if program.single else 'double'}", "#endif", ""]
    lines += ["typedef struct {", f"    PID_REAL {', '.join(SETTINGS)};", f"    PID_REAL {', '.join(STATE)};"]
    lines += ["    int started;", "} Pid;", ""]
    lines += ["void pid_init(Pid *pid)", "{", *values]
    lines += [*written(((name, "0.0") for name in STATE), FORM, NAMES, " " * 4)]
    lines += ["    pid->started = 0;", "}", ""]
    lines += ["/* One sample: set point r and measurement y, returns the output u. */"]
    lines += ["PID_REAL pid_step(Pid *pid, PID_REAL r, PID_REAL y, int manual, PID_REAL u_manual, PID_REAL u_ff)", "{"]
    lines += [f"    PID_REAL {name};" for name in program.local]
    lines += ["    if (!pid->started) {", *written(START, FORM, NAMES, " " * 8), "        pid->started = 1;", "    }"]
    lines += written((*GAINS, *program.filters), FORM, NAMES, " " * 4)
    lines += ["    if (manual) {", f"        pid->u = {limited.format('u_manual')};"]
    lines += [*written(MANUAL, FORM, NAMES, " " * 8), "    } else {"]
    lines += [*written(program.automatic, FORM, NAMES, " " * 8), f"        pid->u = {limited.format('pid->v')};"]
    return [*lines, "    }", "    return pid->u;", "}"]


def _literal(value: float) -> str:
    """A double constant."""
    return repr(float(value))


def _sketch(seconds: float) -> list[str]:
    return [
        "/* To be set: pins, range of the measurement, set point. */",
        "const int PIN_Y = A0, PIN_U = 9;",
        "const double PV_LOW = 0.0, PV_HIGH = 100.0;",
        "double set_point = 0.0;",
        f"const uint32_t PERIOD = {round(seconds * 1e6)}UL;  /* microseconds */",
        "uint32_t last;",
        "Pid pid;",
        "",
        "void setup() {",
        "    pid_init(&pid);",
        "    last = micros();",
        "}",
        "",
        "void loop() {",
        "    if ((uint32_t)(micros() - last) < PERIOD) return;",
        "    last += PERIOD;",
        "    double y = PV_LOW + (PV_HIGH - PV_LOW) * analogRead(PIN_Y) / 1023.0;",
        "    double u = pid_step(&pid, set_point, y, 0, 0.0, 0.0);",
        "    analogWrite(PIN_U, (int)(255.0 * (u - pid.u_min) / (pid.u_max - pid.u_min) + 0.5));",
        "}",
    ]
