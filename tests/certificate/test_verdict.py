"""The stability certificate: on the edges, against closed forms, and two independent methods on random loops."""

import math

import numpy as np
import pytest
from scipy.special import lambertw

from simc_core import (
    IController,
    InvalidParameter,
    Loop,
    ParallelPid,
    Plant,
    SeriesPid,
    count_unstable,
    stability,
)
from simc_core.algebra.factors import Factored, factors
from simc_core.certificate.characteristic import characteristic, shifted
from simc_core.certificate.poles import rightmost
from simc_core.certificate.winding import MOST_SEGMENTS, winding
from tests.oracles.random_loops import third_unstable_loop


def verdict(plant: Plant, controller) -> tuple[str, int | float]:
    found = stability(Loop(plant, controller))
    return found.verdict, found.unstable_poles


@pytest.mark.parametrize("theta", [1.0, 0.37, 1e-3, 1e4])
@pytest.mark.parametrize(
    ("off", "expected"),
    [(-1e-9, ("stable", 0)), (0.0, ("marginal", 0)), (1e-9, ("unstable", 2)), (-1e-12, ("stable", 0))],
)
def test_integral_action_on_dead_time(theta, off, expected):
    """s + K e^{-theta s}: limit K theta = pi/2."""
    assert verdict(Plant(1.0, theta), IController(math.pi / 2 * (1 + off) / theta)) == expected


@pytest.mark.parametrize("K", [1.0, 8.0, 20.0, 300.0, 1e8])
def test_number_of_unstable_poles(K):
    """s + K e^{-s}: a pair crosses at K = pi/2 + 2 pi i."""
    pairs = math.floor((K - math.pi / 2) / (2 * math.pi)) + 1
    assert verdict(Plant(1.0, 1.0), IController(K))[1] == 2 * pairs


@pytest.mark.parametrize("ratio", [4.0, 2.0, 1.3, 1.1, 1.01])
def test_window_of_an_unstable_plant(ratio):
    """k e^{-s}/(ratio s - 1) under P control: stable for 1 < k < hypot(1, ratio w), atan(ratio w) = w."""
    plant, low, high = Plant(-1.0, 1.0, (-ratio,)), 1e-9, math.pi / 2
    for _ in range(200):
        w = (low + high) / 2
        low, high = (w, high) if math.atan(ratio * w) > w else (low, w)
    limit = math.hypot(1, ratio * w)
    for k, expected in [
        (1 - 1e-9, ("unstable", 1)),
        (1.0, ("marginal", 0)),
        (1 + 1e-9, ("stable", 0)),
        (limit * (1 - 1e-9), ("stable", 0)),
        (limit * (1 + 1e-9), ("unstable", 2)),
    ]:
        assert verdict(plant, SeriesPid(k, math.inf)) == expected


def test_dead_time_as_long_as_the_unstable_lag_is_too_long():
    for k in (1 + 1e-6, 1.01, 2.0):
        assert verdict(Plant(-1.0, 1.0, (-0.999,)), SeriesPid(k, math.inf))[0] == "unstable"


@pytest.mark.parametrize(("factor", "expected"), [(1.0, "stable"), (2.8, "unstable"), (0.16, "unstable")])
def test_double_integrator_in_its_three_regimes(factor, expected):
    """theory.md section 3: GM 2.761, lower limit 0.165; outside two poles are unstable."""
    controller = SeriesPid(0.0625 * factor, 8.0, 8.0)
    assert verdict(Plant(1.0, 1.0, integrators=2), controller) == (expected, 0 if expected == "stable" else 2)


def test_double_integrator_needs_derivative_action():
    assert verdict(Plant(1.0, 1.0, integrators=2), SeriesPid(1e-4, math.inf))[0] == "unstable"


@pytest.mark.parametrize("Kc", [0.02, 0.5, 5.0, 300.0])
def test_conditionally_stable(Kc):
    """L = 4 Kc (4 s + 1)^2/(s^3 (0.05 s + 1)) without dead time: roots of 0.05 s^4 + s^3 + 4 Kc (16 s^2 + 8 s + 1)."""
    roots = np.roots([0.05, 1.0, 64 * Kc, 32 * Kc, 4 * Kc])
    found = verdict(Plant(1.0, 0.0, (0.05,), integrators=2), SeriesPid(16 * Kc, 4.0, 4.0))
    assert found[1] == int(np.sum(roots.real > 0))


@pytest.mark.parametrize(
    ("tau_D", "expected"),
    [(1.0, ("stable", 0)), (1.98, ("unstable", 2)), (2.0, ("marginal", 0)), (2.0001, ("unstable", math.inf))],
)
def test_neutral_loop(tau_D, expected):
    """L = e^{-s}(tau_D s + 1)/(2 s): |L(inf)| = tau_D/2; the first pair crosses before that."""
    loop = Loop(Plant(1.0, 1.0, (4.0,)), SeriesPid(2.0, 4.0, tau_D))
    found = stability(loop)
    assert (found.verdict, found.unstable_poles) == expected
    assert found.neutral == pytest.approx(tau_D / 2)


def test_improper_loop_with_dead_time_has_countless_unstable_poles():
    assert verdict(Plant(1.0, 1.0), SeriesPid(0.1, math.inf, 1.0)) == ("unstable", math.inf)


def test_improper_loop_without_dead_time_is_a_polynomial():
    assert verdict(Plant(1.0), SeriesPid(1.0, math.inf, 1.0)) == ("stable", 0)  # 2 + s
    assert verdict(Plant(-3.0), ParallelPid(1.0, 0.0, -1.0)) == ("unstable", 1)  # 1 - 3 + 3 s


def test_ill_posed():
    with pytest.raises(InvalidParameter, match=r"1 \+ L\(inf\)"):
        stability(Loop(Plant(-1.0), SeriesPid(1.0, math.inf)))


@pytest.mark.parametrize(
    ("plant", "controller", "expected"),
    [
        # an unstable pole cancelled by a zero stays where it is
        (Plant(1.0, 0.5, (-4.0, 1.0), (-4.0,)), SeriesPid(0.5, 2.0), ("unstable", 1)),
        # a stable one does no harm: SIMC
        (Plant(1.0, 1.0, (4.0,)), SeriesPid(2.0, 4.0), ("stable", 0)),
        # derivative action alone hides the integrator
        (Plant(1.0, 1.0, (3.0,), integrators=1), ParallelPid(0.0, 0.0, 1.0), ("marginal", 0)),
        (Plant(1.0, 1.0, (3.0,), integrators=1), ParallelPid(0.0, 0.0, 20.0), ("unstable", 2)),
        # undamped modes
        (Plant(1.0, 0.0, lag_pairs=((1.0, 0.0),)), SeriesPid(0.5, math.inf), ("marginal", 0)),
        (Plant(1.0, 0.0, lag_pairs=((1.0, 0.0),)), SeriesPid(0.5, math.inf, 1.0, 0.1), ("stable", 0)),
        # pole at the origin: 1 + L(0) = 0
        (Plant(-1.0, 0.0, (1.0,)), SeriesPid(1.0, math.inf), ("marginal", 0)),
        # no integral action, no dynamics
        (Plant(2.0), SeriesPid(3.0, math.inf), ("stable", 0)),
        # forty equal lags; time constants over eighteen decades
        (Plant(1.0, 1.0, (1.0,) * 40), SeriesPid(0.5, 20.0), ("stable", 0)),
        (Plant(1.0, 1.0, (1e9, 1e-9)), SeriesPid(2.0, 4.0), ("stable", 0)),  # phase margin 3 omega_c > 0
    ],
)
def test_special_loops(plant, controller, expected):
    assert verdict(plant, controller) == expected


@pytest.mark.parametrize("excess", [1e-2, 1e-4, 1e-8])
@pytest.mark.parametrize("Kd", [0.01, 1.0, 30.0])
def test_one_pole_just_right_of_the_origin_whatever_the_signs(Kd, excess):
    """1 + L(0) = -excess: one real pole. A factor -Kd s - Kp turns from -pi at omega = 0, not from pi."""
    Kp, lags = 1 + excess, (40.0, 2.0)
    assert verdict(Plant(1.0, 1.0, lags), ParallelPid(-Kp, 0.0, -Kd)) == ("unstable", 1)
    assert verdict(Plant(-1.0, 1.0, lags), ParallelPid(Kp, 0.0, Kd)) == ("unstable", 1)


def test_contour_close_to_a_real_pole():
    """5 s + 1 + 4 e^{-s}, s = x real right of the axis for k = -4: one pole, wherever the contour is to its left."""
    L = Loop(Plant(-4.0, 1.0, (5.0,)), SeriesPid(1.0, math.inf)).L
    x = float(np.real(lambertw(4 / 5 * math.exp(0.2)))) - 0.2
    for off in (1e-9, 1e-7, 1e-4, 0.01, 0.5):
        assert count_unstable([shifted(L, x * (1 - off))]).unstable_poles == 1
        assert count_unstable([shifted(L, x * (1 + off))]).unstable_poles == 0


def test_several_delays_in_closed_form():
    """s + a e^{-s} + b e^{-2 s}, on the curve w = a sin w + b sin 2 w, a cos w + b cos 2 w = 0."""
    for w in (0.7, 1.0, 1.4):
        a, b = np.linalg.solve([[math.cos(w), math.cos(2 * w)], [math.sin(w), math.sin(2 * w)]], [0.0, w])
        verdicts = []
        for off in (-1e-9, 1e-9):
            integrator = factors((0.0, 1.0, 0.0))
            terms = [Factored(g * (1 + off), factors(), integrator, theta) for g, theta in ((a, 1.0), (b, 2.0))]
            verdicts.append(count_unstable(terms).unstable_poles)
        assert abs(verdicts[1] - verdicts[0]) == 2


def chain(off: float) -> Loop:
    """L = 2 (1 - off) (0.5 s + 1)/(s + 1) e^{-s}: |L| falls from 2 to |L(inf)| = 1 - off."""
    return Loop(Plant(1 - off, 1.0, (1.0,), (0.5,)), SeriesPid(2.0, math.inf))


@pytest.mark.parametrize("off", [0.3, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6])
def test_near_neutral_loops_are_counted_with_little_work(off):
    """A pair to the right for every omega with arg L = -pi (2 m + 1) and |L| > 1, omega^2 < (4 g - 1)/(1 - g)."""
    g = (1 - off) ** 2
    last = math.sqrt((4 * g - 1) / (1 - g))
    turned = (last + math.atan(last) - math.atan(last / 2)) / math.pi
    assert stability(chain(off)).unstable_poles == 2 * math.floor((turned + 1) / 2)
    assert winding(characteristic([chain(off).L])).work < 400


@pytest.mark.parametrize("off", [1e-1, 1e-3, 1e-6, 1e-9, 1e-11])
def test_near_neutral_loops_that_never_reach_one_are_stable(off):
    """|L| rises to 1 - off, or is 1 - off everywhere: no delay makes them unstable."""
    for plant in (Plant((1 - off) / 4, 3.0, (1.0,), (2.0,)), Plant((1 - off) / 2, 0.1)):
        loop = Loop(plant, SeriesPid(2.0, math.inf))
        assert stability(loop).verdict == "stable"
        assert winding(characteristic([loop.L])).work < 400


def test_near_neutral_loops_with_complex_roots_take_more_work_and_are_refused_beyond_a_stated_amount():
    """The bounds of quadratic factors are not as close."""

    def loop(off: float) -> Loop:
        return Loop(
            Plant((1 - off) / 4, 1.0, lag_pairs=((1.0, 0.9),), lead_pairs=((2.0, 0.5),)), SeriesPid(1.0, math.inf)
        )

    for off in (1e-1, 1e-2, 1e-3):
        assert stability(loop(off)).verdict == "stable"
        assert winding(characteristic([loop(off).L])).work <= MOST_SEGMENTS
    for off in (1e-4, 1e-6, 1e-9):
        with pytest.raises(InvalidParameter, match=f"<= {MOST_SEGMENTS} segments, found"):
            stability(loop(off))


@pytest.mark.parametrize(("theta", "T", "gain"), [(5.5e4, 215.4, 2.3), (1e3, 30.0, 0.7), (2.0, 5.0, 3.0)])
def test_millions_of_unstable_poles_are_counted(theta, T, gain):
    """L = gain (T s + 1) e^{-theta s}/(s (0.05 s + 1)): a pair for every turn of arg L past -pi while |L| > 1."""
    slope = 1 - (gain * T) ** 2
    x = (-slope + math.sqrt(slope**2 + 4 * 0.05**2 * gain**2)) / (2 * 0.05**2)  # omega^2 where |L| = 1
    last = math.sqrt(x)
    turned = (theta * last + math.pi / 2 + math.atan(0.05 * last) - math.atan(T * last)) / math.pi
    loop = Loop(Plant(gain, theta, (0.05,), (T,), integrators=1), SeriesPid(1.0, math.inf))
    assert stability(loop).unstable_poles == 2 * math.floor((turned + 1) / 2)


def test_too_many_turns_on_the_axis_are_refused():
    with pytest.raises(InvalidParameter, match=r"omega theta .* must be <= 1000, found .* = 0.99999999"):
        stability(chain(1e-10))


RESOLVED = 12  # unstable poles that the discretised generator gets right however fast they oscillate


def winding_of_samples(terms: list[Factored]) -> int:
    """Unstable poles by the Nyquist criterion on a fine grid, s = 1e-7 + j omega, from a real value to 1."""
    omega = np.concatenate([[0.0], np.geomspace(1e-9, 2e4, 200_000)])
    s = 1e-7 + 1j * omega
    f = 1 + sum(term(s) for term in terms)
    turned = np.sum(np.angle(f[1:] / f[:-1]))
    poles = max((term.poles for term in terms), key=len)
    return round(-turned / math.pi) + int(np.sum(poles.real > 1e-7))


def test_600_random_loops_against_the_generator():
    """The rightmost eigenvalues of the discretised generator: another principle, another representation."""
    rng = np.random.default_rng(1)
    counted = {"stable": 0, "unstable": 0, "with decay": 0}
    for _ in range(600):
        loop = third_unstable_loop(rng)
        values = rightmost(loop.L)
        found = stability(loop)
        counted[found.verdict] += 1
        if found.decay:
            counted["with decay"] += 1
            assert found.verdict == "stable"
            assert np.all(values.real < -found.decay * (1 - 1e-6)), loop
        if found.neutral > 1:  # countless, of which the discretisation has the first few
            assert found.unstable_poles == math.inf
            assert np.any(values.real > 0)
        else:
            known = np.sum(values.real > 1e-9 * np.abs(values))
            # a far too high gain has dozens of unstable poles, of which the discretisation has the first
            assert found.unstable_poles == known or found.unstable_poles > known > RESOLVED, loop
    assert min(counted.values()) > 150


def test_random_cascades_against_samples():
    """1 + Lb + Lb Ca Ga, two dead times, unstable blocks among them."""
    rng = np.random.default_rng(2)
    stable = 0
    for _ in range(120):
        primary, secondary = third_unstable_loop(rng), third_unstable_loop(rng)
        inner, outer = secondary.L, primary.L
        outer = Factored(outer.gain * rng.choice([0.05, 0.3, 1.0]), outer.num, outer.den, outer.theta)
        terms = [inner, inner * outer]
        found = count_unstable(terms)
        expected = math.inf if found.neutral > 1 else winding_of_samples(terms)
        assert found.unstable_poles == expected
        stable += found.verdict == "stable"
    assert stable > 10
