"""Measures that wait until they are asked for: the same numbers, and a record that is no other for them."""

import copy
import math
import pickle
from dataclasses import fields, replace

import numpy as np
import pytest

from simc_core import CascadeLoop, Loop, Plant, Scenario, SeriesPid, margins, performance, sampled_margins, simulate
from simc_core.loops.on_demand import Later
from simc_core.metrics.performance import performance_many

TIGHT = Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))
CASCADE = CascadeLoop(Plant(1, 1, (8,)), Plant(1, 0.1, (1,)), outer=SeriesPid(2, 8), inner=SeriesPid(5, 1))


def test_simc_on_a_lag_has_the_bandwidths_and_the_integral_error_that_are_known():
    """omega_b of L = e^{-s}/(2 s), and IE = tau_I/Kc."""
    found, steps = margins(TIGHT), performance(TIGHT)
    for omega, size in ((found.omega_bS, lambda L: abs(1 / (1 + L))), (found.omega_bT, lambda L: abs(L / (1 + L)))):
        L = np.exp(-1j * omega) / (2j * omega)
        assert size(L) == pytest.approx(math.sqrt(0.5), rel=1e-9)
    assert steps.disturbance.IE == 2.0
    assert pytest.approx(2.0) == steps.setpoint.IE  # tau_c + theta
    assert steps.setpoint.largest_u == pytest.approx(4.5)  # Kc (1 + theta/tau_I), when y begins to move


def test_an_integral_controller_is_as_loud_as_its_closed_loop():
    """Without dead time K S = Kc (8 s + 1)/(8 s) 4 s/(4 s + 1) for G = 2/(8 s + 1), Kc = 1: from 1/2 to 1."""
    assert margins(Loop(Plant(2, 0, (8,)), SeriesPid(1, 8))).max_KS == pytest.approx(1.0)


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda record: pickle.loads(pickle.dumps(record))])
def test_copies_and_pickles_keep_them(again):
    for record, name in ((margins(TIGHT), "omega_bS"), (performance(TIGHT).setpoint, "settling_5")):
        other = again(record)
        assert other == record
        assert hash(other) == hash(record)
        assert getattr(other, name) == getattr(record, name)


def test_they_are_no_part_of_the_record():
    found, steps = margins(TIGHT), performance(TIGHT).setpoint
    assert "_later" not in {each.name for each in (*fields(found), *fields(steps))}
    assert repr(found).count("=") == len(fields(found))
    assert margins(Loop(Plant(2, 1, (8,)), SeriesPid(2, 8))) == found  # L is the same, K S is not
    with pytest.raises((AttributeError, TypeError)):
        found.omega_bS = 1.0


def test_nothing_is_computed_before_it_is_asked_for():
    asked = []
    record = replace(margins(TIGHT))
    Later(lambda: asked.append(1) or [margins(TIGHT).bandwidth]).attach([record])
    assert not asked
    assert record.omega_bS == record.omega_bS
    assert len(asked) == 1


def test_a_record_that_nobody_measured_has_none():
    assert math.isnan(replace(margins(TIGHT), GM=2.0).omega_bT)
    assert math.isnan(margins(Loop(Plant(1, 1, (8,)), SeriesPid(40, 8))).max_KS)
    assert math.isnan(sampled_margins(TIGHT, 0.1).omega_bS)


def test_many_loops_together_have_what_each_has_alone():
    loops = [TIGHT, Loop(Plant(1, 1, integrators=1), SeriesPid(0.5, 8))]
    for loop, together in zip(loops, performance_many(loops), strict=True):
        alone = performance(loop)
        for one, other in ((alone.setpoint, together.setpoint), (alone.disturbance, together.disturbance)):
            for name in ("IE", "ITSE", "settling_1", "settling_5", "first_arrival", "decay_ratio", "largest_u"):
                assert getattr(other, name) == pytest.approx(getattr(one, name), rel=1e-7, nan_ok=True), name


def test_a_cascade_has_them_for_every_disturbance():
    """IE of d1 is 1/K_i of the outer controller, of d2 0: the inner loop integrates too."""
    steps = performance(CASCADE)
    assert pytest.approx(8 / 2, rel=1e-6) == steps.disturbance.IE
    assert pytest.approx(0.0, abs=1e-6) == steps.disturbance2.IE
    t = np.linspace(0, 200, 40_001)
    y = simulate(CASCADE, Scenario(disturbance=0.0, disturbance2=0.0, t=t)).y
    assert pytest.approx(np.trapezoid(t * (1 - y) ** 2, t), rel=1e-4) == steps.setpoint.ITSE
    late = t[np.flatnonzero(np.abs(y - 1) > 0.05)[-1]]
    assert steps.setpoint.settling_5 == pytest.approx(late, abs=0.01)


def test_a_cascade_has_the_bandwidths_of_its_outer_loop():
    """By |T| and |S| of the frequency response, crossing 1/sqrt 2."""
    found = margins(CASCADE.outer_loop)

    def L(omega):
        s = 1j * omega
        inner = SeriesPid(5, 1).response(s) * CASCADE.secondary.response(s)
        return SeriesPid(2, 8).response(s) * CASCADE.primary.response(s) * inner / (1 + inner)

    assert abs(1 / (1 + L(found.omega_bS))) == pytest.approx(math.sqrt(0.5), rel=1e-8)
    assert abs(L(found.omega_bT) / (1 + L(found.omega_bT))) == pytest.approx(math.sqrt(0.5), rel=1e-8)
    omega = np.geomspace(1e-3, 1e3, 200_001)
    assert found.max_KS == pytest.approx(
        np.max(np.abs(SeriesPid(2, 8).response(1j * omega) / (1 + L(omega)))), rel=1e-6
    )
