"""The names that scripts and notebooks rely on: importable from simc_core, with these parameters and fields."""

import dataclasses
import inspect

import numpy as np
import pytest

import simc_core
from simc_core import (
    CascadeLoop,
    FirstOrderDelay,
    Loop,
    NestedLoops,
    NotStable,
    Plant,
    Scenario,
    SeriesPid,
    SimcError,
    crossings,
    direct_synthesis,
    frequency_response,
    margins,
    performance,
    simc,
    simc_cascade,
    simulate,
    stability,
    sweep,
    synthesis_cascade,
)

PARAMETERS = {
    "Plant": "k theta lags leads integrators lag_pairs lead_pairs",
    "FirstOrderDelay": "k theta tau1",
    "SecondOrderDelay": "k theta tau1 tau2",
    "IntegratingDelay": "k_prime theta tau2",
    "DoubleIntegratingDelay": "k_double_prime theta",
    "UnstableDelay": "k_prime theta a tau2",
    "OscillatingDelay": "k theta tau0 zeta",
    "half_rule": "plant order h",
    "simc": "model tau_c",
    "SeriesPid": "Kc tau_I tau_D tau_F b c",
    "IdealPid": "Kc tau_I tau_D tau_F b c",
    "ParallelPid": "Kp Ki Kd tau_F b c",
    "IController": "K_I",
    "Loop": "plant controller",
    "CascadeLoop": "primary secondary outer inner",
    "Scenario": "setpoint disturbance disturbance_time t_end points t",
    "simc_cascade": "primary secondary tau_c_inner tau_c_outer inner outer Ms_inner Ms_outer",
    "synthesis_cascade": ("primary secondary Ms_inner Ms_outer inner outer N_inner N_outer lambda_inner lambda_outer"),
    "direct_synthesis": "process lambda_ kind N",
    "sweep": "plant model tau_c t omega",
    "simulate": "loop scenario",
    "performance": "loop",
    "stability": "loop",
    "margins": "loop",
    "frequency_response": "loop omega",
    "parse_plant": "text",
    "Trend": "t y u r t_u",
    "identify": "trend structure",
    "identify_all": "trend",
    "relay_test": "plant amplitude hysteresis bias",
    "setpoint_overshoot": "Kc0 setpoint peak peak_time lowest F",
    "retune_oscillation": "controller period theta",
    "robust_tau_c": "identified Ms probability",
}
FIELDS = {
    "Reduction": "model steps alternatives",
    "Stability": "verdict unstable_poles",
    "Margins": (
        "GM GM_lower PM_deg delay_margin Ms Mt omega_180 omega_c omega_Ms omega_Mt stable omega_bS omega_bT max_KS"
    ),
    "FrequencyResponse": "omega L S T KS GS",
    "TimeResponse": "t r d y u",
    "Performance": "setpoint disturbance",
    "StepMetrics": (
        "IAE ISE ITAE TV overshoot peak peak_time rise_time settling_time "
        "IE ITSE settling_1 settling_5 first_arrival decay_ratio period largest_u"
    ),
    "Identified": (
        "model plant parameters standard_errors intervals covariance bias drift residuals fit verdicts structure"
    ),
    "Relay": "t y u Ku Pu Ku_exact Pu_exact model",
    "CascadeDesign": "loop inner outer lambda_inner lambda_outer tau_c_inner tau_c_outer notes",
}
PRIMARY, SECONDARY = Plant(1, 1, (20,)), Plant(2, 0.2, (3,))


@pytest.mark.parametrize("name", PARAMETERS)
def test_parameters_come_in_this_order(name):
    given = list(inspect.signature(getattr(simc_core, name)).parameters)
    expected = PARAMETERS[name].split()
    assert given[: len(expected)] == expected


@pytest.mark.parametrize("name", FIELDS)
def test_results_hold_these_fields(name):
    kind = getattr(simc_core, name)
    present = {field.name for field in dataclasses.fields(kind)} | set(dir(kind))
    assert present >= set(FIELDS[name].split())


@pytest.mark.parametrize(
    "name", ["InvalidParameter", "ParseError", "NotReducible", "FormError", "NotStable", "NotIdentifiable"]
)
def test_errors_are_value_errors(name):
    assert issubclass(getattr(simc_core, name), simc_core.SimcError)
    assert issubclass(simc_core.SimcError, ValueError)


def test_sweep_takes_its_arguments_in_order():
    model = FirstOrderDelay(1, 1, 10)
    found = sweep(model.plant, model, [1.0, 2.0], np.array([0.0, 3.0, 50.0]), [0.1, 1.0, 10.0])
    assert found.y_setpoint.shape == found.u_disturbance.shape == (2, 3)
    assert found.L.shape == (2, 3)
    assert found.Ms.shape == (2,)


def test_instants_come_back_as_given():
    t = [0.0, 0.5, 7.0]
    response = simulate(Loop(FirstOrderDelay(1, 1, 10).plant, simc(FirstOrderDelay(1, 1, 10))), Scenario(t=t))
    assert response.t.tolist() == t
    assert response.y.shape == (3,)


@pytest.mark.parametrize("design", [simc_cascade, lambda *blocks: synthesis_cascade(*blocks, 1.6, 1.6)])
def test_a_cascade_has_both_loops_and_both_disturbances(design):
    loop = design(PRIMARY, SECONDARY).loop
    assert isinstance(loop, CascadeLoop)
    assert stability(loop).verdict == stability(loop).inner.verdict == "stable"
    assert margins(loop.outer_loop).stable
    assert margins(loop.inner_loop).stable
    response = simulate(loop, Scenario(disturbance2=1.0, disturbance2_time=5.0))
    assert response.y2.shape == response.d2.shape == response.t.shape
    found = performance(loop)
    assert found.disturbance2.IAE > 0
    assert found.disturbance.IAE > 0


def test_no_metrics_of_an_unstable_loop():
    loop = Loop(FirstOrderDelay(1, 1, 10).plant, simc(FirstOrderDelay(1, 1, 10)))
    fast = Loop(loop.plant, dataclasses.replace(loop.controller, Kc=100.0))
    assert np.isnan(margins(fast).Ms)
    assert not margins(fast).stable
    with pytest.raises(NotStable):
        performance(fast)


def test_direct_synthesis_needs_a_process_and_lambda_only():
    assert hasattr(direct_synthesis(SECONDARY, 0.5), "response")


def test_all_that_is_public_is_in_all():
    """Else a type checker refuses to import it: a package with py.typed exports what it says, nothing by the way."""
    public = {name for name, value in vars(simc_core).items() if name[0] != "_" and not inspect.ismodule(value)}
    assert set(simc_core.__all__) == public


OF_ANY_LOOP = (stability, margins, crossings, performance, simulate, lambda loop: frequency_response(loop, [1.0]))


@pytest.mark.parametrize("function", OF_ANY_LOOP)
@pytest.mark.parametrize("given", [Plant(1, 1, (8,)), SeriesPid(4, 8), None, "loop"])
def test_what_is_no_loop_is_refused_in_words(function, given):
    with pytest.raises(TypeError, match="loop must be a Loop, CascadeLoop or NestedLoops, found") as refused:
        function(given)
    assert isinstance(refused.value, SimcError)


def test_crossings_of_one_nested_loop_and_of_a_cascade_are_those_of_the_loops_they_stand_for():
    inner, outer, Gb, Ga = SeriesPid(1.5, 2.0), SeriesPid(0.5, 6.0), Plant(1, 0.5, (2,)), Plant(2, 1, (6,))
    single = crossings(Loop(Ga, outer))
    alone = crossings(NestedLoops((Ga,), (outer,)))
    assert alone.gain_omega == pytest.approx(single.gain_omega)
    assert alone.phase_omega == pytest.approx(single.phase_omega)
    found = crossings(CascadeLoop(Ga, Gb, outer, inner))
    s = 1j * found.gain_omega  # L of the outer loop written out
    Lb = Gb.response(s) * inner.response(s)
    assert abs(outer.response(s) * Ga.response(s) * Lb / (1 + Lb)) == pytest.approx(1.0)
    assert found.gain_omega.size > 0
