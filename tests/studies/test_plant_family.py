"""Model error: corners, samples and exact limits of one controller round changed plants."""

import math

import numpy as np
import pytest
from scipy.stats import qmc

from simc_core import Loop, Plant, simc
from simc_core.certificate.verdict import stability
from simc_core.errors import InvalidParameter
from simc_core.plants.models import FirstOrderDelay
from simc_core.sensitivity.margins import margins
from simc_core.studies.plant_family import _latin_hypercube, changed, robustness
from simc_core.studies.tuned import tuned
from tests.oracles.random_plants import random_plants

LOOP = Loop(Plant(2.0, 1.0, (5.0,)), simc(FirstOrderDelay(2.0, 1.0, 5.0)))  # L = e^{-s}/(2 s)


def test_corners_are_all_combinations_and_samples_lie_between_them():
    found = robustness(LOOP, 0.3)
    assert {tuple(case.change.values()) for case in found.corners} == {
        (a, b, c) for a in (-0.3, 0.3) for b in (-0.3, 0.3) for c in (-0.3, 0.3)
    }
    parts = np.array([list(case.change.values()) for case in found.samples])
    assert np.all(np.abs(parts) <= 0.3)
    strata = np.sort(np.floor((parts / 0.3 + 1) / 2 * len(parts)), axis=0)
    np.testing.assert_array_equal(strata, np.arange(len(parts))[:, None] * np.ones((1, 3)))  # one in each stratum


@pytest.mark.parametrize(("n", "d"), [(1, 1), (50, 3), (200, 2)])
def test_samples_are_those_of_scipy(n, d):
    assert np.array_equal(_latin_hypercube(n, d, 7), qmc.LatinHypercube(d, seed=7).random(n))


def test_the_same_seed_gives_the_same_plants():
    first, second = robustness(LOOP, 0.2), robustness(LOOP, 0.2)
    assert [case.change for case in first.samples] == [case.change for case in second.samples]


def test_gain_and_dead_time_of_an_integrating_loop_act_by_their_product():
    """c e^{-p s}/(2 s) has the Ms of c p e^{-s}/(2 s), and the limit pi/2 of c p/2."""
    for parts in ((0.2, 0.25), (0.5, 0.0), (0.0, 0.5)):
        plant = changed(LOOP.plant, {"k": parts[0], "theta": parts[1]})
        both = (1 + parts[0]) * (1 + parts[1])
        alone = changed(LOOP.plant, {"k": both - 1})
        assert margins(Loop(plant, LOOP.controller)).Ms == pytest.approx(margins(Loop(alone, LOOP.controller)).Ms)
        assert pytest.approx(math.pi / both) == margins(Loop(plant, LOOP.controller)).GM


def test_the_worst_corner_has_more_gain_and_more_dead_time():
    found = robustness(LOOP, 0.2)
    worst = found.worst_corner
    assert worst.change["k"] > 0
    assert worst.change["theta"] > 0
    assert worst.name.startswith("k +20 %, theta +20 %")
    assert found.worst.Ms >= max(case.Ms for case in found.corners)


def test_the_limits_are_where_stability_ends():
    found = robustness(LOOP, 0.2)
    assert found.k_high == pytest.approx(math.pi)
    assert found.k_low == 0
    for part, verdict in ((1 - 1e-6, "stable"), (1 + 1e-6, "unstable")):
        k = changed(LOOP.plant, {"k": part * found.k_high - 1})
        theta = changed(LOOP.plant, {"theta": part * found.theta_more / LOOP.plant.theta})
        assert stability(Loop(k, LOOP.controller)).verdict == verdict
        assert stability(Loop(theta, LOOP.controller)).verdict == verdict


def test_a_plant_that_leaves_stability_is_the_worst_case():
    found = robustness(LOOP, 0.9)
    assert found.worst_corner.Ms == math.inf
    assert not found.worst.stable


def test_only_what_the_plant_has_is_changed():
    found = robustness(Loop(Plant(1.0, 0.0, (5.0,)), LOOP.controller), 0.2)
    assert set(found.corners[0].change) == {"k", "tau1"}
    pairs = changed(Plant(1.0, 1.0, lag_pairs=((1.0, 0.5), (4.0, 0.5))), {"tau1": 0.5})
    assert pairs.lag_pairs[0] == (6.0, 0.5)


def test_the_change_has_bounds():
    with pytest.raises(InvalidParameter, match="change"):
        robustness(LOOP, 1.5)


def stable(loop: Loop) -> bool:
    return stability(loop).verdict == "stable"


def test_where_a_changed_plant_is_not_stable_a_larger_tau_c_helps():
    """What the page says there, on random plants of all kinds whose rule leaves tau_c free: changes of 50 %."""
    helped = 0
    for i, (kind, plant) in enumerate(random_plants(200)):
        if kind == "unstable":
            continue
        tight = tuned(plant, order=1 + i % 2)
        fast = tight.changed(tau_c=0.4 * tight.tau_c) if tight.tau_c else tight
        found = robustness(fast.loop, 0.5)
        if found.worst_corner.stable:
            continue
        plants = [changed(plant, case.change) for case in found.corners]
        factors = (1.5, 2, 3, 5, 10, 30, 100, 300)
        slower = (fast.changed(tau_c=factor * fast.tau_c).loop for factor in factors)
        assert any(all(stable(Loop(each, loop.controller)) for each in plants) for loop in slower), (kind, plant)
        helped += 1
    assert helped > 100
