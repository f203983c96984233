"""Exported controllers are run: in closed loop with the exact plant, in manual, with gains changed on line."""

import math
import re
import subprocess

import control
import numpy as np
import pytest

from simc_core import (
    Actuation,
    IController,
    IdealPid,
    InvalidParameter,
    Loop,
    Plant,
    Scenario,
    SeriesPid,
    export,
    from_box,
    margins,
    simulate,
)
from simc_core.implementation.exports.program import SETTINGS, STATE
from simc_core.implementation.single_precision import dead_error
from tests.implementation.running import RUNNERS, CSingle, StructuredText, running
from tests.oracles.sampled_loop import driven

LOOPS = [  # k, theta, lags, controller, h, law
    (1, 1, (8,), SeriesPid(4, 8), 0.1, "backward"),
    (1, 1, (10, 3), SeriesPid(5, 8, 3, 0.375, b=0.7, c=0.2), 0.3, "backward"),
    (-2, 0.7, (5,), IdealPid(-1.2, 5, 0, 0.2), 0.25, "backward"),
    (1, 0, (8, 2), IdealPid(4, 8, 1, 0.3, c=1), 0.5, "tustin"),
    (1, 1, (10, 3), SeriesPid(5, 8, 3, 0.375), 0.2, "tustin"),
    (0.5, 2, (3,), IController(0.3), 0.7, "tustin"),
]
LANGUAGES = sorted(RUNNERS)
PID = SeriesPid(5, 8, 3, 0.375, b=0.6)


@pytest.mark.parametrize(("k", "theta", "lags", "controller", "h", "law"), LOOPS)
@pytest.mark.parametrize("limits", [{}, {"u_min": -0.8, "u_max": 1.3}])
@pytest.mark.parametrize("language", LANGUAGES)
def test_the_closed_loop_is_that_of_the_simulation(language, limits, k, theta, lags, controller, h, law, tmp_path):
    plant, n = Plant(k, theta, lags), 200
    pid = running(controller, language, tmp_path, h, law=law, plant=plant, **limits)
    y, u = driven(k, theta, lags, h, pid.step, np.ones(n))
    found = simulate(
        Loop(plant, controller), Scenario(1, 0, t=h * np.arange(n), actuation=Actuation(h=h, law=law, **limits))
    )
    if limits:
        assert {*limits.values()} & {*u}
    assert y == pytest.approx(found.y, rel=0, abs=1e-12)
    assert u == pytest.approx(found.u, rel=0, abs=1e-11)


def test_single_precision_is_the_same_to_its_digits(tmp_path):
    pid = running(PID, "c", tmp_path, 0.2, CSingle, u_max=3.0)
    y, _ = driven(1, 1, (10, 3), 0.2, pid.step, np.ones(200))
    found = simulate(
        Loop(Plant(1, 1, (10, 3)), PID), Scenario(1, 0, t=0.2 * np.arange(200), actuation=Actuation(h=0.2, u_max=3.0))
    )
    assert y == pytest.approx(found.y, abs=1e-5)


@pytest.mark.parametrize("language", LANGUAGES)
def test_from_manual_to_automatic_u_moves_by_the_integral_only(language, tmp_path):
    """u_man 37, e 5, Ki 0.5, h 0.1: 37.25 [by hand]; the trapezoid has had half of it."""
    pid = running(SeriesPid(4, 8), language, tmp_path, 0.1)
    for _ in range(20):
        assert pid.step(45.0, 40.0, True, 37.0) == 37.0
    assert pid.step(45.0, 40.0) == pytest.approx(37.25, abs=1e-12)


@pytest.mark.parametrize("law", ["backward", "tustin"])
@pytest.mark.parametrize("language", LANGUAGES)
def test_in_manual_with_a_moving_measurement_and_feedforward_no_bump_either(language, law, tmp_path):
    pid = running(PID, language, tmp_path, 0.2, law=law)
    for _ in range(400):
        pid.step(45.0, 40.0, True, 37.0, 3.0)
    assert pid.step(45.0, 40.0, False, 0.0, 3.0) == pytest.approx(37.0 + 0.2 * PID.to_parallel().Ki * 5, abs=1e-9)


@pytest.mark.parametrize("law", ["backward", "tustin"])
@pytest.mark.parametrize("language", LANGUAGES)
def test_gains_changed_on_line_make_no_jump(language, law, tmp_path):
    one, other = (running(PID, language, tmp_path, 0.2, law=law) for _ in range(2))
    for pid in (one, other):
        for _ in range(300):
            pid.step(1.0, 0.9)
    other.set(Kp=3.0, Kd=7.0)  # Ki is as before
    expected = one.step(1.0, 0.9)
    assert other.step(1.0, 0.9) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("language", LANGUAGES)
def test_manual_and_feedforward_keep_the_limits(language, tmp_path):
    pid = running(SeriesPid(4, 8), language, tmp_path, 0.1, u_min=0, u_max=10)
    assert pid.step(0.0, 0.0, True, 12.0) == 10
    assert pid.step(0.0, 0.0, True, -2.0) == 0
    assert pid.step(0.0, 0.0, False, 0.0, 4.0) == pytest.approx(4, abs=1e-12)
    assert pid.step(0.0, 0.0, False, 0.0, 40.0) == 10


@pytest.mark.parametrize("language", ["python", "c", "st", "scl", "logix", "matlab"])
def test_the_first_call_takes_measurement_and_set_point_as_they_are(language, tmp_path):
    """No derivative kick: u = Kp (b r - y) + h Ki (r - y) for a filter that starts at the measurement."""
    pid = RUNNERS[language](export(PID, language, 0.2), tmp_path)
    form = PID.to_parallel()
    assert pid.step(50.0, 49.0) == pytest.approx(form.Kp * (0.6 * 50 - 49) + 0.2 * form.Ki, rel=1e-12)


def test_the_arduino_sketch_compiles_and_runs_at_its_period(tmp_path):
    """Against stubs of the board: 50 s in which micros() begins again at 0, measurement 25 %, u by hand."""
    sketch = export(SeriesPid(2, 10), "arduino", 0.5, u_min=0, u_max=100)
    board = """
#include <stdio.h>
#include <stdint.h>
static unsigned long now; static int pwm = -1, calls;
enum { A0 = 14 };
static unsigned long micros(void) { return now; }
static int analogRead(int) { return 256; }
static void analogWrite(int pin, int value) { if (pin == 9) { pwm = value; calls++; } }
"""
    run = """
int main() { now = 4294000000UL; setup(); set_point = 30.0;
for (int i = 0; i < 5000; i++) { loop(); now = (now + 10000UL) & 0xffffffffUL; }
printf("%d %d %.12g", calls, pwm, (double)pid.u); }
"""
    source = tmp_path / "sketch.cpp"
    source.write_text(board + sketch + run)
    subprocess.run(["g++", "-Wall", "-Wextra", "-Werror", str(source), "-o", str(tmp_path / "sketch")], check=True)
    calls, pwm, u = subprocess.run([tmp_path / "sketch"], capture_output=True, text=True, check=True).stdout.split()
    e = 30 - 100 * 256 / 1023
    assert int(calls) == pytest.approx(99, abs=1)
    assert float(u) == pytest.approx(2 * e + int(calls) * 0.5 * 0.2 * e, rel=1e-9)
    assert int(pwm) == round(2.55 * float(u))
    assert "does not move the integral any more" in sketch


@pytest.mark.parametrize(("law", "h"), [("backward", 0.2), ("tustin", 0.5)])
def test_the_arduino_sketch_fits_an_atmega328(law, h, tmp_path):
    """Linked for its 32 KB, of which the boot loader takes 0.5, with avr-libc and a board that does nothing."""
    board = """
#include <stdint.h>
enum { A0 = 14 };
static volatile int level; static volatile unsigned long now;
unsigned long micros(void) { return now; }
int analogRead(int pin) { return level + pin; }
void analogWrite(int, int value) { level = value; }
"""
    source, program = tmp_path / "sketch.cpp", tmp_path / "sketch.elf"
    sketch = export(PID, "arduino", h, law, u_min=0, u_max=100)
    source.write_text(f"{board}{sketch}\nint main() {{ setup(); for (;;) loop(); }}\n")
    flags = ["-mmcu=atmega328p", "-Os", "-Wall", "-Wextra", "-Werror"]
    subprocess.run(["avr-g++", *flags, str(source), "-o", str(program)], check=True)
    sizes = subprocess.run(["avr-size", str(program)], capture_output=True, text=True, check=True).stdout
    text, data, bss = map(int, sizes.splitlines()[1].split()[:3])
    assert 1000 < text + data < 32256
    assert 4 * (len(SETTINGS) + len(STATE)) <= data + bss < 2048  # each number has 4 bytes there


def test_c_compiles_for_a_small_processor_without_a_warning(tmp_path):
    source = tmp_path / "pid.c"
    source.write_text(export(PID, "c", 0.2, single=True))
    flags = ["-mmcu=atmega328p", "-std=c99", "-Os", "-Wall", "-Wextra", "-Wshadow", "-pedantic", "-Werror"]
    subprocess.run(["avr-gcc", *flags, "-c", str(source), "-o", str(tmp_path / "pid.o")], check=True)


@pytest.mark.parametrize(
    "plant", [Plant(1, 1, (10, 3)), Plant(-0.5, 1, (4,), (-0.3,), 1), Plant(2, 0.5, lag_pairs=((1, 0.6),))]
)
def test_the_script_for_python_control_finds_the_margins(plant, capsys):
    controller = SeriesPid(math.copysign(0.4, plant.k), 8, 0.5, 0.1)
    scope = {}
    exec(export(controller, "python-control", 0.1, plant=plant), scope)
    found = margins(Loop(plant, controller))
    assert scope["Ms"] == pytest.approx(found.Ms, rel=1e-5)
    assert scope["Mt"] == pytest.approx(found.Mt, rel=1e-4)
    assert isinstance(scope["G"], control.TransferFunction)
    assert f"Ms = {found.Ms:.3f}" in capsys.readouterr().out


def test_structured_text_declares_what_it_uses_and_nothing_twice():
    for law in ("backward", "tustin"):
        text = export(PID, "st", 0.2, law, u_max=10)
        assert "//" not in text
        assert text.count("VAR_INPUT") == text.count("VAR_OUTPUT") == 1
        assert text.count("END_VAR") == 3
        block = StructuredText(text, None)
        names = re.findall(r"^\s*(\w+) : (?:L?REAL|BOOL)", text, flags=re.MULTILINE)
        assert len({name.upper() for name in names}) == len(names)
        assert set(block.body.co_names) - {"LIMIT"} <= block.declared
    single = export(PID, "st", 0.2, single=True)
    assert "LREAL" not in single
    assert "Kp : REAL := 6.875;" in single


def test_modelica_has_matched_ends_and_the_plant_as_it_is():
    text = export(PID, "modelica", 0.2, plant=Plant(2, 1.5, (10, 3)))
    for word in ("block SimcPid", "model SimcLoop"):
        assert text.count(word) == text.count(f"end {word.split()[1]};") == 1
    assert "delay(pid.u + d, 1.5)" in text
    rows = {name: np.array(eval(value.replace("{", "[").replace("}", "]"))) for name, value in MATRIX.findall(text)}
    s = 0.3j
    G = rows["C"] @ np.linalg.solve(s * np.eye(2) - rows["A"], rows["B"])
    assert 2 / ((10 * s + 1) * (3 * s + 1)) == pytest.approx(G, rel=1e-12)


MATRIX = re.compile(r"parameter Real ([ABC])\[.*?\] = (\{.*\});")


@pytest.mark.parametrize("language", [*LANGUAGES, "python-control"])
def test_the_header_tells_plant_design_peaks_period_unit_and_date(language):
    text = export(PID, language, 0.2, plant=Plant(1, 1, (10, 3)), unit="min", date="2026-11-27")
    for part in (
        "h = 0.2 min",
        "SeriesPid(Kc=5.0",
        "exp(-s)/((10 s + 1) (3 s + 1))",
        "1.914 as designed",
        "2026-11-27",
    ):
        assert part in text
    assert "2.184 sampled" in text


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"language": "cobol"}, "language must be one of python, c, st"),
        ({"h": 0}, "h must not be zero"),
        ({"law": "tustin", "h": 2}, "tau_F must be >= h/2 = 1"),
        ({"language": "python-control"}, "plant must be given for python-control"),
        ({"language": "arduino"}, "u_min and u_max must be given for an Arduino"),
        ({"language": "arduino", "h": 5000, "u_min": 0, "u_max": 1}, "h must be from 0.0001 to 4000 s"),
        ({"u_min": 2.0, "u_max": 1.0}, "u_max must be > u_min = 2"),
        ({"u_min": math.nan}, "u_min must be finite"),
        ({"date": "*/ evil"}, "date may have letters"),
        ({"about": 'TIC-1"""'}, "about may have letters"),
        ({"unit": "h"}, "unit must be one of s, min, found 'h'"),
        ({"controller": IController(0.3)}, "tracking_time or plant must be given for pure integral action"),
    ],
)
def test_what_cannot_be_exported_is_refused(given, text):
    with pytest.raises(InvalidParameter, match=text):
        export(**({"controller": PID, "language": "c", "h": 0.2} | given))


def test_an_integral_in_single_precision_has_a_dead_error():
    """Ti 2000 s, h 0.01 s, I 50 and a gain of 1: 0.38; what is added below it is lost."""
    found = dead_error(50, 1 / 2000, 0.01)
    assert found == pytest.approx(0.38, abs=0.005)
    I = np.float32(50)  # noqa: E741
    assert I + np.float32(0.99 * found * 0.01 / 2000) == I
    assert I + np.float32(1.01 * found * 0.01 / 2000) > I
    assert dead_error(50, 0, 0.01) == math.inf


def test_settings_of_a_box_have_the_design_beside_them():
    """DeltaV with the settings of the unfiltered design typed in: Ms 1.9358 [measured apart], the design's 1.6089."""
    design = IdealPid(6.875, 11, 24 / 11)
    typed = from_box("deltav_standard", {"GAIN": 6.875, "RESET": 11, "RATE": 2.18182, "ALPHA": 0.125})
    about = "loop TIC-101, PV in °C, output in %"
    text = export(typed, "c", 0.1, plant=Plant(1, 1, (10, 3)), design=design, about=about)
    assert f"design  {design!r}" in text
    assert f"typed   {typed!r}" in text
    assert "Ms      1.609 as designed, 1.936 as typed, " in text
    assert about in text


@pytest.mark.parametrize("language", LANGUAGES)
def test_an_output_of_4_to_20_mA_starts_from_manual_without_a_bump(language, tmp_path):
    pid = RUNNERS[language](export(SeriesPid(0.5, 8), language, 0.1, u_min=4, u_max=20), tmp_path)
    for _ in range(3):
        assert pid.step(50.0, 50.0, True, 12.0) == 12
    assert pid.step(50.0, 50.0) == pytest.approx(12, abs=1e-12)
    assert pid.step(50.0, 500.0) == 4


@pytest.mark.parametrize(("language", "tool"), [("scl", "TIA Portal"), ("logix", "Studio 5000")])
def test_what_nobody_compiled_says_so(language, tool):
    assert f"NOT COMPILED: no {tool} was at hand" in export(PID, language, 0.2)


@pytest.mark.parametrize("limits", [{}, {"u_min": -0.8, "u_max": 1.3}])
def test_an_output_written_one_scan_later_is_simulated_and_in_the_header(limits, tmp_path):
    """u reaches the plant a period after it was computed; the program is the same, Ms 1.898 [a program of its own]."""
    plant, controller, n = Plant(1, 1, (8,)), SeriesPid(4, 8), 200
    pid = running(controller, "python", tmp_path, 0.2, plant=plant, **limits)
    written = [0.0]

    def step(r, y):
        written.append(pid.step(r, y))
        return written[-2]

    y, u = driven(1, 1, (8,), 0.2, step, np.ones(n))
    late = Actuation(h=0.2, delay_scans=1, **limits)
    found = simulate(Loop(plant, controller), Scenario(1, 0, t=0.2 * np.arange(n), actuation=late))
    assert y == pytest.approx(found.y, rel=0, abs=1e-12)
    assert u == pytest.approx(found.u, rel=0, abs=1e-11)
    text = export(controller, "c", 0.2, plant=plant, delay_scans=1)
    assert "1.898 sampled, the output written 1 scan later" in text
