"""A class in Python."""

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

NAMES = {name: f"self.{name}" for name in (*SETTINGS, *STATE)}
FORM = "{name} = {value}"


def python(program: Program) -> str:
    """A class `Pid` with `step(r, y)`."""
    settings = [
        f"        self.{name} = {program.values[name]!r}" + (f"  # {MEANING[name]}" if MEANING[name] else "")
        for name in SETTINGS
    ]
    lines = ['"""', *program.header, '"""', "", "", "class Pid:", "    def __init__(self):", *settings]
    lines += ["        self.started = False", ""]
    lines += ["    def step(self, r, y, manual=False, u_manual=0.0, u_ff=0.0):"]
    lines += ['        """One sample: set point r and measurement y, returns the output u."""']
    lines += ["        if not self.started:", *written(START, FORM, NAMES, " " * 12), "            self.started = True"]
    lines += written((*GAINS, *program.filters), FORM, NAMES, " " * 8)
    lines += ["        if manual:", "            self.u = min(max(u_manual, self.u_min), self.u_max)"]
    lines += written(MANUAL, FORM, NAMES, " " * 12)
    lines += ["        else:", *written(program.automatic, FORM, NAMES, " " * 12)]
    lines += ["            self.u = min(max(self.v, self.u_min), self.u_max)", "        return self.u", ""]
    return "\n".join(lines)
