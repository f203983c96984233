"""SIMC and its later forms behind one knob: settings by hand, where tau_I changes branch, choices of tau_c."""

import pytest

from simc_core import DoubleIntegratingDelay, FirstOrderDelay, InvalidParameter, OutOfDomain, simc
from simc_core.rules.simc_family import FAMILY, lag_of, multiples_of, presets_of, settings_of, usual_tau_c
from simc_core.rules.speed import tau_c_in_use

LAGGING, DELAYED = FirstOrderDelay(1, 1, 8), FirstOrderDelay(2, 3, 1)


def test_settings_are_those_of_the_papers():
    """e^{-s}/(8s+1): iSIMC at theta/2 and improved SIMC at theta; the delay-dominant ones by hand [SG12], [GS18]."""
    pid = settings_of("isimc", LAGGING)
    assert (pid.Kc, pid.tau_I, pid.tau_D) == pytest.approx((8 / 1.5, 6, 1 / 3))
    pi = settings_of("improved_simc", LAGGING, 1.0)
    assert (pi.Kc, pi.tau_I, pi.tau_D) == pytest.approx((25 / 6, 8, 0))
    pi = settings_of("improved_simc", DELAYED, 3.0)
    assert (pi.Kc, pi.tau_I) == pytest.approx((2 / 12, 2))
    assert settings_of("simc", DELAYED, 3.0) == simc(DELAYED, 3.0)


@pytest.mark.parametrize("rule", FAMILY)
def test_the_integral_time_is_the_lag_up_to_where_the_other_branch_begins(rule):
    lag = lag_of(rule, LAGGING)
    edge = lag / 4 - LAGGING.theta
    assert settings_of(rule, LAGGING, edge * 1.2).tau_I == pytest.approx(lag)
    assert settings_of(rule, LAGGING, edge * 0.8).tau_I == pytest.approx(4 * (0.8 * edge + LAGGING.theta))


def test_the_usual_choice_is_theta_and_half_of_it_for_isimc():
    assert [usual_tau_c(rule, LAGGING) for rule in FAMILY] == [1, 1, 0.5]
    for rule in FAMILY:
        usual = usual_tau_c(rule, LAGGING)
        assert tau_c_in_use(LAGGING, None, "", rule) == usual
        assert presets_of(rule, LAGGING)["tight"] == usual
        assert min(multiples_of(rule, LAGGING).values()) == usual
        assert tau_c_in_use(LAGGING, None, "2theta", rule) == 2


def test_what_a_rule_does_not_know_is_refused():
    for rule in FAMILY[1:]:
        with pytest.raises(OutOfDomain, match=r"model must be a first-order one .* found a double integrating one"):
            settings_of(rule, DoubleIntegratingDelay(1, 1), 1.0)
    with pytest.raises(InvalidParameter, match="rule must be one of simc, improved_simc, isimc, found 'zn'"):
        settings_of("zn", LAGGING)
