"""Margins within 1e-8 of roots that mpmath finds, from brackets on a dense grid, of a loop written out afresh."""

import math
from collections.abc import Callable

import mpmath as mp
import numpy as np
import pytest

from simc_core import IController, IdealPid, Loop, Margins, ParallelPid, Plant, SeriesPid, crossings, margins, stability
from tests.oracles.high_precision import parallel, plant_factors, value

WITHIN = 1e-8
POINTS = 60_000


def transfer(loop: Loop) -> tuple[Callable, Callable]:
    """L(s) for numpy arrays, and for mpmath numbers."""
    nums, dens = plant_factors(loop.plant)
    Kp, Ki, Kd, tau_F, _, _ = parallel(loop.controller)
    nums.append((Ki, Kp, Kd) if Ki else (Kp, Kd))
    dens.append((0 * Ki, 1 + 0 * Ki, tau_F) if Ki else (1 + 0 * Ki, tau_F))

    def fast(s):
        L = loop.plant.k * np.exp(-loop.plant.theta * s)
        for factor in nums:
            L = L * np.polyval([float(c) for c in reversed(factor)], s)
        for factor in dens:
            L = L / np.polyval([float(c) for c in reversed(factor)], s)
        return L

    def precise(s):
        below = mp.fprod(value(factor, s) for factor in dens)
        return loop.plant.k * mp.exp(-mp.mpf(loop.plant.theta) * s) * mp.fprod(value(p, s) for p in nums) / below

    return fast, precise


def grid(loop: Loop) -> np.ndarray:
    """From far below to far above all corners, dense at resonances and evenly along the phase of the dead time."""
    form, theta = loop.L, loop.plant.theta
    corners = np.abs(np.concatenate([form.poles, form.zeros, [1 / theta] if theta else []]))
    corners = corners[corners > 0]
    parts = [np.geomspace(1e-5 * corners.min(), 1e3 * corners.max(), POINTS)]
    parts += [p.imag + p.real * np.linspace(-50, 50, 5_001) for p in form.poles if 0 < -p.real < 0.3 * p.imag]
    parts += [np.linspace(1e-4, 60, 20_001) / theta] if theta else []
    omega = np.unique(np.concatenate(parts))
    return omega[omega > 0]


def brackets(values: np.ndarray) -> np.ndarray:
    """Indices i where values[i], values[i + 1] differ in sign."""
    return np.flatnonzero(np.sign(values[1:]) * np.sign(values[:-1]) < 0)


def roots(of: Callable, omega: np.ndarray, at: np.ndarray) -> list[float]:
    """Zeros of `of` in the brackets `at`."""
    return [float(mp.findroot(of, (omega[i], omega[i + 1]), solver="anderson", tol=1e-40)) for i in at]


def peak(of: Callable, omega: np.ndarray, values: np.ndarray, start: float) -> tuple[float, float]:
    """Largest value and its place: `start` at omega = 0, or where the derivative vanishes."""
    i = int(np.argmax(values))
    if values[i] <= start * (1 + 1e-12):
        return start, 0.0
    place = mp.findroot(lambda w: mp.diff(lambda x: mp.log(of(x)), w), (omega[i - 1], omega[i + 1]), tol=1e-30)
    return float(of(place)), float(place)


def reference(loop: Loop) -> tuple[Margins, list[float], list[float]]:
    """Margins of a stable loop, and its gain and phase crossings, all of these up to a little behind the former."""
    fast, precise = transfer(loop)
    omega = grid(loop)
    L = fast(1j * omega)

    def at(w):
        return precise(mp.mpc(0, w))

    with mp.workdps(30):
        gain = roots(lambda w: mp.log(abs(at(w))), omega, brackets(np.log(np.abs(L))))
        real = brackets(L.imag)
        real = real[L[real].real < 0]
        size = np.abs(L[real])
        below = np.max(size[size < 0.999], initial=0.0)
        real = real[(size > 0.9 * below) | (omega[real] < last_of_interest(gain, loop))]
        phase = roots(lambda w: mp.im(at(w)), omega, real)
        sizes = [float(abs(at(w))) for w in phase]
        angles = [float(mp.arg(-at(w))) for w in gain]
        _, Ki, *_ = parallel(loop.controller)
        integral = Ki != 0 or loop.plant.integrators > 0
        start = math.inf if integral else float(at(0).real)
        S0, T0 = (0.0, 1.0) if integral else (abs(1 / (1 + start)), abs(start / (1 + start)))
        Ms, omega_Ms = peak(lambda w: 1 / abs(1 + at(w)), omega, np.abs(1 / (1 + L)), S0)
        Mt, omega_Mt = peak(lambda w: abs(at(w) / (1 + at(w))), omega, np.abs(L / (1 + L)), T0)
    GM, omega_180 = min([(1 / size, w) for size, w in zip(sizes, phase, strict=True) if size < 1])
    PM, omega_c = min([(abs(angle), w) for angle, w in zip(angles, gain, strict=True)])
    lower = [1 / size for size in [*sizes, *([-start] if start < 0 else [])] if size > 1]
    delays = [(angle % (2 * math.pi)) / w for angle, w in zip(angles, gain, strict=True)]
    found = Margins(
        GM, max(lower, default=0.0), math.degrees(PM), min(delays), Ms, Mt, omega_180, omega_c, omega_Ms, omega_Mt, True
    )
    return found, gain, phase


def last_of_interest(gain: list[float], loop: Loop) -> float:
    """A little behind the last gain crossing."""
    return max(gain) + (1 / loop.plant.theta if loop.plant.theta else 0.0)


CASES = {
    "lag dominant": Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)),
    "integrating": Loop(Plant(1, 1, integrators=1), SeriesPid(0.5, 8)),
    "double integrating": Loop(Plant(1, 1, integrators=2), SeriesPid(0.0625, 8, 8, 0.1)),
    "unstable plant": Loop(Plant(-1, 1, (-4,)), SeriesPid(2.5, 20)),
    "unstable plant and a lag, other units": Loop(Plant(-200, 0.01, (-0.08, 0.005)), SeriesPid(0.011, 0.6, 0.005)),
    "conditionally stable": Loop(Plant(1, 0.02, (0.05,), integrators=2), SeriesPid(8, 4, 4)),
    "three gain crossings": Loop(Plant(1, 4.5, (), (), 0, ((1, 0.05),)), IController(0.15)),
    "five gain crossings": Loop(Plant(1, 0.5, (), (), 0, ((1, 0.02), (0.25, 0.001)), ((0.5, 0.1),)), IController(0.05)),
    "hardly any damping": Loop(Plant(1, 1, (), (), 0, ((1, 0.005),)), IController(0.006)),
    "inverse response, oscillating": Loop(Plant(1, 1, (2,), (-0.7,), 0, ((1, 0.2),)), SeriesPid(0.3, 2)),
    "dead time, PI": Loop(Plant(1, 1), SeriesPid(0.3, 0.5)),
    "SOPDT, PID with filter": Loop(Plant(1, 1, (6, 3)), SeriesPid(3, 6, 3, 0.05)),
    "order 12": Loop(Plant(1, 2, tuple(np.geomspace(100, 0.01, 12).tolist())), SeriesPid(2, 100)),
    "eight equal lags": Loop(Plant(1, 0.75, (1,) * 8), SeriesPid(0.2, 1.5)),
    "neutral": Loop(Plant(1, 1, (5,)), SeriesPid(1.5, 5, 2)),
    "ideal PID, complex zeros": Loop(Plant(1, 1, (6, 3)), IdealPid(3, 5, 3, 0.3)),
    "no dead time": Loop(Plant(1, 0, (3, 1, 0.2)), SeriesPid(6, 3)),
    "negative gain, offset": Loop(Plant(-1, 0.5, (2, 1)), ParallelPid(-4, 0, -2, 0.1)),
}


@pytest.mark.parametrize("name", CASES)
def test_margins_within_1e_8(name):
    loop = CASES[name]
    assert stability(loop).verdict == "stable"
    expected, gain, _ = reference(loop)
    got = margins(loop)
    for field in Margins.__slots__:
        assert getattr(got, field) == pytest.approx(getattr(expected, field), rel=WITHIN, abs=1e-12), field
    assert crossings(loop).gain_omega == pytest.approx(gain, rel=WITHIN)


def test_the_cases_hold_what_they_are_there_for():
    found = {name: reference(CASES[name]) for name in CASES if "crossings" in name or "conditionally" in name}
    for name, number in (("three gain crossings", 3), ("five gain crossings", 5)):
        expected, gain, _ = found[name]
        assert len(gain) == number
        first = crossings(CASES[name]).gain_phase[0] % (2 * math.pi) / gain[0]
        assert expected.delay_margin < first * 0.99  # a later crossing decides
    assert 0 < found["conditionally stable"][0].GM_lower < 1


def test_every_crossing_is_found_up_to_where_the_loop_is_small():
    """All phase crossings below the last gain crossing, of loops with many."""
    for loop in (
        Loop(Plant(1, 10, (1, 0.3), (5,)), SeriesPid(0.15, 6)),
        Loop(Plant(1, 20, (), (), 0, ((1, 0.02),)), IController(0.008)),
        Loop(Plant(3, 1, (5, 0.1), (), 0, ((0.3, 0.01),)), SeriesPid(2, 5)),  # not stable: to draw
    ):
        _, gain, phase = reference(loop)
        below = [w for w in phase if w < last_of_interest(gain, loop)]
        got = crossings(loop)
        assert got.gain_omega == pytest.approx(gain, rel=WITHIN)
        assert got.phase_omega[: len(below)] == pytest.approx(below, rel=WITHIN)
