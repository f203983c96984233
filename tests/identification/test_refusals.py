"""The honest no: trends from which no model may be given, and those that come with a warning."""

import numpy as np
import pytest

from simc_core import InvalidParameter, NotIdentifiable, Trend, WrongType, find_moves, identify, identify_all
from tests.identification.simulated import closed_loop, rise

N, H = 600, 0.5
NONE = np.zeros(N)
STEP = np.where(np.arange(N) >= 40, 1.0, 0.0)


def noise(size=0.02, seed=0):
    return size * np.random.default_rng(seed).normal(size=N)


def loop(setpoint, noise, load, Kc=0.9, tau_I=12.0) -> Trend:
    return closed_loop(N, H, 2.0, 3.2, 12.0, Kc, tau_I, setpoint, noise, load)


def test_op_that_never_moves_is_no_test_of_the_process():
    """A load moved PV."""
    t = np.arange(200.0)
    with pytest.raises(NotIdentifiable, match="OP never moves"):
        identify(Trend(t, rise(t - 50, 20.0), np.full(200, 40.0)))


def test_pv_that_never_moves():
    with pytest.raises(NotIdentifiable, match="PV never moves"):
        identify(Trend(np.arange(100.0), np.full(100, 3.0), np.arange(100) > 50))


def test_pv_of_two_values_shows_no_dynamics():
    t = np.arange(100.0)
    with pytest.raises(NotIdentifiable, match="PV takes two values only, 0 and 2"):
        identify(Trend(t, 2 * (t >= 53), t >= 50))


@pytest.mark.parametrize("tau_I", [12.0, np.inf])
@pytest.mark.parametrize("load", [NONE, np.where(np.arange(N) > 100, 1.0, 0.0)])
def test_a_loop_at_constant_set_point_shows_its_controller(tau_I, load):
    """Least squares would return -1/Kc with a perfect fit."""
    trend = loop(NONE, noise(), load, 0.5, tau_I)
    with pytest.raises(NotIdentifiable, match="The loop was closed at a constant set point"):
        identify(trend)
    with pytest.raises(NotIdentifiable, match="The loop was closed"):
        identify_all(Trend(trend.t, trend.y, trend.u))


def test_the_same_loop_with_a_set_point_step_shows_the_process():
    trend = loop(STEP, noise(), NONE)
    for given in (trend, Trend(trend.t, trend.y, trend.u)):
        found = identify(given)
        for name, value in {"k": 2.0, "theta": 3.2, "tau1": 12.0}.items():
            assert abs(found.parameters[name] - value) < 5 * found.standard_errors[name]
            assert found.parameters[name] == pytest.approx(value, rel=0.08)


def test_the_set_point_taken_for_op():
    trend = loop(STEP, noise(), NONE)
    assert "are they the set point?" in identify(Trend(trend.t, trend.y, STEP)).verdicts[0]
    with pytest.raises(NotIdentifiable, match="OP and SP are the same"):
        identify(Trend(trend.t, trend.y, STEP, r=STEP))


def test_a_step_lost_in_the_noise_is_refused_with_the_step_it_would_take():
    t = np.arange(200.0)
    y = 0.02 * rise(t - 60, 10.0) + np.random.default_rng(4).normal(size=200)
    with pytest.raises(NotIdentifiable, match=r"steps about \d+ times"):
        identify(Trend(t, y, t >= 50))


def test_a_known_sign_is_held():
    t = np.arange(200.0)
    trend = Trend(t, -rise(t - 60, 10.0), t >= 50)
    assert identify(trend, sign=-1).parameters["k"] == pytest.approx(-1, rel=1e-3)
    with pytest.raises(NotIdentifiable, match="against the sign given"):
        identify(trend, sign=1)
    with pytest.raises(InvalidParameter, match="sign must be 1 or -1"):
        identify(trend, sign=0)


def test_too_few_samples():
    with pytest.raises(NotIdentifiable, match="too few"):
        identify(Trend(range(6), [0, 0, 0, 1, 2, 2], [0, 0, 1, 1, 1, 1]), "SOPDT")


def test_something_that_is_no_trend():
    with pytest.raises(WrongType, match="trend must be a Trend"):
        identify([[0, 1, 2]])
    with pytest.raises(InvalidParameter, match="empty"):
        identify([])
    with pytest.raises(InvalidParameter, match="at least one"):
        identify_all(Trend(range(40), range(40), [0] * 20 + [1] * 20), ())


def steps(sizes, gains, noise=0.02, seed=0) -> Trend:
    t = np.linspace(0, 400, 800)
    at = 30 + 120.0 * np.arange(len(sizes))
    y = sum(k * size * rise(t - s - 5, 12.0) for k, size, s in zip(gains, sizes, at, strict=True))
    y = y + noise * np.random.default_rng(seed).normal(size=t.size)
    return Trend(t, y, np.cumsum([0.0, *sizes]), t_u=[0.0, *at])


def test_steps_that_disagree_are_named():
    found = identify(steps((1.0, -1.0, 1.0), (2.0, 2.8, 2.0)))
    assert any("The gain differs from move to move" in text for text in found.verdicts)
    assert [round(one.gain, 1) for one in found.gains] == [2.0, 2.8, 2.0]


def test_steps_that_agree_are_not():
    for seed in range(10):
        found = identify(steps((1.0, -1.0, 1.0), (2.0, 2.0, 2.0), seed=seed))
        assert not any("differs" in text or "hardly" in text for text in found.verdicts)


def test_an_actuator_that_did_not_follow_is_named():
    found = identify(steps((1.0, 1.0, -1.0), (2.0, 0.0, 2.0)))
    assert any("did not follow" in text for text in found.verdicts)


def test_a_load_in_the_middle_is_placed():
    trend = steps((1.0,), (2.0,))
    load = 0.6 * rise(trend.t - 200, 10.0)
    found = identify(Trend(trend.t, trend.y + load, trend.u, t_u=trend.t_u), drift=False)
    said = [text for text in found.verdicts if "seems to have moved PV" in text]
    assert said
    assert abs(float(said[0].split("near ")[1].split(" ")[0]) - 200) < 40


def test_a_trend_that_ends_early_is_said_to_be_unsettled():
    t = np.linspace(0, 20, 400)
    y = 2 * rise(t - 6, 30.0) + 0.01 * np.random.default_rng(0).normal(size=400)
    found = identify(Trend(t, y, [0.0, 1.0], t_u=[0.0, 5.0]))
    assert any("settled" in text for text in found.verdicts)
    slope, error = found.slope
    assert abs(slope - 2 / 30) < 5 * error
    assert error / slope < 0.5 * found.standard_errors["k"] / abs(found.parameters["k"])


def test_a_dead_time_that_the_sampling_hides_is_said_to_be_unknown():
    t = np.arange(0.0, 200.0, 10.0)
    y = 2 * rise(t - 53, 20.0) + 0.02 * np.random.default_rng(0).normal(size=t.size)
    found = identify(Trend(t, y, [0.0, 1.0], t_u=[0.0, 50.0]))
    assert any("not resolved by this sampling" in text for text in found.verdicts)


def test_moves_stand_out_of_a_noisy_output():
    t = np.arange(400.0)
    u = 50 + 5.0 * (t >= 100) - 8.0 * (t >= 250) + 0.05 * np.random.default_rng(1).normal(size=400)
    moves = find_moves(Trend(t, t, u))
    assert [move.t for move in moves] == [100, 250]
    assert [round(move.size) for move in moves] == [5, -8]
