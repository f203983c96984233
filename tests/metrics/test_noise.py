"""The variance of u under white noise: a closed form with dead time, Lyapunov's equation without, a quadrature."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.linalg import solve_continuous_lyapunov

from simc_core import IController, IdealPid, Loop, NotStable, ParallelPid, Plant, SeriesPid, noise_variance


@pytest.mark.parametrize("K", [0.1, 1 / math.e, 1.0, 1.5])
def test_an_integral_controller_of_a_dead_time_has_a_closed_form(K):
    """x' = -K x(t - 1) from x(0) = 1 has int x^2 = (1 + sin K)/(2 K cos K), and h = K_I x."""
    k = 2.0
    exact = (K / k) ** 2 * (1 + math.sin(K)) / (2 * K * math.cos(K))
    assert noise_variance(Loop(Plant(k, 1.0), IController(K / k))) == pytest.approx(exact, rel=1e-9)


def test_without_dead_time_it_solves_the_equation_of_lyapunov():
    """1/(s + 1)^2 under (Kp + Ki/s)/(tau_F s + 1): KS as a state-space system, h^2 integrated by its Gramian."""
    Kp, Ki, tau_F = 1.5, 0.4, 0.3
    num = np.polymul([Kp, Ki], np.polymul([1, 1], [1, 1]))
    den = np.polyadd(np.polymul([tau_F, 1, 0], np.polymul([1, 1], [1, 1])), [Kp, Ki])
    num, den = num / den[0], den / den[0]
    n = len(den) - 1
    A = np.vstack([-den[1:], np.eye(n)[:-1]])
    B, C = np.eye(n)[:, :1], np.concatenate([np.zeros(n - len(num)), num])
    exact = float(C @ solve_continuous_lyapunov(A, -B @ B.T) @ C)
    loop = Loop(Plant(1, 0, (1, 1)), ParallelPid(Kp, Ki, 0.0, tau_F, b=0.3))
    assert noise_variance(loop) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize(
    "loop",
    [
        Loop(Plant(1, 1, (8,)), SeriesPid(4, 8, 0.0, 0.1)),
        Loop(Plant(-0.5, 1, integrators=1), IdealPid(-1.0, 8, 0.0, 0.3)),
        Loop(Plant(1, 0.5, (1,), (-0.5,)), SeriesPid(0.4, 1, 0.0, 0.2)),
    ],
    ids=["lag", "integrating, negative", "inverse response"],
)
def test_with_dead_time_it_is_the_integral_over_frequency(loop):
    """Piece by piece to Omega; beyond, |KS|^2 lies between |C|^2/(1 +- |L|)^2 and |C| between its two powers."""
    C, L, form = loop.controller.factored, loop.L, loop.controller.to_parallel()
    last = 4000.0
    edges = np.concatenate([[0.0], np.geomspace(1e-3, 1, 10), np.arange(3.0, last, 2.0), [last]])

    def density(omega):
        s = 1j * omega
        return abs(C(s) / (1 + L(s))) ** 2 / math.pi

    inside = sum(quad(density, a, b, epsrel=1e-11)[0] for a, b in pairwise(edges))
    beyond = form.Kp**2 / form.tau_F**2 / last / math.pi
    uncertain = 3 * abs(L(1j * last)) + 2 / (form.tau_F * last) ** 2
    assert noise_variance(loop) == pytest.approx(inside + beyond, abs=1e-8 * inside + uncertain * beyond)


def test_noise_without_filter_has_no_bound():
    assert noise_variance(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))) == math.inf
    assert noise_variance(Loop(Plant(1, 1, (8, 2)), SeriesPid(2, 8, 2, 0.1))) == math.inf


def test_a_loop_that_is_not_stable_has_no_variance():
    with pytest.raises(NotStable):
        noise_variance(Loop(Plant(1, 1), IController(2)))


@pytest.mark.parametrize("factor", [0.01, 60.0])
def test_it_falls_as_time_is_stretched(factor):
    one = noise_variance(Loop(Plant(2, 1, (3,)), SeriesPid(0.6, 3, 0.0, 0.2)))
    other = noise_variance(Loop(Plant(2, factor, (3 * factor,)), SeriesPid(0.6, 3 * factor, 0.0, 0.2 * factor)))
    assert other * factor == pytest.approx(one, rel=1e-8)
