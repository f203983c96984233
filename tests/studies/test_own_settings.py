"""What is said of settings that no rule has made: said where it is true and nowhere else, and what it proposes works.

Damping and period come from formulas, or from the waves of a simulated response.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import IController, IdealPid, Loop, ParallelPid, Plant, Scenario, SeriesPid, half_rule, margins, simc
from simc_core.simulation import simulate
from simc_core.studies.own_settings import advice_on_settings, slow_oscillation

INTEGRATING = Plant(1, 1, integrators=1)


@pytest.mark.parametrize("product", [0.02, 0.1, 0.5, 0.9])
@pytest.mark.parametrize("k", [0.5, -3.0])
def test_damping_of_an_integrating_process_in_closed_form(product, k):
    """k'/s under PI: tau_I s^2 + Kc k' tau_I s + Kc k' has zeta = 0.5 sqrt(Kc k' tau_I)."""
    tau_I = 5.0
    found = slow_oscillation(Plant(k, 0, integrators=1), SeriesPid(product / (k * tau_I), tau_I))
    zeta = 0.5 * math.sqrt(product)
    assert found.value == pytest.approx(zeta, rel=1e-9)
    period = 2 * math.pi * tau_I / math.sqrt(product * (1 - zeta**2))
    assert f"period {period:.3g}:" in found.text
    assert f"Kc k' tau_I is {product:g}, should be at least 4" in found.text


@pytest.mark.parametrize("product", [1.02, 2.0, 3.9, 4.0, 10.0])
def test_what_hardly_swings_is_no_oscillation(product):
    assert slow_oscillation(Plant(1, 0, integrators=1), SeriesPid(product / 5, 5)) is None


@pytest.mark.parametrize(("Kc", "tau_I"), [(0.2, 0.5), (1.0, 2.0), (3.0, 1.0)])
def test_damping_of_a_lag_in_closed_form(Kc, tau_I):
    """1/(20 s + 1): the roots of 20 tau_I s^2 + (1 + Kc) tau_I s + Kc. Its k' = k/tau1 is not spoken of: it is no
    integrator."""
    found = slow_oscillation(Plant(1, 0, (20,)), SeriesPid(Kc, tau_I))
    root = np.roots([20 * tau_I, (1 + Kc) * tau_I, Kc])[0]
    assert found.value == pytest.approx(-root.real / abs(root), rel=1e-9)
    assert "k'" not in found.text


SILENT = [
    (Plant(2.79, 2.44, (15.8,)), SeriesPid(0.966, 11.7)),  # Kc k/tau1 tau_I = 2 < 4, and nothing swings
    (Plant(1, 1, (8,)), SeriesPid(1, 5)),  # 0.63
    (Plant(-2, 3, (30,)), IdealPid(-0.4, 18)),  # 0.48
    (Plant(1, 1, (20, 5)), SeriesPid(1.5, 14)),  # about 1
    (Plant(1, 1, (2,)), SeriesPid(0.1, 2)),  # cancels the lag
    (Plant(1, 5, (1,)), SeriesPid(0.2, 0.9)),
    (Plant(1, 1), SeriesPid(0.3, 0.5)),
    (Plant(1, 1), IController(0.3)),
    (INTEGRATING, SeriesPid(0.1, math.inf)),
    (INTEGRATING, SeriesPid(1.3, 8)),  # swings fast: the gain is too high, not too low
    (Plant(1, 1, lag_pairs=((2, 0.1),)), SeriesPid(0.1, 2)),  # it is the plant that swings
]
SWINGING = [
    (INTEGRATING, SeriesPid(0.1, 5)),
    (Plant(-0.02, 3, integrators=1), IdealPid(-2, 10)),
    (Plant(1, 1, (50,)), SeriesPid(0.5, 1)),
    (Plant(1, 1, (50,)), ParallelPid(0.5, 0.5, 0)),
    (Plant(-4, 0.5, (60, 1)), SeriesPid(-0.3, 1.5)),
    (Plant(1, 1, (3,), integrators=1), SeriesPid(0.02, 20)),
    (Plant(0.5, 2, (100, 10, 3)), IdealPid(1, 6, 0.5, 0.05)),
]


def swings(plant, controller):
    """The third and the second over the first half wave of y after a load."""
    response = simulate(Loop(plant, controller), Scenario(0.0, 1.0, 0.0, 60 * plant.theta + 600, points=40_000))
    y = response.y[np.abs(response.y) > 1e-6 * np.abs(response.y).max()]
    ends = np.flatnonzero(np.diff(np.sign(y)) != 0)
    waves = [np.abs(part).max() for part in np.split(y, ends + 1) if len(part) > 2]
    return (waves[1] / waves[0] if len(waves) > 1 else 0.0), (waves[2] / waves[0] if len(waves) > 2 else 0.0)


@pytest.mark.parametrize(("plant", "controller"), SILENT)
def test_not_said_where_it_would_be_false(plant, controller):
    assert slow_oscillation(plant, controller) is None


@pytest.mark.parametrize(("plant", "controller"), SILENT[:4])
def test_indeed_it_hardly_swings_there(plant, controller):
    """At zeta = 0.5 the second half wave would be exp(-pi/sqrt(3)) = 16 % of the first."""
    assert swings(plant, controller)[0] < 0.1


@pytest.mark.parametrize(("plant", "controller"), SWINGING)
def test_said_where_it_swings_and_what_it_proposes_ends_it(plant, controller):
    """The response itself goes back and forth as it is, and not with the settings proposed, which are robust."""
    found = slow_oscillation(plant, controller)
    second, third = swings(plant, controller)
    assert second > 0.1
    assert third > 0.01
    better = found.change["own"]
    assert type(better) is type(controller)
    assert swings(plant, better)[0] < 0.1
    assert margins(Loop(plant, better)).Ms <= 2
    assert slow_oscillation(plant, better) is None


@given(st.floats(0.01, 100), st.floats(0.01, 100), st.floats(0.01, 100), st.floats(0.01, 100))
def test_the_rule_itself_never_oscillates_slowly(k, theta, tau1, tau_c):
    """tau_I = 4 (tau_c + theta) gives Kc k' tau_I = 4, the limit."""
    for plant in (Plant(k, theta, (tau1,)), Plant(k, theta, integrators=1)):
        assert slow_oscillation(plant, simc(half_rule(plant).model, tau_c)) is None


def test_fragile_and_unstable_settings_are_told():
    """The gain margin of SIMC at tau_c = theta is pi [SK03]."""
    plant, tight = Plant(1, 1, (8,)), SeriesPid(4, 8)

    def told(gain):
        loop = Loop(plant, SeriesPid(gain * tight.Kc, 8))
        return [item.quantity for item in advice_on_settings(loop, margins(loop))]

    assert told(1) == []
    assert told(2) == ["Ms"]
    assert told(3.2) == ["Not stable"]


def test_a_derivative_without_a_filter_is_told():
    loop = Loop(Plant(1, 1, (8, 2)), SeriesPid(2, 8, 2))
    assert [item.quantity for item in advice_on_settings(loop, margins(loop))] == ["tau_F = 0"]
