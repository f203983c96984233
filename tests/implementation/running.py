"""Exported controllers made to run here: Python as it is, C by gcc, MATLAB by Octave, the others by lines
that read their syntax.

Each runner has step(r, y, manual, u_manual, u_ff) -> u, and gains that can be set.
"""

import ctypes
import re
import subprocess
from functools import cache
from itertools import count

from simc_core import export


class Python:
    def __init__(self, text, folder):
        scope = {}
        exec(compile(text, "pid.py", "exec"), scope)
        self.pid = scope["Pid"]()

    def set(self, **gains):
        vars(self.pid).update(gains)

    def step(self, r, y, manual=False, u_manual=0.0, u_ff=0.0):
        return self.pid.step(r, y, manual, u_manual, u_ff)


class C:
    REAL = "double"

    def __init__(self, text, folder):
        source, library = folder / "pid.c", folder / "pid.so"
        source.write_text(text)
        flags = ["-std=c99", "-Wall", "-Wextra", "-Wshadow", "-pedantic", "-Werror", "-O2", f"-DPID_REAL={self.REAL}"]
        subprocess.run(["gcc", *flags, "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
        real = {"double": ctypes.c_double, "float": ctypes.c_float}[self.REAL]
        names = re.search(r"struct \{(.*?)int started", text, re.DOTALL)[1]
        fields = [(name, real) for name in re.findall(r"\w+", names) if name != "PID_REAL"]
        self.pid = type("Pid", (ctypes.Structure,), {"_fields_": [*fields, ("started", ctypes.c_int)]})()
        self.library = ctypes.CDLL(str(library))
        self.library.pid_step.restype = real
        self.library.pid_step.argtypes = [ctypes.c_void_p, real, real, ctypes.c_int, real, real]
        self.library.pid_init(ctypes.byref(self.pid))

    def set(self, **gains):
        for name, value in gains.items():
            setattr(self.pid, name, value)

    def step(self, r, y, manual=False, u_manual=0.0, u_ff=0.0):
        return self.library.pid_step(ctypes.byref(self.pid), r, y, manual, u_manual, u_ff)


class CSingle(C):
    REAL = "float"


def as_python(lines, block_starts, block_ends, middle):
    """Indented by the words that begin and end blocks, whatever the blanks in the text are."""
    depth, found = 0, []
    for line in lines:
        if re.fullmatch(block_ends, line):
            depth -= 1
        elif re.fullmatch(middle, line):
            found.append("    " * (depth - 1) + "else:")
        elif match := re.fullmatch(block_starts, line):
            found.append("    " * depth + f"if {match[1]}:")
            depth += 1
        else:
            found.append("    " * depth + line.rstrip(";").replace(":=", "="))
    assert depth == 0
    return "\n".join(found)


class Variables:
    """A controller whose variables are names in one scope."""

    def set(self, **gains):
        self.scope.update(gains)

    def step(self, r, y, manual=False, u_manual=0.0, u_ff=0.0):
        self.scope.update(r=r, y=y, manual=manual, u_manual=u_manual, u_ff=u_ff)
        exec(self.body, self.scope)
        return self.scope["u"]


class StructuredText(Variables):
    def __init__(self, text, folder):
        text = re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL)
        head, body = text.rsplit("END_VAR", 1)
        declared = re.findall(r"^\s*(\w+) : (\w+)(?: := (.*?))?;", head, flags=re.MULTILINE)
        lines = [line.strip() for line in body.replace("END_FUNCTION_BLOCK", "").splitlines() if line.strip()]
        code = as_python(lines, r"IF (.*) THEN", r"END_IF;", r"ELSE")
        code = code.replace("NOT ", "not ").replace("TRUE", "True")
        self.body = compile(code, "pid.st", "exec")
        self.scope = {name: float(value or 0) if kind != "BOOL" else False for name, kind, value in declared}
        self.declared = set(self.scope)
        self.scope["LIMIT"] = lambda low, value, high: min(max(value, low), high)


class Scl(StructuredText):
    """Its dialect read as Structured Text: # before names, LIMIT with named arguments."""

    def __init__(self, text, folder):
        assert text.count("BEGIN") == 1
        text = text.replace("BEGIN", "").replace("#", "").replace(": LReal", ": LREAL")
        super().__init__(re.sub(r"(MN|IN|MX) := ", "", text), folder)


class Logix(Variables):
    """A routine; its tags are named in the comment."""

    def __init__(self, text, folder):
        comment, body = re.fullmatch(r"\(\*(.*?)\*\)(.*)", text, re.DOTALL).groups()
        reals = re.search(r"REAL tags: (.*)\.", comment)[1].split(", ")
        lines = [line.strip() for line in body.splitlines() if line.strip()]
        code = as_python(lines, r"IF (.*) THEN", r"END_IF;", r"ELSE")
        self.body = compile(code.replace("NOT ", "not ").replace("TRUE", "True"), "pid.txt", "exec")
        self.scope = dict.fromkeys(reals, 0.0) | {"manual": False, "started": False}
        assert set(self.body.co_names) <= set(self.scope)


class Octave:
    """simc_pid.m called by a running Octave, one for all tests, as a user calls it from the folder it lies in."""

    def __init__(self, text, folder):
        (folder / "simc_pid.m").write_text(text)
        self.octave, self.name = octave(), f"pid{next(numbers)}"
        self.octave.stdin.write(f"cd('{folder}'); clear simc_pid; {self.name} = simc_pid();\n")

    def set(self, **gains):
        for name, value in gains.items():
            self.octave.stdin.write(f"{self.name}.{name} = {value!r};\n")

    def step(self, r, y, manual=False, u_manual=0.0, u_ff=0.0):
        given = f"{self.name}, {float(r)!r}, {float(y)!r}, {str(manual).lower()}, {u_manual!r}, {u_ff!r}"
        self.octave.stdin.write(f'{self.name} = simc_pid({given}); printf("%.17g\\n", {self.name}.u);\n')
        self.octave.stdin.flush()
        return float(self.octave.stdout.readline())  # of nothing, where Octave has stopped with an error


numbers = count()


@cache
def octave():
    """Ends when its input does, with the tests. An error ends it too."""
    command = ["octave-cli", "--norc", "--quiet"]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


class Modelica(Variables):
    def __init__(self, text, folder):
        head, rest = text.split("algorithm", 1)
        lines = [line.strip() for line in rest.split("end SimcPid;")[0].splitlines() if line.strip()]
        assert lines.pop(0) == "when sample(0.0, h) then"
        assert lines.pop() == "end when;"
        self.body = compile(as_python(lines, r"if (.*) then", r"end if;", r"else"), "pid.mo", "exec")
        self.scope = {
            name: float(value) for name, value in re.findall(r"(?:parameter|input) Real (\w+) = (\S+?)[ ;]", head)
        }
        self.scope |= dict.fromkeys(re.findall(r"discrete (?:output )?Real (\w+)\(", head), 0.0)


RUNNERS = {
    "python": Python,
    "c": C,
    "st": StructuredText,
    "scl": Scl,
    "logix": Logix,
    "matlab": Octave,
    "modelica": Modelica,
}


def running(controller, language, folder, h, runner=None, **how):
    """The exported controller, started at rest."""
    pid = (runner or RUNNERS[language])(export(controller, language, h, **how), folder)
    pid.step(0.0, 0.0)
    return pid
