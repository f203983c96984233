"""Robust gains in closed form against published and closed-form values, and against the margins of the loops."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simc_core import (
    IdealPid,
    InvalidParameter,
    Loop,
    NotStable,
    ParallelPid,
    Plant,
    SeriesPid,
    gain_intervals,
    margins,
    robust_region,
    stability,
    stability_limit,
)

INF = math.inf
INTEGRATING, LAGGING = Plant(1, 1, (), (), 1), Plant(1, 1, (8,))
PLANTS = {
    "balanced": (Plant(1, 1, (1,)), IdealPid(1, 1.05)),
    "lag dominant": (LAGGING, IdealPid(1, 2.3, 0.475, 0.1)),
    "negative gain": (Plant(-3, 1, (8,)), IdealPid(-1, 3.7)),
    "integrating": (INTEGRATING, IdealPid(1, 8)),
    "double integrating": (Plant(1, 1, (), (), 2), IdealPid(1, 10, 6, 0.1)),
    "unstable": (Plant(-1, 1, (-20,)), IdealPid(1, 6)),
    "pure delay": (Plant(1, 1), IdealPid(1, 0.32)),
    "high order": (Plant(1, 0, (1,) * 8), IdealPid(1, 4, 1.3, 0.2)),
    "complex pair": (Plant(1, 0.3, (2,), (), 0, ((1, 0.1),)), IdealPid(1, 1.5, 0.8, 0.1)),
    "light pair": (Plant(1, 1, (), (), 0, ((1, 0.01),)), IdealPid(1, 0.2)),
    "inverse response": (Plant(1, 0.5, (5, 2), (-1.5,)), IdealPid(1, 4, 1, 0.1)),
    "conditionally stable": (Plant(1, 0.02, (20, 20, 20), (1, 1)), ParallelPid(1, 0.001)),
}


def peak(plant, controller, gain):
    found = margins(Loop(plant, controller.rescaled(gain=gain)))
    return max(found.Ms, found.Mt)


@pytest.mark.parametrize(("Ms", "a"), [(1.4, 0.372672), (1.59, 0.499705), (2, 0.701170)])
def test_an_integrator_with_dead_time_has_its_known_largest_gain(Ms, a):
    """1 - 2 a sin(w)/w + a^2/w^2 = 1/Ms^2 has a double root."""
    assert gain_intervals(INTEGRATING, IdealPid(1, INF), Ms)[0][1] == pytest.approx(a, abs=6e-7)
    assert gain_intervals(LAGGING, SeriesPid(8, 8), Ms)[0][1] == pytest.approx(a, abs=6e-7)


def test_integral_action_on_an_integrator_has_a_smallest_gain_too():
    ((low, high),) = gain_intervals(INTEGRATING, SeriesPid(1, 8), 1.59)
    assert (low, high) == pytest.approx((0.1359, 0.4372), abs=6e-5)


@pytest.mark.parametrize("name", PLANTS)
@pytest.mark.parametrize("Ms", [1.3, 1.59, 2.5])
def test_both_peaks_reach_the_bound_at_the_edges_and_stay_below_inside(name, Ms):
    plant, shape = PLANTS[name]
    for low, high in gain_intervals(plant, shape, Ms):
        for edge in (low, high):
            if 0 < edge < INF:
                assert peak(plant, shape, edge) == pytest.approx(Ms, rel=2e-8)
        inside = np.geomspace(low or high / 50, high, 9)[1:-1] if high < INF else [2 * low + 1]
        assert all(peak(plant, shape, gain) <= Ms * (1 + 1e-8) for gain in inside)


@pytest.mark.parametrize("name", PLANTS)
def test_outside_the_intervals_no_gain_will_do(name):
    """Gains on a grid, by the margins: none that is good is missed."""
    plant, shape = PLANTS[name]
    found = gain_intervals(plant, shape, 1.59)
    for gain in np.geomspace(1e-3, 1e3, 61).tolist():
        good = peak(plant, shape, gain) <= 1.59  # nan, of an unstable loop, is not
        assert good == any(low <= gain <= high for low, high in found)


@settings(max_examples=25)
@given(
    time=st.fractions(Fraction(1, 100), 100, max_denominator=100),
    gain=st.floats(0.01, 100) | st.floats(-100, -0.01),
    name=st.sampled_from(sorted(PLANTS)),
)
def test_gains_are_the_same_in_any_units(time, gain, name):
    plant, shape = PLANTS[name]
    here = gain_intervals(plant, shape, 1.7)
    there = gain_intervals(plant.rescaled(time, gain), shape.rescaled(time, 1 / gain), 1.7)
    assert np.array(there) == pytest.approx(np.array(here), rel=1e-7, abs=1e-9)


def test_without_dead_time_and_with_phase_above_180_degrees_there_is_no_upper_edge():
    assert gain_intervals(Plant(1, 0, (1,)), IdealPid(1, 2), 1.5) == ((0.0, INF),)


def test_a_shape_of_the_wrong_sign_has_no_gain():
    assert gain_intervals(LAGGING, IdealPid(-1, 8), 1.59) == ()


def test_a_double_integrator_has_no_robust_pi_controller():
    assert gain_intervals(Plant(1, 1, (), (), 2), IdealPid(1, 10), 2) == ()


def test_the_contour_over_tau_I_is_that_of_single_shapes():
    tau_I = np.geomspace(1, 40, 200)
    low, high = robust_region(Plant(-1, 1, (8,)), tau_I, 1.59)
    for i in range(0, 200, 19):
        (edges,) = gain_intervals(Plant(-1, 1, (8,)), IdealPid(-1, tau_I[i]), 1.59)
        assert (-low[i], -high[i]) == pytest.approx(edges, rel=1e-7, abs=1e-9)


def test_the_contour_has_no_value_where_no_gain_will_do():
    low, high = robust_region(INTEGRATING, [0.5, 8], 1.59)
    assert np.isnan(low[0])
    assert (low[1], high[1]) == pytest.approx((0.1359, 0.4372), abs=6e-5)


@pytest.mark.parametrize("Ms", [1.0, 0.5, math.nan, 1e3])
def test_a_bound_that_no_loop_can_have_is_refused(Ms):
    with pytest.raises(InvalidParameter, match="Ms must be"):
        gain_intervals(LAGGING, IdealPid(1, 8), Ms)


@pytest.mark.parametrize(
    ("plant", "Kc", "tau_I"), [(INTEGRATING, 0.5, 1.234587), (LAGGING, 10, 2.11568), (INTEGRATING, 1e-6, 1.0)]
)
def test_the_limit_of_stability_is_where_it_is_known_to_be(plant, Kc, tau_I):
    assert stability_limit(plant, Kc) == pytest.approx(tau_I, rel=2e-6)


@pytest.mark.parametrize("name", ["balanced", "negative gain", "unstable", "pure delay", "high order", "complex pair"])
def test_the_limit_of_stability_is_that_of_the_certificate(name):
    plant, shape = PLANTS[name]
    (*_, (low, high)) = gain_intervals(plant, shape.to_ideal(), 2.5)
    Kc = shape.to_ideal().Kc * math.sqrt(max(low, high / 4) * high)
    limit = stability_limit(plant, Kc)
    assert stability(Loop(plant, IdealPid(Kc, limit * 1.001))).verdict == "stable"
    assert stability(Loop(plant, IdealPid(Kc, limit * 0.999))).verdict == "unstable"


def test_the_limit_of_stability_is_that_of_routh():
    """1/(s+1)^3: s^4 + 3 s^3 + 3 s^2 + (1 + Kc) s + Kc/tau_I has its roots to the left for tau_I beyond that."""
    Kc = 3.0
    assert stability_limit(Plant(1, 0, (1, 1, 1)), Kc) == pytest.approx(9 * Kc / ((1 + Kc) * (8 - Kc)), rel=1e-10)


def test_a_single_lag_stands_any_integral_time():
    assert stability_limit(Plant(1, 0, (2,)), 3.0) == 0.0


def test_a_gain_that_no_integral_time_can_save_is_refused():
    with pytest.raises(NotStable, match="Kc must be a gain"):
        stability_limit(INTEGRATING, 1.6)
    with pytest.raises(NotStable, match="other sign"):
        stability_limit(LAGGING, -2.0)


@pytest.mark.parametrize("omega", [0.1, 0.8, 1.3, 1.57])
def test_the_limit_of_an_integrator_with_dead_time_is_its_closed_form(omega):
    """Kc = omega sin(omega), tau_I = tan(omega)/omega for e^{-s}/s."""
    assert stability_limit(INTEGRATING, omega * math.sin(omega)) == pytest.approx(math.tan(omega) / omega, rel=1e-10)
