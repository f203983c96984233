"""The record of a process: what it takes, what it refuses, and its parts."""

import numpy as np
import pytest

from simc_core import InvalidParameter, Trend

T = [0.0, 1.0, 2.0, 3.0, 4.0]


def test_the_series_are_kept_and_cannot_be_changed():
    given = np.array(T)
    trend = Trend(given, T, T)
    given[0] = -1
    assert trend.t[0] == 0
    with pytest.raises(ValueError, match="read-only"):
        trend.y[0] = 1


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"t": [0, 1, 3, 2, 4]}, r"t\[3\] = 2"),
        ({"t": [0, 0, 0, 0, 0]}, "t must cover"),
        ({"y": T[:4]}, "y must have the length of t, 5, found 4"),
        ({"u": [0, 1]}, "u must have the length of t"),
        ({"y": [0, 1, float("nan"), 2, 3]}, r"y\[2\]"),
        ({"t": T[:2], "y": T[:2], "u": T[:2]}, "at least 3"),
        ({"t_u": [1, 0], "u": [0, 1]}, "t_u must not go backwards"),
        ({"r": [1.0]}, "r must have"),
        ({"names": {"pv": "TIC"}}, "names may have the keys"),
        ({"y": "text"}, "y must be"),
    ],
)
def test_what_cannot_be_a_record_is_refused_by_name(change, named):
    with pytest.raises(InvalidParameter, match=named):
        Trend(**({"t": T, "y": T, "u": T} | change))


def test_a_part_keeps_the_output_that_held_when_it_begins():
    trend = Trend(T, T, [0.0, 5.0, 7.0], t_u=[0.0, 0.5, 2.5])
    part = trend.between(1.0, 4.0)
    assert part.t.tolist() == [1, 2, 3, 4]
    assert part.u.tolist() == [5, 7]
    assert part.instants_of_u.tolist() == [1.0, 2.5]


def test_leaving_out_samples_keeps_the_output():
    trend = Trend(T, T, [0.0, 5.0, 7.0, 7.0, 7.0], r=T)
    part = trend.without(0.5, 1.5)
    assert part.y.tolist() == [0, 2, 3, 4]
    assert part.u.tolist() == [0, 5, 7, 7, 7]
    assert part.r.tolist() == [0, 2, 3, 4]
