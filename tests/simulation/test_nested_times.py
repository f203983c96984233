"""Two-delay time responses against an independent computation in 40 digits, on the paper's ten pairs.

With both dead times taken out, the closed loop is a geometric series of rational functions: 1/(1 + Lb + Lb Ca Ga) =
sum over k, i of (-1)^k binomial(k, i) Lb^k (Ca Ga)^i e^{-(k theta_b + i theta_a) s}, of which only the terms with
k theta_b + i theta_a < t matter. Each is inverted on a Talbot contour in numbers of 50 digits; no code is shared.
"""

import math
from functools import cache

import gmpy2
import numpy as np
import pytest
from gmpy2 import mpc, mpfr

from simc_core import CascadeLoop, Loop, NestedLoops, ParallelPid, Plant, Scenario, SeriesPid, simulate
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.several_delays.network import network
from simc_core.simulation.several_delays.stepper import NestedStepper, steps_of
from tests.oracles.pairs import PAIRS

NODES = 32  # of the contour: about 1e-19 of the largest term of the series
MORE_NODES = 52  # for pair 9, whose terms grow to 1e18
DIGITS_50 = 170  # bits
# Ca and Cb (k, ki, kd, Tf), and b; published rows, and designs of the same kind for the pairs without one
SETTINGS = {
    1: ((0.5524, 0.1061, 0.4884, 0.1025), (3.3928, 0.8250, 3.7773, 0.0521), 0.3),
    2: ((1.3012, 0.6089, 0.7678, 0.0245), (1.1397, 8.5497, 0.0346, 0.0027), 1.0),
    3: ((0.5594, 0.0742, 0.6919, 1.7550), (4.1129, 1.8308, 2.4420, 0.0278), 0.41),
    4: ((2.0093, 0.3099, 2.1741, 1.7744), (1.5962, 0.7599, 0.2922, 0.0350), 0.5),
    5: ((2.2, 0.08, 3.0, 0.4), (0.6, 0.45, 0.1, 0.02), 0.2),
    6: ((1.3709, 0.1479, 0, 0), (15.614, 3.2769, 5.8002, 0.0765), 0.0),
    7: ((0.4893, 0.0344, 0.8416, 3.5781), (7.8047, 1.6374, 2.8983, 0.0765), 0.3),
    8: ((2.6181, 0.0551, 7.9475, 4.1722), (0.3428, 0.0665, 0.2912, 0.0543), 0.22),
    9: ((4.3017, 0.1594, 16.8979, 3.9792), (39.731, 92.327, 1.4584, 0.0071), 0.2),
    10: ((0.2086, 0.0305, 0.6076, 0.0585), (2.9959, 4.0580, 0.3078, 0.0141), 0.28),
}


def loop_of(pair: int) -> CascadeLoop:
    Ca, Cb, b = SETTINGS[pair]
    return CascadeLoop(*PAIRS[pair], ParallelPid(*Ca, b=b), ParallelPid(*Cb))


def rational(plant: Plant, s):
    """The plant without its dead time."""
    value = mpc(plant.k)
    for tau in plant.lags:
        value /= mpfr(tau) * s + 1
    return value / s**plant.integrators


def pid(settings, s, b=1, c=1):
    k, ki, kd, Tf = map(mpfr, settings)
    return (b * k + ki / s + c * kd * s) / (Tf * s + 1)


@cache
def contour(nodes):
    """Nodes and weights of the fixed Talbot method (Abate and Valko 2004), for t = 1: for others divided by t."""
    r = mpfr(2 * nodes) / 5
    found = [(mpc(r), mpc(gmpy2.exp(r) / 2 * r / nodes))]
    for j in range(1, nodes):
        angle = j * gmpy2.const_pi() / nodes
        cot = gmpy2.cot(angle)
        z = r * angle * (cot + 1j)
        found.append((z, gmpy2.exp(z) * (1 + 1j * (angle + (angle * cot - 1) * cot)) * r / nodes))
    return found


def series(pair: int, t: float) -> np.ndarray:
    """[y1, y2, u] x [r, d1, d2] at t."""
    Ga, Gb = PAIRS[pair]
    Ca, Cb, b = SETTINGS[pair]
    total = [[mpfr(0)] * 3 for _ in range(3)]
    for shift in ((0, 0), (0, 1), (1, 1), (1, 0)):  # dead times of Ga and of Gb in front of the series
        for k in range(400):
            if k * Gb.theta >= t:
                break
            for i in range(k + 1):
                later = mpfr(t) - (k + shift[1]) * mpfr(Gb.theta) - (i + shift[0]) * mpfr(Ga.theta)
                if later <= 0:
                    continue
                sign = (-1) ** k * math.comb(k, i)
                for z, weight in contour(MORE_NODES if pair == 9 else NODES):
                    s = z / later
                    ga, gb, cb = rational(Ga, s), rational(Gb, s), pid(Cb, s)
                    ca, car = pid(Ca, s), pid(Ca, s, b, 0)
                    term = sign * (cb * gb) ** k * (ca * ga) ** i / z * weight
                    for (row, column), value in numerators(shift, ga, gb, ca, car, cb).items():
                        total[row][column] += (term * value).real
    return np.array(total, dtype=float)


def numerators(shift, ga, gb, ca, car, cb):
    """Rows y1, y2, u, columns r, d1, d2, by the dead times (of Ga, of Gb) in front of them."""
    return {
        (0, 0): {(2, 0): cb * car},
        (0, 1): {(1, 0): cb * car * gb, (1, 2): gb, (2, 2): -cb * gb},
        (1, 1): {(0, 0): cb * car * gb * ga, (0, 2): ga * gb, (2, 2): -cb * ca * ga * gb, (0, 1): ga * cb * gb,
                 (1, 1): -cb * gb * ca * ga},
        (1, 0): {(0, 1): ga, (2, 1): -cb * ca * ga},
    }[shift]  # fmt: skip


def instants(pair: int) -> list[float]:
    """Between and beyond the first jumps, in units of both dead times; a short inner one makes a long series."""
    theta = PAIRS[pair][0].theta + PAIRS[pair][1].theta
    return [part * theta for part in {2: (0.35, 0.93, 1.27), 9: (0.2, 0.99, 1.03)}.get(pair, (0.61, 1.37, 2.4, 4.3))]


@pytest.mark.parametrize("pair", PAIRS)
def test_ten_pairs_against_forty_digits(pair):
    """y1, y2 and u for steps of r, d1 and d2, as `simulate` gives them."""
    loop, t = loop_of(pair), np.array(instants(pair))
    with gmpy2.context(precision=DIGITS_50):
        wanted = np.array([series(pair, each) for each in t])
    for column, name in enumerate(("setpoint", "disturbance", "disturbance2")):
        heights = {"setpoint": 0.0, "disturbance": 0.0, "disturbance2": 0.0, name: 1.0}
        times = {"disturbance_time": 0.0, "disturbance2_time": 0.0}
        found = simulate(loop, Scenario(t=t, **heights, **times))
        error = np.abs(np.array([found.y, found.y2, found.u]).T - wanted[:, :, column])
        assert np.max(error / np.maximum(1, np.abs(wanted[:, :, column]))) < 1e-9


@pytest.mark.parametrize("pair", PAIRS)
def test_integrals_to_the_end(pair):
    """y1 after a load step has the integral -1/k_ia times the change of the outer integrator: 1/k_ia for d1, 0 for d2
    [PSB]. Says that nothing is lost on the long way to rest, with elements of all lengths."""
    pieces = steps_of(loop_of(pair).nested).run(400 * sum(block.theta for block in PAIRS[pair]))
    y1 = pieces.coefficients[:, :, 1, :]
    even = np.array([1 / (1 - k**2) if k % 2 == 0 else 0.0 for k in range(P)])  # mean of T_k over [-1, 1]
    means = np.einsum("ikv,k->iv", y1, even)
    found = np.diff(pieces.edges) @ means
    scale = np.diff(pieces.edges) @ np.abs(means)
    k_ia = SETTINGS[pair][0][1]
    assert found[2] == pytest.approx(1 / k_ia, rel=1e-8)
    assert abs(found[1]) < 1e-8 * max(scale[1], 1 / k_ia)


def test_one_controller_round_both_blocks_is_a_single_loop():
    """Against the single-delay engine, which knows nothing of several delays."""
    Ga, Gb = PAIRS[1]
    C = ParallelPid(0.2, 0.03, 0.1, 0.05, b=0.7)
    t = np.linspace(0, 80, 801)
    wanted = simulate(Loop(Plant(2, 3, (5, 2, 3)), C), Scenario(t=t, disturbance_time=30.0))
    scenario = Scenario(t=t, disturbance=0.0, disturbance2_time=30.0)
    found = simulate(CascadeLoop(Ga, Gb, C, None), scenario)
    assert np.max(np.abs(found.y - wanted.y)) < 1e-10
    assert np.max(np.abs(found.u - wanted.u)) < 1e-10


@pytest.mark.parametrize("ratio", [4000, 137.3])
def test_a_tiny_inner_dead_time(ratio):
    """Ten times the work of the usual case at most, and the limit of no dead time is approached linearly."""
    Ga, Gb = Plant(2, 2, (5,)), Plant(1, 2 / ratio, (2, 3))
    Ca, Cb, b = SETTINGS[1]
    t = np.linspace(0.0, 40.0, 81)

    def steps_of(secondary: Plant) -> NestedStepper:
        steps = NestedStepper(network(NestedLoops((secondary, Ga), (ParallelPid(*Cb), ParallelPid(*Ca, b=b)))))
        steps.run(80.0)
        return steps

    usual, tiny, none = steps_of(Plant(1, 1, (2, 3))), steps_of(Gb), steps_of(Plant(1, 0, (2, 3)))
    assert tiny.count < 10 * usual.count
    assert len(tiny.maps) < 10 * len(usual.maps)
    half = steps_of(Plant(1, 1 / ratio, (2, 3)))
    y, y_half, y_none = (each.run(80.0)(t)[:, 1, 0] for each in (tiny, half, none))
    assert np.max(np.abs(y - y_none)) == pytest.approx(2 * np.max(np.abs(y_half - y_none)), rel=0.1)


def test_a_fast_filter_costs_no_elements():
    """Kd/tau_F = 1e5: u is the small difference of large numbers, and its rounding must not be taken for detail."""
    Gb, Ga = Plant(-0.216, 0.0114, (0.31, 0.47, 1.0), (0.36,)), Plant(2.15, 0.4, (2.8, 0.63), integrators=1)
    Cb, Ca = SeriesPid(-168.6, 0.0946, 0.4736, 0.000612), SeriesPid(0.2152, 8.632, 3.09, 0.0708)
    steps = NestedStepper(network(NestedLoops((Gb, Ga), (Cb, Ca))))
    assert steps.run(600.0)(np.array([600.0]))[0, 1, 0] == pytest.approx(1.0, abs=1e-9)
    assert steps.count < 150


def test_load_steps_settle_and_jumps_are_shown_from_both_sides():
    response = simulate(loop_of(6))
    jumps = np.flatnonzero(np.diff(response.t) == 0)
    assert jumps.size >= 3  # r, d1 and d2 at least
    assert abs(response.y[-1] - 1) < 0.02
    assert response.d2[-1] == response.d[-1] == 1.0
    assert response.d2[0] == response.r[0] == 0.0


def test_an_unstable_cascade_is_simulated_until_it_has_grown():
    loop = CascadeLoop(*PAIRS[1], ParallelPid(2.0, 0.5), ParallelPid(3.3928, 0.8250, 3.7773, 0.0521))
    assert np.max(np.abs(simulate(loop).y)) > 10
