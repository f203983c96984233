"""Sampled margins against an independent program, published margins and eigenvalues of the whole loop."""

import math
from dataclasses import astuple, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from simc_core import (
    IController,
    IdealPid,
    InvalidParameter,
    Loop,
    NotStable,
    ParallelPid,
    Plant,
    SeriesPid,
    longest_sampling_period,
    margins,
    sampled_margins,
)
from simc_core.algebra.state_space import chain
from simc_core.controllers.discrete import LAWS, State

PI = Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))
PID = Loop(Plant(1, 1, (10, 3)), SeriesPid(5, 8, 3, 0.375))
PERIODS = (0.1, 0.2, 0.3, 0.5, 1.0)
PEAKS = [
    (PI, "backward", (1.6386, 1.6908, 1.7336, 1.8764, 2.3318)),
    (PI, "tustin", (1.6335, 1.6795, 1.7155, 1.8380, 2.1947)),
    (PID, "backward", (2.0409, 2.1838, 2.3464, 2.7482, 4.66)),
    (PID, "tustin", (1.9774, 2.0446, 2.1161, 2.2730)),
]
LOOPS = [
    PI,
    PID,
    Loop(Plant(2, 0.7), IController(0.3)),
    Loop(Plant(0.5, 1, integrators=1), SeriesPid(1, 8)),
    Loop(Plant(-1, 0.4, (-4,)), IdealPid(3, 12)),
    Loop(Plant(1, 0, (8,), (2,)), SeriesPid(2, 8)),
    Loop(Plant(1, 0.3, lag_pairs=((1, 0.02),)), IController(0.02)),
    Loop(Plant(-2, 1, (5, 1), (-0.5,)), SeriesPid(-1.2, 5, 1, 0.4)),
]


def spectral_radius(loop, h, law):
    """Largest closed-loop eigenvalue: plant, all u on their way and the law's own states, one column after another."""
    A, B, C, D = chain(loop.plant.factored)
    n, pid = len(A), loop.controller.to_parallel()
    d = math.floor(loop.plant.theta / h + 1e-9)
    late = max(loop.plant.theta - d * h, 0.0)

    def hold(x, u, dt):
        M = np.zeros((n + 1, n + 1))
        M[:n, :n], M[:n, n] = A * dt, B * dt
        return (expm(M) @ [*x, u])[:n]

    def sample(z):
        x, on_the_way, state = z[:n], z[n : n + d + 1], State(*z[n + d + 1 :])
        state = LAWS[law].step(pid, h, 0.0, state, 0.0, C @ x + D * on_the_way[0])
        inputs = [*on_the_way, state.u]
        return [*hold(hold(x, inputs[0], late), inputs[1], h - late), *inputs[1:], *state]

    size = n + d + 1 + len(State._fields)
    return abs(np.linalg.eigvals(np.transpose([sample(column) for column in np.eye(size)]))).max()


@pytest.mark.parametrize(("loop", "law", "peaks"), PEAKS)
def test_peaks_are_those_of_the_table(loop, law, peaks):
    found = [sampled_margins(loop, h, law).Ms for h in PERIODS[: len(peaks)]]
    assert found == pytest.approx(peaks, abs=6e-5 if peaks[-1] < 4 else 3e-3)


@pytest.mark.parametrize(("h", "GM", "PM"), [(0.1, 2.97177, 59.823), (0.5, 2.40286, 53.432)])
def test_gain_and_phase_margin_of_the_sampled_pi(h, GM, PM):
    found = sampled_margins(PI, h)
    assert pytest.approx(GM, abs=6e-6) == found.GM
    assert found.PM_deg == pytest.approx(PM, abs=6e-4)


@pytest.mark.parametrize(
    ("num", "den", "h", "GM", "PM"), [([24], [1, 6, 11, 6], 0.3, 1.41, 18.60), ([2], [1, 3, 2, 0], 0.05, 2.79, 31.5)]
)
def test_published_margins_of_plants_behind_a_hold(num, den, h, GM, PM):
    found = sampled_margins(Loop(Plant.from_polynomials(num, den), ParallelPid(1, 0)), h)
    assert pytest.approx(GM, abs=0.006) == found.GM
    assert found.PM_deg == pytest.approx(PM, abs=0.06)


@pytest.mark.parametrize("loop", LOOPS)
def test_with_fast_sampling_they_are_those_of_the_continuous_loop_with_half_a_period_more(loop):
    h = 0.01
    found = sampled_margins(loop, h)
    continuous = margins(replace(loop, plant=replace(loop.plant, theta=loop.plant.theta + h / 2)))
    for name in ("GM", "PM_deg", "Ms", "Mt", "omega_c"):
        assert getattr(found, name) == pytest.approx(getattr(continuous, name), rel=6e-3), name


@pytest.mark.parametrize("loop", LOOPS)
@pytest.mark.parametrize("h", [0.15, 0.4, 1.1, 2.5])
def test_the_verdict_is_that_of_the_eigenvalues(loop, h):
    assert sampled_margins(loop, h).stable == (spectral_radius(loop, h, "backward") < 1)


@pytest.mark.parametrize("loop", LOOPS)
@pytest.mark.parametrize(("h", "law"), [(0.15, "backward"), (0.3, "backward"), (0.3, "tustin")])
def test_at_a_margin_the_loop_swings(loop, h, law):
    found = sampled_margins(loop, h, law)
    plant = loop.plant
    gains = [gain for gain in (found.GM, found.GM_lower) if 0 < gain < math.inf]
    for changed in [replace(plant, k=plant.k * gain) for gain in gains]:
        assert spectral_radius(replace(loop, plant=changed), h, law) == pytest.approx(1, abs=1e-9)
    before, after = (
        spectral_radius(replace(loop, plant=replace(plant, theta=plant.theta + found.delay_margin + more)), h, law)
        for more in (-1e-6, 1e-6)
    )
    assert before < 1 < after


def test_the_verdict_holds_for_thousands_of_samples_in_a_dead_time():
    found = sampled_margins(PI, 1 / 3000)
    assert found.Ms == pytest.approx(margins(PI).Ms, rel=3e-4)
    assert not sampled_margins(replace(PI, controller=SeriesPid(13, 8)), 1 / 3000).stable
    with pytest.raises(InvalidParameter, match=r"h must be >= theta/10000 = 0.0001, found 1e-05"):
        sampled_margins(PI, 1e-5)


def test_an_output_written_one_sample_late_is_a_dead_time_longer_by_one_period():
    late = sampled_margins(PI, 0.2, delay_scans=1)
    assert late.Ms == pytest.approx(1.898, abs=6e-4)
    other = sampled_margins(replace(PI, plant=replace(PI.plant, theta=1.2)), 0.2)
    assert astuple(late) == pytest.approx(astuple(other), rel=1e-12)


@settings(max_examples=15)
@given(time=st.floats(0.01, 100), gain=st.floats(0.01, 100) | st.floats(-100, -0.01), h=st.floats(0.05, 0.6))
def test_margins_scale_with_time_and_gain(time, gain, h):
    one = sampled_margins(PID, h)
    plant = Plant(gain, time, (10 * time, 3 * time))
    other = sampled_margins(Loop(plant, SeriesPid(5 / gain, 8 * time, 3 * time, 0.375 * time)), h * time)
    assert other.Ms == pytest.approx(one.Ms, rel=1e-9)
    assert pytest.approx(one.GM, rel=1e-9) == other.GM
    assert other.omega_c * time == pytest.approx(one.omega_c, rel=1e-9)
    assert other.delay_margin / time == pytest.approx(one.delay_margin, rel=1e-7)


@pytest.mark.parametrize(
    ("loop", "law", "more", "longest"),
    [
        (PI, "backward", 0.05, 0.16),
        (PI, "backward", 0.1, 0.32),
        (PI, "tustin", 0.05, 0.19),
        (PI, "tustin", 0.1, 0.38),
        (PID, "backward", 0.05, 0.076),
        (PID, "backward", 0.1, 0.147),
    ],
)
def test_the_longest_sampling_period(loop, law, more, longest):
    h = longest_sampling_period(loop, law, more=more)
    assert h == pytest.approx(longest, abs=6e-3 if longest > 0.15 else 1e-3)
    assert sampled_margins(loop, h, law).Ms == pytest.approx((1 + more) * margins(loop).Ms, rel=1e-4)


def test_the_longest_period_is_none_where_the_law_ends_first():
    assert longest_sampling_period(replace(PI, controller=SeriesPid(1, 8, 0, 0.05)), "tustin", more=0.5) == math.inf


def test_what_has_no_sampled_margins_is_refused():
    with pytest.raises(InvalidParameter, match=r"tau_F must be >= h/2 = 0.5"):
        sampled_margins(PID, 1.0, "tustin")
    with pytest.raises(InvalidParameter, match="loop must be a Loop, found Plant"):
        sampled_margins(PI.plant, 1.0)
    with pytest.raises(NotStable):
        longest_sampling_period(replace(PI, controller=SeriesPid(40, 8)))


@pytest.mark.parametrize("theta", [0.0, 1.0])
def test_a_period_is_found_where_S_has_no_peak_within(theta):
    """P control of a lag, no dead time: |S| rises to its end at pi/h; Ms grows by 5 % there or nowhere."""
    loop = Loop(Plant(1, theta, (5,)), SeriesPid(1, math.inf))
    longest = longest_sampling_period(loop)
    assert longest > 0
    if longest < math.inf:
        grown = sampled_margins(loop, longest).Ms / margins(loop).Ms
        assert grown == pytest.approx(1.05, rel=1e-3)
