"""Margins are the edges of the certificate, and nothing that assumes stability is given where there is none."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from simc_core import (
    IController,
    Loop,
    Margins,
    NotStable,
    ParallelPid,
    Plant,
    SeriesPid,
    dominant_poles,
    margins,
    performance,
    stability,
)
from tests.oracles.random_loops import resonant_loop, third_unstable_loop

ASIDE = 1e-7


def verdict(loop: Loop) -> str:
    return stability(loop).verdict


def with_gain(loop: Loop, factor: float) -> Loop:
    return Loop(replace(loop.plant, k=loop.plant.k * factor), loop.controller)


def later(loop: Loop, delay: float) -> Loop:
    return Loop(replace(loop.plant, theta=loop.plant.theta + delay), loop.controller)


def test_at_each_margin_the_verdict_changes():
    """k GM, k GM_lower and theta + delay_margin: stable on one side, unstable on the other, a ten-millionth away."""
    rng = np.random.default_rng(11)
    checked = dict.fromkeys(("GM", "GM_lower", "delay_margin"), 0)
    while min(checked.values()) < 8:
        loop = (resonant_loop if rng.random() < 0.5 else third_unstable_loop)(rng)
        found = stability(loop)
        if found.verdict != "stable" or found.neutral:
            continue
        m = margins(loop)
        if math.inf > m.GM:
            checked["GM"] += 1
            assert verdict(with_gain(loop, m.GM * (1 - ASIDE))) == "stable", loop
            assert verdict(with_gain(loop, m.GM * (1 + ASIDE))) == "unstable", loop
        if m.GM_lower > 0:
            checked["GM_lower"] += 1
            assert verdict(with_gain(loop, m.GM_lower * (1 + ASIDE))) == "stable", loop
            assert verdict(with_gain(loop, m.GM_lower * (1 - ASIDE))) == "unstable", loop
        if m.delay_margin < math.inf:
            checked["delay_margin"] += 1
            assert verdict(later(loop, m.delay_margin * (1 - ASIDE))) == "stable", loop
            assert verdict(later(loop, m.delay_margin + ASIDE * (m.delay_margin + loop.plant.theta))) == "unstable", (
                loop
            )


def test_double_integrator_at_both_edges_of_its_window():
    """L = K (8 s + 1)^2 e^{-s}/(8 s^3): 2 atan(8 w) = w + pi/2 at the edges, K = 8 w^3/(1 + 64 w^2)."""
    plant = Plant(1.0, 1.0, integrators=2)
    for low, high, side in ((0.01, 0.3, 1), (0.3, 1.5, -1)):
        w = brentq(lambda w: 2 * math.atan(8 * w) - w - math.pi / 2, low, high, xtol=1e-16)
        K = 8 * w**3 / (1 + 64 * w**2)
        for off, expected in ((side * 1e-9, ("stable", 0)), (-side * 1e-9, ("unstable", 2))):
            found = stability(Loop(plant, SeriesPid(K * (1 + off), 8.0, 8.0)))
            assert (found.verdict, found.unstable_poles) == expected


@pytest.mark.parametrize("theta", [0.01, 1.0])
def test_conditionally_stable_with_dead_time(theta):
    """L = K (4 s + 1)^2 e^{-theta s}/s^3: unstable, stable, unstable as K grows."""
    plant = Plant(1.0, theta, integrators=2)

    def phase(w):
        return 2 * math.atan(4 * w) - w * theta - math.pi / 2

    edges = []
    for low, high in ((1e-3, 0.5), (0.5, 3 / theta)):
        w = brentq(phase, low, high, xtol=1e-16)
        edges.append(w**3 / (1 + 16 * w**2))
    for factor, expected in ((1 - 1e-9, ("unstable", 2)), (1 + 1e-9, ("stable", 0))):
        found = stability(Loop(plant, SeriesPid(4 * edges[0] * factor, 4.0, 4.0)))
        assert (found.verdict, found.unstable_poles) == expected
    for factor, expected in ((1 - 1e-9, ("stable", 0)), (1 + 1e-9, ("unstable", 2))):
        found = stability(Loop(plant, SeriesPid(4 * edges[1] * factor, 4.0, 4.0)))
        assert (found.verdict, found.unstable_poles) == expected


def gives_nothing(loop: Loop) -> None:
    m = margins(loop)
    assert m.stable is False
    assert all(math.isnan(getattr(m, name)) for name in Margins.__slots__ if name != "stable"), loop
    with pytest.raises(NotStable, match=stability(loop).verdict):
        performance(loop)


def test_a_loop_that_is_not_stable_gets_no_margins_and_no_metrics():
    rng = np.random.default_rng(12)
    checked, countless = 0, 0
    while checked < 200:
        loop = (resonant_loop if rng.random() < 0.5 else third_unstable_loop)(rng)
        found = stability(loop)
        if found.verdict == "stable":
            continue
        checked += 1
        countless += found.unstable_poles == math.inf
        gives_nothing(loop)
    assert 3 <= countless < 150


@pytest.mark.parametrize(
    "loop",
    [
        Loop(Plant(1, 1), IController(math.pi / 2)),
        Loop(Plant(-1, 1, (-4,)), SeriesPid(1, math.inf)),
        Loop(Plant(1, 0, lag_pairs=((1, 0),)), SeriesPid(0.5, math.inf)),
        Loop(Plant(1, 0.5, (-4, 1), (-4,)), SeriesPid(0.5, 2)),  # an unstable pole cancelled
        Loop(Plant(1, 1, (3,), integrators=1), ParallelPid(0, 0, 1)),  # an integrator hidden
        Loop(Plant(1, 1), SeriesPid(1, math.inf)),  # neutral, |L(inf)| = 1
        Loop(Plant(1, 1), SeriesPid(2, 4)),
        Loop(Plant(1, 1, (4,)), SeriesPid(2, 4, 3)),  # no filter: countless
        Loop(Plant(1, 1, (8,)), SeriesPid(-4, 8)),
        Loop(Plant(-1, 1, (-4,)), SeriesPid(0.3, 20)),  # too little gain
    ],
)
def test_nor_does_one_on_the_limit_or_unstable_in_a_way_that_margins_do_not_show(loop):
    gives_nothing(loop)


def test_dominant_poles_of_an_unstable_loop_are_right_of_the_axis():
    rng = np.random.default_rng(13)
    checked = 0
    while checked < 60:
        loop = third_unstable_loop(rng)
        found = stability(loop)
        if found.verdict != "unstable" or found.neutral:
            continue
        checked += 1
        first = dominant_poles(loop)[0]
        assert first.s.real > 0
        assert first.zeta < 0
