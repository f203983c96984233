"""Cascades against closed forms and brute force; the published rows are in test_cascade_published.py."""

import math

import numpy as np
import pytest

from simc_core import (
    Plant,
    direct_synthesis,
    margins,
    performance,
    simc_cascade,
)
from simc_core.rules.direct_synthesis import numerator
from tests.oracles.pairs import PAIRS


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("K", "tau", "T", "lam"), [(2.0, 1.0, 5.0, 0.8), (0.5, 0.3, 20.0, 1.1)])
def test_closed_form_of_a_first_order_block(sign, K, tau, T, lam):
    """[PSB], K e^{-tau s}/(T s + sg)."""
    q = -sign / T
    eta = (math.exp(tau * q) * (lam * q + 1) ** 2 - 1) / q
    F1, F2, F3 = 2 * lam + tau - eta, lam**2 - tau**2 / 2 + eta * tau, tau**3 / 6 - eta * tau**2 / 2
    h0, r1, r2, a1, a2 = sign / (K * F1), F2 / F1, F3 / F1, sign * T + eta, sign * T * eta
    h1, h2 = h0 * (a1 - r1), h0 * (a2 - a1 * r1 + r1**2 - r2)
    block = Plant(sign * K, tau, (sign * T,))
    Tf = lam / 20
    assert numerator(block, lam) == pytest.approx([1, eta], rel=1e-12)
    found = direct_synthesis(block, lam)
    assert (found.Ki, found.Kp, found.Kd) == pytest.approx((h0, h1 + Tf * h0, h2 + Tf * h1), rel=1e-10)
    found = direct_synthesis(block, lam, "PI")
    assert (found.Ki, found.Kp, found.Kd, found.tau_F) == pytest.approx((h0, h1, 0, 0), rel=1e-10)


@pytest.mark.parametrize(("K", "tau", "lam"), [(1.0, 0.5, 0.7), (2.0, 2.0, 1.08611)])
def test_closed_form_of_an_integrating_block(K, tau, lam):
    """[PSB], K e^{-tau s}/s."""
    eta = 2 * lam + tau
    F2, F3 = lam**2 + 2 * lam * tau + tau**2 / 2, tau**3 / 6 - eta * tau**2 / 2
    F4 = -(tau**4) / 24 + eta * tau**3 / 6
    h0, r1, r2 = 1 / (K * F2), F3 / F2, F4 / F2
    h1, h2 = h0 * (eta - r1), h0 * (-eta * r1 + r1**2 - r2)
    found = direct_synthesis(Plant(K, tau, integrators=1), lam, tau_F=0.1)
    assert (found.Ki, found.Kp, found.Kd) == pytest.approx((h0, h1 + 0.1 * h0, h2 + 0.1 * h1), rel=1e-10)


def test_no_pole_of_a_block_is_cancelled():
    """F of the docstring vanishes at complex, double and unstable poles, and at s = 0 once more than they do."""
    block = Plant(1.5, 0.4, (3.0, 3.0, -8.0), lag_pairs=((2.0, 0.3),), integrators=1)
    lam, p = 0.9, 12
    eta = numerator(block, lam)

    def F(s):
        return (lam * s + 1) ** p - np.exp(-0.4 * s) * np.polyval(eta[::-1], s)

    step = 1e-4
    for pole in block.poles:
        assert abs(F(pole)) < 1e-9
    for double in (-1 / 3, 0.0):
        assert abs(F(double + step) - F(double - step)) / (2 * step) < 1e-5


def test_simc_cascade_tight():
    """Pair 1 and 3, PID inside and PI outside: settings, Msa, Msb and IAE in shared/cascade.md."""
    expected = {
        1: ((2.5, 0.5, 3.0), (0.3929, 0.0714), 1.777, 1.632, 14.00, 4.11),
        3: ((3, 1, 2), (0.5, 0.0625), 2.102, 1.632, 16.0, 3.24),
    }
    for pair, (inner, outer, Msa, Msb, IAE1, IAE2) in expected.items():
        design = simc_cascade(*PAIRS[pair], inner="PID")
        form, around = design.inner.to_parallel(), design.outer.to_parallel()
        assert (form.Kp, form.Ki, form.Kd) == pytest.approx(inner, rel=1e-12)
        assert (around.Kp, around.Ki) == pytest.approx(outer, abs=5e-5)
        assert design.inner.tau_F == pytest.approx(design.tau_c_inner / 20)
        found = performance(design.loop)
        assert margins(design.loop.outer_loop).Ms == pytest.approx(Msa, abs=1e-3)
        assert margins(design.loop.inner_loop).Ms == pytest.approx(Msb, abs=1e-3)
        assert pytest.approx(IAE1, rel=2e-3) == found.disturbance.IAE
        assert pytest.approx(IAE2, rel=2e-3) == found.disturbance2.IAE
        assert "tau_c_inner" in design.notes[0]


def test_simc_cascade_with_given_peaks():
    design = simc_cascade(*PAIRS[1], Ms_inner=1.5, Ms_outer=1.4)
    assert margins(design.loop.inner_loop).Ms == pytest.approx(1.5, rel=1e-8)
    assert margins(design.loop.outer_loop).Ms == pytest.approx(1.4, rel=1e-8)
    again = simc_cascade(*PAIRS[1], tau_c_inner=design.tau_c_inner, tau_c_outer=design.tau_c_outer)
    assert again.outer == design.outer


def test_IE_of_a_load_is_the_inverse_of_the_integral_gain():
    """IE_d1 = 1/k_ia where y1 stays on one side: IAE is the same; the tight design of pair 1 has IAE_d1 = 14."""
    assert pytest.approx(14.0, rel=1e-6) == performance(simc_cascade(*PAIRS[1], inner="PID").loop).disturbance.IAE
