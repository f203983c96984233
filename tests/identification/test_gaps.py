"""Records with a long gap: two tests of one process, days apart, in one file; the truth is known from closed forms."""

import numpy as np
import pytest

from simc_core import Trend, identify_all
from simc_core.identification.estimator.records import as_record
from tests.identification.simulated import rise

K, TAU1 = 1.7, 15.0


def two_tests(theta: float, gap: float, moves: int, seed: int, n: int = 300, h: float = 0.5) -> Trend:
    """OP between -1 and 1 at `moves` instants of each test, nothing in the gap; noise of 3 %."""
    chance = np.random.default_rng(seed)
    once = np.arange(n) * h
    at, values = [], []
    for begin in (0.0, once[-1] + gap):
        at += (begin + np.sort(chance.uniform(0.05, 0.95, moves)) * once[-1]).tolist()
        values += [*chance.choice([-1.0, 1.0], moves - 1), 0.0]
    t = np.concatenate([once, once[-1] + gap + once])
    sizes = np.diff([0.0, *values])
    y = 10 + K * sum(size * rise(t - s - theta, TAU1) for size, s in zip(sizes, at, strict=True))
    return Trend(t, y + 0.03 * K * chance.normal(size=t.size), [0.0, *values], t_u=[0.0, *at])


@pytest.mark.parametrize(("theta", "gap", "moves", "seed"), [(63.0, 2e6, 30, 2), (42.0, 1e6, 120, 3), (2.0, 1e7, 5, 4)])
def test_a_gap_of_days_costs_nothing(theta, gap, moves, seed):
    """It is longer than the tests by thousands of times, and a grid over all of it would step over the dead time."""
    best = identify_all(two_tests(theta, gap, moves, seed))[0]
    assert best.structure == "FOPDT"
    for name, value in {"k": K, "theta": theta, "tau1": TAU1}.items():
        assert abs(best.parameters[name] - value) < 4 * best.standard_errors[name]
        assert best.parameters[name] == pytest.approx(value, rel=0.05, abs=0.2)


@pytest.mark.parametrize("factor", [10, 30, 100, 300, 1000])
@pytest.mark.parametrize("theta", [1.0, 4.0, 15.0, 45.0])
def test_a_gap_of_many_times_the_test_leaves_the_gain_alone(factor, theta):
    """Dead times are short against the gap: 1/15000 to 1/33 of it; a grid that spans the gap misses them."""
    for seed in (1, 2):
        trend = two_tests(theta, factor * 150.0, 1 + seed, seed)
        found = {one.structure: one for one in identify_all(trend, ("FOPDT", "SOPDT"))}
        one = found["FOPDT"]
        for name, value in {"k": K, "theta": theta, "tau1": TAU1}.items():
            assert abs(one.parameters[name] - value) < 4 * one.standard_errors[name]
        assert one.parameters["k"] == pytest.approx(K, rel=0.03)
        assert found["SOPDT"].parameters["k"] == pytest.approx(K, rel=0.03)


def test_a_mean_of_neighbours_takes_in_no_gap():
    record = as_record(two_tests(2.0, 1e6, 3, 5, n=997), False).reduced(100)
    edge = 996 * 0.5
    assert not np.any((record.t > edge) & (record.t < edge + 1e6))
    assert record.stretch == pytest.approx(edge, abs=10)
