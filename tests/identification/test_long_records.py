"""Records far longer than the answers of the process in them: a week at one second; the truth is a closed form."""

import numpy as np
import pytest

from simc_core import Trend, identify_all
from simc_core.identification.estimator.records import as_record
from tests.identification.simulated import rise

K, THETA, TAU1 = 1.2, 32.0, 230.0


@pytest.fixture(scope="module")
def week() -> Trend:
    """Four moves in a record of 240 000 seconds, written down every two."""
    t = np.arange(0.0, 240_000.0, 2.0)
    at = (20_000.0, 80_000.0, 140_000.0, 200_000.0)
    sizes = (5.0, -5.0, 5.0, -5.0)
    y = 120 + K * sum(size * rise(t - s - THETA, TAU1) for size, s in zip(sizes, at, strict=True))
    y = y + 0.15 * np.random.default_rng(0).normal(size=t.size)
    return Trend(t, y, np.cumsum([45.0, *sizes]), t_u=[0.0, *at])


def test_the_dead_time_is_found_although_means_are_longer_than_it(week):
    best = identify_all(week, ("FOPDT", "SOPDT"))[0]
    assert best.structure == "FOPDT"
    for name, value in {"k": K, "theta": THETA, "tau1": TAU1}.items():
        assert abs(best.parameters[name] - value) < 4 * best.standard_errors[name]
        assert best.parameters[name] == pytest.approx(value, rel=0.02)


def test_means_are_short_after_a_move_and_long_before_the_next(week):
    record = as_record(week, False).reduced(400)
    assert 250 < record.t.size < 500
    steps = np.diff(record.t)
    after = steps[np.searchsorted(record.t, 80_000.0) :]
    assert after[:3].max() < 10
    assert after[:80].max() > 1000
    assert np.sum(record.weight) == week.t.size
