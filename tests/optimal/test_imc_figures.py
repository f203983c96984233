"""[RMS86] figures 4 and 5 against numbers of an independent program, print, and the engine."""

import math

import numpy as np
import pytest

from simc_core import IdealPid, InvalidParameter, Loop, NotStable, Plant, margins, performance
from simc_core.optimal.imc_figures import imc_loop, imc_point
from simc_core.sensitivity.delay_bound import delay_bound

KNOWN = [  # kind, epsilon/theta, M, J
    ("PID", 0.3, 4.2563, 1.5343),
    ("PID", 0.672, 1.2792, 1.09557),
    ("PID", 0.8, 1.0389, 1.1080),
    ("PID", 1.0, 1.0, 1.1584),
    ("PID", 2.0, 1.0, 1.5714),
    ("PI", 1.0, 2.3270, 1.7041),
    ("PI", 1.353, 1.3452, 1.53192),
    ("PI", 1.4, 1.2873, 1.5334),
    ("PI", 2.0, 1.0, 1.6858),
]


@pytest.mark.parametrize(("kind", "ratio", "M", "J"), KNOWN)
def test_peak_and_squared_error_are_those_that_are_known(kind, ratio, M, J):
    found = imc_point(ratio, kind)
    peak, error = found.M, found.J
    assert (peak, error) == pytest.approx((M, J), abs=6e-5)


def test_the_smallest_squared_errors_are_where_they_are_printed():
    """At 0.68 with 1.092 for PID [RMS86]; the exact minimum is 1.0956."""
    for kind, at, J in (("PID", 0.672, 1.09557), ("PI", 1.353, 1.53192)):
        around = [imc_point(ratio, kind).J for ratio in (at - 0.01, at, at + 0.01)]
        assert around[1] == min(around)
        assert around[1] == pytest.approx(J, abs=6e-6)


@pytest.mark.parametrize(("ratio", "stable"), [(0.144, False), (0.1455, True)])
def test_pid_is_unstable_below_its_known_limit(ratio, stable):
    assert math.isfinite(imc_point(ratio).J) == stable


def test_pi_is_unstable_below_two_over_pi():
    assert math.isnan(imc_point(0.999 * 2 / math.pi, "PI").M)
    assert math.isfinite(imc_point(1.001 * 2 / math.pi, "PI").M)


@pytest.mark.parametrize("ratio", [0.7, 1.0, 1.4, 3.0])
def test_the_squared_error_of_pi_is_that_of_the_engine(ratio):
    """On a first-order plant, whose lag the controller cancels."""
    both = performance(Loop(Plant(2, 1, (8,)), IdealPid(4 / ratio, 8)))
    own = imc_point(ratio, "PI").J
    assert own == pytest.approx(both.setpoint.ISE, rel=1e-9)


@pytest.mark.parametrize("kind", ["PI", "PID"])
def test_the_squared_error_is_that_of_parseval(kind):
    """int |S/s|^2 d omega/pi, the loop's neutral tail averaged over a turn: |S|^2 = 1/(1 - l^2) in the mean."""
    ratio, end = 1.2, 2 * math.pi * 4000
    beta = 0.5 if kind == "PID" else 0.0
    omega = np.linspace(1e-9, end, 6_000_001)
    s = 1j * omega
    S_over_s = 1 / (s + (1 + beta * s) * np.exp(-s) / (ratio + beta))
    tail = 1 / (1 - (beta / (ratio + beta)) ** 2) / end
    whole = (np.trapezoid(np.abs(S_over_s) ** 2, omega) + tail) / math.pi
    own = imc_point(ratio, kind).J
    assert own == pytest.approx(whole, rel=1e-6)


@pytest.mark.parametrize(("ratio", "margin"), [(1.4, 1.199), (2.0, 2.142)])
def test_pi_has_its_known_delay_margin(ratio, margin):
    found = imc_point(ratio, "PI").delay_margin
    assert found == pytest.approx(margin, abs=6e-4)


@pytest.mark.parametrize("ratio", [1.0, 1.4, 2.0])
def test_at_the_bound_the_error_is_just_as_large_as_T_allows(ratio):
    """By brute force: |e^{-j omega delta} - 1| |T| over a fine grid."""
    s = 1j * np.linspace(1e-3, 6, 600_000)
    L, delta = np.exp(-s) / (ratio * s), imc_point(ratio, "PI").delay_bound
    assert np.max(np.abs(np.expm1(-s * delta) * L / (1 + L))) == pytest.approx(1, abs=1e-8)


def test_unfiltered_pid_has_a_delay_margin_but_no_bound():
    """|T| peaks at a/(1 - a) >= 1/2 for ever, a = (theta/2)/(epsilon + theta/2), for epsilon <= theta."""
    found = imc_point(0.9)
    assert found.delay_bound == 0.0
    assert 0 < found.delay_margin < math.inf
    assert imc_point(1.1).delay_bound > 0


@pytest.mark.parametrize("tau1", [0.0, 1.0, 8.0])
def test_the_bound_never_exceeds_the_margin(tau1):
    loop = Loop(Plant(2, 1, (tau1,) if tau1 else ()), IdealPid(0.1 + 0.2 * tau1, 0.5 + tau1))
    assert 0 < delay_bound(loop) <= margins(loop).delay_margin * (1 + 1e-9)


def test_a_loop_whose_T_is_small_stands_any_error():
    assert delay_bound(Loop(Plant(1, 1, (5,)), IdealPid(0.1, math.inf))) == math.inf


def test_unstable_loops_and_other_kinds_are_refused():
    with pytest.raises(NotStable):
        delay_bound(imc_loop(0.1, "PI"))
    with pytest.raises(InvalidParameter, match="kind must be one of PI, PID, found"):
        imc_point(1.0, "P")
    with pytest.raises(InvalidParameter, match="epsilon/theta"):
        imc_point(-1.0)
