"""Integrals of loops whose last part is very small and very slow, against closed forms."""

import math

import mpmath
import pytest

from simc_core import Loop, Plant, SeriesPid, performance


def without_delay(tau: float, Kc: float, tau_I: float) -> tuple[float, float]:
    """IAE and ITAE of a set-point step of 1/(tau s + 1) under PI, e = a e^{pt} + b e^{qt} with both poles real.

    e(0) = 1, e'(0) = -Kc/tau. In 50 digits, since a may be 1e-10.
    """
    with mpmath.workdps(50):
        tau, Kc, tau_I = map(mpmath.mpf, (tau, Kc, tau_I))
        root = mpmath.sqrt((1 + Kc) ** 2 - 4 * tau * Kc / tau_I)
        p, q = (-(1 + Kc) + root) / (2 * tau), (-(1 + Kc) - root) / (2 * tau)
        a = (-Kc / tau - q) / (p - q)
        b = 1 - a
        zero = mpmath.log(-b / a) / (p - q) if a * b < 0 else 0

        def beyond(t, moment: bool):  # int_t^inf of e, or of t e
            parts = [(-size * mpmath.exp(rate * t) / rate, rate) for size, rate in ((a, p), (b, q))]
            return sum(area * (t - 1 / rate) if moment else area for area, rate in parts)

        zero = max(zero, 0)
        found = [abs(beyond(0, moment) - beyond(zero, moment)) + abs(beyond(zero, moment)) for moment in (False, True)]
        return float(found[0]), float(found[1])


@pytest.mark.parametrize("ratio", [1e1, 1e3, 1e4, 1e5, 1e6])
@pytest.mark.parametrize("unit", [1e-2, 1.0, 1e2])
def test_a_slow_mode_counts_to_its_end(ratio, unit):
    """High gain and a slow integral: the tail is 1/(Kc ratio) high and lasts ratio times longer than the rise."""
    tau, Kc, tau_I = unit, 20.0, ratio * unit
    IAE, ITAE = without_delay(tau, Kc, tau_I)
    found = performance(Loop(Plant(1.0, 0.0, (tau,)), SeriesPid(Kc, tau_I))).setpoint
    assert math.isfinite(found.ITAE) or ratio > 1e4
    assert pytest.approx(IAE, rel=1e-6) == found.IAE
    assert math.isnan(found.ITAE) or pytest.approx(ITAE, rel=1e-6) == found.ITAE


@pytest.mark.parametrize("amount", [1e-4, 1e-6, 1e-8, 1e-9, 1e-10])
@pytest.mark.parametrize("unit", [1e-2, 1.0, 1e2])
def test_a_tiny_slow_tail_of_a_nearly_cancelled_pole(amount, unit):
    """tau = tau_I (1 + amount): the pole near -1/tau is almost hidden from the set point."""
    tau, Kc = 1000.0 * unit, 5000.0
    IAE, ITAE = without_delay(tau * (1 + amount), Kc, tau)
    found = performance(Loop(Plant(1.0, 0.0, (tau * (1 + amount),)), SeriesPid(Kc, tau))).setpoint
    assert pytest.approx(IAE, rel=1e-6) == found.IAE
    assert math.isnan(found.ITAE) or pytest.approx(ITAE, rel=1e-6) == found.ITAE
