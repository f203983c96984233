"""What a trend leaves open: the band of the frequency response, and the few numbers that hold it."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.optimize import brentq

from simc_core import (
    InvalidParameter,
    SeriesPid,
    Trend,
    Uncertainty,
    frequency_band,
    identify,
    identify_all,
    ms_of_plants,
    uncertainty_of,
)
from simc_core.identification.cloud import clouds
from tests.identification.simulated import rise


def trend(noise: float, seed: int = 0, k: float = 2.0, time: float = 1.0) -> Trend:
    t = np.linspace(0, 60, 200)
    y = k * (rise(t - 13, 8.0) + noise * np.random.default_rng(seed).normal(size=200))
    return Trend(time * t, y, [0.0, 1.0], t_u=[0.0, 10.0 * time])


@pytest.mark.parametrize("k", [2.0, -2.0])
def test_without_noise_the_band_is_the_response(k):
    omega = np.geomspace(0.01, 3, 40)
    found = frequency_band(identify(trend(0.0, k=k)), omega)
    assert found.magnitude_low == pytest.approx(2 / np.hypot(1, 8 * omega), rel=0.01)
    assert found.magnitude_high == pytest.approx(found.magnitude_low, rel=0.02)
    assert found.phase == pytest.approx(-np.degrees(3 * omega + np.arctan(8 * omega)), rel=0.01)


def test_the_crossing_of_180_degrees():
    found = frequency_band(identify(trend(0.0)))
    exact = brentq(lambda omega: 3 * omega + np.arctan(8 * omega) - np.pi, 0.1, 1)
    assert found.omega_180 == pytest.approx((exact, exact, exact), rel=0.01)


def test_the_band_holds_the_truth_as_often_as_it_says():
    """Twenty tests with 5 % noise, at three frequencies; the band is 95 %."""
    omega = np.array([0.05, 0.2, 0.6])
    truth = 2 / np.hypot(1, 8 * omega)
    inside = []
    for seed in range(20):
        found = frequency_band(identify(trend(0.05, seed)), omega)
        inside.extend((found.magnitude_low <= truth) & (truth <= found.magnitude_high))
    assert np.mean(inside) > 0.88


def test_numbers_of_it_give_the_same_plants_as_the_fit():
    ranked = identify_all(trend(0.1))
    known = uncertainty_of(ranked)
    assert len(known) == sum(one.criterion <= 6 for one in ranked) > 1
    controller = SeriesPid(0.5, 8)
    assert ms_of_plants(known, controller) == pytest.approx(ms_of_plants(ranked, controller))


@pytest.mark.parametrize("structure", ["FOPDT", "SOPDT", "IPDT_lag", "inverse", "oscillating", "DIPDT"])
def test_another_time_unit_changes_the_numbers_and_nothing_else(structure):
    """In seconds the same plant has times 60 times as large; Ms with times of the controller alike is the same."""
    (known,) = (
        [Uncertainty("DIPDT", (3.0, 0.1), (0.09, 0.01, 0.0004), 40.0)]
        if structure == "DIPDT"
        else uncertainty_of(identify(trend(0.03), structure))
    )
    seconds = known.rescaled(Fraction(60))
    gains = {"IPDT_lag": 60.0, "DIPDT": 3600.0}.get(structure, 1.0)
    omega = np.geomspace(0.01, 2, 30)
    before, after = clouds(known)[0], clouds(seconds)[0]
    assert after.values[:, 0] == pytest.approx(60 * before.values[:, 0], rel=1e-6, abs=1e-6)
    ours = before.response(omega)[0]
    assert after.response(omega / 60)[0] == pytest.approx(ours, rel=1e-9)
    assert gains * after.values[0, -1] == pytest.approx(before.values[0, -1] * (60 if structure == "inverse" else 1))


def test_members_are_plants():
    cloud = clouds(identify(trend(0.1)))[0]
    plants = cloud.plants(20)
    assert len(plants) == 20
    assert plants[0].response(1j * 0.3) == pytest.approx(cloud.response(np.array([0.3]))[0, 0])


def test_bounds():
    with pytest.raises(InvalidParameter, match="structure must be one of"):
        Uncertainty("ARX", (), (), 5)
    with pytest.raises(InvalidParameter, match="values of FOPDT must have 3"):
        Uncertainty("FOPDT", (1.0,), (0.0,) * 6, 5)
    with pytest.raises(InvalidParameter, match="negative variance"):
        Uncertainty("FOPDT", (1.0, 1.0, 1.0), (-1.0, 0.0, 0.0, 0.0, 0.0, 0.0), 5)
    with pytest.raises(InvalidParameter, match="omega must be positive"):
        frequency_band(identify(trend(0.0)), [2.0, 1.0])
