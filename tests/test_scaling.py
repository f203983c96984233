"""Nothing depends on units: every result scales with the time unit and with the gain of the plant.

A plant in another time unit has times T times as long; one with another gain needs a controller with the inverse gain.
y, Ms and all that has no unit stay as they are.
"""

import dataclasses
import math
from fractions import Fraction
from functools import cache

import numpy as np
import pytest

from simc_core import (
    Actuation,
    CascadeLoop,
    IController,
    IdealPid,
    Loop,
    ParallelPid,
    Plant,
    Scenario,
    SeriesPid,
    dominant_poles,
    frequency_response,
    half_rule,
    margins,
    performance,
    simc,
    simc_cascade,
    simulate,
    stability,
    sweep,
    synthesis_cascade,
)
from simc_core.controllers.tracking import tracking_time
from simc_core.simulation.nested_windup import PROTECTIONS, limited
from simc_core.studies.advice import advice
from simc_core.studies.plant_family import robustness
from simc_core.studies.tuned import tuned
from simc_core.studies.with_actuator import as_built

UNITS = [(Fraction(60), 1.0), (Fraction(1, 60), 1.0), (Fraction(1), -3.0), (Fraction(60), -3.0)]  # of time, of the gain

PLANTS = {
    "lags": Plant(2.0, 1.0, (8.0, 1.5)),
    "inverse response": Plant(1.0, 0.5, (6.0, 2.0), (-0.7,)),
    "oscillating": Plant(1.0, 0.6, (), (), 0, ((2.0, 0.3),)),
    "integrating": Plant(0.3, 1.0, (0.4,), (), 1),
    "double integrating": Plant(0.05, 0.5, (), (), 2),
    "unstable": Plant(-2.0, 0.4, (-5.0, 0.3)),
    "pure delay": Plant(1.5, 2.0),
}
STABLE = {  # loops that come to rest without offset
    ("lags", "PI"): SeriesPid(1.2, 7.0),
    ("lags", "PID"): SeriesPid(1.8, 8.0, 1.4, 0.1, b=0.6),
    ("lags", "I"): IController(0.04),
    ("inverse response", "PI"): SeriesPid(1.0, 6.0, b=0.5),
    ("oscillating", "PID"): IdealPid(0.5, 1.2, 3.0, 0.2),
    ("integrating", "PI"): SeriesPid(1.2, 9.0),
    ("integrating", "PID"): ParallelPid(1.5, 0.15, 0.6, 0.05),
    ("double integrating", "PID"): SeriesPid(0.8, 9.0, 8.0, 0.4),
    ("unstable", "PI"): SeriesPid(2.5, 6.0),
    ("unstable", "PID"): SeriesPid(2.5, 6.0, 0.3, 0.03),
    ("pure delay", "I"): IController(0.15),
    ("pure delay", "PI"): SeriesPid(0.2, 0.8),
}
OTHERS = {  # with an offset, or not stable
    ("lags", "P"): SeriesPid(2.0, math.inf),
    ("lags", "PD"): SeriesPid(2.0, math.inf, 1.0, 0.1),
    ("integrating", "P"): SeriesPid(1.5, math.inf),
    ("integrating", "I"): IController(0.1),
    ("double integrating", "PD"): SeriesPid(0.8, math.inf, 8.0, 0.4),
    ("double integrating", "I"): IController(0.01),
    ("unstable", "P"): SeriesPid(2.5, math.inf),
    ("unstable", "PD"): IdealPid(2.5, math.inf, 0.3, 0.03),
    ("pure delay", "P"): SeriesPid(0.3, math.inf),
    ("lags", "too fast"): SeriesPid(30.0, 2.0),
}


def loops(cases) -> list:
    return [
        pytest.param(Loop(PLANTS[plant], controller), id=f"{plant}, {kind}")
        for (plant, kind), controller in cases.items()
    ]


any_loop = pytest.mark.parametrize("loop", loops(STABLE | OTHERS))
stable_loop = pytest.mark.parametrize("loop", loops(STABLE))
any_units = pytest.mark.parametrize(("T", "gain"), UNITS)


def same(value, expected, rel=1e-9):
    return value == pytest.approx(expected, rel=rel, abs=1e-12, nan_ok=True)


def in_units(loop: Loop, T: Fraction, gain: float) -> Loop:
    return Loop(loop.plant.rescaled(T, gain), loop.controller.rescaled(T, 1 / gain))


@any_loop
@any_units
def test_the_loop_itself(loop, T, gain):
    other, omega = in_units(loop, T, gain), np.geomspace(0.01, 10, 7)
    assert same(other.plant.response(1j * omega / float(T)), gain * loop.plant.response(1j * omega))
    assert same(other.controller.response(1j * omega / float(T)), loop.controller.response(1j * omega) / gain)
    found, before = frequency_response(other, omega / float(T)), frequency_response(loop, omega)
    for name, factor in (("L", 1), ("S", 1), ("T", 1), ("KS", 1 / gain), ("GS", gain)):
        assert same(getattr(found, name), factor * getattr(before, name))


@any_loop
@any_units
def test_verdict_margins_and_poles(loop, T, gain):
    other, T_ = in_units(loop, T, gain), float(T)
    assert stability(other) == stability(loop) or same(stability(other).neutral, stability(loop).neutral)
    assert stability(other).verdict == stability(loop).verdict
    found, before = margins(other), margins(loop)
    for each in dataclasses.fields(before):
        factor = T_ if each.name == "delay_margin" else 1 / T_ if each.name.startswith("omega") else 1.0
        rel = 1e-6 if each.name in ("omega_Ms", "omega_Mt") else 1e-9  # flat about a peak
        assert same(getattr(found, each.name), factor * getattr(before, each.name), rel), each.name
    poles, poles_before = dominant_poles(other, 4), dominant_poles(loop, 4)
    assert same([pole.s * T_ for pole in poles], [pole.s for pole in poles_before], 1e-6)


@stable_loop
@any_units
def test_step_metrics(loop, T, gain):
    found, before, T_ = performance(in_units(loop, T, gain)), performance(loop), float(T)
    of_y = {"IAE": T_, "ISE": T_, "ITAE": T_**2, "overshoot": 1, "peak": 1, "rise_time": T_, "settling_time": T_}
    for name, factor in of_y.items():
        assert same(getattr(found.setpoint, name), factor * getattr(before.setpoint, name), 1e-7), name
        power = {"IAE": 1, "ISE": 2, "ITAE": 1, "peak": 1}.get(name, 0)
        size = gain if name == "peak" else abs(gain)
        expected = factor * size**power * getattr(before.disturbance, name)
        assert same(getattr(found.disturbance, name), expected, 1e-7), name
    for step, size in (("setpoint", abs(gain)), ("disturbance", 1)):
        now, then = getattr(found, step), getattr(before, step)
        assert same(now.TV * size, then.TV, 1e-7)
        assert same(now.peak_time, T_ * then.peak_time, 1e-5)


INSTANTS = np.linspace(0.0, 40.0, 81)


@cache  # one loop is compared with all units
def responses(loop: Loop, actuation: Actuation):
    return simulate(loop, Scenario(1.0, -0.2, 20.1, t=INSTANTS, actuation=actuation))


@any_loop
@any_units
@pytest.mark.parametrize(
    "actuation", [Actuation(), Actuation(-0.3, 0.5), Actuation(-2.0, 0.5, h=0.4), Actuation(noise=0.01, seed=3)]
)
def test_responses(loop, T, gain, actuation):
    before, T_ = responses(loop, actuation), float(T)
    low, high = sorted((actuation.u_min / gain, actuation.u_max / gain))
    other = dataclasses.replace(actuation, u_min=low, u_max=high, h=actuation.h * T_)
    scenario = Scenario(1.0, -0.2 / gain, 20.1 * T_, t=INSTANTS * T_, actuation=other)
    found = simulate(in_units(loop, T, gain), scenario)
    assert np.max(np.abs(found.y - before.y)) <= 1e-8 * np.max(np.abs(before.y))
    assert np.max(np.abs(found.u * gain - before.u)) <= 1e-8 * np.max(np.abs(before.u))


@any_loop
@any_units
def test_tracking_time(loop, T, gain):
    before = tracking_time(loop.controller, loop.plant.k, loop.plant.integrators)
    other = in_units(loop, T, gain)
    assert same(tracking_time(other.controller, other.plant.k, other.plant.integrators), float(T) * before)


@cache
def built(loop: Loop):
    return as_built(loop, Scenario(1.0, -0.2, 20.0, 40.0, actuation=Actuation(-0.5, 0.7))).numbers


@stable_loop
@any_units
def test_the_loop_as_built(loop, T, gain):
    T_, before = float(T), built(loop)
    low, high = sorted((-0.5 / gain, 0.7 / gain))
    other = Scenario(1.0, -0.2 / gain, 20 * T_, 40 * T_, actuation=Actuation(low, high))
    found = as_built(in_units(loop, T, gain), other).numbers
    assert same((found.IAE, found.IAE_linear), (T_ * before.IAE, T_ * before.IAE_linear), 1e-8)
    assert same(found.limited, T_ * before.limited)
    assert same(sorted(u * gain for u in found.u_asked), list(before.u_asked), 1e-8)
    assert same(sorted(u * gain for u in found.u_given), list(before.u_given), 1e-8)


REDUCED = {
    "order 1": Plant(1.0, 0.0, (10.0, 6.0, 1.0), (-2.0,)),
    "with a lead": Plant(2.0, 0.3, (8.0, 3.0, 1.0), (2.0,)),
    "integrating": Plant(0.4, 1.0, (3.0, 0.5), (), 1),
    "double integrating": Plant(0.4, 1.0, (0.5,), (), 2),
    "unstable": Plant(-2.0, 0.4, (-5.0, 0.3)),
    "oscillating": Plant(1.0, 0.2, (0.3,), (), 0, ((2.0, 0.3),)),
    "pure delay": Plant(1.5, 2.0),
}


def power_of_time(name: str, plant: Plant) -> int:
    """Of a field of a model."""
    return {"k": 0, "k_prime": -1, "k_double_prime": -2, "a": -1, "zeta": 0}.get(name, 1)


@pytest.mark.parametrize("plant", REDUCED.values(), ids=REDUCED)
@pytest.mark.parametrize("order", [1, 2])
@any_units
def test_half_rule_and_settings(plant, order, T, gain):
    before, found = half_rule(plant, order), half_rule(plant.rescaled(T, gain), order)
    assert type(found.model) is type(before.model)
    for each in dataclasses.fields(before.model):
        factor = float(T) ** power_of_time(each.name, plant) * (gain if each.name.startswith("k") else 1)
        assert same(getattr(found.model, each.name), factor * getattr(before.model, each.name)), each.name
    assert [step.rule for step in found.steps] == [step.rule for step in before.steps]
    wanted = simc(before.model).rescaled(T, 1 / gain)
    assert type(simc(found.model)) is type(wanted)
    assert same(list(simc(found.model).settings.values()), list(wanted.settings.values()))


@pytest.mark.parametrize("plant", REDUCED.values(), ids=REDUCED)
@pytest.mark.parametrize(("order", "speed"), [(1, ""), (2, ""), (1, "3theta"), (2, "moderate"), (1, "0.5theta")])
@any_units
def test_advice(plant, order, speed, T, gain):
    before = advice(tuned(plant, order, speed=speed, filter=0.05))
    found = advice(tuned(plant.rescaled(T, gain), order, speed=speed, filter=0.05))
    assert [(item.level, item.quantity) for item in found] == [(item.level, item.quantity) for item in before]
    for now, then in zip(found, before, strict=True):
        factor = {"tau_c": float(T), "High-frequency gain Kd/tau_F": 1 / abs(gain)}.get(then.quantity, 1.0)
        assert same((now.value, now.limit), (factor * then.value, factor * then.limit), 1e-6), then.quantity
        assert now.change.keys() == then.change.keys()


@pytest.mark.parametrize("plant", [PLANTS["lags"], PLANTS["integrating"], PLANTS["pure delay"]])
@any_units
def test_sweep(plant, T, gain):
    tau_c, t, omega, T_ = np.array([0.7, 1.5, 4.0]), np.linspace(0, 30, 31), np.geomspace(0.01, 3, 9), float(T)
    other, model = plant.rescaled(T, gain), half_rule(plant).model
    before = sweep(plant, model, tau_c, t, omega, b=0.8, disturbance_time=14.9)
    found = sweep(other, half_rule(other).model, tau_c * T_, t * T_, omega / T_, b=0.8, disturbance_time=14.9 * T_)
    factors = {
        **dict.fromkeys(("L", "stable", "GM", "GM_lower", "PM_deg", "Ms", "Mt", "y_setpoint", "overshoot"), 1.0),
        **dict.fromkeys(("tau_c", "delay_margin", "IAE_setpoint"), T_),
        **{"IAE_disturbance": T_ * abs(gain), "TV_setpoint": 1 / abs(gain), "TV_disturbance": 1.0},
        **{"u_setpoint": 1 / gain, "y_disturbance": gain, "u_disturbance": 1.0},
    }
    for name, factor in factors.items():
        then = factor * getattr(before, name)
        assert np.allclose(getattr(found, name), then, rtol=1e-8, atol=1e-10 * np.max(np.abs(then)), equal_nan=True), (
            name
        )


@any_units
def test_a_family_of_plants(T, gain):
    loop = Loop(PLANTS["lags"], STABLE["lags", "PI"])
    found, before = robustness(in_units(loop, T, gain)), robustness(loop)
    assert same([case.Ms for case in found.corners], [case.Ms for case in before.corners], 1e-8)
    assert same([case.Ms for case in found.samples], [case.Ms for case in before.samples], 1e-8)
    limits = (before.k_low, before.k_high, float(T) * before.theta_more)
    assert same((found.k_low, found.k_high, found.theta_more), limits)


BLOCKS = {
    "lags": (Plant(2.0, 2.0, (5.0,)), Plant(1.5, 0.5, (2.0, 0.3))),
    "integrating": (Plant(0.2, 1.0, (0.5,), (), 1), Plant(1.0, 0.2, (1.0,))),
}


def cascade_in_units(loop: CascadeLoop, T: Fraction, ga: float, gb: float) -> CascadeLoop:
    """gb multiplies the gain of the secondary block, ga that of the primary one."""
    return CascadeLoop(
        loop.primary.rescaled(T, ga),
        loop.secondary.rescaled(T, gb),
        loop.outer.rescaled(T, 1 / ga),
        loop.inner.rescaled(T, 1 / gb),
    )


@pytest.mark.parametrize("blocks", BLOCKS.values(), ids=BLOCKS)
@pytest.mark.parametrize("kind", ["PI", "PID"])
@any_units
def test_designs_of_cascades(blocks, kind, T, gain):
    primary, secondary = blocks
    for design, peaks in ((simc_cascade, {}), (synthesis_cascade, {"Ms_inner": 2.0, "Ms_outer": 2.5})):
        before = design(primary, secondary, inner=kind, outer=kind, **peaks)
        found = design(primary.rescaled(T, gain), secondary.rescaled(T, gain), inner=kind, outer=kind, **peaks)
        wanted = cascade_in_units(before.loop, T, gain, gain)
        # a speed found for a given peak is solved for to 1e-6 or so
        rel = 1e-9 if design is simc_cascade else 1e-5
        assert same(list(found.outer.settings.values()), list(wanted.outer.settings.values()), rel)
        assert same(list(found.inner.settings.values()), list(wanted.inner.settings.values()), rel)
        assert len(found.notes) == len(before.notes)


CASCADES = {
    "PI in PI": CascadeLoop(*BLOCKS["lags"], SeriesPid(0.7, 5.0), SeriesPid(1.2, 2.0)),
    "I inside": CascadeLoop(*BLOCKS["lags"], SeriesPid(0.4, 6.0), IController(0.3)),
    "I outside": CascadeLoop(*BLOCKS["lags"], IController(0.05), SeriesPid(1.2, 2.0)),
    "P inside": CascadeLoop(*BLOCKS["integrating"], SeriesPid(1.0, 12.0), SeriesPid(2.0, math.inf)),
}


@pytest.mark.parametrize("loop", CASCADES.values(), ids=CASCADES)
@any_units
def test_cascades(loop, T, gain):
    T_, other = float(T), cascade_in_units(loop, T, gain, 2 * gain)
    assert stability(other).verdict == stability(loop).verdict == "stable"
    for which in ("outer_loop", "inner_loop"):
        found, before = margins(getattr(other, which)), margins(getattr(loop, which))
        assert same(
            (found.GM, found.PM_deg, found.Ms, found.Mt), (before.GM, before.PM_deg, before.Ms, before.Mt), 1e-8
        )
        assert same(found.delay_margin, T_ * before.delay_margin, 1e-8)
    found, before = performance(other), performance(loop)
    assert same(found.setpoint.IAE, T_ * before.setpoint.IAE, 1e-6)
    assert same(found.disturbance.IAE, T_ * abs(gain) * before.disturbance.IAE, 1e-6)
    assert same(found.disturbance2.IAE, T_ * 2 * gain**2 * before.disturbance2.IAE, 1e-6)
    t = np.linspace(0.0, 60.0, 61)
    now = simulate(other, Scenario(1.0, 0.5 / gain, 20 * T_, t=t * T_, disturbance2=0.0))
    then = simulate(loop, Scenario(1.0, 0.5, 20.0, t=t, disturbance2=0.0))
    assert np.max(np.abs(now.y - then.y)) <= 1e-8
    assert np.max(np.abs(now.u * 2 * gain**2 - then.u)) <= 1e-8 * np.max(np.abs(then.u))


@cache
def with_limits(loop: CascadeLoop, protection: str):
    return limited(loop, -0.2, 0.35, protection, t_end=60.0)


@pytest.mark.parametrize("loop", CASCADES.values(), ids=CASCADES)
@pytest.mark.parametrize("protection", PROTECTIONS)
@any_units
def test_cascades_with_a_limited_actuator(loop, protection, T, gain):
    """Where there are integrators the limits matter most, so the step is large."""
    T_, g = float(T), 2 * gain**2
    then = with_limits(loop, protection)
    now = limited(cascade_in_units(loop, T, gain, 2 * gain), -0.2 / g, 0.35 / g, protection, t_end=60.0 * T_)
    assert now.t == pytest.approx(T_ * then.t)
    assert np.max(np.abs(now.y - then.y)) <= 1e-7
    assert np.max(np.abs(now.u * g - then.u)) <= 1e-7
