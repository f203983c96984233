"""The ultimate point against closed forms and against a search that knows nothing of crossings."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from simc_core import NotReducible, Plant, ultimate


@pytest.mark.parametrize(
    ("plant", "Ku", "Pu"),
    [
        (Plant(1, 1, (), (), 1), math.pi / 2, 4),  # e^-s/s: omega = pi/2
        (Plant(1, 0, (1, 1, 1, 1)), 4, 2 * math.pi),
        (Plant(1, 0, (1, 1, 1)), 8, 2 * math.pi / math.sqrt(3)),
        (Plant(2, 3), 0.5, 6),  # 2 e^-3s: omega = pi/3
        (Plant(1, 1, (1,)), 2.26183, 3.09706),
        (Plant(1, 1, (8,)), 13.21044, 3.81593),
        (Plant(1, 1, (6, 2)), 8.87344, 8.05229),
        (Plant(-1, 1, (8,)), -13.21044, 3.81593),
        (Plant(1, 0, (10,), (), 0, ((1, 0.5),)), 11.1, 2 * math.pi / math.sqrt(1.1)),  # Routh: (s^2+s+1)(10s+1) + K
    ],
)
def test_ultimate_point_is_the_known_one(plant, Ku, Pu):
    point = ultimate(plant)
    assert (point.Ku, point.Pu) == pytest.approx((Ku, Pu), rel=3e-6)


@pytest.mark.parametrize("seed", range(20))
def test_at_the_ultimate_point_the_loop_closes_on_itself(seed):
    """1 + Ku G(2 pi j/Pu) = 0, and below it the phase never reached -180 degrees."""
    random = np.random.default_rng(seed)
    lags = tuple(random.uniform(0.1, 10, random.integers(1, 5)).tolist())
    plant = Plant(random.choice([-3.0, 0.5]), random.uniform(0.1, 5), lags, (), int(random.integers(0, 2)))

    def phase(omega):  # of G/k, unwrapped
        return -omega * plant.theta - sum(math.atan(omega * tau) for tau in lags) - plant.integrators * math.pi / 2

    omega = brentq(lambda w: phase(w) + math.pi, 1e-6, 1e3, xtol=1e-14)
    point = ultimate(plant)
    assert point.Pu == pytest.approx(2 * math.pi / omega, rel=1e-9)
    assert point.Ku * plant.response(1j * omega) == pytest.approx(-1, abs=1e-9)


def test_an_unstable_plant_has_its_upper_limit():
    """e^-s/(20 s - 1): stable from Kc = 1, where a pole leaves through 0, to the first crossing."""
    point = ultimate(Plant(-1, 1, (-20,)))
    omega = 2 * math.pi / point.Pu
    assert point.Ku > 1
    assert math.pi - omega - math.pi + math.atan(20 * omega) == pytest.approx(0, abs=1e-9)
    assert point.Ku == pytest.approx(math.hypot(1, 20 * omega), rel=1e-9)


@pytest.mark.parametrize(
    "plant", [Plant(1, 0, (1,)), Plant(1, 0, (2, 1)), Plant(1, 1, (), (), 2), Plant(1, 0, (1,), (-1,))]
)
def test_where_no_gain_makes_it_oscillate_there_is_no_ultimate_point(plant):
    with pytest.raises(NotReducible, match="ultimate gain"):
        ultimate(plant)
