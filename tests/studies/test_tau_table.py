"""Reading between rows, and the smallest tau_c that keeps a limit on Ms."""

import math

import numpy as np
import pytest

from simc_core import Loop, Plant, simc
from simc_core.errors import InvalidParameter
from simc_core.plants.models import FirstOrderDelay
from simc_core.sensitivity.margins import margins
from simc_core.studies.tau_table import MOST_ROWS, first_rows, kinks, read, refined, smallest


def Ms(tau_c: float) -> float:
    """Of 2 e^{-s}/(8 s + 1) with tau_I = 8: L = e^{-s}/((tau_c + 1) s)."""
    return margins(Loop(Plant(2.0, 1.0, (8.0,)), simc(FirstOrderDelay(2.0, 1.0, 8.0), tau_c))).Ms


def test_cubics_are_read_exactly_on_each_side_of_a_kink():
    rows = first_rows(0.1, 10.0, [1.0])
    curve = np.where(rows.x < 0, rows.x**3, 5 * rows.x)[:, None]
    for x in np.linspace(rows.x[0], rows.x[-1], 101):
        assert read(rows, curve, x)[0] == pytest.approx(x**3 if x < 0 else 5 * x, abs=1e-12)


def test_the_kink_of_simc_is_where_tau_I_changes_branch():
    model = FirstOrderDelay(1.0, 1.0, 16.0)
    (tau_c,) = kinks(model)
    assert simc(model, tau_c * 0.999).tau_I < 16
    assert simc(model, tau_c).tau_I == pytest.approx(16)
    assert kinks(FirstOrderDelay(1.0, 1.0, 3.0)) == []


def test_rows_are_added_where_a_curve_is_sharp():
    def resonance(tau_c):
        return [1 / (1 + (np.log(tau_c)[:, None] / 0.02) ** 2) * np.array([1.0, 0.0])]

    coarse = first_rows(0.1, 10.0, [])
    rows, (curve,) = refined(coarse, resonance)
    assert len(coarse.x) < len(rows.x) < MOST_ROWS
    assert np.diff(rows.x).min() < 0.01
    for x in np.linspace(-0.1, 0.1, 41):
        assert read(rows, curve, x)[0] == pytest.approx(1 / (1 + (x / 0.02) ** 2), abs=2e-3)


def test_the_smallest_tau_c_for_the_ms_of_tight_tuning_is_theta():
    assert smallest(Ms, 1.590492, 0.3, 100.0) == pytest.approx(1.0, abs=1e-4)  # theory.md sect. 3: Ms 1.59049
    assert smallest(Ms, 50.0, 0.9, 100.0) == pytest.approx(0.9)


def test_a_limit_that_nothing_keeps_is_refused_and_nan_keeps_none():
    with pytest.raises(InvalidParameter, match="Ms must be >="):
        smallest(Ms, 1.001, 0.3, 2.0)
    assert smallest(lambda tau_c: math.nan if tau_c < 2 else 1.0, 1.5, 0.5, 10.0) == pytest.approx(2.0, rel=1e-6)
