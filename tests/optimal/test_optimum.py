"""Optimal PI and PID controllers: known optima, an independent global optimiser, and what holds of any front."""

import math
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import differential_evolution

from simc_core import (
    FirstOrderDelay,
    IdealPid,
    InvalidParameter,
    Loop,
    NoOptimum,
    Plant,
    SeriesPid,
    margins,
    optimal,
    performance,
    simc,
    trade_off,
)

BALANCED, LAGGING, SLOW = Plant(1, 1, (1,)), Plant(1, 1, (8,)), Plant(1, 1, (20,))
INTEGRATING, FOUR_LAGS, TWO_LAGS = Plant(1, 1, (), (), 1), Plant(1, 0, (1, 1, 1, 1)), Plant(1, 1, (6, 2))
DELAY, DOUBLE, UNSTABLE = Plant(1, 1), Plant(1, 1, (), (), 2), Plant(-1, 1, (-20,))
COMPLEX = Plant(1, 0.3, (2,), (), 0, ((1, 0.1),))
PI = [  # plant, criterion, M, Kc, tau_I, value: of an independent program
    (BALANCED, "load", 1.59, 0.5190, 1.0467, 2.0182),
    (LAGGING, "load", 1.59, 3.3295, 3.6827, 1.13450),
    (SLOW, "load", 1.59, 8.0908, 4.7095, 0.60030),
    (INTEGRATING, "load", 1.59, 0.3961, 5.7836, 15.0942),
    (FOUR_LAGS, "load", 1.59, 0.6404, 2.4767, 3.8726),
    (UNSTABLE, "load", 1.8, 9.396, 6.003, 0.6497),
    (LAGGING, "J", 1.59, 3.473, 4.042, 1.2270),
    (INTEGRATING, "J", 1.59, 0.4099, 6.272, 1.5055),
    (BALANCED, "setpoint", 1.59, 0.5531, 1.1410, 2.0714),
    (DELAY, "setpoint", 1.59, 0.1984, 0.3190, 1.6083),
    (LAGGING, "setpoint", 2.5, 4.750, 8.003, 2.1037),
]
PID = [  # with tau_F = 0.1 theta of the half rule
    (BALANCED, "load", 0.8181, 1.081, 0.3997, 1.5551),
    (LAGGING, "load", 4.796, 2.301, 0.475, 0.67565),
    (INTEGRATING, "load", 0.5730, 3.542, 0.4664, 7.7109),
    (FOUR_LAGS, "load", 1.4166, 2.464, 1.285, 2.1357),
]
ANY = [BALANCED, LAGGING, INTEGRATING, FOUR_LAGS, TWO_LAGS, DELAY, UNSTABLE, COMPLEX]


@pytest.mark.parametrize(("plant", "criterion", "Ms", "Kc", "tau_I", "value"), PI)
def test_the_best_pi_controller_is_the_one_that_is_known(plant, criterion, Ms, Kc, tau_I, value):
    found = optimal(plant, "PI", Ms, criterion)
    assert found.value == pytest.approx(value, abs=6e-5)
    assert (found.controller.Kc, found.controller.tau_I) == pytest.approx(
        (Kc, tau_I), rel=1.5e-3
    )  # the optimum is flat
    assert max(found.Ms, found.Mt) <= Ms * (1 + 1e-7)


@pytest.mark.parametrize(("plant", "criterion", "Kc", "tau_I", "tau_D", "value"), PID)
def test_the_best_pid_controller_is_the_one_that_is_known(plant, criterion, Kc, tau_I, tau_D, value):
    found = optimal(plant, "PID", 1.59, criterion)
    controller = found.controller
    assert found.value == pytest.approx(value, abs=6e-5)
    assert (controller.Kc, controller.tau_I, controller.tau_D) == pytest.approx((Kc, tau_I, tau_D), rel=3e-3)
    assert max(found.Ms, found.Mt) <= 1.59 * (1 + 1e-7)


@pytest.mark.parametrize(
    ("plant", "load"), [(BALANCED, 1.5729), (LAGGING, 0.7589), (INTEGRATING, 8.3947), (TWO_LAGS, 1.8187)]
)
def test_the_best_pid_controller_for_J_has_its_known_load_error(plant, load):
    found = optimal(plant, "PID", 1.59, "J")
    value = performance(Loop(plant, found.controller)).disturbance.IAE
    assert value == pytest.approx(load, rel=1e-3)


def test_three_lags_have_the_settings_of_largest_integral_gain():
    """Astrom, Panagopoulos, Hagglund 1998 print Kc 0.633, Ki 0.325 for 1/(s+1)^3 and Ms 1.4: without change of sign of
    the load response IAE is 1/Ki.
    """
    found = optimal(Plant(1, 0, (1, 1, 1)), "PI", 1.4)
    Kc, tau_I = found.controller.Kc, found.controller.tau_I
    assert (Kc, Kc / tau_I, tau_I) == pytest.approx((0.633, 0.325, 1.946), rel=1.2e-3)
    assert found.value == pytest.approx(tau_I / Kc, rel=1e-7)


def test_the_set_point_of_an_integrator_is_best_followed_by_a_gain_alone():
    found = optimal(INTEGRATING, "PI", 1.59, "setpoint")
    assert found.controller.tau_I == math.inf
    assert (found.controller.Kc, found.value) == pytest.approx((0.49971, 2.1692), rel=3e-5)


def test_without_an_active_bound_the_free_optimum_stays():
    two, three = (optimal(BALANCED, "PI", Ms, "setpoint") for Ms in (2.0, 3.0))
    assert not two.active
    assert not three.active
    assert two.value == pytest.approx(1.9062, abs=6e-5)
    assert two.value == pytest.approx(three.value, rel=1e-5)
    assert two.Ms == pytest.approx(1.88, abs=0.01)


@pytest.mark.parametrize(("tau_F", "value"), [(0.01, 0.594), (0.03, 0.613), (0.1, 0.676), (0.3, 0.811)])
def test_the_filter_has_its_price(tau_F, value):
    assert optimal(LAGGING, "PID", tau_F=tau_F).value == pytest.approx(value, abs=6e-4)


@pytest.mark.parametrize(("plant", "loss"), [(BALANCED, 1.038), (FOUR_LAGS, 1.21)])
def test_real_zeros_have_their_price(plant, loss):
    series = optimal(plant, "PID", series=True)
    assert isinstance(series.controller, SeriesPid)
    assert series.value / optimal(plant, "PID").value == pytest.approx(loss, abs=2e-3)


@pytest.mark.parametrize("kind", ["PI", "PID"])
@pytest.mark.parametrize("plant", ANY)
def test_the_value_is_that_of_the_loop_and_the_bound_is_kept(plant, kind):
    for criterion in ("load", "setpoint"):
        found = optimal(plant, kind, 1.8, criterion)
        judged = margins(Loop(plant, found.controller))
        assert max(judged.Ms, judged.Mt) <= 1.8 * (1 + 1e-7)
        if found.controller.tau_I < math.inf:
            both = performance(Loop(plant, found.controller))
            value = both.disturbance.IAE if criterion == "load" else both.setpoint.IAE
            assert found.value == pytest.approx(value, rel=1e-6)


@pytest.mark.parametrize("kind", ["PI", "PID"])
@pytest.mark.parametrize("plant", [LAGGING, INTEGRATING, TWO_LAGS])
def test_the_optimum_scales_with_gain_and_time(plant, kind):
    time, gain = Fraction(60), -2.5
    here, there = optimal(plant, kind), optimal(plant.rescaled(time, gain), kind)
    assert there.value == pytest.approx(here.value * 60 * abs(gain), rel=1e-5)
    assert there.controller.Kc == pytest.approx(here.controller.rescaled(time, 1 / gain).Kc, rel=1e-3)


def worst_of(plant, settings, Ms, tau_F):
    """IAE of the load, with a penalty beyond the bound, from margins and performance alone."""
    loop = Loop(plant, IdealPid(*np.exp(settings).tolist(), *([0.0] * (3 - len(settings))), tau_F))
    found = margins(loop)
    if not found.stable or max(found.Ms, found.Mt) > 20:
        return 20.0
    excess = math.log(max(found.Ms, found.Mt) / Ms)
    return math.log(performance(loop).disturbance.IAE) + (1e3 * excess if excess > 0 else 0.0)


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("kind", ["PI", "PID"])
def test_a_slow_global_optimiser_finds_nothing_better(kind, seed):
    random = np.random.default_rng(seed)
    plant = Plant(1, float(random.uniform(0.2, 2)), tuple(random.uniform(0.2, 10, random.integers(1, 4)).tolist()))
    Ms, tau_F = float(random.uniform(1.35, 2)), 0.0 if kind == "PI" else 0.1
    mine = optimal(plant, kind, Ms, tau_F=tau_F)
    centre = np.log([mine.controller.Kc, mine.controller.tau_I, mine.controller.tau_D or 1.0][: len(kind)])
    shift = random.uniform(-0.4, 0.4, len(centre))  # of the bounds, so that the middle is not the answer
    slow = differential_evolution(
        lambda x: worst_of(plant, x, Ms, tau_F),
        [(x - 1.2, x + 1.2) for x in centre + shift],
        popsize=8,
        maxiter=25,
        seed=seed,
        polish=False,
    )
    assert math.log(mine.value) <= slow.fun + 1e-4


@pytest.mark.parametrize("kind", ["PI", "PID"])
@pytest.mark.parametrize("criterion", ["load", "J"])
@pytest.mark.parametrize("plant", [LAGGING, FOUR_LAGS])
def test_fronts_fall_and_a_pid_controller_is_never_worse(plant, criterion, kind):
    front = trade_off(plant, kind, criterion, (1.3, 1.5, 1.8, 2.2))
    values = [each.value for each in front]
    assert len(front) == 4
    assert all(after <= before * (1 + 1e-5) for before, after in pairwise(values))
    if kind == "PID":
        assert all(
            pid <= pi.value * (1 + 1e-5)
            for pid, pi in zip(values, trade_off(plant, "PI", criterion, (1.3, 1.5, 1.8, 2.2)), strict=True)
        )


@pytest.mark.parametrize("criterion", ["load", "setpoint"])
@pytest.mark.parametrize("tau1", [1, 8])
def test_simc_is_never_below_the_front(tau1, criterion):
    plant = Plant(1, 1, (tau1,))
    for tau_c in (0.6, 1.0, 2.0):
        loop = Loop(plant, simc(FirstOrderDelay(1, 1, tau1), tau_c))
        judged, both = margins(loop), performance(loop)
        value = both.disturbance.IAE if criterion == "load" else both.setpoint.IAE
        assert optimal(plant, "PI", max(judged.Ms, judged.Mt), criterion).value <= value * (1 + 1e-5)


def test_a_front_leaves_out_bounds_that_no_controller_meets():
    front = trade_off(UNSTABLE, "PI", "load", (1.05, 1.8, 2.5))
    assert len(front) == 2


@pytest.mark.parametrize("kind", ["PI", "PID"])
def test_without_dead_time_a_single_lag_has_no_optimum(kind):
    with pytest.raises(NoOptimum, match="without end"):
        optimal(Plant(2, 0, (3,)), kind)


def test_a_double_integrator_has_no_pi_controller_but_a_pid_one():
    with pytest.raises(NoOptimum, match="take PID"):
        optimal(DOUBLE, "PI", 2)
    found = optimal(DOUBLE, "PID", 1.8)
    assert max(found.Ms, found.Mt) <= 1.8 * (1 + 1e-7)
    assert found.value <= 134.77


def test_a_bound_that_is_too_small_is_refused_with_the_smallest_that_is_not():
    with pytest.raises(NoOptimum, match=r"Ms must be large enough.*about"):
        optimal(UNSTABLE, "PI", 1.05)


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ({"kind": "PD"}, "kind must be one of PI, PID, found 'PD'"),
        ({"criterion": "ISE"}, "criterion must be one of"),
        ({"Ms": 1.0}, "Ms must be > 1"),
        ({"kind": "PID", "criterion": "J", "tau_F": 0.0}, "tau_F must be > 0"),
        ({"kind": "PID", "tau_F": -1.0}, "tau_F must be >= 0"),
    ],
)
def test_what_cannot_be_asked_for_is_refused(how, words):
    with pytest.raises(InvalidParameter, match=words):
        optimal(LAGGING, **how)


def test_a_pure_delay_needs_a_filter_for_derivative_action():
    with pytest.raises(InvalidParameter, match="relative degree 0"):
        optimal(DELAY, "PID", tau_F=0.0)
    found = optimal(DELAY, "PID")  # a neutral loop
    assert found.value < optimal(DELAY, "PI").value


def test_no_controller_is_given_for_a_bound_that_none_meets():
    """An unstable pole under PID: the smallest peak is near 1.4; the search for less ends in words, not in a number."""
    front = trade_off(Plant(-2, 1, (-10,)), "PID", Ms=(1.2, 1.3, 1.5, 2.0))
    assert [max(best.Ms, best.Mt) for best in front] == pytest.approx([1.5, 2.0], rel=1e-4)
    assert all(best.value < 10 for best in front)
    with pytest.raises(NoOptimum, match="smallest that was found is about 1"):
        optimal(Plant(-2, 1, (-10,)), "PID", 1.2)
