"""Cells that are numbers, and those that are none."""

import numpy as np
import pytest

from simc_core import read_trend
from simc_core.identification.reading.reader import load
from tests.identification.texts import OP, PV, TIMES, check, rows


@pytest.mark.parametrize("word", ["Bad", "#N/A", "No Data", "I/O Timeout", "NaN", "", "---", "inf"])
def test_bad_values_are_left_out_and_told(word):
    spoiled = [*PV[:3], word, *PV[4:]]
    trend = read_trend("t;PV;OP\n" + rows(separator=";", series=(spoiled, OP)))
    assert trend.y.tolist() == PV[:3] + PV[4:]
    assert trend.u[np.searchsorted(trend.instants_of_u, 4.0)] == 42.5
    assert not word or any("line 5" in note and word in note for note in trend.notes)


def test_a_column_of_quality():
    quality = ["Good"] * 3 + ["Bad"] + ["Good"] * 4
    trend = read_trend("t;PV;Status;OP\n" + rows(separator=";", series=(PV, quality, OP)))
    assert trend.y.tolist() == PV[:3] + PV[4:]


def test_states_of_a_switch():
    states = ["Off", "Off"] + ["On"] * 6
    assert read_trend("t;PV;OP\n" + rows(separator=";", series=(PV, states))).u.tolist() == [0.0, 0.0] + [1.0] * 6


def test_thousands_and_units_behind_numbers():
    text = "t;PV;OP\n" + "".join(f'{t};"1,2{y:05.2f}";{u} %\n' for t, y, u in zip(TIMES, PV, OP, strict=True))
    assert read_trend(text).y.tolist() == [1200 + y for y in PV]


def test_three_digits_after_every_comma_are_asked_about():
    table = load("t;PV;OP\n0;1,234;5\n1;1,235;5\n2;1,236;6\n3;1,250;6\n")
    assert [question.name for question in table.questions] == ["decimal"]
    assert read_trend("t;PV;OP\n0;1,234;5\n1;1,235;5\n2;1,236;6\n", decimal=".").y.tolist() == [1234.0, 1235.0, 1236.0]


def test_a_first_sample_of_a_sensor_that_wakes_up():
    y = [3.75, *(27.25 + 0.25 * (i // 4) for i in range(30))]
    trend = read_trend("t;PV;OP\n" + "".join(f"{i};{value};{5 if i > 8 else 0}\n" for i, value in enumerate(y)))
    assert trend.y[0] == 27.25
    assert any("3.75" in note for note in trend.notes)


def test_exponents():
    check(
        read_trend(
            "t;PV;OP\n" + "".join(f"{t:e};{1e3 * y:.3f}E-3;{u:e}\n" for t, y, u in zip(TIMES, PV, OP, strict=True))
        )
    )
