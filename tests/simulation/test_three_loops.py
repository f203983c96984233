"""Three nested loops against methods that share no code with them: integration interval by interval, dense grids, and
the argument principle on a contour beside the imaginary axis."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from simc_core import (
    Loop,
    NestedLoops,
    NotStable,
    ParallelPid,
    Plant,
    direct_synthesis,
    frequency_response,
    margins,
    performance,
    stability,
)
from simc_core.simulation.several_delays.stepper import steps_of

K, THETA, TAU = (1.0, 2.0, 1.5), (0.2, 0.4, 1.0), (0.5, 3.0, 20.0)  # first-order blocks, from the inside out
BLOCKS = tuple(Plant(k, theta, (tau,)) for k, theta, tau in zip(K, THETA, TAU, strict=True))
STEP = 0.2  # all dead times are multiples of it: within one step nothing that is delayed is unknown


def designed() -> NestedLoops:
    """From the inside out by direct synthesis, PI."""
    C1 = direct_synthesis(BLOCKS[0], 0.3, "PI")
    C2 = direct_synthesis(BLOCKS[1], 1.0, "PI", inside=Loop(BLOCKS[0], C1))
    C3 = direct_synthesis(BLOCKS[2], 3.0, "PI", inside=NestedLoops(BLOCKS[:2], (C1, C2)), b=0.6)
    return NestedLoops(BLOCKS, (C1, C2, C3))


def turned(gain: float) -> NestedLoops:
    """The same with the outermost controller `gain` times as strong."""
    loops = designed()
    C3 = loops.controllers[2]
    return NestedLoops(BLOCKS, (*loops.controllers[:2], ParallelPid(C3.Kp * gain, C3.Ki * gain, b=C3.b)))


LOOPS = designed()
GAINS = [(C.Kp, C.Ki) for C in LOOPS.controllers]


def open_loops(s):
    """L1, L2, L3 at s, each with the loops inside closed, written out."""
    closed, found = 1.0, []
    for (Kp, Ki), k, theta, tau in zip(GAINS, K, THETA, TAU, strict=True):
        L = (Kp + Ki / s) * k * np.exp(-theta * s) / (tau * s + 1) * closed
        found.append(L)
        closed = L / (1 + L)
    return found


def integrated(r: float, d: tuple[float, float, float], steps: int, per_step: int) -> np.ndarray:
    """y1, y2, y3, u1 on a grid of STEP/per_step: DOP853 from one multiple of STEP to the next, the delayed inputs of
    the blocks read from the dense output of earlier ones."""
    past = []

    def controls(y, xi):
        set_point, u = r, [0.0] * 3
        for i in (2, 1, 0):
            b = 0.6 if i == 2 else 1.0
            u[i] = GAINS[i][0] * (b * set_point - y[i]) + xi[i]
            set_point = u[i]
        return u

    def inputs(x):
        y, xi = x[:3], x[3:]
        return [controls(y, xi)[0] + d[0], y[0] + d[1], y[1] + d[2]]

    def delayed(i, j, t):
        """Input of block i at t - theta, t in step j."""
        back = j - round(THETA[i] / STEP)
        return inputs(past[back](t - THETA[i]))[i] if back >= 0 else 0.0

    x, found = np.zeros(6), []
    for j in range(steps):

        def slope(t, x, j=j):
            y, xi = x[:3], x[3:]
            u = controls(y, xi)
            goals = (u[1], u[2], r)
            dy = [(K[i] * delayed(i, j, t) - y[i]) / TAU[i] for i in range(3)]
            return [*dy, *(GAINS[i][1] * (goals[i] - y[i]) for i in range(3))]

        span = (j * STEP, (j + 1) * STEP)
        run = solve_ivp(slope, span, x, "DOP853", rtol=1e-11, atol=1e-13, dense_output=True)
        past.append(run.sol)
        for t in np.linspace(*span, per_step, endpoint=False):
            at = run.sol(t)
            found.append([*at[:3], controls(at[:3], at[3:])[0]])
        x = run.y[:, -1]
    return np.array(found)


@pytest.mark.parametrize("column", range(4), ids=["r", "d1", "d2", "d3"])
def test_time_responses(column):
    steps, per_step = 30, 4
    r, d = float(column == 0), tuple(float(column == i) for i in (1, 2, 3))
    wanted = integrated(r, d, steps, per_step)
    t = STEP / per_step * np.arange(steps * per_step)
    found = steps_of(LOOPS).run(t[-1])(t)[:, :4, column]  # y1, y2, y3, u1
    assert np.max(np.abs(wanted)) > 0.1
    assert np.max(np.abs(found - wanted)) < 1e-8


def test_frequency_response_and_margins_of_the_outermost_loop():
    omega = np.geomspace(1e-3, 1e2, 400_001)
    L = open_loops(1j * omega)[2]
    assert pytest.approx(L[::4000], rel=1e-10) == frequency_response(LOOPS, omega[::4000]).L
    found = margins(LOOPS)
    assert found.Ms == pytest.approx(np.max(np.abs(1 / (1 + L))), rel=1e-7)
    assert found.Mt == pytest.approx(max(1.0, np.max(np.abs(L / (1 + L)))), rel=1e-7)
    phase, size = np.unwrap(np.angle(L)), np.abs(L)
    i = np.flatnonzero((size[1:] < 1) & (size[:-1] >= 1))
    assert len(i) == 1
    assert found.PM_deg == pytest.approx(180 + np.degrees(phase[i[0]]), abs=0.01)
    assert found.omega_c == pytest.approx(omega[i[0]], rel=1e-4)
    crossing = np.flatnonzero((L.imag[1:] > 0) & (L.imag[:-1] <= 0) & (L.real[1:] < 0))[0]
    assert pytest.approx(1 / size[crossing], rel=1e-3) == found.GM
    assert found.omega_180 == pytest.approx(omega[crossing], rel=1e-3)


def counted(gain: float) -> int:
    """Closed-loop poles right of Re s = 1e-4, by how often (1 + L1)(1 + L2)(1 + L3) goes round 0 on that line.

    Written over the open-loop poles, all of which lie left of the line, it has no poles to the right of it; far out
    it tends to 1. The line is sampled so densely that the phase can be unwrapped.
    """
    omega = np.concatenate([np.linspace(0, 2, 400_001), np.geomspace(2, 1e4, 400_001)[1:]])
    s = 1e-4 + 1j * omega
    terms, product = [], 1.0
    for (Kp, Ki), k, theta, tau, factor in zip(GAINS, K, THETA, TAU, (1, 1, gain), strict=True):
        product = product * factor * (Kp + Ki / s) * k * np.exp(-theta * s) / (tau * s + 1)
        terms.append(product)
    angle = np.unwrap(np.angle(1 + sum(terms)))
    return round(-(angle[-1] - angle[0]) / np.pi)


def test_stability_against_another_count():
    GM = margins(LOOPS).GM
    counts = {gain: counted(gain) for gain in (1.0, 0.99 * GM, 1.01 * GM, 3 * GM, 300 * GM)}
    assert counts[0.99 * GM] == 0 < counts[1.01 * GM] < counts[300 * GM]
    for gain, poles in counts.items():
        found = stability(turned(gain))
        assert found.unstable_poles == poles
        assert found.verdict == ("unstable" if poles else "stable")
        assert found.inner.verdict == found.inner.inner.verdict == "stable"


def test_metrics():
    """IE of a load is the change of the outermost integral over its gain: 1/Ki at the block next to it, else 0; what
    does not change sign has it as IAE."""
    found = performance(LOOPS)
    assert len(found.disturbances) == 3
    assert 1 / GAINS[2][1] * (1 - 1e-9) <= found.disturbance.IAE
    assert found.disturbance.peak > found.disturbances[1].peak > found.disturbance2.peak > 0
    assert found.setpoint.settling_time < 60
    with pytest.raises(NotStable):
        performance(turned(2 * margins(LOOPS).GM))
