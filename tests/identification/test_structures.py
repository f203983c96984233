"""Every structure is found from its own closed-form response, and told from the others."""

import numpy as np
import pytest

from simc_core import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    InvalidParameter,
    OscillatingDelay,
    SecondOrderDelay,
    Trend,
    UnstableDelay,
    identify,
    identify_all,
)
from tests.identification.simulated import ramp, rise, two_lags
from tests.identification.test_responses import swing

MOVES = ((12.0, 2.0), (55.0, -3.0))
THETA = 4.3


def trend(step, noise=0.0, n=400, end=120.0, seed=0, moves=MOVES) -> Trend:
    t = np.linspace(0, end, n)
    y = sum(size * step(t - at - THETA) for at, size in moves)
    y = y + noise * np.ptp(y) * np.random.default_rng(seed).normal(size=n)
    t_u = [0.0, *(at for at, _ in moves)]
    return Trend(t, 30 + y, 50 + np.cumsum([0.0, *(size for _, size in moves)]), t_u=t_u)


def inverse(t):
    """1.5 (1 - 8s)/((12s + 1)(5s + 1)): x - 8 x'."""
    late = np.maximum(t, 0)
    slope = (np.exp(-late / 12) - np.exp(-late / 5)) / 7
    return 1.5 * (two_lags(t, 12, 5) - 8 * np.where(t > 0, slope, 0))


CASES = {
    "FOPDT": (lambda t: 1.5 * rise(t, 9), {"k": 1.5, "theta": THETA, "tau1": 9}, FirstOrderDelay),
    "SOPDT": (
        lambda t: -1.5 * two_lags(t, 9, 4),
        {"k": -1.5, "theta": THETA, "tau1": 9, "tau2": 4},
        SecondOrderDelay,
    ),
    "IPDT": (lambda t: 0.2 * ramp(t), {"k_prime": 0.2, "theta": THETA}, IntegratingDelay),
    "IPDT_lag": (
        lambda t: 0.2 * (ramp(t) - 6 * rise(t, 6)),
        {"k_prime": 0.2, "theta": THETA, "tau2": 6},
        IntegratingDelay,
    ),
    "DIPDT": (lambda t: 0.01 * ramp(t) ** 2, {"k_double_prime": 0.02, "theta": THETA}, DoubleIntegratingDelay),
    "inverse": (inverse, {"k": 1.5, "T": -8, "theta": THETA, "tau1": 12, "tau2": 5}, FirstOrderDelay),
    "oscillating": (
        lambda t: 2 * swing(t, 5, 0.3),
        {"k": 2, "theta": THETA, "tau0": 5, "zeta": 0.3},
        OscillatingDelay,
    ),
}


@pytest.mark.parametrize("key", CASES)
def test_a_structure_is_found_from_its_own_response(key):
    step, truth, kind = CASES[key]
    found = identify(trend(step), key)
    assert list(found.parameters) == list(truth)
    for name, value in truth.items():
        assert found.parameters[name] == pytest.approx(value, rel=2e-3)
    assert isinstance(found.model, kind)
    assert found.fit > 0.999
    if not found.estimate.fit.problem.structure.integrating:
        assert found.bias == pytest.approx(30, abs=0.05)


@pytest.mark.parametrize("key", CASES)
def test_noise_leaves_the_truth_within_five_standard_errors(key):
    step, truth, _ = CASES[key]
    found = identify(trend(step, noise=0.01, n=1000), key)
    for name, value in truth.items():
        assert abs(found.parameters[name] - value) < 5 * found.standard_errors[name]


def test_an_unstable_process_is_found_from_its_closed_loop():
    """1.2 e^{-0.5s}/(s - 0.2) under P control with gain 1, noise on the measurement, exact between samples."""
    h, n, k, a, chance = 0.1, 900, 1.2, 0.2, np.random.default_rng(3)
    y, u, state = np.zeros(n), np.zeros(n), 0.0
    setpoint = np.where(np.arange(n) > 50, 1.0, 0.0) - 2.0 * (np.arange(n) > 400)
    noise = 0.02 * chance.normal(size=n)
    for i in range(n):
        if i:
            state = np.exp(a * h) * state + k * np.expm1(a * h) / a * (u[i - 6] if i >= 6 else 0.0)
        y[i] = state + noise[i]
        u[i] = setpoint[i] - y[i]
    found = identify(Trend(np.arange(n) * h, y, u, r=setpoint), "unstable")
    assert isinstance(found.model, UnstableDelay)
    for name, value in {"k_prime": k, "theta": 0.5, "a": a}.items():
        assert found.parameters[name] == pytest.approx(value, rel=0.08)


@pytest.mark.parametrize("key", ["FOPDT", "SOPDT", "IPDT", "IPDT_lag"])
def test_the_right_structure_ranks_first(key):
    ranked = identify_all(trend(CASES[key][0], noise=0.005, n=600, seed=2))
    assert ranked[0].structure == key
    assert ranked[0].criterion == 0
    assert [one.criterion for one in ranked] == sorted(one.criterion for one in ranked)


def test_no_self_regulating_process_is_taken_for_integrating():
    for seed in range(12):
        chance = np.random.default_rng(seed)
        tau = 10 ** chance.uniform(0.5, 1.5)
        moves = ((12.0, 2.0),) if seed % 2 else MOVES
        found = identify_all(trend(lambda t, tau=tau: rise(t, tau), noise=0.01, seed=seed, moves=moves))
        assert not found[0].structure.startswith("IPDT")


def test_an_unknown_structure_is_refused_by_name():
    with pytest.raises(InvalidParameter, match="structure must be one of FOPDT"):
        identify(trend(CASES["FOPDT"][0]), "ARX")


def test_a_record_that_ends_before_pv_settles_does_not_make_an_integrator():
    """Two lags of 180, the record ends after 4 of them, noise that shows the drift an integrator would need."""
    t = np.linspace(0, 720, 1441)
    late = np.maximum(t - 60, 0)
    y = 150 * (1 - np.exp(-late / 180) * (1 + late / 180)) + 0.3 * np.random.default_rng(0).normal(size=t.size)
    ranked = identify_all(Trend(t, 27 + y, [0.0, 30.0], t_u=[0.0, 60.0]))
    assert not ranked[0].plant.integrators
