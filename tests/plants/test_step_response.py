"""Step response of a plant against closed forms, numerical inversion of the transform, and limits."""

import mpmath
import numpy as np
import pytest

from simc_core import Plant
from simc_core.errors import InvalidParameter
from simc_core.plants.step_response import plant_step, step_horizon


def damped(t):
    w = np.sqrt(1 - 0.09)
    return 1 - np.exp(-0.3 * t) * (np.cos(w * t) + 0.3 / w * np.sin(w * t))


@pytest.mark.parametrize(
    ("plant", "y0"),
    [
        (Plant(2.0, 0.7, (3.0,)), lambda t: 2 * (1 - np.exp(-t / 3))),
        (Plant(1.0, 0.0, (2.0, 2.0)), lambda t: 1 - np.exp(-t / 2) * (1 + t / 2)),
        (Plant(1.0, 0.31, (2.0, 1e-3)), lambda t: 1 - (2 * np.exp(-t / 2) - 1e-3 * np.exp(-t / 1e-3)) / (2 - 1e-3)),
        (Plant(1.0, 1.0, (4.0,), (-2.0,)), lambda t: 1 - 1.5 * np.exp(-t / 4)),
        (Plant(0.5, 1.0, integrators=1), lambda t: 0.5 * t),
        (Plant(0.5, 1.0, (3.0,), integrators=1), lambda t: 0.5 * (t - 3 * (1 - np.exp(-t / 3)))),
        (Plant(0.5, 1.0, integrators=2), lambda t: 0.25 * t**2),
        (Plant(-1.0, 0.5, (-20.0,)), lambda t: np.exp(t / 20) - 1),
        (Plant(1.0, 0.2, lag_pairs=((1.0, 0.3),)), damped),
        (Plant(3.0, 2.0), lambda t: 3.0 + 0 * t),
        (Plant(1.0, 0.0, (1.0, 1.0), lead_pairs=((1.0, 1.0),)), lambda t: 1.0 + 0 * t),
    ],
)
def test_closed_forms(plant, y0):
    step = plant_step(plant)
    expected = np.where(step.t >= plant.theta, y0(np.maximum(step.t - plant.theta, 0)), 0.0)
    assert step.y == pytest.approx(expected, abs=1e-11 * (1 + np.max(np.abs(expected))))


@pytest.mark.parametrize(
    "plant",
    [
        Plant(1.5, 0.4, (20.0, 3.0, 0.2, 0.01), (-1.0, 5.0)),
        Plant(1.0, 0.0, (1.0,) * 8),
        Plant(1.0, 1.0, (5.0, 2.0), (-0.5,), 1, ((1.0, 0.4),), ((0.7, 0.1),)),
    ],
)
def test_against_numerical_inversion_of_the_laplace_transform(plant):
    step = plant_step(plant)

    def transform(s):
        value = plant.k / s ** (plant.integrators + 1)
        for T in plant.leads:
            value *= T * s + 1
        for tau in plant.lags:
            value /= tau * s + 1
        for tau, zeta in plant.lead_pairs:
            value *= tau**2 * s**2 + 2 * zeta * tau * s + 1
        for tau, zeta in plant.lag_pairs:
            value /= tau**2 * s**2 + 2 * zeta * tau * s + 1
        return value

    for i in (60, 250, 590):
        with mpmath.workdps(30):
            exact = mpmath.invertlaplace(transform, step.t[i] - plant.theta, method="talbot", degree=60)
        assert step.y[i] == pytest.approx(float(exact), rel=1e-10)


def test_a_stable_response_is_at_rest_at_its_horizon():
    for plant in (
        Plant(2.0, 3.0, (6.0, 4.0, 2.0)),
        Plant(2.0, 0.0, (1.0,) * 8),
        Plant(2.0, 1.0, lag_pairs=((1, 0.2),)),
    ):
        assert plant_step(plant).y[-1] == pytest.approx(2.0, rel=0.02)


def test_extremes_stay_finite():
    for plant in (Plant(1e12, 1e9, (1e9, 1e-9)), Plant(1.0, lag_pairs=((1.0, 0.0),)), Plant(1.0, 1.0, (-1e-9, 1e9))):
        assert np.all(np.isfinite(plant_step(plant).y))
        assert step_horizon(plant) > 0


def test_the_horizon_given_is_kept_and_must_be_positive():
    assert plant_step(Plant(1.0, 5.0), 2.0).t[-1] == 2.0
    assert not plant_step(Plant(1.0, 5.0), 2.0).y.any()
    with pytest.raises(InvalidParameter, match="t_end must not be zero"):
        plant_step(Plant(1.0, 5.0), 0.0)
