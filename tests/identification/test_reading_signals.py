"""Which column is PV, OP and SP, and what else was moved."""

import numpy as np
import pytest

from simc_core import DataError, read_trend
from simc_core.identification.reading.meaning import understand
from simc_core.identification.reading.reader import load
from tests.identification.texts import OP, PV, TIMES, rows


def test_one_row_for_each_value_of_a_tag():
    text = "Tag;Timestamp;Value\n"
    for i, t in enumerate(TIMES):
        text += f"FIC1.PV;2024-03-14 10:00:0{int(t)};{PV[i]}\n"
        if i in (0, 2):
            text += f"FIC1.OP;2024-03-14 10:00:0{int(t)}.5;{OP[i]}\n"
    trend = read_trend(text)
    assert trend.y.tolist() == PV
    assert trend.u.tolist() == [30.0, 42.5]
    assert trend.t_u[1] - trend.t[0] == pytest.approx(2.5)


def test_a_wide_export_with_empty_cells():
    op = [30.0, "", 42.5, "", "", "", "", ""]
    trend = read_trend("t;PV;OP\n" + rows(separator=";", series=(PV, op)))
    assert trend.u.tolist() == [30.0, 42.5]
    assert trend.t_u.tolist() == [0.0, 2.0]


def test_a_column_of_time_for_each_signal():
    text = "time 1;PV;time 2;OP\n" + "".join(f"{t};{PV[i]};{t + 0.5};{OP[i]}\n" for i, t in enumerate(TIMES))
    trend = read_trend(text)
    assert trend.t_u.tolist() == [t + 0.5 for t in TIMES]


def test_names_on_the_wrong_columns_are_asked_about():
    """The header says input, set point, output; the columns are set point, OP, PV."""
    t = np.arange(0, 90, 0.25)
    r = np.where(t < 2, 0.0, np.where(t < 45, 260.0, 230.0))
    y = r + 4 * np.sin(3 * t)
    u = 130 + 0.5 * (r - 260) + np.round(20 * np.cos(0.7 * t)) / 4
    text = "Tiempo (s),Input (rpm),Setpoint (rpm),Output (PWM)\n"
    text += "".join(f"{a},{b},{c},{d:.3f}\n" for a, b, c, d in zip(t, r, u, y, strict=True))
    reading = understand(load(text))
    assert (reading.roles["SP"], reading.roles["OP"], reading.roles["PV"]) == ("Input", "Setpoint", "Output")
    assert any("do not fit" in question.text for question in reading.questions)
    assert dict(reading.trend.units) == {"t": "s"}  # rpm and PWM stand above the wrong columns as well
    assert any("Units are left open" in said for said in reading.understood)


def test_two_outputs_that_move_together_are_asked_about():
    text = "t;PWM;Voltaje (V);Velocidad (rad/s)\n"
    text += "".join(f"{t};{85 * (t > 2)};{3 * (t > 2)};{y}\n" for t, y in zip(TIMES, PV, strict=True))
    reading = understand(load(text))
    assert reading.roles["OP"] == "Voltaje"
    (question,) = (each for each in reading.questions if each.name == "OP")
    assert set(question.choices) == {"PWM", "Voltaje"}
    assert read_trend(text, columns={"OP": "PWM"}).u.max() == 85


def test_a_file_without_op_is_refused_in_words():
    text = "timestamp_ms,setpoint_rpm,actual_rpm\n" + "".join(f"{10 * i},100,{y}\n" for i, y in enumerate(PV))
    with pytest.raises(DataError, match="controller output"):
        read_trend(text)


@pytest.mark.parametrize(
    ("at", "said"), [(12.0, "moves exactly as OP does"), (13.0, "moved at once with OP"), (45.0, "changes too")]
)
def test_another_input_that_was_moved_is_told(at, said):
    """A feed is moved with OP, a little later, or long after: PV may answer it."""
    t = np.arange(0.0, 80.0, 0.5)
    rows = "".join(f"{a};{50 + 0.1 * a:.2f};{40 + 5 * (a >= 12):.0f};{100 + 10 * (a >= at):.0f}\n" for a in t)
    text = "t [s];PV;OP;Feed\n" + rows
    reading = understand(load(text))
    (question,) = (each for each in reading.questions if each.name == "inputs")
    assert said in question.text
    assert "Feed" in question.text
    assert any(said in note for note in read_trend(text).notes)


def test_op_in_a_second_unit_and_numbers_of_phases_are_no_other_input():
    t = np.arange(0.0, 80.0, 0.5)
    rows = "".join(
        f"{a};{50 + 0.1 * a:.2f};{40 + 5 * (a >= 12):.0f};{4 + 0.5 * (a >= 12)};{1 + int(a // 10)};{b:.3f}\n"
        for a, b in zip(t, np.sin(t), strict=True)
    )
    reading = understand(load("t [s];PV;OP;OP mA;Phase;Noise\n" + rows))
    assert not [each for each in reading.questions if each.name == "inputs"]
