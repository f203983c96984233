"""Models at several operating points, from several steps and from several trends; the truth is a closed form."""

import numpy as np
import pytest

from simc_core import FirstOrderDelay, GainSchedule, NotIdentifiable, Trend, operating_points
from tests.identification.simulated import rise


def steps(levels, gains, taus, seed=0, rest=200.0) -> Trend:
    """OP goes from level to level; each move is answered with its own gain and lag; theta = 6; noise of 1 %."""
    t = np.arange(0.0, 60 + rest * len(gains))
    at = 60 + rest * np.arange(len(gains))
    moves = zip(np.diff(levels), gains, taus, at, strict=True)
    y = 30 + sum(k * size * rise(t - s - 6, tau) for size, k, tau, s in moves)
    y = y + 0.01 * np.ptp(y) * np.random.default_rng(seed).normal(size=t.size)
    return Trend(t, y, np.array(levels, float), t_u=np.concatenate([[0.0], at]))


def test_each_point_has_its_own_model():
    found = operating_points(steps((40, 50, 60, 70), (1.0, 2.0, 4.0), (30, 20, 10)))
    assert [point.OP for point in found] == [45, 55, 65]
    for point, k, tau in zip(found, (1.0, 2.0, 4.0), (30, 20, 10), strict=True):
        assert point.identified.parameters["k"] == pytest.approx(k, rel=0.05)
        assert point.identified.parameters["tau1"] == pytest.approx(tau, rel=0.2)
        assert point.identified.parameters["theta"] == pytest.approx(6, abs=2)
    assert pytest.approx(30 + 5, abs=1) == found[0].PV
    assert pytest.approx(30 + 10 + 20 + 20, abs=2) == found[2].PV


def test_up_and_back_are_one_point():
    found = operating_points(steps((40, 50, 40, 30), (2.0, 2.0, 1.0), (20, 20, 20)))
    assert [(point.OP, point.moves) for point in found] == [(35, 1), (45, 2)]
    assert [round(point.identified.parameters["k"], 1) for point in found] == [1.0, 2.0]


def test_several_trends_make_one_schedule():
    found = operating_points([steps((20, 30), (1.0,), (20,)), steps((60, 70), (3.0,), (10,), seed=1)])
    models = [point.identified.model for point in found]
    assert all(isinstance(model, FirstOrderDelay) for model in models)
    made = GainSchedule([point.OP for point in found], models)
    assert made.settings(25).Kc > 1.2 * made.settings(65).Kc


def test_a_move_that_tells_nothing_is_left_out():
    found = operating_points(steps((40, 50, 60), (2.0, 0.0), (20, 20)))
    assert [point.OP for point in found] == [45]


def test_no_steps_no_points():
    t = np.arange(400.0)
    u = 50 + np.random.default_rng(0).normal(size=400)
    with pytest.raises(NotIdentifiable, match="made of steps of OP"):
        operating_points(Trend(t, np.sin(t / 9), u))
