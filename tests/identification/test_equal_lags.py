"""Two equal lags: how far they may part does not show in first derivatives; the truth is a closed form."""

import numpy as np
import pytest

from simc_core import Loop, Plant, SeriesPid, Trend, identify, margins, ms_of_plants, robust_tau_c, simc
from simc_core.identification.cloud import clouds

TRUTH = Plant(2.0, 4.0, (12.0, 12.0))


def trend(seed: int, noise: float = 0.02) -> Trend:
    """A step of 2 e^{-4s}/(12 s + 1)^2: 1 - (1 + t/12) e^{-t/12}."""
    t = np.arange(0.0, 160.0)
    since = np.maximum(t - 24.0, 0.0) / 12
    y = 2 * (1 - (1 + since) * np.exp(-since))
    return Trend(t, y + 2 * noise * np.random.default_rng(seed).normal(size=t.size), [0.0, 1.0], t_u=[0.0, 20.0])


@pytest.fixture(scope="module")
def results():
    """Ten tests with 2 % noise."""
    return [identify(trend(seed), "SOPDT") for seed in range(10)]


def test_intervals_hold_both_and_are_of_use(results):
    hit = []
    for found in results:
        for name in ("k", "theta", "tau1", "tau2"):
            value = {"k": 2.0, "theta": 4.0}.get(name, 12.0)
            hit.append(found.intervals[name][0] <= value <= found.intervals[name][1])
        assert found.intervals["tau1"][1] < 4 * found.parameters["tau1"]
    assert np.mean(hit) > 0.85


def test_plants_of_the_cloud_keep_the_sum(results):
    """It is known within a few per cent, however far the lags part."""
    for found in results:
        (cloud,) = clouds(found)
        total = cloud.values[:, 1] + cloud.values[:, 2]
        assert np.quantile(total, 0.95) < 1.5 * total[0]


def test_there_is_a_safe_tau_c_and_it_is_safe(results):
    for found in results[:5]:
        safe = simc(found.model, robust_tau_c(found, Ms=1.8))
        assert margins(Loop(TRUTH, safe)).Ms <= 1.8


def test_the_cloud_holds_what_is_known_of_the_truth(results):
    """Ms of settings by hand on the true plant lies among those of the cloud."""
    controller = SeriesPid(1.0, 14.0, 10.0)
    truth = margins(Loop(TRUTH, controller)).Ms
    inside = []
    for found in results:
        low, high = np.quantile(ms_of_plants(found, controller), [0.01, 0.99])
        inside.append(low <= truth <= high)
    assert np.mean(inside) >= 0.8
