"""What must not change the answer: units, the origin of time, own instants of OP, how a record is cut in two."""

import numpy as np
import pytest

from simc_core import Trend, identify
from tests.identification.simulated import rise

K, THETA, TAU1 = 1.7, 6.4, 15.0


def trend(noise=0.01, n=300, seed=1, sizes=(2.0, -3.0), drift=0.0) -> Trend:
    t = np.linspace(0, 150, n)
    y = sum(K * size * rise(t - at - THETA, TAU1) for at, size in zip((20.0, 80.0), sizes, strict=True))
    y = y + noise * np.ptp(y) * np.random.default_rng(seed).normal(size=n) + drift * t
    return Trend(t, 30 + y, 40 + np.cumsum([0.0, *sizes]), t_u=[0.0, 20.0, 80.0])


def compared(found, other, factors) -> None:
    for name, factor in factors.items():
        assert other.parameters[name] == pytest.approx(factor * found.parameters[name], rel=1e-4)
        assert other.standard_errors[name] == pytest.approx(abs(factor) * found.standard_errors[name], rel=1e-2)


@pytest.mark.parametrize("time", [1e-3, 60.0, 3600.0])
def test_another_unit_of_time(time):
    one = trend()
    other = Trend(one.t * time, one.y, one.u, t_u=one.t_u * time)
    compared(identify(one), identify(other), {"k": 1, "theta": time, "tau1": time})


@pytest.mark.parametrize(("pv", "op"), [(1e-3, 1.0), (1.8, 1e4), (-1.0, 1.0), (1.0, -0.1)])
def test_other_units_of_pv_and_op(pv, op):
    one = trend()
    other = Trend(one.t, 32 + pv * one.y, op * one.u, t_u=one.t_u)
    compared(identify(one), identify(other), {"k": pv / op, "theta": 1, "tau1": 1})


def test_time_may_begin_anywhere():
    """Seconds since 1970: times have 1e-7 s left."""
    one = trend()
    other = Trend(one.t + 1.7e9, one.y, one.u, t_u=one.t_u + 1.7e9)
    compared(identify(one), identify(other), {"k": 1, "theta": 1, "tau1": 1})


def test_op_sampled_with_pv_or_written_down_when_it_moves_is_the_same():
    one = trend(n=301)  # samples every half unit: the moves fall on samples
    u = one.u[np.searchsorted(one.t_u, one.t, "right") - 1]
    compared(identify(one), identify(Trend(one.t, one.y, u)), {"k": 1, "theta": 1, "tau1": 1})


def test_op_written_down_late_costs_half_an_interval_unless_told():
    """OP every 8 from a logger, moved at 20 and 80: seen at 24 and 80."""
    one = trend(noise=0.0, n=1501)
    t_u = np.arange(0, 151, 8.0) + 5  # 5, 13, 21, ...: the moves lie between
    u = one.u[np.maximum(np.searchsorted(one.t_u, t_u, "right") - 1, 0)]
    late = identify(Trend(one.t, one.y, u, t_u=t_u)).parameters["theta"]
    middle = identify(Trend(one.t, one.y, u, t_u=t_u), between_samples=True).parameters["theta"]
    assert abs(middle - THETA) < abs(late - THETA)


def test_several_trends_have_one_model_and_levels_of_their_own():
    first = trend(sizes=(2.0, -3.0), seed=1, drift=0.02)
    second = trend(sizes=(-1.0, 4.0), seed=2)
    second = Trend(second.t, second.y + 100, second.u, t_u=second.t_u)
    found = identify([first, second])
    assert found.bias[1] - found.bias[0] == pytest.approx(100, abs=0.5)
    for name, value in {"k": K, "theta": THETA, "tau1": TAU1}.items():
        assert abs(found.parameters[name] - value) < 5 * found.standard_errors[name]
        assert found.standard_errors[name] < 1.1 * identify(first).standard_errors[name]
    assert found.residuals.size == first.t.size + second.t.size


def test_drift_is_found_and_reported():
    found = identify(trend(drift=0.05, noise=0.005))
    assert found.drift == pytest.approx(0.05, rel=0.1)
    assert any("drifts" in text for text in found.verdicts)
    assert identify(trend(noise=0.005), drift=False).drift == 0


def test_single_bad_samples_do_no_harm():
    one = trend(noise=0.005)
    y = one.y.copy()
    y[[50, 120, 121, 250]] = [0.0, 500.0, -500.0, 0.0]
    found = identify(Trend(one.t, y, one.u, t_u=one.t_u))
    for name, value in {"k": K, "theta": THETA, "tau1": TAU1}.items():
        assert abs(found.parameters[name] - value) < 5 * found.standard_errors[name]
    assert any("4 single samples" in text for text in found.verdicts)


def test_a_hundred_thousand_samples_and_a_loop_in_which_op_always_moves():
    chance = np.random.default_rng(0)
    n = 100_000
    t = np.linspace(0, 1500, n)
    u = np.where(t > 100, 1.0, 0.0) + 0.1 * np.cumsum(chance.normal(size=n)) / np.sqrt(n)
    kept = np.exp(-(t[1] - t[0]) / TAU1)
    late = round(THETA / (t[1] - t[0]))
    y = np.zeros(n)
    for i in range(1, n):
        y[i] = kept * y[i - 1] + K * (1 - kept) * (u[i - 1 - late] - u[0] if i > late else 0.0)
    found = identify(Trend(t, y + 0.02 * chance.normal(size=n), u))
    for name, value in {"k": K, "theta": late * (t[1] - t[0]), "tau1": TAU1}.items():
        assert found.parameters[name] == pytest.approx(value, rel=0.01)
