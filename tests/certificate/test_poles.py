"""Dominant closed-loop poles: Lambert's W, polynomial roots, and roots found by mpmath to 30 digits."""

import math

import mpmath
import numpy as np
import pytest
from scipy.special import lambertw

from simc_core import (
    IController,
    IdealPid,
    Loop,
    ParallelPid,
    Plant,
    SeriesPid,
    count_unstable,
    dominant_poles,
    stability,
)
from simc_core.certificate.characteristic import shifted
from tests.oracles.pole_count import unstable
from tests.oracles.random_loops import resonant_loop, wild_loop


def upper(values) -> list[complex]:
    return [pole.s for pole in values]


@pytest.mark.parametrize(("K", "theta"), [(0.2, 1.0), (0.5, 1.0), (1.5, 0.01), (0.004, 300.0), (8.0, 1.0)])
def test_integral_action_on_dead_time_is_lambert_w(K, theta):
    """s + K e^{-theta s} = 0: s theta = W_n(-K theta)."""
    found = dominant_poles(Loop(Plant(1.0, theta), IController(K)), most=5)
    exact = {complex(lambertw(-K * theta, n)) / theta for n in range(-8, 8)}
    exact = sorted((s for s in exact if s.imag >= 0), key=lambda s: (-s.real, s.imag))[:5]
    assert upper(found) == pytest.approx(exact, rel=1e-12)
    assert found[0].zeta == pytest.approx(-exact[0].real / abs(exact[0]))
    assert found[0].omega_n == pytest.approx(abs(exact[0]))


@pytest.mark.parametrize("k", [0.3, 4.0, 40.0])
def test_proportional_control_of_a_lag_is_lambert_w(k):
    """5 s + 1 + k e^{-s} = 0: s = -1/5 + W_n(-(k/5) e^{1/5})."""
    found = dominant_poles(Loop(Plant(k, 1.0, (5.0,)), SeriesPid(1.0, math.inf)), most=4)
    exact = [complex(lambertw(-k / 5 * math.exp(0.2), n)) - 0.2 for n in range(-6, 6)]
    exact = sorted((s for s in exact if s.imag >= 0), key=lambda s: (-s.real, s.imag))[:4]
    assert upper(found) == pytest.approx(exact, rel=1e-11)


@pytest.mark.parametrize("controller", [SeriesPid(0.9, math.inf), ParallelPid(0.9, 0.0, 0.0)])
def test_proportional_control_of_a_pure_dead_time_is_a_logarithm(controller):
    """1 + K e^{-s} = 0: s = ln K + i pi (2n + 1)."""
    found = dominant_poles(Loop(Plant(1.0, 1.0), controller), most=2)
    assert upper(found) == pytest.approx([complex(math.log(0.9), math.pi * n) for n in (1, 3)], rel=1e-12)


def test_without_dead_time_all_roots_of_the_polynomial():
    """s (s + 1)(2 s + 1)(3 s + 1) + (20 s + 1)/20, times 20."""
    found = upper(dominant_poles(Loop(Plant(1.0, 0.0, (1.0, 2.0, 3.0)), SeriesPid(1.0, 20.0))))
    open_loop = np.polymul(np.polymul([1, 1], [2, 1]), np.polymul([3, 1], [1, 0]))
    exact = np.roots(np.polyadd(20 * open_loop, [20, 1]))
    exact = sorted(exact[exact.imag >= 0], key=lambda s: (-s.real, s.imag))
    assert found == pytest.approx(exact, rel=1e-10)


def test_slow_cancelled_pole_of_simc_is_reported_as_such():
    """L = e^{-s}/(2 s) hides the lag 8, which a load disturbance excites."""
    found = dominant_poles(Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 8.0)))
    assert found[0].cancelled
    assert found[0].s == pytest.approx(-1 / 8)
    assert not found[1].cancelled
    assert found[1].s == pytest.approx(complex(lambertw(-0.5)), rel=1e-12)


@pytest.mark.parametrize(
    ("plant", "controller"),
    [
        (Plant(1.0, 1.0, integrators=1), SeriesPid(0.5, 8.0)),
        (Plant(1.0, 1.0, integrators=2), SeriesPid(0.0625, 8.0, 8.0, 0.1)),
        (Plant(-1.0, 1.0, (-4.0,)), SeriesPid(2.5, 20.0)),
        (Plant(1.0, 10.0, lag_pairs=((1.0, 0.005),)), SeriesPid(0.005, 20.0)),
        (Plant(1.0, 0.3, (2.0, 1.0), (-0.5,), lag_pairs=((0.3, 0.2),)), IdealPid(0.8, 2.0, 1.0, 0.1)),
        (Plant(1.0, 1.0, (1.0,) * 8), SeriesPid(0.3, 4.0)),
        (Plant(1.0, 1.0, tuple(np.geomspace(0.01, 100, 12))), SeriesPid(2.0, 60.0)),
    ],
)
def test_every_pole_is_a_root_and_none_is_missing(plant, controller):
    loop = Loop(plant, controller)
    L = loop.L
    found = dominant_poles(loop)
    # the certificate, with the axis moved to just left of the last one, counts them: conjugates included
    beside = found[-1].s.real - 1e-7 * abs(found[-1].s)
    counted = count_unstable([shifted(L, beside)]).unstable_poles
    assert counted == sum(2 if pole.s.imag else 1 for pole in found)

    def characteristic(s):
        value = mpmath.mpf(L.gain) * mpmath.exp(-mpmath.mpf(L.theta) * s)
        for a, b, c in L.num.tolist():
            value *= (a * s + b) * s + c
        below = mpmath.mpf(1)
        for a, b, c in L.den.tolist():
            below *= (a * s + b) * s + c
        return below + value

    with mpmath.workdps(30):
        for pole in found:
            exact = mpmath.findroot(characteristic, mpmath.mpc(pole.s) * (1 + 1e-9), tol=1e-40, verify=False)
            assert complex(exact) == pytest.approx(pole.s, rel=1e-11)


def test_neutral_chain():
    """1 + k e^{-s} = 0: s = ln k + j pi (2 n + 1), one line; the slowest come first."""
    found = upper(dominant_poles(Loop(Plant(0.5, 1.0), SeriesPid(1.0, math.inf)), most=3))
    assert found == pytest.approx([math.log(0.5) + 1j * math.pi * n for n in (1, 3, 5)], rel=1e-12)


def test_none_without_dynamics_or_causality():
    assert dominant_poles(Loop(Plant(2.0), SeriesPid(1.0, math.inf))) == ()
    assert dominant_poles(Loop(Plant(2.0, 1.0), SeriesPid(1.0, math.inf, 1.0))) == ()


def test_sign_of_the_rightmost_pole_is_the_verdict():
    rng = np.random.default_rng(5)
    for _ in range(60):
        plant = Plant(10 ** rng.uniform(-1, 1), 10 ** rng.uniform(-1, 1), tuple(10 ** rng.uniform(-1, 1, 3)))
        loop = Loop(plant, SeriesPid(1.0, 10 ** rng.uniform(0, 1.5)))
        assert (dominant_poles(loop)[0].s.real < 0) == (stability(loop).verdict == "stable")


@pytest.mark.parametrize("loops", [wild_loop, resonant_loop])
def test_none_is_missing_among_those_shown(loops):
    """Mikhailov's criterion on a grid counts as many to the right of the last one."""
    rng, counted, full = np.random.default_rng(31), 0, 0
    for _ in range(150):
        loop = loops(rng)
        poles = [pole for pole in dominant_poles(loop) if not pole.cancelled]
        if len(poles) < 2 or loop.L.relative_degree == 0:
            continue
        full += len(poles) == 8
        beside, last = (pole.s.real for pole in poles[-2:])
        exact = unstable(loop.L, (beside + last) / 2)
        if beside - last > 1e-5 * abs(last) and exact is not None:
            counted += 1
            assert exact == sum(2 if pole.s.imag else 1 for pole in poles[:-1])
    assert counted > 100
    assert full > 100


def test_resonances_that_turn_many_times_within_the_dead_time_are_found():
    """14 pairs about 15.7 rad/s, which the dead time 39 turns a hundred times."""
    plant = Plant(
        1.0, 39.07, (0.001453, 52.69, 113.9), (151.3, -80.01, 49.93), lag_pairs=((0.0636060314463138, 0.0048325),)
    )
    loop = Loop(plant, SeriesPid(0.0019149185, 152.57, 0.0, 1.40857857))
    assert stability(loop).unstable_poles == unstable(loop.L) == 28
    found = dominant_poles(loop, most=20)
    assert sum(2 for pole in found if pole.s.real > 0) == 28
    assert all(abs(1 + loop.L(pole.s)) < 1e-6 for pole in found)


def test_of_a_neutral_loop_with_countless_unstable_poles_none_is_called_the_rightmost():
    assert dominant_poles(Loop(Plant(1.0, 0.5, (1.0,)), SeriesPid(0.8, 5.0, 5.0))) == ()
