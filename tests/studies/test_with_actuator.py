"""The loop as built: its numbers against closed forms."""

import math

import numpy as np
import pytest

from simc_core import Actuation, Loop, Plant, Scenario, SeriesPid
from simc_core.studies.with_actuator import as_built

DEAF = Loop(Plant(1e-9, 1.0, (8.0,)), SeriesPid(2.0, 4.0))  # y stays 0: v = Kc r (1 + t/tau_I) until it saturates
USUAL = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 8.0))


def test_time_at_the_limit_and_what_is_asked_for_in_closed_form():
    """v reaches u_max at t1 = tau_I (u_max/Kc - 1); then (v - u_max)' = Kc/tau_I - (v - u_max)/T_t."""
    found = as_built(DEAF, Scenario(1.0, 0.0, t_end=20.0, actuation=Actuation(u_max=3.0, tracking_time=1.5)))
    assert found.numbers.u_asked == pytest.approx((2.0, 3.0 + 0.5 * 1.5 * (1 - math.exp(-18 / 1.5))), rel=1e-5)
    assert found.numbers.u_given == (2.0, 3.0)
    assert found.numbers.limited == pytest.approx(18.0, abs=0.01)
    assert found.unprotected.u.max() == 3.0
    assert found.T_t == 1.5


def test_IAE_of_a_load_step_is_tau_I_over_Kc():
    """For an error of one sign [theory.md sect. 3]; limits that are not met change nothing."""
    found = as_built(USUAL, Scenario(0.0, 1.0, 0.0, t_end=120.0, actuation=Actuation(u_min=-5.0)))
    assert pytest.approx(2.0, rel=1e-3) == found.numbers.IAE
    assert found.numbers.IAE_linear == pytest.approx(2.0, rel=1e-4)
    assert found.numbers.limited == 0.0


def test_noise_on_u_is_Kc_times_the_noise_where_the_loop_does_not_answer():
    loop = Loop(DEAF.plant, SeriesPid(2.0, 1e6))
    found = as_built(loop, Scenario(0.0, 0.0, t_end=200.0, actuation=Actuation(noise=0.1, h=0.05)))
    assert found.numbers.noise_u == pytest.approx(0.2, rel=0.05)  # 4000 samples
    assert found.step == 0.05
    quiet = as_built(USUAL, Scenario(actuation=Actuation(u_max=2.0))).numbers
    assert quiet.noise_y == quiet.noise_u == 0.0


def test_the_largest_move_of_a_sampled_controller():
    """Y stays 0: each sample adds h Kc/tau_I."""
    assert as_built(
        DEAF, Scenario(1.0, 0.0, t_end=20.0, actuation=Actuation(h=0.5))
    ).numbers.largest_move == pytest.approx(0.25)
    assert math.isnan(as_built(DEAF, Scenario(t_end=20.0, actuation=Actuation(u_max=5.0))).numbers.largest_move)


def test_the_horizon_grows_while_a_limited_loop_is_on_its_way():
    """With u_max = 1.05 y goes to 1 as the plant alone under it: 1.05 (1 - e^{-t/8})."""
    found = as_built(USUAL, Scenario(1.0, 0.0, actuation=Actuation(u_max=1.05)))
    y = found.built.y[found.built.t < 20]
    t = found.built.t[found.built.t < 20]
    assert y == pytest.approx(np.where(t > 1, 1.05 * -np.expm1(-(t - 1) / 8), 0.0), abs=1e-4)
    assert found.linear.t[-1] == found.built.t[-1] > 60
    assert found.built.y[-1] == pytest.approx(1.0, abs=0.01)


def test_without_anti_windup_the_overshoot_is_larger():
    loop = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 3.0))
    found = as_built(loop, Scenario(actuation=Actuation(u_min=0.0, u_max=1.2)))
    assert found.unprotected.y.max() > found.built.y.max() + 0.05


def test_an_unstable_loop_has_curves_and_no_numbers():
    found = as_built(
        Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(20.0, 8.0)), Scenario(actuation=Actuation(u_min=-2.0, u_max=2.0))
    )
    assert found.numbers is None
    assert np.ptp(found.built.y) > 0.1


@pytest.mark.parametrize("t_end", [20.0, 7.3, 3.3, 2.1, 0.3])
@pytest.mark.parametrize("h", [0.0, 0.1, 0.7])
def test_integrals_end_with_the_horizon_whatever_the_step(t_end, h):
    """Y stays 0, so |e| = 1 all the time; u is at its limit from the start."""
    loop = Loop(DEAF.plant, SeriesPid(4.0, 8.0))
    found = as_built(loop, Scenario(1.0, 0.0, t_end=t_end, actuation=Actuation(u_max=1.0, h=h))).numbers
    assert pytest.approx(t_end, rel=1e-5) == found.IAE
    assert found.limited == pytest.approx(t_end, rel=1e-5)
