"""Every rule of the catalogue: numbers worked out by hand from its source, the peaks they are known for, its domain.

The settings were computed apart, with a calculator, from the formulas as printed; Ms with tau_F = tau_D/100 is that
of an independent program.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import (
    RULES,
    FirstOrderDelay,
    IController,
    IntegratingDelay,
    InvalidParameter,
    Loop,
    OutOfDomain,
    Plant,
    SecondOrderDelay,
    Ultimate,
    margins,
    tune,
)
from simc_core.rules.imc_1986 import imc_without_delay

BALANCED, LAGGING = Plant(1, 1, (1,)), Plant(1, 1, (8,))
INTEGRATING, FOUR_LAGS, TWO_LAGS = Plant(1, 1, (), (), 1), Plant(1, 0, (1, 1, 1, 1)), Plant(1, 1, (6, 2))
INF = math.inf
KNOWN = [  # plant, rule, kind, Kc, tau_I, tau_D in the form of the source, Ms
    (LAGGING, "zn_step", "PI", 7.2, 3.333, 0, 3.271),
    (LAGGING, "zn_step", "PID", 9.6, 2, 0.5, 3.417),
    (LAGGING, "cohen_coon", "PID", 10.917, 2.339, 0.3556, 3.992),
    (LAGGING, "amigo", "PI", 2.160, 5.332, 0, 1.301),
    (LAGGING, "amigo", "PID", 3.8, 3.778, 0.4819, 1.408),
    (LAGGING, "iae_load", "PI", 7.646, 3.025, 0, 3.907),
    (LAGGING, "lee_1998", "PID", 4.125, 8.25, 0.2399, 1.447),
    (LAGGING, "isimc", "PID", 5.333, 6, 0.3333, 1.676),
    (LAGGING, "imc_1986", "PID", 6.538, 8.5, 0.4706, 2.011),
    (INTEGRATING, "zn_ultimate", "PI", 0.707, 3.333, 0, 2.831),
    (INTEGRATING, "tyreus_luyben", "PI", 0.491, 8.8, 0, 1.672),
    (INTEGRATING, "amigo", "PI", 0.35, 13.4, 0, 1.410),
    (INTEGRATING, "lambda", "PI", 0.4375, 7, 0, 1.613),
    (FOUR_LAGS, "kuhn", "PI", 0.5, 2, 0, 1.560),
    (FOUR_LAGS, "kuhn_fast", "PI", 1, 2.8, 0, 1.994),
    (FOUR_LAGS, "magnitude_optimum", "PI", 0.5, 2, 0, 1.560),
    (FOUR_LAGS, "schaedel", "PI", 0.8333, 2.5, 0, 1.850),
    (BALANCED, "magnitude_optimum", "PI", 0.5714, 1.0667, 0, 1.664),
    (Plant(1, 0, (1,), (), 1), "symmetrical_optimum", "PI", 0.5, 4, 0, 1.682),
]
BY_HAND = [  # for k = 2, theta = 1, tau1 = 4: a = 0.5, r = 0.25
    ("improved_simc", "PI", 13 / 12, 13 / 3, 0),
    ("imc_1986", "PI", 4 / 3.4, 4, 0),
    ("imc_1986_improved", "PI", 9 / 6.8, 4.5, 0),
    ("desired_model", "PI", 1, 4, 0),
    ("zn_step", "P", 2, INF, 0),
    ("chr_setpoint_0", "P", 0.6, INF, 0),
    ("chr_setpoint_0", "PI", 0.7, 4.8, 0),
    ("chr_setpoint_0", "PID", 1.2, 4, 0.5),
    ("chr_setpoint_20", "P", 1.4, INF, 0),
    ("chr_setpoint_20", "PI", 1.2, 4, 0),
    ("chr_setpoint_20", "PID", 1.9, 5.6, 0.47),
    ("chr_load_0", "P", 0.6, INF, 0),
    ("chr_load_0", "PI", 1.2, 4, 0),
    ("chr_load_0", "PID", 1.9, 2.4, 0.42),
    ("chr_load_20", "P", 1.4, INF, 0),
    ("chr_load_20", "PI", 1.4, 2.3, 0),
    ("chr_load_20", "PID", 2.4, 2, 0.42),
    ("cohen_coon", "P", 2 * (1 + 0.25 / 3), INF, 0),
    ("cohen_coon", "PI", 2 * (0.9 + 0.25 / 12), 30.75 / 14, 0),
    ("cohen_coon", "PD", 2 * (1.25 + 0.25 / 6), INF, 5.5 / 22.75),
    ("iae_load", "PID", 1.435 * 4**0.921 / 2, 4 / (0.878 * 4**0.749), 4 * 0.482 / 4**1.137),
    ("itae_load", "PI", 0.859 * 4**0.977 / 2, 4 / (0.674 * 4**0.680), 0),
    ("itae_load", "PID", 1.357 * 4**0.947 / 2, 4 / (0.842 * 4**0.738), 4 * 0.381 / 4**0.995),
    ("iae_setpoint", "PI", 0.758 * 4**0.861 / 2, 4 / 0.93925, 0),
    ("iae_setpoint", "PID", 1.086 * 4**0.869 / 2, 4 / 0.7075, 4 * 0.348 / 4**0.914),
    ("itae_setpoint", "PI", 0.586 * 4**0.916 / 2, 4 / 0.98875, 0),
    ("itae_setpoint", "PID", 0.965 * 4**0.855 / 2, 4 / 0.75925, 4 * 0.308 / 4**0.929),
    ("kuhn", "PID", 0.5, 3.3, 0.835),
    ("kuhn_fast", "PID", 1, 4, 0.97),
    ("spectral", "PI", 1, 4, 0),
]
AT_THE_LIMIT = [  # Ku = 20, Pu = 3
    ("zn_ultimate", "P", 10, INF, 0),
    ("zn_ultimate", "PI", 9, 2.5, 0),
    ("zn_ultimate", "PID", 12, 1.5, 0.375),
    ("tyreus_luyben", "PI", 6.25, 6.6, 0),
    ("tyreus_luyben", "PID", 100 / 11, 6.6, 3 / 6.3),
    ("pessen", "PID", 14, 1.2, 0.45),
    ("some_overshoot", "PID", 20 / 3, 1.5, 1),
    ("no_overshoot", "PID", 4, 1.5, 1),
]


def settings(controller):
    return controller.Kc, controller.tau_I, controller.tau_D


@pytest.mark.parametrize(("plant", "key", "kind", "Kc", "tau_I", "tau_D", "Ms"), KNOWN)
def test_settings_and_peak_are_those_that_are_known(plant, key, kind, Kc, tau_I, tau_D, Ms):
    controller = tune(key, plant, kind)
    assert settings(controller) == pytest.approx((Kc, tau_I, tau_D), rel=6e-4)
    if tau_D:
        controller = replace(controller, tau_F=controller.tau_D / 100)
    assert margins(Loop(plant, controller)).Ms == pytest.approx(Ms, abs=6e-4)


@pytest.mark.parametrize(("key", "kind", "Kc", "tau_I", "tau_D"), BY_HAND)
def test_settings_of_a_first_order_model_are_those_worked_out_by_hand(key, kind, Kc, tau_I, tau_D):
    assert settings(tune(key, FirstOrderDelay(2, 1, 4), kind)) == pytest.approx((Kc, tau_I, tau_D), rel=1e-12)


@pytest.mark.parametrize(("key", "kind", "Kc", "tau_I", "tau_D"), AT_THE_LIMIT)
def test_settings_from_an_ultimate_point_are_those_worked_out_by_hand(key, kind, Kc, tau_I, tau_D):
    assert settings(tune(key, Ultimate(20, 3), kind)) == pytest.approx((Kc, tau_I, tau_D), rel=1e-12)


def test_every_rule_and_kind_is_compared_with_numbers_that_are_known():
    compared = {row[1:3] for row in KNOWN} | {row[:2] for row in (*BY_HAND, *AT_THE_LIMIT)}
    offered = {(rule.key, kind) for rule in RULES.values() for kind in rule.kinds}
    assert offered - compared == {("simc", "PI"), ("simc", "PID"), ("spectral", "PID")}  # test_simc.py, and below


def test_pole_cancelling_leaves_an_integrator_and_dead_time():
    model, s = SecondOrderDelay(2, 1, 6, 2), 1j * np.geomspace(0.01, 10, 20)
    controller = tune("spectral", model, "PID", Ki=0.3)
    assert model.plant.response(s) * controller.response(s) == pytest.approx(0.6 * np.exp(-s) / s, rel=1e-12)


def test_desired_model_with_beta_e_has_a_double_pole():
    """1 + e^{-s}/(e s) and its derivative vanish at s = -1: the fastest answer without overshoot."""
    controller = tune("desired_model", FirstOrderDelay(1, 1, 5), beta=math.e)
    loop = Loop(Plant(1, 1, (5,)), controller)
    s = np.array([-1.0, -1 + 1e-4, -1 - 1e-4])
    assert 1 + loop.L(s) == pytest.approx([0, -5e-9, -5e-9], abs=1e-11)


def test_magnitude_optimum_makes_the_closed_loop_flat():
    """|T| - 1 falls as omega^6: by 64 when omega is halved."""
    plant = Plant(2, 0.5, (3, 1), (0.4,))
    loop = Loop(plant, tune("magnitude_optimum", plant))
    L = loop.L(1j * np.array([0.02, 0.01]))
    rest = np.abs(L / (1 + L)) - 1
    assert rest[0] / rest[1] == pytest.approx(64, rel=0.03)


def test_symmetrical_optimum_has_its_phase_margin_and_overshoot():
    found = margins(Loop(Plant(1, 0, (1,), (), 1), tune("symmetrical_optimum", Plant(1, 0, (1,), (), 1))))
    assert found.PM_deg == pytest.approx(math.degrees(math.atan(2) - math.atan(0.5)), abs=1e-9)
    assert found.Ms == pytest.approx(found.Mt, rel=1e-9)


@given(
    key=st.sampled_from([key for key, rule in RULES.items() if key != "symmetrical_optimum"]),
    time=st.floats(0.01, 100),
    gain=st.floats(0.01, 100) | st.floats(-100, -0.01),
)
def test_settings_scale_with_time_and_gain(key, time, gain):
    rule = RULES[key]
    kind = rule.kinds[-1] if key not in ("simc", "spectral") else "PI"
    model, scaled = FirstOrderDelay(1, 1, 2), FirstOrderDelay(gain, time, 2 * time)
    one, other = tune(key, model, kind), tune(key, scaled, kind)
    assert other.Kc == pytest.approx(one.Kc / gain, rel=1e-6)
    assert other.tau_I == pytest.approx(one.tau_I * time, rel=1e-6)
    assert other.tau_D == pytest.approx(one.tau_D * time, rel=1e-6)


@pytest.mark.parametrize(
    ("key", "kind", "limit"),
    [
        ("itae_setpoint", "PI", 6.24),
        ("iae_setpoint", "PI", 3.16),
        ("itae_setpoint", "PID", 5.41),
        ("iae_setpoint", "PID", 5.69),
    ],
)
def test_set_point_fits_end_where_their_integral_time_would_be_negative(key, kind, limit):
    assert tune(key, FirstOrderDelay(1, limit - 0.01, 1), kind).tau_I > 0
    with pytest.raises(OutOfDomain, match=f"theta/tau1 must be < {limit:.3g}"):
        tune(key, FirstOrderDelay(1, limit + 0.01, 1), kind)


@pytest.mark.parametrize(
    ("key", "subject", "kind", "words"),
    [
        ("zn_step", FirstOrderDelay(1, 0, 1), "PI", "theta must be > 0"),
        ("zn_step", FirstOrderDelay(1, 1, 0), "PI", "tau1 must be > 0"),
        ("zn_step", Ultimate(1, 1), "PI", "subject must be a model or a plant"),
        ("lee_1998", IntegratingDelay(1, 1), "PID", "model must be a first-order one"),
        ("amigo", IntegratingDelay(1, 1, 2), "PI", "tau2 must be 0"),
        ("isimc", FirstOrderDelay(1, 1, 1), "PI", "kind must be PID"),
        ("kuhn", INTEGRATING, "PI", "integrators must be 0"),
        ("kuhn", Plant(1, 1, (-2,)), "PI", "left half plane"),
        ("kuhn", Plant(1, 0, (1,), (2,)), "PI", "T-sum must be > 0"),
        ("symmetrical_optimum", BALANCED, "PI", "integrators must be 1"),
        ("simc", FirstOrderDelay(1, 1, 1), "PID", "kind must be PI "),
        ("simc", SecondOrderDelay(1, 1, 2, 1), "PI", "kind must be PID"),
        ("lee_1998", FirstOrderDelay(1, 1, 0), "PID", "tau_D must be > 0"),
        ("cohen_coon", FirstOrderDelay(1, 4, 1), "PD", "tau_D must be > 0"),
    ],
)
def test_outside_its_domain_a_rule_refuses_with_field_and_bound(key, subject, kind, words):
    with pytest.raises(OutOfDomain, match=words):
        tune(key, subject, kind)


def test_unknown_rules_and_parameters_are_named():
    with pytest.raises(InvalidParameter, match=r"rule must be one of simc, .*found 'zn'"):
        tune("zn", BALANCED)
    with pytest.raises(InvalidParameter, match="has only tau_c, found lambda_"):
        tune("simc", BALANCED, lambda_=1)
    with pytest.raises(InvalidParameter, match="has no parameter of its own, found tau_c"):
        tune("amigo", BALANCED, tau_c=1)
    with pytest.raises(InvalidParameter, match="subject must be a reduced model"):
        tune("amigo", "e^-s/(s+1)")


def test_defaults_are_those_of_the_sources():
    model = FirstOrderDelay(1, 2, 3)
    for key, kind, knob in [
        ("improved_simc", "PI", 2),
        ("isimc", "PID", 1),
        ("lambda", "PI", 3),
        ("lee_1998", "PID", 2),
    ]:
        assert tune(key, model, kind) == tune(key, model, kind, **{RULES[key].knob: knob})
    assert tune("imc_1986", model) == tune("imc_1986", model, epsilon=3.4)
    assert tune("imc_1986", model, "PID") == tune("imc_1986", model, "PID", epsilon=1.6)
    assert tune("lambda", IntegratingDelay(1, 2)) == tune("lambda", IntegratingDelay(1, 2), lambda_=6)
    assert isinstance(tune("simc", FirstOrderDelay(1, 1, 0)), IController)


def test_recommended_ranges_are_those_of_the_sources():
    def within(key, model, kind, knob=None):
        return RULES[key].within(model, kind, knob)

    assert within("zn_step", FirstOrderDelay(1, 0.5, 1), "PI")
    assert not within("zn_step", FirstOrderDelay(1, 2, 1), "PI")
    assert not within("iae_load", FirstOrderDelay(1, 0.05, 1), "PI")
    assert within("cohen_coon", FirstOrderDelay(1, 0.05, 1), "PI")
    assert within("amigo", FirstOrderDelay(1, 0.1, 1), "PI")
    assert not within("amigo", FirstOrderDelay(1, 0.1, 1), "PID")
    assert within("imc_1986", FirstOrderDelay(1, 1, 8), "PI")
    assert not within("imc_1986", FirstOrderDelay(1, 1, 20), "PI")  # 1.7 theta < 0.1 tau1
    assert not within("imc_1986", FirstOrderDelay(1, 1, 8), "PID", 0.5)


ALL_PASS = Plant(2, 0, (), (-0.7,), 0, ((3, 0.4),))
TABLE = [  # plant, ramp, all_pass, y/ys as a function of s for epsilon = 0.5
    (Plant(2, 0, (3,)), False, True, lambda s: 1 / (0.5 * s + 1)),
    (Plant(2, 0, (3, 1)), False, True, lambda s: 1 / (0.5 * s + 1)),
    (Plant(2, 0, (), (), 0, ((3, 0.4),)), False, True, lambda s: 1 / (0.5 * s + 1)),
    (ALL_PASS, False, True, lambda s: (1 - 0.7 * s) / (1 + 0.7 * s) / (0.5 * s + 1)),
    (ALL_PASS, False, False, lambda s: (1 - 0.7 * s) / (0.5 * s + 1)),
    (Plant(-2, 0, (), (), 1), False, True, lambda s: 1 / (0.5 * s + 1)),
    (Plant(-2, 0, (), (), 1), True, True, lambda s: (s + 1) / (0.5 * s + 1) ** 2),
    (Plant(2, 0, (3,), (), 1), False, True, lambda s: 1 / (0.5 * s + 1)),
    (Plant(2, 0, (3,), (), 1), True, True, lambda s: (s + 1) / (0.5 * s + 1) ** 2),
    (Plant(2, 0, (), (-0.7,), 1), False, True, lambda s: (1 - 0.7 * s) / (1 + 0.7 * s) / (0.5 * s + 1)),
    (Plant(2, 0, (), (-0.7,), 1), True, True, lambda s: (1 - 0.7 * s) * (1.7 * s + 1) / (0.5 * s + 1) ** 2),
]


@pytest.mark.parametrize(("plant", "ramp", "all_pass", "closed"), TABLE)
def test_without_dead_time_the_loop_is_the_closed_loop_of_table_1_identically(plant, ramp, all_pass, closed):
    s = 1j * np.geomspace(0.01, 100, 30)
    L = plant.response(s) * imc_without_delay(plant, 0.5, ramp, all_pass).response(s)
    assert pytest.approx(closed(s), rel=1e-11) == L / (1 + L)


@pytest.mark.parametrize(
    ("plant", "how", "words"),
    [
        (Plant(1, 1, (1,)), {}, "no dead time"),
        (Plant(1, 0, (1,), (2,)), {}, "no zero but"),
        (Plant(1, 0, (1, 2, 3)), {}, "one of Table I"),
        (Plant(1, 0, (1,)), {"ramp": True}, "ramp must be False"),
        (Plant(1, 0, (1,)), {"all_pass": False}, "all_pass must be True"),
        (Plant(1, 0, (), (), 0, ((1, 0),)), {}, "zeta must be > 0"),
    ],
)
def test_plants_that_are_not_in_table_1_are_refused(plant, how, words):
    with pytest.raises(OutOfDomain, match=words):
        imc_without_delay(plant, 1.0, **how)
