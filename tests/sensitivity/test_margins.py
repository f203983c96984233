"""Margins and peaks: published values, closed forms with exact dead time, brute force on random loops."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from simc_core import (
    IController,
    IdealPid,
    IntegratingDelay,
    Loop,
    ParallelPid,
    Plant,
    SeriesPid,
    crossings,
    margins,
    margins_of,
    stability,
)
from simc_core.sensitivity.log_response import Closed, FactoredResponse, ResponseBatch, Series
from simc_core.sensitivity.search_grid import MOST_NODES, search_grid
from tests.oracles.published import select
from tests.oracles.random_loops import resonant_loop

QUANTITY = {
    "GM": lambda m, theta: m.GM,
    "PM_deg": lambda m, theta: m.PM_deg,
    "DM/theta": lambda m, theta: m.delay_margin / theta,
    "Ms": lambda m, theta: m.Ms,
    "Mt": lambda m, theta: m.Mt,
    "w180*theta": lambda m, theta: m.omega_180 * theta,
    "wc*theta": lambda m, theta: m.omega_c * theta,
}


@pytest.mark.parametrize("value", select("-rob-", "-Ms"))
def test_published_margins(value):
    quantity = QUANTITY[value.id.rsplit("-", 1)[1]]
    assert quantity(margins(value.loop), value.plant.theta) == value.approx()


@pytest.mark.parametrize("value", select("SG12-J-", "SG12-comb-", "SG12-impr-"))
def test_published_peaks_beside_other_values(value):
    assert margins(value.loop).Ms == value.approx(-1)


@pytest.mark.parametrize(("a_theta", "factor", "Ms"), [(0.1, 4 / 3, 1.80), (0.25, 2.5, 2.06), (0.4, 10.0, 4.62)])
def test_unstable_delay_rule(a_theta, factor, Ms):
    """theory.md section 3, [SK98 eq. 23-24]: f is the printed one up to rounding."""
    f = (1 + a_theta / (2 * (1 - 2 * a_theta))) / (1 - 2 * a_theta)
    assert f == pytest.approx(factor, abs=0.01)
    loop = Loop(Plant(-1 / a_theta, 1.0, (-1 / a_theta,)), SeriesPid(0.5, 8 * f))
    assert margins(loop).Ms == pytest.approx(Ms, abs=0.0051)


@pytest.mark.parametrize("ratio", [0.3, 1.0, 2.5, 10.0])
@pytest.mark.parametrize(("k", "theta", "tau1"), [(1.0, 1.0, 1.0), (-3.0, 0.02, 7.0), (1e-3, 50.0, 0.1)])
def test_first_order_closed_forms(k, theta, tau1, ratio):
    """L = e^{-theta s}/((tau_c + theta) s): GM = (pi/2)(tau_c/theta + 1), PM = pi/2 - theta/(tau_c + theta)."""
    tau_c = ratio * theta
    m = margins(Loop(Plant(k, theta, (tau1,)), SeriesPid(tau1 / (k * (tau_c + theta)), tau1)))
    assert pytest.approx(math.pi / 2 * (ratio + 1), rel=1e-13) == m.GM
    assert m.GM_lower == 0
    assert m.PM_deg == pytest.approx(90 - math.degrees(1 / (ratio + 1)), rel=1e-13)
    assert m.delay_margin == pytest.approx((math.pi / 2 - 1 / (ratio + 1)) * (tau_c + theta), rel=1e-13)
    assert m.omega_180 * theta == pytest.approx(math.pi / 2, rel=1e-13)
    assert m.omega_c * theta == pytest.approx(1 / (ratio + 1), rel=1e-13)
    # |T|^2 = 1/(1 - 2 x sin y + x^2), x = omega (tau_c + theta), y = omega theta: 1 at most where tau_c >= theta
    if ratio >= 1:
        assert (m.Mt, m.omega_Mt) == (1.0, 0.0)
    # |S| is largest where tan(y) = y + (tau_c/theta + 1) - cos(y) (d|S|^2 = 0, x = (ratio + 1) y)
    y = m.omega_Ms * theta
    x = (ratio + 1) * y
    assert pytest.approx(x / math.sqrt(1 - 2 * x * math.sin(y) + x * x), rel=1e-13) == m.Ms


def test_tight_settings_to_six_digits():
    """theory.md section 3, 'Exact facts for tau_c = theta'."""
    first = margins(Loop(Plant(2.0, 3.0, (5.0,)), SeriesPid(5 / 12, 5.0)))
    assert (first.GM, first.PM_deg) == pytest.approx((math.pi, 61.3521), abs=5e-5)
    assert (first.delay_margin / 3, first.Ms) == pytest.approx((2.14159, 1.59049), abs=5e-6)
    ramp = margins(Loop(IntegratingDelay(0.2, 3.0).plant, SeriesPid(1 / 1.2, 24.0)))
    assert (ramp.GM, ramp.Ms, ramp.Mt) == pytest.approx((2.96340, 1.70352, 1.29942), abs=5e-6)
    assert (ramp.PM_deg, ramp.delay_margin / 3) == pytest.approx((46.8643, 1.58964), abs=5e-5)
    assert ramp.GM_lower == 0
    double = margins(Loop(Plant(1.0, 1.0, integrators=2), SeriesPid(0.0625, 8.0, 8.0)))
    assert (double.GM, double.GM_lower, double.Ms) == pytest.approx((2.761, 0.165, 1.959), abs=6e-4)
    assert double.PM_deg == pytest.approx(33.11, abs=5e-3)


def test_unstable_plant_has_both_gain_limits():
    """k e^{-s}/(tau s - 1) under P control: lower limit |L(0)| = 1, upper where atan(tau w) = w."""
    m = margins(Loop(Plant(-1.0, 1.0, (-4.0,)), SeriesPid(2.0, math.inf)))
    assert m.GM_lower == pytest.approx(0.5, rel=1e-14)
    assert math.atan(4 * m.omega_180) == pytest.approx(m.omega_180, rel=1e-14)
    assert pytest.approx(math.hypot(1, 4 * m.omega_180) / 2, rel=1e-14) == m.GM
    assert m.omega_c == pytest.approx(math.sqrt(3) / 4, rel=1e-14)
    assert m.delay_margin == pytest.approx((math.atan(4 * m.omega_c) - m.omega_c) / m.omega_c, rel=1e-13)
    assert (m.Mt, m.omega_Mt) == pytest.approx((2.0, 0.0))


def test_limits_that_do_not_exist():
    m = margins(Loop(Plant(1.0, 0.0, (1.0,)), SeriesPid(1.0, math.inf)))
    assert (m.GM, m.GM_lower, m.PM_deg, m.delay_margin) == (math.inf, 0, math.inf, math.inf)
    assert (m.Ms, m.omega_Ms, m.Mt, m.omega_Mt) == (1.0, math.inf, 0.5, 0.0)


@pytest.mark.parametrize("tau", [0.10156531834357964, 1.0, 1.133159816002351, 7.3])
def test_the_jump_at_an_undamped_pair_is_no_phase_crossing(tau):
    """L = s/((T s + 1)(tau^2 s^2 + 1)): its phase jumps from 90 to -90 degrees, less atan(T omega), and stays there."""
    m = margins(Loop(Plant(1.0, lag_pairs=((tau, 0.0),)), ParallelPid(0.0, 0.0, 1.0, 0.1 * tau)))
    assert (m.GM, m.GM_lower) == (math.inf, 0.0)
    assert math.isnan(m.omega_180)


def test_any_dead_time_is_too_much_for_a_loop_that_does_not_roll_off():
    m = margins(Loop(Plant(2.0, 0.0, (1.0,), (0.9,)), SeriesPid(1.0, math.inf)))
    assert m.stable
    assert m.delay_margin == 0


def test_neutral_loop_near_its_limit():
    """P control of pure dead time: |S| = 1/|1 + k e^{-j w theta}|, peaks 1/(1 - k) at odd multiples of pi."""
    m = margins(Loop(Plant(0.9, 2.0), SeriesPid(1.0, math.inf)))
    assert (m.Ms, m.Mt, m.GM) == pytest.approx((10.0, 9.0, 1 / 0.9), rel=1e-12)
    assert (m.PM_deg, m.delay_margin) == (math.inf, math.inf)


@pytest.mark.parametrize("off", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize(
    "plant",
    [Plant(1.0, 1.0), Plant(0.25, 1.0, (1.0,), (2.0,)), Plant(0.25, 1e-3, (9.0, 1e4), (18.0, 1e4)), Plant(1.0, 1e6)],
)
def test_near_neutral_loops_take_a_bounded_grid(plant, off):
    """|L| = 1 - off at infinity and nowhere more: |S| has peaks 1/off, as far as the eye reaches."""
    limit = plant.k * math.prod(plant.leads) / math.prod(plant.lags)
    loop = Loop(plant, SeriesPid((1 - off) / limit, math.inf))
    response = FactoredResponse(loop.L)
    assert search_grid([response], ResponseBatch([response]).log_derivatives).omega.size <= MOST_NODES + 1000
    m = margins(loop)
    assert (m.Ms, m.GM) == pytest.approx((1 / off, 1 / (1 - off)), rel=1e-5)


def test_all_crossings_are_there_to_draw():
    """Pure dead time with I action: phase crossings at omega theta = pi/2 + 2 pi i, |L| = K_I/omega."""
    found = crossings(Loop(Plant(1.0, 1.0), IController(0.5)))
    assert found.gain_omega == pytest.approx([0.5])
    assert found.gain_phase == pytest.approx([math.pi / 2 - 0.5])
    expected = math.pi / 2 + 2 * math.pi * np.arange(found.phase_omega.size)
    assert found.phase_omega == pytest.approx(expected, rel=1e-13)
    assert found.phase_gain == pytest.approx(0.5 / expected, rel=1e-13)


FIRST = 6  # crossings and peaks that come nearest to the best on the grid are looked at again


def brute_force(loop: Loop) -> dict[str, float]:
    """Margins from L on a fine grid: crossings bracketed there, then by bisection; peaks on finer and finer grids."""
    L0 = loop.L
    roots = np.abs(np.concatenate([L0.poles, L0.zeros, [1 / L0.theta]]))
    roots = roots[roots > 0]
    coarse = np.geomspace(1e-5 * roots.min(), 1e2 * roots.max(), 60_000)
    resonances = [root for root in L0.poles if 0 < -root.real < 0.3 * root.imag]
    near = [p.imag - p.real * np.linspace(-60, 60, 30_001) for p in resonances]
    omega = np.unique(np.concatenate([coarse, np.linspace(1e-4, 40, 60_001) / L0.theta, *near]))
    omega = omega[omega > 0]
    L = L0(1j * omega)

    far = abs(L0(1e9j * roots.max())) if L0.relative_degree == 0 else 0.0  # |L(inf)|, at any phase

    def peak(sensitivity, *ends):
        size = np.abs(sensitivity(L))
        top = np.flatnonzero((size[1:-1] >= size[:-2]) & (size[1:-1] >= size[2:]))
        top = top[np.argsort(-size[top + 1])][:FIRST]
        best = [*ends]
        for i in top + 1:
            low, high = omega[i - 1], omega[i + 1]
            for _ in range(3):
                around = np.linspace(low, high, 401)
                values = np.abs(sensitivity(L0(1j * around)))
                at = int(np.argmax(values))
                low, high = around[max(at - 1, 0)], around[min(at + 1, 400)]
            best.append(values.max())
        return max(best)

    def crossed(function, where):
        return np.array([brentq(lambda w: function(L0(1j * w)), omega[i], omega[i + 1], xtol=1e-15) for i in where])

    size, angle = np.abs(L), np.angle(-L)
    step = np.flatnonzero((size[:-1] < 1) != (size[1:] < 1))
    at = crossed(lambda L: np.log(np.abs(L)), step)
    PM = np.angle(-L0(1j * at))
    cross = np.flatnonzero(((angle[:-1] < 0) != (angle[1:] < 0)) & (np.abs(np.diff(angle)) < 3))
    cross = cross[np.argsort(np.abs(np.log(size[cross])))]  # nearest to 1 first
    cross = np.concatenate([side[:FIRST] for side in (cross[size[cross] < 1], cross[size[cross] >= 1])])
    gains = 1 / np.abs(L0(1j * crossed(lambda L: np.angle(-L), cross)))
    return {
        "GM": gains[gains > 1].min(initial=1 / far if far else math.inf),
        "GM_lower": gains[gains <= 1].max(initial=0.0),
        "PM_deg": math.degrees(np.min(np.abs(PM), initial=math.inf)),
        "delay_margin": np.min((PM % (2 * math.pi)) / at, initial=math.inf),
        "Ms": peak(lambda L: 1 / (1 + L), 1 / (1 - far)),
        "Mt": peak(lambda L: L / (1 + L), 1.0, far / (1 - far)),
    }


def test_nothing_missed_in_300_random_loops():
    rng = np.random.default_rng(20240)
    checked, kinds = 0, dict.fromkeys(("inverse", "integrating", "light", "unfiltered", "filtered"), 0)
    while checked < 300:
        loop = resonant_loop(rng)
        if stability(loop).verdict != "stable":
            continue
        checked += 1
        plant, controller = loop.plant, loop.controller
        kinds["inverse"] += any(T < 0 for T in plant.leads)
        kinds["integrating"] += plant.integrators
        kinds["light"] += any(zeta < 0.02 for _, zeta in plant.lag_pairs)
        kinds["unfiltered"] += controller.tau_D > 0 and controller.tau_F == 0
        kinds["filtered"] += controller.tau_F > 0
        m, expected = margins(loop), brute_force(loop)
        for name, value in expected.items():
            ours = getattr(m, name)
            assert ours == pytest.approx(value, rel=1e-8), (name, loop)
        # a peak is never smaller than any sample of it
        assert m.Ms >= expected["Ms"] * (1 - 1e-12)
        assert m.Mt >= expected["Mt"] * (1 - 1e-12)
    assert min(kinds.values()) >= 20, kinds


def test_outer_loop_of_a_cascade_against_a_fine_grid():
    """La = Ca Ga Lb/(1 + Lb), cascade.md row 1b: Msb 2.0, Msa 1.8017."""
    Lb = Loop(Plant(1.0, 1.0, (2.0, 3.0)), IdealPid(3.3928, 3.3928 / 0.8250, 3.7773 / 3.3928, 0.0521)).L
    CaGa = Loop(Plant(2.0, 2.0, (5.0,)), IdealPid(0.3788, 0.3788 / 0.0763)).L
    assert margins_of(FactoredResponse(Lb)).Ms == pytest.approx(2.0, abs=0.051)
    m = margins_of(Series(FactoredResponse(CaGa), Closed(FactoredResponse(Lb), np.array([]))))
    s = 1j * np.geomspace(1e-3, 1e2, 400_000)
    La = CaGa(s) * Lb(s) / (1 + Lb(s))
    assert pytest.approx(np.max(np.abs(1 / (1 + La))), rel=1e-8) == m.Ms
    assert pytest.approx(1.8017, abs=0.00051) == m.Ms
    assert pytest.approx(np.max(np.abs(La / (1 + La))), rel=1e-6) == m.Mt
