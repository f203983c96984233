"""A schedule as programs have it: the same gains in every language, and the peaks of what they do."""

import ctypes
import re
import subprocess

import numpy as np
import pytest

from simc_core import (
    FirstOrderDelay,
    GainSchedule,
    InvalidParameter,
    ScheduleTable,
    SecondOrderDelay,
    SeriesPid,
    export,
    export_schedule,
    simc,
)
from tests.implementation.running import octave, running

ROWS = (20, 50, 80), (FirstOrderDelay(1, 4, 20), FirstOrderDelay(2, 3, 15), FirstOrderDelay(5, 2, 8))
BAND, TAU_I = (0.4, 0.8, 2.5), (20, 15, 8)  # 1/Kc of SIMC by hand
AT = [-5.0, 20.0, 33.3, 50.0, 65.0, 79.9, 80.0, 200.0]
PIDS = ((0, 1), (SecondOrderDelay(1, 1, 10, 3), SecondOrderDelay(2, 1, 8, 2)))


def by_hand(x):
    """Kp, Ki, Kd of the table of PI controllers."""
    Kp = 1 / np.interp(x, ROWS[0], BAND)
    return Kp, Kp / np.interp(x, ROWS[0], TAU_I), 0.0


def in_python(table):
    scope = {}
    exec(export(SeriesPid(2.5, 20), "python", 0.1) + export_schedule(table, "python"), scope)
    pid = scope["Pid"]()

    def gains(x):
        scope["schedule"](pid, x)
        return pid.Kp, pid.Ki, pid.Kd

    return gains


def in_c(table, folder):
    source, library = folder / "both.c", folder / "both.so"
    reader = "void read_gains(Pid *p, double *g) { g[0] = p->Kp; g[1] = p->Ki; g[2] = p->Kd; }"
    source.write_text(export(SeriesPid(2.5, 20), "c", 0.1) + export_schedule(table, "c") + reader)
    flags = ["-std=c99", "-Wall", "-Wextra", "-Wshadow", "-pedantic", "-Werror", "-shared", "-fPIC"]
    subprocess.run(["gcc", *flags, str(source), "-o", str(library)], check=True)
    c, pid, found = ctypes.CDLL(str(library)), ctypes.create_string_buffer(1000), (ctypes.c_double * 3)()

    def gains(x):
        c.pid_schedule(pid, ctypes.c_double(x))
        c.read_gains(pid, found)
        return tuple(found)

    return gains


def in_octave(table, folder):
    (folder / "simc_schedule.m").write_text(export_schedule(table, "matlab"))
    program = octave()
    program.stdin.write(f"cd('{folder}'); clear simc_schedule; s = struct();\n")

    def gains(x):
        program.stdin.write(f's = simc_schedule(s, {x!r}); printf("%.17g %.17g %.17g\\n", s.Kp, s.Ki, s.Kd);\n')
        program.stdin.flush()
        return tuple(map(float, program.stdout.readline().split()))

    return gains


def run_text(body, scope):
    """Gains from a body whose blocks are made of IF, WHILE and assignments, in whatever dialect."""
    depth, lines = 0, []
    for line in body.splitlines():
        line = line.strip().rstrip(";")
        if line.lower() in ("end_if", "end_while", "end while"):
            depth -= 1
            continue
        begins = re.fullmatch(r"(?i)(if|while) (.*) (then|do|loop)", line)
        text = f"{begins[1].lower()} {begins[2]}:" if begins else line.replace(":=", "=")
        lines.append(" " * depth + text.replace("AND", "and").replace("NOT", "not"))
        depth += bool(begins)
    assert depth == 0
    code = "\n".join(line for line in lines if line.strip())

    def gains(x):
        scope["x"] = x
        exec(code, scope)
        return scope["Kp"], scope["Ki"], scope["Kd"]

    return gains


def limited(low, value, high):
    return min(max(value, low), high)


def in_structured_text(table):
    return of_block(export_schedule(table, "st"))


def of_block(text):
    text = re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL)
    head, body = text.rsplit("END_VAR", 1)
    arrays = re.findall(r"(\w+) : ARRAY\[0\.\.\d+\] OF LREAL := (\[.*?\]);", head, flags=re.IGNORECASE)
    scope = {name: eval(values) for name, values in arrays}
    return run_text(body.replace("END_FUNCTION_BLOCK", ""), {**scope, "LIMIT": limited})


def in_scl(table):
    """Its dialect read as Structured Text."""
    text = export_schedule(table, "scl")
    assert text.count("BEGIN") == 1
    assert set(re.findall(r"#(\w+)", text)) == set(re.findall(r"^    (\w+) :", text, flags=re.MULTILINE))
    return of_block(re.sub(r"(MN|IN|MX) := ", "", text.replace("BEGIN", "").replace("#", "")))


def in_logix(table):
    """A routine; its tags are named in the comment."""
    comment, body = re.fullmatch(r"\(\*(.*?)\*\)(.*)", export_schedule(table, "logix"), re.DOTALL).groups()
    arrays = re.search(r"REAL\[3\] tags: (.*)\.", comment)[1].split(", ")
    reals = re.search(r"REAL tags: (.*)\.", comment)[1].split(", ")
    scope = {name: [0.0] * 3 for name in arrays} | dict.fromkeys([*reals, "i", "tabled"], 0)
    assert set(re.findall(r"[a-zA-Z]\w*", body)) - {"IF", "NOT", "THEN", "WHILE", "AND", "DO"} <= set(scope) | {
        "END_IF",
        "END_WHILE",
    }
    return run_text(body, scope)


def in_modelica(table):
    """Arrays begin with 1 there."""
    head, body = export_schedule(table, "modelica").split("algorithm")
    arrays = re.findall(r"parameter Real (\w+)\[3\] = \{(.*?)\};", head)
    scope = {name: [None, *map(float, values.split(", "))] for name, values in arrays}
    return run_text(body.replace("end SimcSchedule;", ""), scope)


@pytest.mark.parametrize("language", ["python", "c", "matlab", "st", "scl", "logix", "modelica"])
def test_every_language_has_the_gains_of_the_table(language, tmp_path):
    table = ScheduleTable(GainSchedule(*ROWS, between="PB"))
    gains = {
        "python": lambda: in_python(table),
        "c": lambda: in_c(table, tmp_path),
        "matlab": lambda: in_octave(table, tmp_path),
        "st": lambda: in_structured_text(table),
        "scl": lambda: in_scl(table),
        "logix": lambda: in_logix(table),
        "modelica": lambda: in_modelica(table),
    }[language]()
    for x in AT:
        assert gains(x) == pytest.approx(by_hand(x), rel=1e-12)
        form = table.settings(x).to_parallel()
        assert (form.Kp, form.Ki, form.Kd) == pytest.approx(by_hand(x), rel=1e-12)


def test_derivative_action_is_in_the_table_and_the_filter_is_the_shortest():
    schedule = GainSchedule(*PIDS, rule=lambda model: simc(model).with_filter(0.1), between="PB")
    table = ScheduleTable(schedule)
    assert table.tau_F == pytest.approx(0.2)  # tau_D 3 and 2
    first = SeriesPid(5, 8, 3).to_ideal()
    assert in_python(table)(0.0) == pytest.approx((first.Kc, first.Kc / first.tau_I, first.Kc * first.tau_D), rel=1e-12)


def test_a_schedule_of_the_model_is_approached_by_more_rows():
    """The worst peak of the rule itself is 1.590 at all x; straight lines between more rows come nearer to it."""
    schedule = GainSchedule(*ROWS)
    coarse, fine = (ScheduleTable(schedule, parts) for parts in (1, 10))
    assert len(fine.x) == 21
    off = [max(abs(table.settings(x).Kc / schedule.settings(x).Kc - 1) for x in AT) for table in (coarse, fine)]
    assert off[1] < off[0] / 20
    assert fine.worst_Ms() == pytest.approx(1.590, abs=3e-3)


def test_gains_that_follow_a_schedule_make_no_jump(tmp_path):
    """At rest with r = y, u stays where it is through the whole schedule."""
    table = ScheduleTable(GainSchedule(*ROWS, between="PB"))
    pid = running(SeriesPid(2.5, 20), "python", tmp_path, 0.1)
    for _ in range(5):
        pid.step(3.0, 3.0, True, 40.0)
    for x in np.linspace(20, 80, 50):
        form = table.settings(x).to_parallel()
        pid.set(Kp=form.Kp, Ki=form.Ki)
        assert pid.step(3.0, 3.0) == pytest.approx(40, abs=1e-9)


def test_the_header_tells_the_worst_peak_and_the_filter():
    text = export_schedule(ScheduleTable(GainSchedule(*ROWS, between="PB")), "st", unit="min")
    assert "largest Ms between the rows 1.59\n" in text  # plant linear or exponential between them
    assert "times in min" in text


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (
            lambda: export_schedule(ScheduleTable(GainSchedule(*ROWS)), "python-control"),
            "language must be one of python, c, arduino, st",
        ),
        (
            lambda: export_schedule(ScheduleTable(GainSchedule(*ROWS)), "c", unit="h"),
            "unit must be one of s, min, found 'h'",
        ),
        (lambda: ScheduleTable(GainSchedule(*ROWS), 0), "parts must be >= 1"),
        (
            lambda: ScheduleTable(GainSchedule((0, 1), (FirstOrderDelay(1, 1, 0), FirstOrderDelay(2, 1, 0)))),
            "settings must have an ideal form to be tabulated, found at 0",
        ),
    ],
)
def test_what_cannot_be_tabulated_is_refused(make, text):
    with pytest.raises(InvalidParameter, match=text):
        make()
