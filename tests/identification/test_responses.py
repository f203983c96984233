"""Responses to a held OP at delayed instants, against superposed closed forms."""

import numpy as np
import pytest

from simc_core.identification.estimator.held_input import HeldInput
from simc_core.identification.estimator.structures import STRUCTURES
from tests.identification.simulated import ramp, rise, two_lags

THETA = 0.37


def record(even: bool) -> tuple[np.ndarray, np.ndarray, HeldInput]:
    chance = np.random.default_rng(5)
    s = np.arange(60) * 0.7 if even else np.cumsum(chance.exponential(1, 60))
    u = chance.normal(size=60)
    return np.linspace(-1, s[-1] + 30, 500), u, HeldInput(s, u)


def superposed(step, t, held) -> np.ndarray:
    return sum(d * step(t - s - THETA) for d, s in zip(held.d, held.s, strict=True))


def two_equal(t, tau):
    t = np.maximum(t, 0)
    return 1 - np.exp(-t / tau) * (1 + t / tau)


def swing(t, tau0, zeta):
    t, root = np.maximum(t, 0), np.sqrt(1 - zeta**2)
    angle = root * t / tau0
    return 1 - np.exp(-zeta * t / tau0) * (np.cos(angle) + zeta / root * np.sin(angle))


@pytest.mark.parametrize("even", [True, False])
@pytest.mark.parametrize(
    ("key", "lags", "step"),
    [
        ("FOPDT", (3.0,), lambda t: rise(t, 3.0)),
        ("FOPDT", (0.01,), lambda t: rise(t, 0.01)),
        ("SOPDT", (3.0, 1.0), lambda t: two_lags(t, 3.0, 1.0)),
        ("SOPDT", (1.0, 3.0), lambda t: two_lags(t, 3.0, 1.0)),
        ("SOPDT", (2.0, 2.0), lambda t: two_equal(t, 2.0)),
        ("IPDT", (), ramp),
        ("IPDT_lag", (2.0,), lambda t: ramp(t) - 2.0 * rise(t, 2.0)),
        ("DIPDT", (), lambda t: np.maximum(t, 0) ** 2 / 2),
        ("oscillating", (2.0, 0.3), lambda t: swing(t, 2.0, 0.3)),
        ("oscillating", (2.0, 0.0), lambda t: swing(t, 2.0, 0.0)),
    ],
)
def test_columns_are_superposed_step_responses(even, key, lags, step):
    t, _, held = record(even)
    column = STRUCTURES[key].columns(held, held.locate(t - THETA), np.array(lags))[0]
    expected = superposed(step, t, held)
    assert np.max(np.abs(column - expected)) < 1e-13 * max(np.max(np.abs(expected)), 10.0)


def test_lags_near_one_another_lose_no_digits():
    t, _, held = record(even=False)
    at = held.locate(t - THETA)
    near, equal = (STRUCTURES["SOPDT"].columns(held, at, np.array([2.0, tau]))[0] for tau in (2.0 + 1e-12, 2.0))
    assert np.max(np.abs(near - equal)) < 1e-11


def test_the_zero_adds_the_derivative_of_the_response():
    """(T s + 1) x = x + T x': the second column is the derivative of the first, of any two lags."""
    t, _, held = record(even=False)
    t = t[np.min(np.abs(t[:, None] - THETA - held.s), axis=1) > 1e-3]
    h, lags = 1e-5, np.array([3.0, 1.0])
    late, here, early = (
        STRUCTURES["inverse"].columns(held, held.locate(t - THETA + shift), lags) for shift in (h, 0.0, -h)
    )
    assert np.max(np.abs((late[0] - early[0]) / (2 * h) - here[1])) < 1e-8


def test_two_moves_at_one_instant_are_their_sum():
    twice = HeldInput(np.array([0.0, 1.0, 1.0]), np.array([0.0, 5.0, 2.0]))
    once = HeldInput(np.array([0.0, 1.0]), np.array([0.0, 2.0]))
    t = np.linspace(0, 5, 50)
    for structure in STRUCTURES.values():
        lags = np.array([2.0, 0.5][: len(structure.lags)])
        for a, b in zip(
            structure.columns(twice, twice.locate(t), lags), structure.columns(once, once.locate(t), lags), strict=True
        ):
            assert np.allclose(a, b, atol=1e-14)
