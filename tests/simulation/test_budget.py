"""What would cost more than a stated budget, or is not a number at all, is refused at the door, with the number."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from simc_core import (
    Actuation,
    InvalidParameter,
    Loop,
    Plant,
    Scenario,
    SeriesPid,
    frequency_response,
    simulate,
    stability,
)

LOOP = Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"t_end": 1e12}, "t_end. must be between 1e-09 and 1e[+]09, found 1e[+]12"),
        ({"t_end": math.inf}, "t_end must be finite, found inf"),
        ({"t_end": 0}, "t_end must not be zero"),
        ({"points": 10**9}, "points must be <= 100000, found 1e[+]09"),
        ({"points": 1}, "points must be >= 2"),
        ({"points": 10.5}, "points must be a whole number, found 10.5"),
        ({"disturbance_time": -1.0}, "disturbance_time must be >= 0, found -1"),
        ({"disturbance": math.nan}, "disturbance must be finite, found nan"),
        ({"t": np.zeros(10**6)}, "t must be a list of 1 to 100000 numbers, found shape .1000000,."),
        ({"t": []}, "found shape .0,."),
        ({"t": "soon"}, "t must be a list of numbers, found 'soon'"),
        ({"t": [0.0, 1e300]}, "t must be <= 1e[+]09, found 1e[+]300"),
        ({"t": [0.0, math.nan]}, "t must be finite"),
    ],
)
def test_scenario(fields, words):
    with pytest.raises(InvalidParameter, match=words):
        Scenario(**fields)


@pytest.mark.parametrize(
    ("omega", "words"),
    [
        (np.broadcast_to(1.0, 10**7), "omega must be a list of 1 to 1000000 numbers, found shape .10000000,."),
        ([], "found shape .0,."),
        ([1.0, -2.0], "omega must be positive and finite, found -2"),
        ([1.0, math.inf], "found inf"),
        ([[1.0]], "found shape .1, 1."),
        ("fast", "omega must be a list of numbers, found 'fast'"),
        (None, "positive and finite, found nan|list of numbers"),
    ],
)
def test_frequencies(omega, words):
    with pytest.raises(InvalidParameter, match=words):
        frequency_response(LOOP, omega)


def test_saturation_with_a_dead_time_far_below_the_horizon():
    with pytest.raises(InvalidParameter, match=r"50000 steps for a dead time of 1e-09, found 1e[+]15"):
        simulate(Loop(Plant(1, 1e-9, (8,)), SeriesPid(4, 8)), Scenario(t_end=1e6, actuation=Actuation(u_max=1.0)))


@pytest.mark.parametrize("off", [1e-7, 1e-8, 1e-9])
def test_a_loop_that_is_neutral_to_the_last_digits(off):
    """(1 - off)(1 + 1/(1000 s)) e^{-s}: two unstable poles for each phase crossing with |L| > 1."""
    count, k = 0, 0
    while True:
        omega = brentq(lambda w, k=k: w + math.atan(1 / (1e3 * w)) - (2 * k + 1) * math.pi, 1e-6, 1e6)
        if (1 - off) * math.hypot(1, 1 / (1e3 * omega)) <= 1:
            break
        count, k = count + 1, k + 1
    found = stability(Loop(Plant(1, 1), SeriesPid(1 - off, 1e3)))
    assert found.unstable_poles == 2 * count
    assert found.verdict == ("unstable" if count else "stable")


def test_closer_than_rounding_is_on_the_limit():
    assert stability(Loop(Plant(1, 1), SeriesPid(1 - 1e-13, 1e3))).verdict == "marginal"


def test_a_phase_that_doubles_cannot_hold():
    with pytest.raises(InvalidParameter, match="omega theta of poles on the imaginary axis must be"):
        stability(Loop(Plant(1, 1e9, (1e-9,)), SeriesPid(0.5, 1e9)))
