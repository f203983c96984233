"""What can be done where terms with different dead times were added."""

from fractions import Fraction

from simc_core.plants.parse_values import Value, degree, expanded, is_zero
from simc_core.wording import said


def advice(a: Value, b: Value, sign: int) -> str:
    """The way out for a + sign b, as a plant with one dead time that is close for slow changes where there is one.

    k1 e^{-t1 s} + k2 e^{-t2 s} and (k1 + k2) e^{-t s} with t = (k1 t1 + k2 t2)/(k1 + k2) agree at s = 0 in value and
    slope; k (e^{-t1 s} - e^{-t2 s}) and k (t2 - t1) s e^{-(t1 + t2) s/2} agree up to s^2.
    """
    common = said("take a common dead time out of the sum, as in (1/(s+1) + 2/(3s+1)) e^(-2s)")
    if degree(a) or degree(b) or is_zero(a) or is_zero(b) or min(a.theta, b.theta) < 0:
        return said(
            "{common}, or enter one term, or a model with one dead time fitted to the step response", common=common
        )
    k1, k2 = _constant(a), sign * _constant(b)
    if k1 * k2 > 0:
        middle = (k1 * a.theta + k2 * b.theta) / (k1 + k2)
        return said(
            "{common}; for slow changes this sum is close to {k1} e^(-{middle}s)",
            common=common,
            k1=_text(k1 + k2),
            middle=_text(middle),
        )
    if k1 == -k2:
        slope, middle = k1 * (b.theta - a.theta), (a.theta + b.theta) / 2
        return said(
            "{common}; for slow changes this difference is close to {slope} s e^(-{middle}s)",
            common=common,
            slope=_text(slope),
            middle=_text(middle),
        )
    return said("{common}, or enter the larger term alone", common=common)


def _constant(value: Value) -> Fraction:
    return expanded(value.num)[0] / expanded(value.den)[0]


def _text(number: Fraction) -> str:
    return f"{float(number):.6g}"
