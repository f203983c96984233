"""What is drawn of a long record: nothing that the eye would see is missing."""

import numpy as np

from simc_core import Trend
from simc_core.figures.thinned import MOST_DRAWN, held, thinned
from simc_core.figures.trend import trend_figure


def test_every_peak_stays_and_points_are_few():
    rng = np.random.default_rng(1)
    t = np.arange(100_000.0)
    y = rng.standard_normal(t.size)
    y[12_345], y[77_777] = 50.0, -60.0
    few_t, few_y = thinned(t, y)
    assert few_t.size <= MOST_DRAWN
    assert few_y.max() == 50.0
    assert few_y.min() == -60.0
    assert np.all(np.diff(few_t) > 0)
    assert np.array_equal(y[few_t.astype(int)], few_y)  # points of the record, none invented
    ends = np.linspace(0, t.size, MOST_DRAWN // 2).astype(int)
    for a, b in zip(ends[:-1:50], ends[1::50], strict=False):  # in each stretch the whole range is drawn
        inside = (few_t >= a) & (few_t < b)
        assert (few_y[inside].min(), few_y[inside].max()) == (y[a:b].min(), y[a:b].max())


def test_short_records_are_drawn_whole():
    t, y = np.arange(10.0), np.arange(10.0) ** 2
    drawn = thinned(t, y)
    assert drawn[0] is t
    assert drawn[1] is y


def test_a_held_signal_has_square_corners():
    t, u = held(np.array([0.0, 1.0, 2.0, 3.0]), np.array([5.0, 5.0, 7.0, 7.0]), 4.0)
    assert t.tolist() == [0, 2, 2, 4]
    assert u.tolist() == [5, 5, 7, 7]


def test_a_part_of_a_long_record_is_drawn_with_all_its_samples():
    t = np.arange(100_000.0)
    record = Trend(t, np.sin(t), np.floor(t / 10_000))
    drawn = trend_figure(record, shown=(50_000.0, 50_100.0))
    (pv,) = (trace for trace in drawn["data"] if trace["name"] == "PV")
    np.testing.assert_array_equal(pv["x"], np.arange(49_999.0, 50_102.0))
    np.testing.assert_array_equal(pv["y"], np.sin(pv["x"]))
    assert drawn["layout"]["xaxis"]["range"] == [50_000.0, 50_100.0]
