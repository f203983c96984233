"""y and u within 1e-9 of seventy-five digits: the cases of the house list, and loops at random."""

import math

import mpmath as mp
import numpy as np
import pytest

from simc_core import (
    IController,
    IdealPid,
    Loop,
    ParallelPid,
    Plant,
    Scenario,
    SeriesPid,
    simulate,
    stability,
)
from tests.oracles.high_precision import course, parallel, plant_factors, value, without_delay
from tests.oracles.random_loops import simulated_loop

WITHIN = 1e-9
ORDER_12 = tuple(np.geomspace(100, 0.01, 12).tolist())


def unit_step(loop: Loop, load: bool, t: np.ndarray) -> np.ndarray:
    """y and u at t, (2, n), from the engine."""
    found = simulate(loop, Scenario(0.0 if load else 1.0, 1.0 if load else 0.0, 0.0, t=t))
    return np.array([found.y, found.u])


def reference(loop: Loop, load: bool, t: np.ndarray) -> np.ndarray:
    """The same in high precision."""
    at = course(loop, load, t[-1]).at if loop.plant.theta else without_delay(loop, load)
    return np.array([at(instant) for instant in t.tolist()]).T


# the reference itself


@pytest.mark.parametrize(
    "loop",
    [
        Loop(Plant(1, 1, (5,)), SeriesPid(1.5, 5)),
        Loop(Plant(2, 1, (6, 3), (-0.7,)), SeriesPid(0.8, 5, 2, 0.1, b=0.6, c=0.5)),
        Loop(Plant(-1, 1, (-4,)), IdealPid(-2.2, 20, 0.3, 0.05)),
        Loop(Plant(1, 1, (2,), (), 1, ((1, 0.2),), ((0.5, 0.3),)), ParallelPid(0.05, 0.01, 0.04, 0.2)),
        Loop(Plant(1, 1, (5,)), SeriesPid(1.5, 5, 2)),
    ],
)
def test_the_reference_against_the_expansion_in_delays_by_mpmath(loop):
    """y_r = sum_k (-1)^k (G C)^k G C_r/s,  u_r = sum_k (-1)^k (G C)^k C_r/s, and so on, each inverted by mpmath."""
    nums, dens = plant_factors(loop.plant)
    Kp, Ki, Kd, tau_F, b, c = parallel(loop.controller)

    def G(s):
        return loop.plant.k * mp.fprod(value(p, s) for p in nums) / mp.fprod(value(p, s) for p in dens)

    def C(s, p=1, d=1):
        return value((Ki, p * Kp, d * Kd), s) / value((0 * Ki, 1 + 0 * Ki, tau_F), s)

    def inverse(F, t):
        return mp.invertlaplace(F, t, method="talbot", degree=60) if t > 0 else 0

    with mp.workdps(45):
        for t in (mp.mpf("1.625"), mp.mpf("3.375")):
            terms = range(math.ceil(t))
            y_r = mp.fsum(
                (-1) ** k * inverse(lambda s, k=k: G(s) ** (k + 1) * C(s) ** k * C(s, b, c) / s, t - k - 1)
                for k in terms
            )
            u_r = mp.fsum((-1) ** k * inverse(lambda s, k=k: (G(s) * C(s)) ** k * C(s, b, c) / s, t - k) for k in terms)
            y_d = mp.fsum((-1) ** k * inverse(lambda s, k=k: G(s) * (G(s) * C(s)) ** k / s, t - k - 1) for k in terms)
            u_d = -mp.fsum((-1) ** k * inverse(lambda s, k=k: (G(s) * C(s)) ** (k + 1) / s, t - k - 1) for k in terms)
            assert course(loop, False, 4).at(t) == pytest.approx((float(y_r), float(u_r)), abs=1e-14)
            assert course(loop, True, 4).at(t) == pytest.approx((float(y_d), float(u_d)), abs=1e-14)


def test_the_reference_a_long_time_on_against_lambert_w():
    """L = K e^{-s}/s: Y = K e^{-s}/(s (s + K e^{-s})) has poles p = W_n(-K), K e^{-p} = -p, residues -1/(1 + p)."""
    K, t = 0.9, 30.25
    poles = [mp.lambertw(-K, n) for n in range(-12, 13)]
    expected = 1 - mp.fsum(mp.exp(p * t) / (1 + p) for p in poles)
    assert course(Loop(Plant(1, 1), IController(K)), False, t).at(t)[0] == pytest.approx(
        float(expected.real), abs=1e-15
    )


def test_the_reference_does_not_depend_on_its_pieces():
    for loop in (
        Loop(Plant(1, 2, (3, 0.1), (-0.5,)), SeriesPid(0.7, 3, 0.2, 0.02)),
        Loop(Plant(1, 1, (0.1,), (-0.2,)), SeriesPid(0.475, 2)),
    ):
        for load in (False, True):
            assert course(loop, load, 40).at(39.3) == course(loop, load, 40, reach=2).at(39.3)


# the engine

CASES = {
    "lag dominant": (Plant(1, 1, (8,)), SeriesPid(4, 8), 40),
    "lag dominant, other units": (Plant(-3e-3, 256, (4000,)), SeriesPid(-2500, 2048), 8192),
    "delay dominant": (Plant(1, 1, (0.1,)), SeriesPid(0.05, 0.1), 20),
    "more delay dominant": (Plant(1, 1, (0.01,)), SeriesPid(0.005, 0.01), 20),
    "delay dominant, slow lag ignored": (Plant(1, 1, (0.1,)), SeriesPid(0.3, 0.6), 40),
    "integrating": (Plant(1, 1, integrators=1), SeriesPid(0.5, 8), 80),
    "double integrating": (Plant(1, 1, integrators=2), SeriesPid(0.0625, 8, 8, 0.125), 80),
    "double integrating, no filter": (Plant(1, 1, integrators=2), SeriesPid(0.0625, 8, 8), 80),
    "SOPDT, PID with filter": (Plant(1, 1, (6, 3)), SeriesPid(3, 6, 3, 0.05), 40),
    "SOPDT, PID with weights": (Plant(1, 1, (6, 3)), SeriesPid(3, 6, 3, 0.3, b=0.4, c=0.7), 40),
    "SOPDT, PID without filter": (Plant(1, 1, (6, 3)), SeriesPid(3, 6, 3), 40),
    "ideal PID, complex zeros": (Plant(1, 1, (6, 3)), IdealPid(3, 5, 3, 0.3), 40),
    "P control, an offset": (Plant(1, 1, (4,)), ParallelPid(1.2, 0), 40),
    "unstable plant": (Plant(-1, 1, (-4,)), SeriesPid(-2.2, 20), 8),
    "unstable plant, stable loop": (Plant(-1, 1, (-4,)), SeriesPid(2.5, 20), 100),
    "inverse response, oscillating": (Plant(1, 1, (2,), (-0.7,), 0, ((1, 0.2),)), SeriesPid(0.3, 2), 60),
    "inverse response, light damping": (Plant(1, 1, (2,), (-0.7,), 0, ((1, 0.05),)), SeriesPid(0.03, 2), 100),
    "hardly any damping": (Plant(1, 1, (), (), 0, ((1, 0.005),)), IController(0.002), 200),
    "complex zeros": (Plant(1, 1, (3, 2), (), 0, ((0.5, 0.1),), ((0.8, 0.05),)), SeriesPid(1, 3), 40),
    "a fast filter": (Plant(1, 1, (6, 3)), SeriesPid(3, 6, 3, 2e-3), 12),
    "a lag a thousandth of the dead time": (Plant(1, 1, (10, 1e-3)), SeriesPid(5, 8), 20),
    "order 12": (Plant(1, 2, ORDER_12), SeriesPid(2, 100), 200),
    "eight equal lags": (Plant(1, 0.75, (1,) * 8), SeriesPid(0.2, 1.5), 40),
    "pure dead time, PI": (Plant(1, 1), SeriesPid(0.3, 0.5), 20),
    "pure dead time, jumps of 0.9^k": (Plant(2, 1), SeriesPid(0.45, 20), 20),
    "pure dead time, I": (Plant(2, 1), IController(0.25), 30),
    "a plant that answers at once": (Plant(1, 1, (4,), (2,)), SeriesPid(0.6, 4), 40),
    "neutral, |L(inf)| = 0.6": (Plant(1, 1, (5,)), SeriesPid(1.5, 5, 2), 20),
    "neutral, 0.8, delay dominant": (Plant(1, 1, (0.1,), (-0.2,)), SeriesPid(0.4, 2), 20.25),
    "neutral, 0.95, delay dominant": (Plant(1, 1, (0.1,), (-0.2,)), SeriesPid(0.475, 2), 40.25),
    "neutral, 0.8, PID without filter": (Plant(1, 1, (0.2,)), SeriesPid(0.4, 2, 0.4), 40.25),
    "horizon / theta = 1e4": (Plant(1, 2**-9, (8, 1)), SeriesPid(2, 8), 20),
    "horizon / theta = 1e4, integrating": (Plant(1, 2**-9, integrators=1), SeriesPid(0.9, 8), 20),
    "unstable loop": (Plant(1, 1), IController(2), 16),
}


def instants(theta: float, until: float) -> np.ndarray:
    """From the step on; jumps at k theta, the last instant among them, and what lies between."""
    early = theta * np.array([0, 0.125, 0.5, 1, 1.0625, 1.5, 2, 2.25, 3, 4.875, 5])
    late = until - theta * np.array([0.95, 0.25, 0.0])
    return np.unique(np.concatenate([early[early < until], until * np.array([0.1, 0.29, 0.5, 0.77]), late]))


@pytest.mark.parametrize("load", [False, True])
@pytest.mark.parametrize("name", CASES)
def test_y_and_u_within_1e_9(name, load):
    plant, controller, until = CASES[name]
    loop, t = Loop(plant, controller), instants(plant.theta, until)
    expected = reference(loop, load, t)
    scale = np.maximum(np.abs(expected).max(axis=1, keepdims=True), 1.0)  # of what grows, or is large in its units
    np.testing.assert_allclose(unit_step(loop, load, t) / scale, expected / scale, rtol=0, atol=WITHIN)


@pytest.mark.parametrize("load", [False, True])
@pytest.mark.parametrize(
    ("plant", "controller"),
    [
        (Plant(2, 0, (3,)), ParallelPid(1.5, 0)),
        (Plant(1, 0, (6, 3, 0.5), (-0.4,)), SeriesPid(1.1, 6, 1, 0.05)),
        (Plant(1, 0, (6, 3, 0.5)), SeriesPid(1.1, 6, 1)),
        (Plant(1, 0, (2,), (), 1, ((1, 0.05),)), SeriesPid(0.02, 20)),
        (Plant(1, 0, (4,), (2,)), SeriesPid(3, 2, b=0.5)),
        (Plant(0.5), SeriesPid(1, 2)),
        (Plant(-1, 0, (-4, 1)), IdealPid(5, 6, 1, 0.1, c=0.5)),
        (Plant(1, 0, ORDER_12), SeriesPid(2, 100)),
    ],
)
def test_without_dead_time_within_1e_9(plant, controller, load):
    loop, t = Loop(plant, controller), np.array([1e-3, 0.02, 0.3, 1, 2.5, 7, 20, 60, 100])
    np.testing.assert_allclose(unit_step(loop, load, t), reference(loop, load, t), rtol=0, atol=WITHIN)


@pytest.mark.parametrize("tau_F", [1e3, 1e6])
def test_a_filter_much_slower_than_the_plant_passes_little_at_first_and_that_exactly(tau_F):
    """u begins as Kp t/tau_F: nothing of it may be lost against Kp. Relative errors."""
    loop = Loop(Plant(2, 0, (1e-3, 5)), SeriesPid(1.5, 10 * tau_F, tau_F, tau_F))
    t = np.array([1e-5, 1e-4, 1e-3, 0.02, 1, 7, 100])
    np.testing.assert_allclose(unit_step(loop, False, t), reference(loop, False, t), rtol=WITHIN)


def test_120_random_loops_within_1e_9():
    """Stable or not, relative to what the response has grown to; |L(inf)| <= 0.9."""
    rng = np.random.default_rng(20)
    checked = {"stable": 0, "unstable": 0}
    while sum(checked.values()) < 120:
        loop = simulated_loop(rng)
        found = stability(loop)
        if found.neutral > 0.9:
            continue
        checked[found.verdict] += 1
        t = instants(loop.plant.theta, 20 * loop.plant.theta)
        for load in (False, True):
            expected = reference(loop, load, t)
            scale = np.maximum(np.abs(expected).max(axis=1, keepdims=True), 1.0)
            error = np.abs(unit_step(loop, load, t) - expected) / scale
            assert error.max() < WITHIN, loop
    assert min(checked.values()) > 40
