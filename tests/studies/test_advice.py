"""Each guard speaks where it should and is silent where it should be; what it says is so, what it proposes helps."""

import math
from dataclasses import replace

import numpy as np
import pytest

from simc_core import (
    Plant,
    RuleEnds,
    Scenario,
    SimcError,
    performance,
    simc,
    simulate,
)
from simc_core.plants.step_response import plant_step
from simc_core.reduction.equal_peak import EQUAL_MS, at_equal_peak
from simc_core.studies import advice as guards
from simc_core.studies.advice import advice
from simc_core.studies.tuned import tuned
from tests.oracles.random_plants import random_plants

FOPDT = Plant(1, 1, (8,))
THREE_LAGS = Plant(1, 3, (6, 4, 2))
SITE = Plant(2.2, 20, (180,))
RINGING = Plant(1.5, 2, lag_pairs=((5, 0.2),))
UNSTABLE = Plant(-3, 2, (-10, 2))  # 3 e^{-2s}/((10s - 1)(2s + 1))
CLOSE_POLE = Plant(-4, 1, (-4,))  # e^{-s}/(s - 0.25)

PROVOKED = [
    (guards.not_stable, Plant(1, 1, (8, 1)), {"order": 2, "tau_c": 0.01, "filter": 3}),
    (guards.large_Ms, FOPDT, {"tau_c": 0.3}),
    (guards.large_Ms, Plant(1, 1, integrators=1), {"tau_c": 0.4}),
    (guards.large_Ms, UNSTABLE, {}),
    (guards.large_Ms, THREE_LAGS, {"order": 2, "tau_c": 2}),
    (guards.faster_than_dead_time, FOPDT, {"tau_c": 0.5}),
    (guards.slower_than_plant, SITE, {"tau_c": 1800}),
    (guards.slower_than_plant, Plant(1, 1), {"tau_c": 3}),
    (guards.slower_than_plant, RINGING, {"tau_c": 30}),
    (guards.slower_than_plant, Plant(1, 1, integrators=1), {"tau_c": 720}),
    (guards.derivative_noise, THREE_LAGS, {"order": 2}),
    (guards.derivative_noise, Plant(1, 1, integrators=2), {}),
    (guards.order_two, THREE_LAGS, {}),
    (guards.order_two, Plant(1, 1, (5, 0.5)), {"order": 2}),
    (guards.other_than_chosen, RINGING, {}),
    (guards.other_than_chosen, Plant(1, 1, integrators=2), {}),
    (guards.other_than_chosen, FOPDT, {"order": 2}),
    (guards.set_point_overshoot, Plant(0.05, 2, integrators=1), {}),
    (guards.set_point_overshoot, Plant(1, 1, (3,), integrators=1), {"order": 2}),
]


@pytest.mark.parametrize(("guard", "plant", "choices"), PROVOKED)
def test_what_a_guard_proposes_ends_it(guard, plant, choices):
    design = tuned(plant, **choices)
    found = guard(design)
    assert found in advice(design)
    assert found.change
    after = guard(design.changed(**found.change))
    assert after is None or (guard is guards.derivative_noise and after.level == "note")


def test_a_good_loop_is_left_in_peace():
    assert advice(tuned(FOPDT)) == ()
    assert advice(tuned(SITE)) == ()  # Ms 1.601, what the rule itself recommends
    assert not [item for item in advice(tuned(Plant(1, 1, integrators=1))) if item.level != "note"]  # Ms 1.70


def test_the_gravest_comes_first():
    levels = [item.level for item in advice(tuned(THREE_LAGS, order=2, tau_c=1))]
    assert levels == sorted(levels, key=guards.LEVELS.index)
    assert set(levels) == {"warning", "note"}


def test_a_fixed_tau_c_is_never_to_be_increased():
    """The rule for an unstable pole knows tau_c = theta alone."""
    (found,) = (item for item in advice(tuned(CLOSE_POLE)) if item.quantity == "Ms")
    assert found.value == pytest.approx(2.06, abs=0.005)  # [SK98] at a theta = 0.25
    assert not found.change
    assert "tau_c" not in found.remedy
    assert "inner loop" in found.remedy
    (found,) = (item for item in advice(tuned(UNSTABLE)) if item.quantity == "Ms")
    assert found.value == pytest.approx(4.66, abs=0.005)
    assert found.change == {"order": 2}


def test_the_filter_is_a_part_of_the_tau_D_that_is_shown():
    """[V06] example 1: tau_D = 5 in series form, so a tenth is 0.5."""
    found = guards.derivative_noise(tuned(THREE_LAGS, order=2))
    assert found.change == {"filter": 0.1}
    assert "tau_F = 0.5:" in found.remedy
    assert tuned(THREE_LAGS, order=2, filter=0.1).controller.tau_F == pytest.approx(0.5)


@pytest.mark.parametrize(("plant", "overshoot"), [(RINGING, 0.5718), (Plant(1, 1, lag_pairs=((4, 0.3),)), 0.452)])
def test_an_oscillating_plant_rings_after_a_set_point_step_as_well(plant, overshoot):
    """D on the measurement: r to y keeps the poles of the plant."""
    design = tuned(plant)
    assert performance(design.loop).setpoint.overshoot == pytest.approx(overshoot, abs=6e-4)
    (found,) = (item for item in advice(design) if item.quantity == "zeta")
    assert "both set-point steps and disturbances at the plant input ring" in found.text
    (tau, zeta), *_ = plant.lag_pairs
    pole = complex(-zeta, math.sqrt(1 - zeta**2)) / tau
    feedback, setpoint = (abs(path(pole)) for path in (design.controller.response, design.controller.setpoint_response))
    assert feedback < 1e-12 * setpoint  # cancelled in the loop, not from r


def test_a_filter_that_would_ruin_the_loop_is_not_proposed():
    """e^{-s}/(1e4 s^2 + 1e-4 s + 1): tau_D = tau0/(2 zeta) = 1e8; with tau_F = 2e5 there is hardly a margin left."""
    found = guards.derivative_noise(tuned(Plant(1, 1, lag_pairs=((100, 5e-7),))))
    assert not found.change
    assert "fragile" in found.remedy
    assert _peak(tuned(Plant(1, 1, lag_pairs=((100, 5e-7),)), filter=0.002).loop) > 2


def test_the_phase_margin_that_hides_a_large_peak():
    design = tuned(Plant(1, 1, (8, 1)), order=2, tau_c=0.45)
    assert design.margins.PM_deg > 45
    assert "phase margin" in guards.large_Ms(design).text


DESIGNS = [(i, plant) for i, (_, plant) in enumerate(random_plants(240))]


def _designed(i, plant):
    """Both orders, several speeds, with and without a filter, in turn; None where the rule ends."""
    try:
        tight = tuned(plant, order=1 + i // 10 % 2, filter=(0.0, 0.1)[i // 40 % 2])
    except RuleEnds:
        return None
    factor = (0.2, 1, 1.5, 12)[i // 20 % 4]
    return tight if factor == 1 else tight.changed(tau_c=factor * tight.tau_c)


@pytest.mark.parametrize("part", range(8))
def test_every_sentence_on_plants_of_all_kinds(part):
    """On 240 plants: every change proposed is made and ends its guard, every number in the words is computed apart."""
    said = 0
    for design in filter(None, (_designed(i, plant) for i, plant in DESIGNS[part::8])):
        for guard in guards.GUARDS:
            item = guard(design)
            if item is None:
                continue
            said += 1
            CLAIMS[guard](design, item)
            if item.change:
                changed = design.changed(**item.change)
                after = guard(changed)
                assert after is None or (guard is guards.derivative_noise and after.level == "note")
                assert changed.margins.stable or not design.margins.stable
    assert said > 20


def _peak(loop):
    """Ms on a fine grid, from below."""
    plant, controller = loop.plant, loop.controller
    scale = plant.theta + sum(map(abs, plant.lags)) + sum(tau for tau, _ in plant.lag_pairs)
    shortest = min([scale, *([plant.theta] if plant.theta else []), *map(abs, plant.lags)])
    s = 1j * np.geomspace(1e-4 / scale, 1e3 / shortest, 20_000)
    return float(np.max(1 / np.abs(1 + plant.response(s) * controller.response(s))))


def _Ms_as_told(design, item):
    if item.change:
        told = float(item.remedy.rstrip(".").rsplit(" ", 1)[1])
        assert _peak(design.changed(**item.change).loop) == pytest.approx(told, rel=6e-3)


def _large(design, item):
    assert _peak(design.loop) > 2
    _Ms_as_told(design, item)
    if item.change:
        assert design.changed(**item.change).margins.Ms <= 2


def _not_stable(design, item):
    response = simulate(design.loop, Scenario(t_end=200 * design.tau_c))
    late = np.abs(response.y[response.t > 0.8 * response.t[-1]])
    assert late.max() > 3
    assert not item.change or _peak(design.changed(**item.change).loop) <= 2


def _derivative(design, item):
    form = design.controller.to_parallel()
    if item.level == "warning":
        assert form.tau_F == 0
        if "Ms becomes" in item.remedy:
            _Ms_as_told(design, item)
        if item.change and design.margins.stable:
            assert _peak(design.changed(**item.change).loop) <= 1.11 * max(_peak(design.loop), 2)
        if not item.change:
            assert not _peak(replace(design.loop, controller=design.controller.with_filter(0.002))) <= 2
    else:
        gain = abs(design.controller.response(1j * 1e9 / form.tau_F))
        assert item.value == pytest.approx(gain, rel=1e-6)


def _faster(design, item):
    words = item.text.rstrip(".").replace(",", "").split()
    now, tight = float(words[words.index("Ms") + 2]), float(words[-1])
    assert _peak(design.loop) == pytest.approx(now, rel=6e-3)
    assert _peak(design.changed(tau_c=None).loop) == pytest.approx(tight, rel=6e-3)
    assert tight <= now


def _rise(t, y, end):
    """When 63 % of the end is first reached."""
    return t[np.argmax(y / end >= 1 - math.exp(-1))]


def _slower(design, item):
    if design.plant.integrators:
        tight = design.changed(tau_c=None).controller.to_parallel().Ki
        worse = float(item.text.split(" is ")[1].split()[0])
        assert tight / design.controller.to_parallel().Ki == pytest.approx(worse, rel=6e-3)
        return
    if not design.margins.stable:
        return
    response = simulate(design.loop, Scenario(disturbance=0.0))
    alone = plant_step(design.plant)
    own = _rise(alone.t, alone.y, design.plant.k)
    assert _rise(response.t, response.y, 1.0) > own


def _orders(design, item):
    orders = design.reduction.orders
    for order, error in ((1, orders.first), (2, orders.second)):
        model = tuned(design.plant, order, filter=design.choices["filter"]).model
        found = at_equal_peak(design.plant, model)
        if found is None:
            assert math.isinf(error)
            continue
        loop = replace(design.loop, controller=simc(model, found.tau_c))
        peak = _peak(loop)
        assert peak == pytest.approx(EQUAL_MS, rel=6e-3) or peak < EQUAL_MS
        s = 1e-7j / (design.plant.theta + sum(design.plant.lags) + 1)
        assert abs(1 / (s * loop.controller.response(s))) == pytest.approx(error, rel=1e-4)  # y/(d s) at s = 0


def _chosen(design, item):
    kind = item.quantity.split(", ")[1].split()[0]
    form = design.controller.to_parallel()
    assert kind == ("PID" if form.Kd else "PI" if form.Kp else "I")
    if item.change:
        assert design.changed(**item.change).controller == design.controller


def _rings(design, item):
    (tau, zeta), *_ = design.plant.lag_pairs
    pole = complex(-zeta, math.sqrt(1 - zeta**2)) / tau
    assert abs(design.controller.setpoint_response(pole)) > 1e6 * abs(design.controller.response(pole))


def _overshoots(design, item):
    """Peaks of y on a fine grid; with b = 1 the error of a loop with two integrators has no area: y must overshoot."""

    def beyond(of):
        return 100 * (float(np.max(simulate(of.loop, Scenario(disturbance=0.0)).y)) - 1)

    assert beyond(design) == pytest.approx(item.value, abs=0.1)
    changed = design.changed(**item.change)
    told = float(item.remedy.split(": ")[1].split()[0])
    assert max(beyond(changed), 0) == pytest.approx(told, abs=0.1)
    assert told <= 10 < 20 < item.value
    assert changed.margins == design.margins
    slow = performance(design.changed(tau_c=5 * design.tau_c).loop).setpoint
    assert slow.overshoot > 0.05


CLAIMS = {
    guards.set_point_overshoot: _overshoots,
    guards.not_stable: _not_stable,
    guards.large_Ms: _large,
    guards.derivative_noise: _derivative,
    guards.faster_than_dead_time: _faster,
    guards.slower_than_plant: _slower,
    guards.order_two: _orders,
    guards.other_than_chosen: _chosen,
    guards.oscillating_plant: _rings,
}


@pytest.mark.parametrize(
    ("plant", "settings", "Ms"),
    [
        (Plant(-1, 0.01, (math.sqrt(0.1), -math.sqrt(0.1))), (15.8114, 0.086843, 0.316228), 1.7293),
        (Plant(2.86 / 27**2, 0, (1 / 27, -1 / 27, 0.005)), None, 2.21),
    ],
)
def test_where_the_PI_rule_ends_the_PID_that_exists_is_told(plant, settings, Ms):
    """1/(0.1 s^2 - 1) with dead time, and a magnetic levitation: the lag, not the dead time, is what is too long."""
    with pytest.raises(RuleEnds, match=r"order 1 adds .* take PID") as refusal:
        tuned(plant)
    found = tuned(plant, **refusal.value.change)
    assert found.margins.Ms == pytest.approx(Ms, abs=0.005)
    assert settings is None or tuple(found.controller.settings.values()) == pytest.approx(settings, rel=1e-5)


def test_where_no_rule_is_left_the_plant_lacks_a_dead_time():
    """The inverted pendulum -1/(s^2 - 9.81)."""
    tau = 1 / math.sqrt(9.81)
    for order in (1, 2):
        with pytest.raises(SimcError, match="enter the dead time or the lag of the actuator"):
            tuned(Plant(1 / 9.81, 0, (tau, -tau)), order)


def test_isimc_is_tight_at_half_of_the_dead_time_and_its_remedies_stay_with_it():
    """[GS18] has tau_c = theta/2; half of that is called fast, and the way back is the rule's own choice."""
    assert not [item for item in advice(tuned(FOPDT, rule="isimc")) if item.quantity == "tau_c"]
    fast = tuned(FOPDT, rule="isimc", tau_c=0.25)
    (item,) = (item for item in advice(fast) if item.quantity == "tau_c")
    assert "tau_c = theta/2" in item.text
    cured = fast.changed(**item.change)
    assert (cured.rule, cured.tau_c) == ("isimc", 0.5)
    assert cured.margins.Ms < fast.margins.Ms


def test_no_order_is_proposed_for_a_rule_that_has_one_kind_of_controller():
    for rule in ("improved_simc", "isimc"):
        for plant in (FOPDT, THREE_LAGS, Plant(1, 1)):
            assert not [item for item in advice(tuned(plant, rule=rule)) if "order" in item.change]


def test_a_later_form_that_does_not_know_the_model_leads_back_to_SIMC():
    with pytest.raises(RuleEnds, match="model must be a first-order one") as refused:
        tuned(Plant(1, 1, integrators=2), rule="isimc")
    assert tuned(Plant(1, 1, integrators=2), **refused.value.change).margins.stable
