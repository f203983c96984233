"""From data in another language: what is understood of files, verdicts, refusals, experiments."""

import numpy as np
import pytest

from tests.identification.test_known_controller import logged
from tests.pages.from_data import experiment, pasted
from tests.pages.tools import run_page, texts, unfold
from tests.pages.wrapped import left_in_english, speak_brackets

WORDS_OF_A_FILE = {"Level", "Valve", "Flow", "Temp", "Heater"}  # names of columns are what they are in the file


@pytest.fixture(autouse=True)
def _brackets(monkeypatch):
    speak_brackets(monkeypatch)


def mixed(app) -> list[str]:
    assert not app.exception, app.exception
    return [found for found in left_in_english(app) if found.split(": ", 1)[1] not in WORDS_OF_A_FILE]


def rows_of(header: str, *columns) -> str:
    return header + "\n" + "\n".join(";".join(f"{value:.4g}" for value in row) for row in zip(*columns, strict=True))


T = np.arange(120.0)
OP = np.where(T < 30, 40.0, 45.0)
PV = 20 + 0.1 * (T - 32).clip(0, 40)


@pytest.mark.parametrize("view", ["Auto-tuning", "Operating points"])
def test_no_view_of_a_model_mixes(view):
    app = run_page("from_data", f"⟦{view}⟧", "ways", example="integrating")
    assert mixed(unfold(app, "by_hand")) == []


def test_a_model_with_what_is_not_known_does_not_mix():
    app = run_page("from_data", example="sticking")
    assert mixed(unfold(app, "Ms_against_tau_c")) == []
    app.text_input(key="part_begin").set_value("2000").run()
    app.text_input(key="bad_from").set_value("200").run()
    app.button(key="leave_out").click().run()
    assert len(app.error) == 2
    assert mixed(app) == []
    app.text_input(key="bad_to").set_value("250").run()
    app.button(key="leave_out").click().run()
    assert any("Take back 200" in button.label for button in app.button)
    assert mixed(app) == []


@pytest.mark.parametrize(
    "rows",
    [
        "hello",
        "hello <b>world</b>\nand\nmore",
        "t;PV\n1;2\n2;3\n3;4",
        "t;PV;OP\n1;2;3\n2;3;3\n3;4;3",
        rows_of("PV;OP", PV, OP),
        rows_of("t;PV;OP", T, PV, OP),
        rows_of("t [min];PV;OP;Heater", T[::-1], PV, OP, OP),
        rows_of("Temp;u", PV, OP) + "\nbad;45",
        rows_of("Time;Level;Valve;Flow", np.where(T < 60, T, T - 60), PV, OP, np.where(T < 60, 1.0, 2.0)),
        "Date;PV;OP\n"
        + "\n".join(f"0{1 + i // 60}/0{2}/2024 10:{i % 60:02d};{20 + i % 7};{i // 20}" for i in range(99)),
        "t;PV;OP\n" + "\n".join(f"{i};1,{200 + i};{40 if i < 30 else 45}" for i in range(80)),
    ],
)
def test_nothing_that_is_understood_of_a_file_mixes(rows):
    assert mixed(pasted(rows)) == []


def test_a_loop_without_op_does_not_mix():
    _, record = logged(0.01)
    app = pasted(rows_of("Time [s];SP;PV", record.t, record.r, record.y))
    assert mixed(app) == []
    assert "controller=" not in texts(app)
    app.text_input(key="loop_Kc").set_value("0.9").run()
    app.text_input(key="loop_tau_I").set_value("12").run()
    app.button(key="compute_op").click().run()
    assert any("was computed from PV" in item.value for item in app.warning)
    assert mixed(app) == []


def test_several_records_do_not_mix():
    app = run_page("from_data", example="step")
    app.toggle(key="add_record").set_value(True).run()
    app.text_area(key="trend_paste_0").set_value(rows_of("t [min];PV;OP", T, PV, OP))
    next(button for button in app.button if button.label == "⟦Read⟧").click().run()
    assert any("is not fitted along" in item.value for item in app.warning)
    assert mixed(app) == []


@pytest.mark.parametrize(
    ("title", "form", "given"),
    [
        ("Set-point overshoot", "overshoot", ("1.5", "1", "1.05", "0.95", "4")),
        ("Set-point overshoot", "overshoot", ("1.5", "1", "2", "0.1", "4")),
        ("Set-point overshoot", "overshoot", ("1.5", "1", "1", "2", "4")),
        ("Set-point overshoot", "overshoot", ("0", "1")),
        ("Loop that oscillates", "oscillation", ("0.5", "4", "40")),
        ("Loop that oscillates", "oscillation", ("0.5", "4", "200", "1")),
        ("Loop that oscillates", "oscillation", ("0.5", "40", "10")),
        ("Loop that oscillates", "oscillation", ("0.5", "20", "40")),
        ("Relay test", "relay", ("1",)),
        ("Relay test", "relay", ("1", "1e6")),
        ("Relay test", "relay", ("-1",)),
    ],
)
def test_no_experiment_mixes(title, form, given):
    names = {
        "overshoot": ("Kc0", "setpoint", "peak", "lowest", "peak_time"),
        "oscillation": ("Kc", "tau_I", "period", "theta"),
        "relay": ("amplitude", "hysteresis"),
    }
    fields = {f"experiment_{form}_{name}": text for name, text in zip(names[form], given, strict=False)}
    app = experiment(run_page("from_data", plant="exp(-0.3s)/((s+1)(10s+1))"), title, **fields)
    assert mixed(app) == []
