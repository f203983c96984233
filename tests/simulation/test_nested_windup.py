"""Limited actuator under nested loops: the linear engine where nothing saturates, and what protection must achieve."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from simc_core import (
    CascadeLoop,
    IController,
    InvalidParameter,
    ParallelPid,
    Plant,
    Scenario,
    SeriesPid,
    simc_cascade,
    simulate,
)
from simc_core.simulation.nested_windup import PROTECTIONS, limited
from tests.oracles.pairs import PAIRS

LOOP = simc_cascade(*PAIRS[1], inner="PID").loop


@pytest.mark.parametrize("protection", PROTECTIONS)
@pytest.mark.parametrize("loop", [simc_cascade(*PAIRS[1]).loop, CascadeLoop(*PAIRS[1], ParallelPid(0.2, 0.03), None)])
def test_without_limits_it_is_the_linear_response(loop, protection):
    found = limited(loop, -1e6, 1e6, protection, t_end=60.0)
    exact = simulate(loop, Scenario(disturbance=0.0, disturbance2=0.0, t=found.t))
    assert np.max(np.abs(found.y - exact.y)) < 2e-4
    assert np.max(np.abs(found.ys[0] - exact.ys[0])) < 5e-3  # a jump of u between two instants is a ramp here


def test_protection_pays():
    """Large step, u just enough: the more is protected, the less overshoot."""
    y = {kind: limited(LOOP, -0.2, 0.6, kind, t_end=120.0).y for kind in PROTECTIONS}
    over = {kind: np.max(each) - 1 for kind, each in y.items()}
    assert over["both"] < over["inner"] < over["none"]
    assert over["both"] < 0.5 * over["none"]
    for each in y.values():
        assert each[-1] == pytest.approx(1.0, abs=0.02)


def test_limits_hold():
    response = limited(LOOP, -0.2, 0.6, "both")
    assert np.max(response.u) == pytest.approx(0.6)
    assert np.min(response.u) >= -0.2


def test_a_jump_passed_on_at_once_is_refused():
    biproper = Plant(1, 0, (2,), (1,))
    with pytest.raises(InvalidParameter, match="innermost block"):
        limited(CascadeLoop(Plant(1, 1, (5,)), biproper, ParallelPid(*OUTER), ParallelPid(*INNER)), *LIMITS)


def test_bounds():
    with pytest.raises(InvalidParameter, match="u_min must be <= 0, where the loop is at rest, found"):
        limited(LOOP, 0.1, 0.6)
    with pytest.raises(InvalidParameter, match="protection"):
        limited(LOOP, -1, 1, "all")


INNER, OUTER, LIMITS, LOAD_AT = (2.0, 0.8), (0.6, 0.12), (-0.3, 0.7), 15.0  # Kp, Ki


def slopes(protection: str, yb, ya, xb, xa, d2, input_b, input_a):
    """One lag each, Gb = 1/(2 s + 1) and Ga = 1/(5 s + 1), PI in both loops; written out as theory has it.

    Slopes of (yb, ya, xb, xa), and the limited u. input_b, input_a: what the blocks get, u and yb where they have no
    dead time (None).
    """
    (Kb, Ib), (Ka, Ia) = INNER, OUTER
    r2 = Ka * (1.0 - ya) + xa
    u = Kb * (r2 - yb) + xb
    limited_u = min(max(u, LIMITS[0]), LIMITS[1])
    cut = limited_u - u
    back_b = cut / (Kb / Ib) if protection != "none" else 0.0
    back_a = cut / Kb / (Ka / Ia) if protection == "both" else 0.0
    into_b = limited_u + d2 if input_b is None else input_b
    into_a = yb if input_a is None else input_a
    return ((into_b - yb) / 2, (into_a - ya) / 5, Ib * (r2 - yb) + back_b, Ia * (1.0 - ya) + back_a), limited_u


def cascade(theta_b: float, theta_a: float) -> CascadeLoop:
    return CascadeLoop(Plant(1, theta_a, (5,)), Plant(1, theta_b, (2,)), ParallelPid(*OUTER), ParallelPid(*INNER))


@pytest.mark.parametrize("protection", PROTECTIONS)
def test_without_dead_time_against_a_general_integrator(protection):
    """RK45 of scipy, with u at its limits for a good part of the time. Order two: the error is below dt^2."""
    found = limited(cascade(0, 0), *LIMITS, protection, disturbance2=-0.4, disturbance2_time=LOAD_AT, t_end=40.0)

    def slope(t, x):
        return slopes(protection, *x, -0.4 * (t >= LOAD_AT), None, None)[0]

    first = solve_ivp(slope, (0, LOAD_AT), np.zeros(4), max_step=0.01, rtol=1e-9, atol=1e-11, dense_output=True)
    second = solve_ivp(slope, (LOAD_AT, 40), first.y[:, -1], max_step=0.01, rtol=1e-9, atol=1e-11, dense_output=True)
    x = np.where(found.t < LOAD_AT, first.sol(found.t), second.sol(found.t))
    assert np.mean(found.u == LIMITS[1]) > 0.1
    assert np.max(np.abs(found.y2 - x[0])) < found.t[1] ** 2
    assert np.max(np.abs(found.y - x[1])) < found.t[1] ** 2


@pytest.mark.parametrize("protection", PROTECTIONS)
def test_with_dead_times_against_a_difference_equation(protection):
    """Euler with steps of a thousandth, dead times as shifts of what was stored: first order, so half the step must
    halve the distance."""
    found = limited(cascade(0.5, 1.0), *LIMITS, protection, disturbance2=-0.4, disturbance2_time=LOAD_AT, t_end=40.0)
    distances = []
    for dt in (0.004, 0.002):
        n, back_b, back_a = round(40 / dt), round(0.5 / dt), round(1.0 / dt)
        x, u, yb = np.zeros((n + 1, 4)), np.zeros(n + 1), np.zeros(n + 1)
        for j in range(n):
            d2 = -0.4 * (j * dt >= LOAD_AT)
            yb[j] = x[j, 0]
            input_b = u[j - back_b] if j >= back_b else 0.0
            change, limited_u = slopes(protection, *x[j], d2, input_b, yb[j - back_a] if j >= back_a else 0.0)
            u[j] = limited_u + d2
            x[j + 1] = x[j] + dt * np.array(change)
        t = dt * np.arange(n + 1)
        y2, y = np.interp(found.t, t, x[:, 0]), np.interp(found.t, t, x[:, 1])
        distances.append(max(np.max(np.abs(found.y2 - y2)), np.max(np.abs(found.y - y))))
    assert np.mean(found.u == LIMITS[1]) > 0.1
    assert distances[0] < 5e-3
    assert distances[1] == pytest.approx(distances[0] / 2, rel=0.1)


@pytest.mark.parametrize("protection", PROTECTIONS)
def test_minutes_are_seconds_with_an_integrating_controller_inside(protection):
    """The tracking time of pure I action is a time too: 1/|K_I k|, not 1."""
    seconds = CascadeLoop(Plant(2.0, 2.0, (30.0,)), Plant(1.5, 3.0), IController(0.1), SeriesPid(1.0, 30.0))
    time = Fraction(1, 64)
    blocks = (each.rescaled(time) for each in (seconds.primary, seconds.secondary))
    other = CascadeLoop(*blocks, seconds.outer.rescaled(time), seconds.inner.rescaled(time))
    first = limited(seconds, -0.4, 0.6, protection, t_end=320.0)
    second = limited(other, -0.4, 0.6, protection, t_end=5.0)
    assert np.max(np.abs(first.y - second.y)) < 1e-12
    assert np.max(np.abs(first.u - second.u)) < 1e-12
