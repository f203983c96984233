"""Actuators with a resolution, a dead band, play, a slow motion: closed forms, and a second program by samples."""

import math

import numpy as np
import pytest

from simc_core import Actuation, IController, InvalidParameter, Loop, Plant, Scenario, SeriesPid, export, simulate
from tests.oracles.sampled_loop import driven

PI = Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))


class Actuator:
    """The actuator of the test: one law at a time, written out."""

    def __init__(self, kind, size):
        self.kind, self.size, self.u = kind, size, 0.0

    def __call__(self, v):
        if self.kind == "resolution":
            self.u = self.size * math.floor(v / self.size + 0.5)
        elif self.kind == "dead_band" and abs(v - self.u) > self.size:
            self.u = v
        elif self.kind == "backlash":
            if v > self.u + self.size / 2:
                self.u = v - self.size / 2
            elif v < self.u - self.size / 2:
                self.u = v + self.size / 2
        return self.u


@pytest.mark.parametrize("kind", ["resolution", "dead_band", "backlash"])
@pytest.mark.parametrize("theta", [1.0, 0.0, 0.13])
@pytest.mark.parametrize("limits", [{}, {"u_max": 1.3}])
def test_it_is_what_a_second_program_finds_sample_by_sample(kind, theta, limits):
    """The exported controller, which knows its limits alone, an actuator behind it, the exact plant."""
    h, n, size = 0.2, 150, 0.07
    scope = {}
    exec(export(SeriesPid(3, 7, 0.5, 0.1), "python", h, **limits), scope)
    pid, actuator = scope["Pid"](), Actuator(kind, size)
    pid.step(0.0, 0.0)
    y, u = driven(1, theta, (8, 2), h, lambda r, y: actuator(pid.step(r, y)), np.full(n, 0.977))
    found = simulate(
        Loop(Plant(1, theta, (8, 2)), SeriesPid(3, 7, 0.5, 0.1)),
        Scenario(0.977, 0, t=h * np.arange(n), actuation=Actuation(h=h, **limits, **{kind: size})),
    )
    np.testing.assert_allclose(found.y, y, rtol=0, atol=1e-11)
    np.testing.assert_allclose(found.u, u, rtol=0, atol=1e-10)


@pytest.mark.parametrize(("r", "continuous"), [(0.03, False), (0.05, False), (0.08, False), (0.03, True)])
def test_the_limit_cycle_of_a_resolution_has_its_closed_form(r, continuous):
    """e^{-theta s} under K_I/s, u in steps of q, 0 < r < q: u goes between 0 and q, and so does y, for

        T = theta (2 + e1/e2 + e2/e1),  e1 = r, e2 = q - r.

    The integral goes up with slope K_I e1 while y = 0, a dead time longer than u, and down with K_I e2 while y = q.
    """
    q, theta, h = 0.1, 1.0, 0.002
    period = theta * (2 + r / (q - r) + (q - r) / r)
    t = np.arange(0, 80, 0.01)
    actuation = Actuation(h=0.0 if continuous else h, resolution=q)
    found = simulate(Loop(Plant(1, theta), IController(0.2)), Scenario(r, 0, t=t, t_end=80.0, actuation=actuation))
    late = found.y[t > 40]
    assert np.ptp(late) == pytest.approx(q, rel=1e-9)
    rises = t[t > 40][1:][np.diff(late) > q / 2]
    assert np.diff(rises).mean() == pytest.approx(period, rel=0.01)


@pytest.mark.parametrize(
    ("kind", "swing", "period", "within"), [("resolution", 0.0135, 6.0, 0.01), ("dead_band", 0.037, 12.4, 0.04)]
)
def test_swings_of_a_known_loop(kind, swing, period, within):
    """FOPDT 8, 1 under PI 4, 8, h 0.1, r 0.977, size 0.1: digits of a program of its own.

    The period of the dead band is a mean: it wanders between 12.1 and 13.
    """
    t = 0.1 * np.arange(3000)
    found = simulate(PI, Scenario(0.977, 0, t=t, actuation=Actuation(h=0.1, **{kind: 0.1})))
    late = t > 200
    y = found.y[late]
    assert np.ptp(y) == pytest.approx(swing, rel=0.03)
    above = y >= (y.max() + y.min()) / 2
    rises = t[late][1:][above[1:] & ~above[:-1]]
    assert np.diff(rises).mean() == pytest.approx(period, rel=within)


def test_play_alone_makes_no_swing_that_lasts_here():
    """The same loop: within the play the actuator rests, 0.0007 from the set point [the program of its own]."""
    t = 0.1 * np.arange(3000)
    found = simulate(PI, Scenario(0.977, 0, t=t, actuation=Actuation(h=0.1, backlash=0.1)))
    assert np.abs(found.y[t > 200] - 0.977).max() <= 0.0007
    assert np.ptp(found.y[t > 200]) < 1e-9


def test_a_slow_actuator_moves_as_fast_as_it_can():
    """k/s behind a dead time under P control: u = rate t before y answers, so y = k rate t^2/2, late by a step dt."""
    rate, dt = 0.5, 7.9 / 5000
    loop = Loop(Plant(2.0, 4.0, integrators=1), SeriesPid(100.0, math.inf))
    t = np.array([4.5, 6.0, 7.9])
    found = simulate(loop, Scenario(1.0, 0, t=t, actuation=Actuation(h=1.0, rate_limit=rate)))
    ahead = found.y - 2.0 * rate * (t - 4.0) ** 2 / 2
    assert np.all((ahead > 0) & (ahead < 2.0 * rate * (t - 4.0) * dt))
    courses = simulate(loop, Scenario(1.0, 0, t=np.linspace(0, 9, 901), actuation=Actuation(h=1.0, rate_limit=rate)))
    assert np.abs(np.diff(courses.u)).max() <= rate * 0.01 * (1 + 1e-9) + rate * 9 / 5000 * 1.01


def test_an_actuator_that_does_as_it_is_told_changes_nothing():
    t = 0.1 * np.arange(400)
    plain = simulate(PI, Scenario(1, -0.5, t=t, actuation=Actuation(h=0.1, u_max=1.2)))
    free = simulate(PI, Scenario(1, -0.5, t=t, actuation=Actuation(h=0.1, u_max=1.2, rate_limit=1e9)))
    fine = simulate(PI, Scenario(1, -0.5, t=t, actuation=Actuation(h=0.1, u_max=1.2, resolution=1e-9)))
    assert np.array_equal(plain.y, free.y)
    np.testing.assert_allclose(fine.y, plain.y, atol=1e-8)


def test_sizes_scale_with_the_signals():
    t = 0.1 * np.arange(600)
    sizes = {"resolution": 0.03, "backlash": 0.05, "rate_limit": 2.0}
    one = simulate(PI, Scenario(1, -0.5, t=t, actuation=Actuation(h=0.1, **sizes)))
    tenth = {name: size * 0.125 for name, size in sizes.items()}
    other = simulate(PI, Scenario(0.125, -0.0625, t=t, actuation=Actuation(h=0.1, **tenth)))
    np.testing.assert_allclose(other.y, 0.125 * one.y, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"resolution": -1}, "resolution must be >= 0, found -1"),
        ({"dead_band": math.nan}, "dead_band must be finite"),
        ({"backlash": 1e13}, "backlash must be <= 1e\\+12"),
        ({"rate_limit": 0}, "rate_limit must not be zero"),
        ({"rate_limit": -2}, "rate_limit must be > 0, found -2"),
    ],
)
def test_sizes_have_bounds(given, text):
    with pytest.raises(InvalidParameter, match=text):
        Actuation(**given)
