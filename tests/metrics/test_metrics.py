"""Step metrics within 1e-8: closed forms, and polynomials of seventy-five digits integrated exactly."""

import math
from itertools import pairwise

import mpmath as mp
import numpy as np
import pytest
from scipy.optimize import brentq

from simc_core import IController, IdealPid, Loop, ParallelPid, Plant, SeriesPid, performance
from tests.oracles.exact_metrics import metrics

WITHIN = 1e-8
INTEGRALS = ("IAE", "ISE", "ITAE", "TV")


def approx(value: float):
    return pytest.approx(value, rel=WITHIN, abs=1e-10)


# closed forms


def test_tight_integral_action_on_dead_time():
    """L = e^{-theta s}/(2 theta s), SIMC: y = sum_{k < x} (-1)^(k + 1) (x - k)^k/(2^k k!), x = t/theta."""

    def e(x):
        return 1 - mp.fsum((-1) ** (k + 1) * (x - k) ** k / (2**k * mp.factorial(k)) for k in range(1, math.ceil(x)))

    def slope(x):
        return -mp.fsum(
            (-1) ** (k + 1) * (x - k) ** (k - 1) / (2**k * mp.factorial(k - 1)) for k in range(1, math.ceil(x))
        )

    with mp.workdps(40):
        places = mp.linspace(1, 30, 117)
        change = [pair for pair in pairwise(places) if e(pair[0]) * e(pair[1]) < 0]
        zeros = [mp.findroot(e, pair, solver="anderson") for pair in change]
        parts = pairwise([mp.mpf(0), *zeros, mp.mpf(30)])
        IAE = mp.fsum(abs(mp.quad(e, [a, *range(math.floor(a) + 1, math.ceil(b)), b])) for a, b in parts)
        rise = mp.findroot(lambda x: e(x) - 0.1, 3.1) - mp.mpf("1.2")
        peak_time = mp.findroot(slope, 4.5)
        settling = mp.findroot(lambda x: e(x) + mp.mpf("0.02"), 5.2)
        peak = 1 - e(peak_time)
    for theta in (0.02, 1.0, 50.0):
        got = performance(Loop(Plant(1, theta), IController(0.5 / theta))).setpoint
        in_theta = (got.IAE / theta, got.peak_time / theta, got.rise_time / theta, got.settling_time / theta)
        assert in_theta == (approx(float(IAE)), approx(float(peak_time)), approx(float(rise)), approx(float(settling)))
        assert (got.TV, got.peak, got.overshoot) == (
            approx(float(IAE) / 2),
            approx(float(peak)),
            approx(float(peak) - 1),
        )


@pytest.mark.parametrize("K", [0.05, 0.3, 1 / math.e])
def test_without_overshoot_the_integrals_are_derivatives_at_the_origin(K):
    """E = 1/(s + K e^{-s}), e > 0: IAE = E(0) = 1/K, ITAE = -E'(0) = (1 - K)/K^2, and u' = K e: TV = K IAE = 1."""
    got = performance(Loop(Plant(1, 1), IController(K))).setpoint
    assert (got.IAE, got.ITAE, got.TV, got.overshoot) == (approx(1 / K), approx((1 - K) / K**2), approx(1), 0)


@pytest.mark.parametrize("K", [0.3, 0.5, 1.0, 1.4, 1.55, 1.565])
def test_square_of_the_error_of_integral_action_on_dead_time(K):
    """int e^2 = cos K/(2 K (1 - sin K)), up to the stability limit K = pi/2."""
    got = performance(Loop(Plant(1, 1), IController(K))).setpoint
    assert approx(math.cos(K) / (2 * K * (1 - math.sin(K)))) == got.ISE
    assert approx(K * got.IAE) == got.TV


def test_a_second_order_loop_in_closed_form():
    """T = 1/(s^2 + 2 zeta s + 1): e = e^{-zeta t} cos(w t - phi)/cos phi, zeros pi/w apart, q = e^{-pi zeta/w}."""
    zeta = 0.3
    got = performance(Loop(Plant(1 / (2 * zeta), 0, (1 / (2 * zeta),)), IController(1.0)))
    w = math.sqrt(1 - zeta**2)
    p = complex(-zeta, w)
    amplitude = 1 + zeta / (1j * w)  # e = Re(amplitude e^{p t})

    def whole(t):
        """int_0^t e."""
        return (amplitude * (np.exp(p * t) - 1) / p).real

    def moment(t):
        """int_0^t t e."""
        return (amplitude * (np.exp(p * t) * (t / p - 1 / p**2) + 1 / p**2)).real

    first = (math.pi / 2 - np.angle(amplitude)) / w
    zeros = first + np.arange(0, 40) * math.pi / w
    IAE = whole(first) + np.sum(np.abs(np.diff(whole(zeros))))
    ITAE = moment(first) + np.sum(np.abs(np.diff(moment(zeros))))
    assert (approx(IAE), approx(ITAE)) == (got.setpoint.IAE, got.setpoint.ITAE)
    q = math.exp(-math.pi * zeta / w)
    assert pytest.approx(whole(first) + abs(whole(zeros[1]) - whole(first)) / (1 - q)) == IAE  # the geometric series
    assert approx((1 + 4 * zeta**2) / (4 * zeta)) == got.setpoint.ISE
    assert approx(IAE) == got.setpoint.TV  # u = int e
    assert (got.setpoint.overshoot, got.setpoint.peak, got.setpoint.peak_time) == (
        approx(q),
        approx(1 + q),
        approx(math.pi / w),
    )

    rise = np.diff([brentq(lambda t, e=e: (amplitude * np.exp(p * t)).real - e, 0, first) for e in (0.9, 0.1)])[0]
    settled = brentq(lambda t: (amplitude * np.exp(p * t)).real + 0.02, 3 * math.pi / w, zeros[3])  # q^3 > 0.02 > q^4
    assert got.setpoint.rise_time == approx(rise)
    assert got.setpoint.settling_time == approx(settled)
    # load: y = k s/(s^2 + 2 zeta s + 1) at 1/s: y = e^{-zeta t} sin(w t)/w
    load, peak_time = got.disturbance, math.acos(zeta) / w
    peak = math.exp(-zeta * peak_time)
    assert (load.peak, load.peak_time, load.overshoot) == (approx(peak), approx(peak_time), approx(q))
    assert (approx((1 + q) / (1 - q)), approx(1 / (4 * zeta))) == (load.IAE, load.ISE)
    assert math.isnan(load.rise_time)


@pytest.mark.parametrize("beyond", [1e-3, 1e-5, 1e-7])
@pytest.mark.parametrize("lobe", [2, 3])
def test_a_lobe_that_hardly_leaves_the_band_counts(lobe, beyond):
    """T as above: e reaches q^lobe at t = lobe pi/w, here 0.02 (1 + beyond), and is back in the band a moment later.

    There e is nearly flat: its slope is some 1e-5 for the last of these, so the time is not known to more digits.
    """
    decay = -math.log(0.02 * (1 + beyond)) / lobe
    zeta = decay / math.hypot(math.pi, decay)
    w = math.sqrt(1 - zeta**2)
    got = performance(Loop(Plant(1 / (2 * zeta), 0, (1 / (2 * zeta),)), IController(1.0))).setpoint

    def size(t):
        return abs(math.exp(-zeta * t) * (math.cos(w * t) + zeta / w * math.sin(w * t)))

    begin = lobe * math.pi / w
    assert got.settling_time == pytest.approx(brentq(lambda t: size(t) - 0.02, begin, begin + 1, xtol=1e-14), rel=1e-7)


# the reference


@pytest.mark.parametrize("K", [0.3, 1.2])
def test_the_reference_against_the_closed_forms(K):
    found = metrics(Loop(Plant(1, 1), IController(K)), False, 300)
    assert pytest.approx(math.cos(K) / (2 * K * (1 - math.sin(K))), rel=1e-13) == found.ISE
    assert pytest.approx(K * found.IAE, rel=1e-13) == found.TV
    if 1 / math.e > K:
        assert pytest.approx((1 / K, (1 - K) / K**2), rel=1e-13) == (found.IAE, found.ITAE)


CASES = {
    "lag dominant": (Plant(1, 1, (8,)), SeriesPid(4, 8), 200),
    "oscillating": (Plant(1, 1, (8,)), SeriesPid(6, 3.3), 150),
    "delay dominant": (Plant(1, 1, (0.1,)), SeriesPid(0.3, 0.6), 60),
    "resonance and inverse response": (Plant(1, 1, (2,), (-0.7,), 0, ((1, 0.2),)), SeriesPid(0.3, 2), 250),
    "integrating": (Plant(1, 1, integrators=1), SeriesPid(0.5, 8), 200),
    "double integrating": (Plant(1, 1, integrators=2), SeriesPid(0.0625, 8, 8, 0.5), 400),
    "unstable": (Plant(-1, 1, (-4,)), SeriesPid(2.5, 20), 400),
    "SOPDT, PID with filter": (Plant(1, 1, (6, 3)), SeriesPid(3, 6, 3, 0.3), 200),
    "SOPDT, weights": (Plant(1, 1, (6, 3)), IdealPid(3, 12, 2, 0.25, b=0.4, c=0.7), 300),
    "jumps for ever": (Plant(1, 1), SeriesPid(0.3, 0.6), 60),  # tau_I 0.5 would touch 90 % and turn: no rise time
    "neutral": (Plant(1, 1, (5,)), SeriesPid(1.5, 5, 2), 150),
    "neutral, 0.8, delay dominant": (Plant(1, 1, (0.1,), (-0.2,)), SeriesPid(0.4, 2), 250),
    "negative gain": (Plant(-2e-3, 16, (100,)), ParallelPid(-800, -9), 4000),
    "many equal lags": (Plant(1, 0.5, (1,) * 6), SeriesPid(0.4, 3), 150),
}


def compare(got, expected, names) -> None:
    for name in names:
        assert getattr(got, name) == approx(getattr(expected, name)), name


@pytest.mark.parametrize("name", CASES)
def test_metrics_within_1e_8(name):
    plant, controller, until = CASES[name]
    got = performance(Loop(plant, controller))
    for step, load in ((got.setpoint, False), (got.disturbance, True)):
        expected = metrics(Loop(plant, controller), load, until)
        names = [*INTEGRALS, "overshoot", "peak", "settling_time"]
        names += [] if load else ["rise_time"]
        # the time of a largest value exists where there is one: not on the way to 1, nor on a plateau
        names += ["peak_time"] if (expected.overshoot > 1e-6 or load) and plant.order else []
        compare(step, expected, names)


def test_metrics_of_random_designs_within_1e_8():
    """PI by the SIMC rule, tau_c from 0.6 theta on, for a model that leaves out a lag, a zero or a resonance."""
    rng = np.random.default_rng(7)
    for _ in range(6):
        theta = 2.0 ** rng.integers(-5, 6)
        tau1, reach = theta * rng.uniform(0.5, 6), theta * rng.uniform(1.6, 4)
        more = [[], [0.3 * theta]][rng.integers(2)]
        leads = [[], [0.2 * theta], [-0.2 * theta]][rng.integers(3)]
        pairs = [[], [(0.2 * theta, 0.6)]][rng.integers(2)]
        plant = Plant(2 / theta, theta, (tau1, *more), leads, 0, pairs)
        loop = Loop(plant, SeriesPid(tau1 * theta / (2 * reach), min(tau1, 4 * reach)))
        got = performance(loop)
        for step, load in ((got.setpoint, False), (got.disturbance, True)):
            compare(step, metrics(loop, load, 170 * theta), [*INTEGRALS, "peak", "settling_time"])
