"""What a Scenario means: instants, jumps, heights, times; values from seventy-five digits."""

import math

import numpy as np
import pytest

from simc_core import IController, InvalidParameter, Loop, Plant, Scenario, SeriesPid, simulate
from tests.oracles.high_precision import course

WITHIN = 1e-9
DEAD_TIME = Loop(Plant(1, 1), SeriesPid(0.8, 4))  # y and u jump for ever, by (-0.8)^k
NEUTRAL = Loop(Plant(1, 1, (5,)), SeriesPid(1.5, 5, 2))  # u jumps for ever, y does not
FAST_ZERO = Loop(Plant(1, 0.5, (4,), (2,)), SeriesPid(1.2, 4))  # a plant that answers at once


def doubled(t: np.ndarray) -> np.ndarray:
    """Instants that are there twice."""
    return t[:-1][np.diff(t) == 0]


def exact(loop: Loop, scenario: Scenario, begins: float, t, left=None) -> np.ndarray:
    """y and u, (2, n): heights times unit steps, the second one from `begins` on; left limits where `left`."""
    r, d = course(loop, False, t[-1]), course(loop, True, t[-1])
    sides = np.zeros(len(t), dtype=bool) if left is None else left
    steps = [
        [np.array(unit.at(instant - start, side)) for instant, side in zip(t, sides, strict=True)]
        for unit, start in ((r, 0.0), (d, begins))
    ]
    return (scenario.setpoint * np.array(steps[0]) + scenario.disturbance * np.array(steps[1])).T


@pytest.mark.parametrize("loop", [DEAD_TIME, NEUTRAL, FAST_ZERO])
@pytest.mark.parametrize("t", [[0.0], [1.0], [0.0, 1.0, 2.0, 3.0], [0.25, 2.0], [0.5, 2.0, 2.0, 7.0], [3.0, 11.0]])
def test_given_instants_come_back_as_given_with_right_hand_limits(loop, t):
    """The last one too, even if it is a jump."""
    scenario = Scenario(disturbance=0.5, disturbance_time=2.0, t=np.array(t))
    got = simulate(loop, scenario)
    assert got.t.tolist() == t
    assert got.r.tolist() == [1.0] * len(t)
    assert got.d.tolist() == [0.5 if instant >= 2 else 0.0 for instant in t]
    np.testing.assert_allclose(np.array([got.y, got.u]), exact(loop, scenario, 2.0, t), rtol=0, atol=WITHIN)


@pytest.mark.parametrize("loop", [DEAD_TIME, NEUTRAL, FAST_ZERO])
@pytest.mark.parametrize("begins", [3.0, 2.375])
def test_every_jump_has_two_points_with_its_limits(loop, begins):
    """At k theta, and at k theta behind the disturbance, which need not be a multiple of it."""
    scenario, theta = Scenario(2.0, -0.5, begins, t_end=9.25, points=50), loop.plant.theta
    got = simulate(loop, scenario)
    twice = doubled(got.t)
    jumps = theta * np.arange(19)
    expected = np.unique(np.concatenate([jumps[jumps <= 9.25], begins + jumps[jumps <= 9.25 - begins]]))
    # the disturbance itself jumps at its beginning; u answers one dead time later
    np.testing.assert_allclose(twice, expected, rtol=0, atol=1e-12)
    assert np.max(np.unique(np.diff(got.t))) <= 9.25 / 49 * (1 + 1e-12)
    assert (got.t[0], got.t[-1]) == (0.0, 9.25)
    at = np.flatnonzero(np.diff(got.t) == 0)
    snapped = expected[np.searchsorted(expected, got.t[at] - 1e-9)]
    for index, left in ((at, True), (at + 1, False)):
        sides = np.full(len(at), left)
        values = exact(loop, scenario, begins, snapped, sides)
        np.testing.assert_allclose(np.array([got.y[index], got.u[index]]), values, rtol=0, atol=WITHIN)
    assert (got.r[0], got.r[1], got.d[0]) == (0.0, 2.0, 0.0)
    assert np.all(got.d[(got.t > 0) & (got.t < begins)] == 0)
    assert np.all(got.d[got.t > begins] == -0.5)
    assert sorted(got.d[got.t == begins]) == [-0.5, 0.0]


def test_a_horizon_that_ends_at_a_jump_ends_with_both_limits():
    got = simulate(DEAD_TIME, Scenario(disturbance=0, t_end=4.0, points=9))
    assert got.t[-2:].tolist() == [4.0, 4.0]
    unit = course(DEAD_TIME, False, 4.0)
    assert got.u[-2:] == pytest.approx([unit.at(4.0, left=True)[1], unit.at(4.0)[1]], abs=WITHIN)


def test_a_response_without_jumps_has_no_instant_twice_but_at_the_steps():
    got = simulate(Loop(Plant(1, 1, (4, 2)), IController(0.05)), Scenario(disturbance_time=7.5, t_end=20))
    assert set(doubled(got.t)) <= {0.0, 7.5}
    assert len(got.t) <= 603


def test_jumps_of_a_dead_time_that_is_no_binary_fraction():
    """k theta in doubles: 3 * 0.3 < 0.9. Either may be meant by an instant, so a hair beside it is right."""
    loop = Loop(Plant(1, 0.3), SeriesPid(0.8, 4))
    t = np.array([0.3 * k for k in range(12)])
    got = simulate(loop, Scenario(disturbance=0, t=t)).u
    after = simulate(loop, Scenario(disturbance=0, t=t + 1e-10)).u
    assert got == pytest.approx(after, abs=1e-8)


@pytest.mark.parametrize("begins", [0.0, 0.7, 3.0, math.pi, 17.3])
def test_the_disturbance_may_begin_at_any_time(begins):
    loop, t = Loop(Plant(1, 1, (4, 2)), SeriesPid(1, 4, 2, 0.25)), np.linspace(0.1, 25.1, 14)
    scenario = Scenario(-1.5, 3.0, begins, t=t)
    got = simulate(loop, scenario)
    np.testing.assert_allclose(np.array([got.y, got.u]), exact(loop, scenario, begins, t), rtol=0, atol=WITHIN)


def test_nothing_moves_without_steps():
    got = simulate(NEUTRAL, Scenario(0.0, 0.0, t_end=10))
    assert not np.any(got.y)
    assert not np.any(got.u)


def test_times_that_are_left_open():
    """The disturbance begins when the set-point step has settled, and settles itself."""
    for loop in (
        Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)),
        Loop(Plant(1, 1, integrators=1), SeriesPid(0.5, 8)),
        Loop(Plant(1, 0, (3, 1)), SeriesPid(2, 3)),
        Loop(Plant(1e-3, 200, (5000,)), SeriesPid(1e3, 1600)),
    ):
        got = simulate(loop)
        begins = got.t[np.argmax(got.d > 0)]
        assert got.t[-1] == pytest.approx(2 * begins)
        before, height = got.y[got.t < begins], np.max(np.abs(got.y[got.t >= begins] - 1))
        assert before[-1] == pytest.approx(1, abs=0.02)
        assert abs(got.y[-1] - 1) < 0.02 * height
        assert np.sum(np.abs(before - 1) > 0.02) > 20  # and not so long that nothing of it is seen
        half = simulate(loop, Scenario(t_end=30.0))
        assert half.t[np.argmax(half.d > 0)] == pytest.approx(15)
        late = simulate(loop, Scenario(disturbance_time=3 * begins))
        assert late.t[np.argmax(late.d > 0)] == pytest.approx(3 * begins)
        assert late.t[-1] > 3 * begins


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"t": [1.0, 0.5]}, "increasing"),
        ({"t": []}, "list of 1 to"),
        ({"t": [0.0, math.nan]}, "finite"),
        ({"t": [-1.0, 0.5]}, ">= 0"),
        ({"t_end": 0.0}, "t_end"),
        ({"t_end": -1.0}, "t_end"),
        ({"points": 1}, "points"),
        ({"points": 10**7}, "points"),
        ({"disturbance_time": -0.1}, "disturbance_time"),
        ({"setpoint": math.inf}, "setpoint"),
        ({"disturbance": math.nan}, "disturbance"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, says):
    with pytest.raises(InvalidParameter, match=says):
        Scenario(**wrong)
