"""PI control of pure dead time, G = e^{-s}: every stable loop is measured; y is a polynomial between whole times."""

import numpy as np
import pytest

from simc_core import Loop, Plant, SeriesPid, margins, performance, stability

GAINS = np.linspace(0.05, 0.6, 18)
TIMES = np.linspace(0.15, 1.5, 19)


def integral_of_error(Kc: float, tau_I: float, h: float = 1e-3) -> float:
    """int (r - y) dt after a step of r: y(t) = u(t - 1), u = Kc e + (Kc/tau_I) int e, in steps of h by trapezium."""
    n = round(1 / h)
    u, total, e_before = np.zeros(n), 0.0, 1.0
    integral, errors = 0.0, []
    for k in range(200 * n):
        e = 1.0 - u[k % n]
        integral += h * (e + e_before) / 2 if k else 0.0
        u[k % n] = Kc * e + Kc / tau_I * integral
        e_before = e
        errors.append(e)
        if k > 5 * n and k % n == 0 and np.max(np.abs(1.0 - u)) < 1e-9:
            break
    total = np.trapezoid(errors, dx=h)
    return float(total)


def test_every_stable_loop_is_measured():
    refused = []
    for Kc in GAINS:
        for tau_I in TIMES:
            loop = Loop(Plant(1, 1), SeriesPid(Kc, tau_I))
            if stability(loop).verdict == "stable" and margins(loop).Ms < 10:
                measured = performance(loop)
                if not tau_I / Kc * (1 - 1e-9) <= measured.setpoint.IAE:  # int e is tau_I/Kc, whatever the signs of e
                    refused.append((Kc, tau_I))
    assert not refused


def test_the_loop_that_was_refused():
    loop = Loop(Plant(1, 1), SeriesPid(0.2, 0.32))
    assert margins(loop).Ms == pytest.approx(1.5946, abs=5e-5)
    assert pytest.approx(1.6, rel=1e-6) == performance(loop).setpoint.IAE  # tau_I/Kc: e does not change sign
    assert integral_of_error(0.2, 0.32) == pytest.approx(1.6, rel=2e-3)
