"""The search for a minimum of one variable, on functions whose minimum is known: smooth, a kink, a cliff, a slope."""

import math

import numpy as np
import pytest

from simc_core.optimal.valley import lowest

KINDS = {
    "smooth": (lambda x: 2 + (x - 0.37) ** 2 + 0.3 * (x - 0.37) ** 3, 0.37, 2.0),
    "kink": (lambda x: 1 + np.where(x < 0.123, 2 * (0.123 - x), 0.4 * (x - 0.123)), 0.123, 1.0),
    "kink of curves": (lambda x: np.maximum(np.exp(-x), 0.5 * np.exp(2 * x)), math.log(2) / 3, 2 ** (-1 / 3)),
    "cliff": (lambda x: np.where(x < -0.211, 50.0 - x, 1 + 0.7 * (x + 0.211)), -0.211, 1.0),
    "nothing there": (lambda x: np.where(x > 0.4, math.inf, 3 - x), 0.4, 2.6),
}


@pytest.mark.parametrize("name", KINDS)
def test_the_minimum_is_the_one_that_is_known(name):
    function, place, value = KINDS[name]
    grid = np.linspace(-2, 2, 9) + 0.0137
    evaluations = 0
    walk = lowest(list(zip(grid.tolist(), function(grid).tolist(), strict=True)))
    try:
        tried = next(walk)
        while True:
            evaluations += len(tried)
            tried = walk.send(function(tried))
    except StopIteration as end:
        found, lowest_value = end.value
    assert lowest_value == pytest.approx(value, rel=1e-6)
    assert found == pytest.approx(place, abs=2e-3)
    assert evaluations <= (24 if name in ("smooth", "kink", "kink of curves") else 48)  # rounds of four for a cliff


def test_a_minimum_at_the_end_stays_there():
    with pytest.raises(StopIteration) as end:
        next(lowest([(0.0, 1.0), (1.0, 2.0), (2.0, 3.0)]))
    assert end.value.value == (0.0, 1.0)
