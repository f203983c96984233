"""Ms of a cloud of plants against tau_c, and the tau_c that follows."""

import numpy as np
import pytest

from simc_core import (
    InvalidParameter,
    Loop,
    NotIdentifiable,
    Plant,
    Trend,
    WrongType,
    identify,
    identify_all,
    margins,
    ms_of_cloud,
    robust_tau_c,
    simc,
    uncertainty_of,
)
from simc_core.identification.cloud import clouds
from tests.identification.simulated import rise


def trend(noise, seed=0, n=200) -> Trend:
    t = np.linspace(0, 60, n)
    y = 2 * rise(t - 13, 8.0)
    return Trend(t, y + 2 * noise * np.random.default_rng(seed).normal(size=n), [0.0, 1.0], t_u=[0.0, 10.0])


@pytest.mark.parametrize("structure", ["FOPDT", "SOPDT", "IPDT", "IPDT_lag"])
def test_ms_of_each_plant_is_that_of_the_exact_loop(structure):
    found = identify(trend(0.05), structure)
    tau_c = np.array([0.3, 1.0, 4.0]) * found.model.theta
    measured = ms_of_cloud(found, tau_c)
    cloud = clouds(found)[0]
    for j in (0, 3, 50, 120):
        value = dict(zip(cloud.names, cloud.values[j].tolist(), strict=True))
        lags = tuple(value[name] for name in ("tau1", "tau2") if name in value)
        gain = value.get("k", value.get("k_prime"))
        plant = Plant(gain, value["theta"], lags, integrators=cloud.integrators)
        for i, one in enumerate(tau_c.tolist()):
            exact = margins(Loop(plant, simc(found.model, one)))
            if not exact.stable:
                assert measured.Ms[i, j] == np.inf
            else:
                assert measured.Ms[i, j] == pytest.approx(exact.Ms, rel=2e-3)


def test_the_cloud_has_the_covariance_of_the_estimate():
    found = identify(trend(0.02))
    cloud = clouds(found, 4000)[0]
    spread = np.cov(np.log(cloud.values[:, 1:]).T)[0, 0] ** 0.5
    freedom = found.estimate.freedom
    expected = found.standard_errors["tau1"] / found.parameters["tau1"] * (freedom / (freedom - 2)) ** 0.5
    assert spread == pytest.approx(expected, rel=0.1)


def test_more_noise_asks_for_a_slower_loop():
    tests = [identify(trend(noise)) for noise in (0.0, 0.05, 0.15)]
    found = [robust_tau_c(one, Ms=1.7) / one.model.theta for one in tests]
    assert found[0] == pytest.approx(1, rel=1e-3)
    assert found[0] < found[1] < found[2]


def test_the_limit_holds_where_it_is_said_to():
    found = identify(trend(0.1))
    tau_c = robust_tau_c(found, Ms=1.7, probability=0.9)
    at = ms_of_cloud(found, [tau_c])
    assert at.within(1.7)[0] >= 0.9
    assert at.quantile(0.9)[0] <= 1.7


def test_the_true_plant_stays_within_the_limit():
    """24 tests with 10 % noise: Ms of the truth with the settings found is within 1.7 in nearly all."""
    true, kept = Plant(2, 3, (8,)), []
    for seed in range(24):
        found = identify(trend(0.1, seed))
        kept.append(margins(Loop(true, simc(found.model, robust_tau_c(found)))).Ms <= 1.7)
    assert np.mean(kept) > 0.9


def test_structures_that_fit_nearly_as_well_are_in_the_cloud():
    ranked = identify_all(trend(0.1))
    near = [one for one in ranked if one.criterion <= 6]
    assert len(clouds(ranked)) == len(near) > 1
    assert ms_of_cloud(ranked, [3.0]).Ms.size > 1.9 * ms_of_cloud(ranked[0], [3.0]).Ms.size


def test_a_trend_that_says_too_little_gives_no_settings():
    with pytest.raises(NotIdentifiable, match="No tau_c up to"):
        robust_tau_c(identify(trend(0.25, seed=3, n=40)), Ms=1.1, probability=0.999)


def test_bounds():
    found = identify(trend(0.01))
    with pytest.raises(InvalidParameter, match=r"Ms must be >= 1\.05"):
        robust_tau_c(found, Ms=1.0)
    with pytest.raises(InvalidParameter, match="tau_c"):
        ms_of_cloud(found, [0.0])
    with pytest.raises(InvalidParameter, match="found 2e\\+09"):  # the one that is wrong, not the smallest
        ms_of_cloud(found, [1.0, 2e9])
    with pytest.raises(InvalidParameter, match="1 to 100"):
        ms_of_cloud(found, [])


@pytest.mark.parametrize("given", [None, (), "FOPDT", 3.0])
def test_settings_are_those_of_something_fitted(given):
    for ask in (ms_of_cloud, robust_tau_c):
        with pytest.raises(WrongType, match="identify or identify_all"):
            ask(given)
        with pytest.raises(WrongType, match="identify or identify_all"):
            ask(uncertainty_of(identify(trend(0.01))))  # an uncertainty alone has no settings of its own
