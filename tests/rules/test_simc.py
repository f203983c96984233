"""SIMC settings against the published tables and the desired loop they are derived from."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IController,
    IdealPid,
    IntegratingDelay,
    InvalidParameter,
    Loop,
    OscillatingDelay,
    SecondOrderDelay,
    SeriesPid,
    UnstableDelay,
    frequency_response,
    simc,
    tau_c_presets,
)
from simc_core.rules.simc import unstable_factor
from tests.oracles.published import PUBLISHED, select

TIMES = st.floats(0.01, 100)
GAINS = st.floats(0.01, 100) | st.floats(-100, -0.01)


def model_of(inputs):
    """The model printed with a row of [SK03] Table 4."""
    if "theta" in inputs:
        return IntegratingDelay(1.0, inputs["theta"])
    given = inputs["model"]
    if given["tau1"] == "inf":
        return IntegratingDelay(given["k"], given["theta"], given["tau2"])
    if given["tau2"]:
        return SecondOrderDelay(given["k"], given["theta"], given["tau1"], given["tau2"])
    return FirstOrderDelay(given["k"], given["theta"], given["tau1"])


@pytest.mark.parametrize("row", select("-tuning"))
def test_rows_of_the_2003_table(row):
    controller = simc(model_of(row.inputs))
    settings = (controller.Kc, controller.tau_I, controller.tau_D)[: len(row.expected)]
    for i, value in enumerate(settings):
        assert value == row.approx(i)


@pytest.mark.parametrize("row", select("S002-f-"))
def test_factor_of_the_unstable_rule(row):
    assert unstable_factor(row.inputs["a_theta"]) == row.approx()


def test_unstable_example_of_1998():
    row = PUBLISHED["S002-ex2-tune"]
    given = row.inputs
    controller = simc(UnstableDelay(given["kprime"], given["theta"], given["a"], given["tau"]))
    assert (controller.Kc, controller.tau_I, controller.tau_D) == (row.approx(0), row.approx(1), row.approx(2))


def test_settings_of_v06_example_1_in_ideal_form():
    """[V06] example 1: models and settings as printed, series and ideal."""
    pi, row = simc(FirstOrderDelay(1, 7, 8)), PUBLISHED["S000-ex1a"]
    assert (pi.Kc, pi.tau_I) == (row.approx(2), row.approx(3))
    pid, row = simc(SecondOrderDelay(1, 4, 6, 5)).to_ideal(), PUBLISHED["S000-ex1b"]
    assert (pid.Kc, pid.tau_I, pid.tau_D) == (row.approx(3), row.approx(4), row.approx(5))


def test_pure_delay_has_integral_action_and_equals_a_fast_PI():
    """[SK98]: K_I = 0.5/(k theta) is the PI with Kc = 0.25/k, tau_I = theta/2 as far as Ki goes."""
    row = PUBLISHED["S002-pure-PI"]
    controller = simc(FirstOrderDelay(1, 1, 0))
    assert isinstance(controller, IController)
    fast = row.inputs["controller"]
    assert fast["Kc"] / fast["tau_I"] == row.approx()
    assert row.approx() == controller.K_I


def desired(theta, tau_c, s):
    """L of the closed loop e^{-theta s}/(tau_c s + 1) with e^{-theta s} = 1 - theta s in the denominator."""
    return np.exp(-theta * s) / ((tau_c + theta) * s)


@given(GAINS, TIMES, TIMES, TIMES, TIMES)
def test_direct_synthesis_while_tau_I_is_tau1(k, theta, tau_c, tau1, tau2):
    """[SK03 eq. 18-20]: C G = e^{-theta s}/((tau_c + theta) s) where tau_I = tau1."""
    tau1 = min(tau1, 4 * (tau_c + theta))
    s = 1j * np.geomspace(0.01, 10, 7) / (tau_c + theta)
    models = [FirstOrderDelay(k, theta, 0.0), FirstOrderDelay(k, theta, tau1)]
    models += [SecondOrderDelay(k, theta, tau1, min(tau1, tau2)), OscillatingDelay(k, theta, tau1, 0.01 * tau2)]
    for model in models:
        loop = model.plant.response(s) * simc(model, tau_c).response(s)
        assert loop == pytest.approx(desired(theta, tau_c, s), rel=1e-9)


@given(GAINS, TIMES, TIMES, TIMES)
def test_integrating_rules_are_the_limit_of_slow_lags(k_prime, theta, tau_c, tau2):
    slow = 1e8
    near = simc(SecondOrderDelay(k_prime * slow, theta, slow, tau2), tau_c)
    limit = simc(IntegratingDelay(k_prime, theta, tau2), tau_c)
    assert (near.Kc, near.tau_I, near.tau_D) == pytest.approx((limit.Kc, limit.tau_I, limit.tau_D), rel=1e-9)


@given(GAINS, TIMES, TIMES)
def test_double_integrator_continues_the_series_rule(k, theta, tau_c):
    """[SK03 eq. 27]: k'/(s (tau2 s+1)) with k' = k'' tau2, tau2 -> infinity, tau_D = 4 (tau_c + theta)."""
    controller = simc(DoubleIntegratingDelay(k, theta), tau_c)
    q = tau_c + theta
    assert controller.Kc * controller.tau_D == pytest.approx(1 / (k * q), rel=1e-12)
    assert controller.tau_I == controller.tau_D == pytest.approx(4 * q, rel=1e-12)


@given(TIMES, st.floats(0.001, 0.49), GAINS, TIMES)
def test_unstable_rule_scales_with_time(theta, a_theta, k_prime, tau2):
    """With time in units of theta only a theta is left: tau_I/theta and Kc k' theta do not depend on theta."""
    one = simc(UnstableDelay(1.0, 1.0, a_theta, tau2))
    other = simc(UnstableDelay(k_prime, theta, a_theta / theta, tau2), theta)
    assert other.Kc * k_prime * theta == pytest.approx(one.Kc, rel=1e-12)
    assert other.tau_I / theta == pytest.approx(one.tau_I, rel=1e-9)


def test_unstable_rule_is_the_integrating_one_for_a_slow_pole():
    """f(0) = 1: Kc = 0.5/(k' theta), tau_I = 8 theta."""
    controller = simc(UnstableDelay(2.0, 3.0, 1e-9))
    limit = simc(IntegratingDelay(2.0, 3.0))
    assert (controller.Kc, controller.tau_I) == pytest.approx((limit.Kc, limit.tau_I), rel=1e-7)


def test_oscillating_rule_is_the_series_rule_at_critical_damping():
    """zeta = 1: two lags tau0; the same controller written in ideal form."""
    assert simc(OscillatingDelay(2, 1, 3, 1)) == IdealPid(1.5 * 2 / 2, 6.0, 1.5)
    series = simc(SecondOrderDelay(2, 1, 3, 3)).to_ideal()
    assert (series.Kc, series.tau_I, series.tau_D) == pytest.approx((1.5, 6.0, 1.5))


def test_integrating_loop_is_critically_damped():
    """[SK98]: with tau_I = 8 theta and the delay neglected tau0 = 4 theta, zeta = 1, period 2 pi tau0 = 25 theta."""
    row = PUBLISHED["S002-tau0"]
    controller = simc(IntegratingDelay(1, 1))
    assert (controller.Kc, controller.tau_I) == (row.inputs["Kc"], row.inputs["tau_I"])
    poles = np.roots([controller.tau_I / controller.Kc, controller.tau_I, 1])
    tau0 = 1 / math.sqrt(abs(np.prod(poles)))
    assert tau0 == row.approx(0)
    assert -np.sum(poles).real * tau0 / 2 == row.approx(1)
    assert 2 * math.pi * tau0 == row.approx(2)


def test_slow_oscillation_and_the_retuning_rule():
    """[SG12]: Kc tau_I times F = 0.1 (P0/tau_I)^2 brings k' Kc tau_I back to 4; exactly 1/pi^2 without dead time."""
    k_prime, Kc, tau_I = 1.0, 0.1, 8.0
    period = 2 * math.pi * math.sqrt(tau_I / (k_prime * Kc))
    factor = 4 / (k_prime * Kc * tau_I)
    assert factor / (period / tau_I) ** 2 == PUBLISHED["SG12-retune"].approx()


def offset(plant, controller):
    """Steady-state error of a set-point step, |S(0)|."""
    return abs(frequency_response(Loop(plant, controller), [1e-9]).S[0])


def test_offset_of_proportional_control():
    """[SK98]: below 10 % only from tau1/theta = 18 on with the gain of the rule; 50 % at best for pure dead time."""
    model = FirstOrderDelay(2, 1, PUBLISHED["S002-offset"].expected[0])
    assert offset(model.plant, SeriesPid(simc(model).Kc, math.inf)) == pytest.approx(0.1, rel=1e-9)
    row = PUBLISHED["S002-pure-offset"]
    assert offset(row.plant, SeriesPid(1.0, math.inf)) == row.approx()


def test_presets_of_arbogast_cooper_and_rice():
    """[V06 eq. 7], read as max(...): the printed intervals would be empty for tau1 > 8 theta."""
    presets = tau_c_presets(FirstOrderDelay(1, 2, 30))
    assert presets == {"tight": 2, "aggressive": 3, "moderate": 30, "conservative": 300}
    assert tau_c_presets(IntegratingDelay(1, 2))["moderate"] == 16
    assert tau_c_presets(UnstableDelay(1, 2, 0.1)) == {"tight": 2}
    assert tau_c_presets(FirstOrderDelay(1, 0, 10)) == {"aggressive": 1, "moderate": 10, "conservative": 100}


@pytest.mark.parametrize("model", [FirstOrderDelay(1, 1, 3), IntegratingDelay(1, 1), DoubleIntegratingDelay(1, 1)])
@pytest.mark.parametrize(
    ("tau_c", "words"),
    [
        (0, "> 0, found 0"),
        (-0.5, "> 0, found -0.5"),
        (-1, "above -theta"),
        (-2, "found -2"),
        (math.nan, "finite"),
        (math.inf, "finite"),
        (1e300, "<= 1e"),
        ("1", "number"),
        (True, "number"),
    ],
)
def test_tau_c_out_of_bounds(model, tau_c, words):
    with pytest.raises(InvalidParameter, match=words):
        simc(model, tau_c)


@pytest.mark.parametrize(
    ("model", "tau_c", "words"),
    [
        (FirstOrderDelay(1, 0, 3), None, "tau_c must be given"),
        (UnstableDelay(1, 1, 0.1), 2.0, "theta = 1 for an unstable pole, found 2"),
        (UnstableDelay(1, 1, 0.5), None, "a theta must be < 0.5"),
        (UnstableDelay(1, 0, 0.5), None, "theta must be > 0"),
        (OscillatingDelay(1, 1, 1, 0), None, "zeta must be > 0"),
        (SeriesPid(1, 1), None, "as half_rule makes it"),
    ],
)
def test_where_the_rules_end(model, tau_c, words):
    with pytest.raises(InvalidParameter, match=words):
        simc(model, tau_c)
