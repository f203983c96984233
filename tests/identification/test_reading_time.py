"""Time in files as people have them: dates, clocks, epochs, units, and samples out of order."""

from datetime import datetime, timedelta

import numpy as np
import pytest

from simc_core import DataError, read_trend
from simc_core.identification.reading.meaning import understand
from simc_core.identification.reading.reader import load
from tests.identification.texts import OP, PV, TIMES, check, rows

BEGIN = datetime(2024, 3, 14, 9, 59, 57)
SHAPES = {
    "ISO": "%Y-%m-%dT%H:%M:%SZ",
    "ISO with fractions": "%Y-%m-%d %H:%M:%S.%f",
    "points": "%d.%m.%Y %H:%M:%S",
    "month first": "%m/%d/%Y %I:%M:%S %p",
    "named month": "%d-%b-%y %H:%M:%S",
    "slashes, year first": "%Y/%m/%d %H:%M:%S",
    "clock alone": "%H:%M:%S",
}


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES.keys())
def test_dates(shape):
    instants = [(BEGIN + timedelta(seconds=t)).strftime(shape) for t in TIMES]
    check(read_trend(rows(instants)))


def test_the_first_twelve_days_of_a_month_are_asked_about():
    instants = [f"03/04/2024 10:00:0{int(t)}" for t in TIMES]
    (question,) = understand(load(rows(instants))).questions
    assert question.name == "day_first"
    slow = [f"0{3 + i // 2}/04/2024 {12 * (i % 2):02d}:00:00" for i in range(8)]
    trend = read_trend(rows(slow), day_first=True)
    assert trend.span == 3.5 * 86400
    assert (
        read_trend(rows(slow), day_first=False).span
        == (datetime(2024, 6, 4, 12) - datetime(2024, 3, 4)).total_seconds()
    )


def test_points_between_day_and_month_mean_the_day_first():
    instants = [f"0{3 + i // 4}.04.2024 {6 * (i % 4):02d}:00:00" for i in range(8)]
    assert read_trend(rows(instants)).span == 1.75 * 86400


def test_clock_times_over_midnight():
    instants = [(datetime(2024, 1, 1, 23, 59, 56) + timedelta(seconds=t)).strftime("%H:%M:%S") for t in TIMES]
    trend = read_trend(rows(instants))
    assert np.diff(trend.t).tolist() == [1.0] * 7


def test_date_and_clock_in_two_columns():
    instants = [(BEGIN + timedelta(seconds=t)).strftime("%d.%m.%Y\t%H:%M:%S") for t in TIMES]
    check(read_trend("Datum\tZeit\tPV\tOP\n" + rows(instants)))


@pytest.mark.parametrize(("unit", "scale"), [("s", 1), ("ms", 1e3), ("us", 1e6), ("ns", 1e9)])
def test_epochs(unit, scale):
    instants = [str(int((1710410397 + t) * scale)) for t in TIMES]
    check(read_trend(rows(instants)))


def test_an_epoch_with_microseconds_in_a_column_of_their_own():
    instants = [f"{1382907437 + i // 2} {323492 + 500000 * (i % 2)}" for i in range(8)]
    assert np.diff(read_trend(rows(instants, " ")).t).tolist() == pytest.approx([0.5] * 7)


def test_days_of_a_spreadsheet():
    instants = [45365 + (36000 + 60 * t) / 86400 for t in TIMES]
    check(read_trend(rows(instants)), [60 * t for t in TIMES])


@pytest.mark.parametrize(
    ("title", "unit", "factor"), [("Time (ms)", "s", 1e-3), ("t [min]", "min", 1), ("Zeit in h", "h", 1)]
)
def test_units_of_plain_times(title, unit, factor):
    trend = read_trend(f"{title}\tPV\tOP\n" + rows())
    assert trend.units["t"] == unit
    assert trend.span == pytest.approx(7 * factor)


def test_the_unit_of_time_can_be_told():
    assert read_trend(rows(), time_unit="ms").span == pytest.approx(0.007)


def test_time_that_does_not_begin_at_zero():
    check(read_trend(rows([t + 1e6 for t in TIMES])))


def test_no_time_at_all():
    text = "PV;OP\n" + "\n".join(f"{y};{u}" for y, u in zip(PV, OP, strict=True))
    with pytest.raises(DataError, match="period"):
        read_trend(text)
    check(read_trend(text, period=1.0))


def test_the_newest_first():
    check(read_trend("t\tPV\tOP\n" + rows(TIMES[::-1], series=(PV[::-1], OP[::-1]))))


def test_equal_instants_keep_the_last_but_a_step_of_op_stays():
    trend = read_trend("t;PV;OP\n0;1;0\n0;1;50\n1;1;50\n1;3;50\n2;4;50\n3;5;50\n")
    assert trend.t.tolist() == [0, 0, 1, 2, 3]
    assert trend.u.tolist() == [0, 50, 50, 50, 50]
    assert trend.y.tolist() == [1, 1, 3, 4, 5]


def test_a_clock_that_is_put_back_by_an_hour():
    instants = [
        (datetime(2024, 10, 27, 2, 40) + timedelta(minutes=10 * i)).strftime("%Y-%m-%d %H:%M") for i in range(3)
    ]
    instants += [
        (datetime(2024, 10, 27, 2, 10) + timedelta(minutes=10 * i)).strftime("%Y-%m-%d %H:%M") for i in range(5)
    ]
    trend = read_trend(rows(instants))
    assert np.diff(trend.t).tolist() == [600.0] * 7
    assert any("put back by an hour" in note for note in trend.notes)


def test_samples_out_of_order_are_sorted():
    order = [0, 1, 3, 2, 4, 5, 7, 6]
    trend = read_trend(
        "t\tPV\tOP\n" + rows([TIMES[i] for i in order], series=([PV[i] for i in order], [OP[i] for i in order]))
    )
    check(trend)
    assert any("backwards 2 times" in note for note in trend.notes)


def test_what_was_done_to_time_that_runs_back_is_to_be_checked():
    """A clock put back by 4 s: sorted, the samples of before and after are mixed, and nobody can see it in them."""
    back = [*TIMES[:5], *(t - 4 for t in TIMES[5:])]
    for times, said in ((back, "went backwards once"), ([*TIMES[:4], *TIMES], "begins anew: 2 records")):
        count = len(times)
        text = "t;PV;OP\n" + rows(times, ";", series=((PV * 2)[:count], (OP * 2)[:count]))
        (question,) = (each for each in understand(load(text)).questions if each.name == "order")
        assert said in question.text
        assert question.assumed
    assert not [each for each in understand(load("t;PV;OP\n" + rows(separator=";"))).questions if each.name == "order"]


def test_time_that_begins_anew():
    trend = read_trend("t\tPV\tOP\n" + rows(TIMES[:4], series=(PV, OP)) + rows())
    check(trend)
    assert any("2 records" in note for note in trend.notes)


def test_an_epoch_beyond_all_dates_is_no_traceback():
    rows = "".join(f"{i};1;3\n" for i in range(1382907437, 1382907637))
    with pytest.raises(DataError, match=r"must hold numbers within"):
        read_trend("1382907437323492;27;62\n" + rows)
