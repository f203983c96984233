"""What the Accuracy page shows: every row holds, says so where it does not, and its constants are evidence."""

import math
from dataclasses import replace

import mpmath as mp
import pytest

from simc_core import NotStable
from simc_core.published.checks import GROUPS, REFERENCES, check, check_all
from simc_core.published.values import MARGIN_CASES, STEP_METRICS, TIME_CASES
from tests.oracles.delay_expansion import by_contour, by_series, crossing_margins, delayed_integrator_metrics, peak_of_S

LOOPS = {
    "first order": lambda s: mp.exp(-s) / (2 * s),
    "integrating": lambda s: mp.exp(-s) * (8 * s + 1) / (16 * s**2),
    "double integrating": lambda s: mp.exp(-s) * (8 * s + 1) ** 2 / (128 * s**3),
}
NEAR = {"first order": (1.1, 1.6, 0.5), "integrating": (1.0, 1.5, 0.5), "double integrating": (0.7, 1.4, 0.5)}


@pytest.mark.parametrize(
    "reference", REFERENCES, ids=lambda each: f"{each.group}, {each.what}, {each.quantity}, {each.source}"
)
def test_each_reference_is_met(reference):
    found = check(reference)
    assert found.met, found


@pytest.mark.parametrize("case", TIME_CASES, ids=lambda each: each.what)
def test_time_responses_are_computed_again_in_many_digits(case):
    with mp.workdps(110):
        y_r, y_d = by_contour(case.plant, case.controller, case.t)
    assert (float(y_r), float(y_d)) == (case.setpoint, case.load)


@pytest.mark.parametrize("case", [each for each in TIME_CASES if 0 < each.plant.theta < 2], ids=lambda each: each.what)
def test_the_contour_agrees_with_the_taylor_series(case):
    """Which takes the gains of its factors as doubles: 1e-16, that the responses magnify up to a hundred times."""
    with mp.workdps(60):
        y_r, y_d = by_series(case.plant, case.controller.factored, case.t)
    assert (float(y_r), float(y_d)) == pytest.approx((case.setpoint, case.load), rel=1e-14, abs=1e-15)


def test_step_metrics_are_computed_again_from_the_polynomials():
    with mp.workdps(60):
        found = delayed_integrator_metrics(0.5, 80)
    assert {name: float(value) for name, value in found.items()} == STEP_METRICS


@pytest.mark.parametrize("name", MARGIN_CASES)
def test_margins_are_computed_again_by_root_finding(name):
    values = MARGIN_CASES[name][1]
    near_Ms, near_180, near_c = NEAR[name]
    with mp.workdps(60):
        Ms, _ = peak_of_S(LOOPS[name], near_Ms)
        GM, PM, delay = crossing_margins(LOOPS[name], near_180, near_c)
    found = {"Ms": Ms, "GM": GM, "PM_deg": PM, "delay_margin": delay}
    assert {key: float(found[key]) for key in values} == values


def test_what_is_not_met_is_not_passed():
    number = next(each for each in REFERENCES if isinstance(each.expected, float))
    words = next(each for each in REFERENCES if isinstance(each.expected, str))

    def refused():
        raise NotStable("no")

    assert not check(replace(number, expected=number.expected + 2 * number.tolerance)).met
    assert not check(replace(number, compute=lambda: math.nan)).met
    assert not check(replace(words, expected="stables")).met
    fault = check(replace(number, compute=refused))
    assert not fault.met
    assert fault.fault == "no"


def test_all_groups_are_there():
    assert {found.reference.group for found in check_all()} == set(GROUPS)
