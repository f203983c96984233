"""Magnitude and unbroken phase, as Bode diagrams show them."""

from dataclasses import dataclass

import numpy as np

from simc_core.factors import Factored


@dataclass(frozen=True, slots=True, eq=False)
class BodeCurve:
    """Arrays of shape (n,): omega in rad per time unit, |F|, and the phase of F in degrees, unbroken."""

    omega: np.ndarray
    magnitude: np.ndarray
    phase_deg: np.ndarray


def bode_curve(F: Factored, omega: np.ndarray) -> BodeCurve:
    """F(j omega): each factor's angle is continuous over omega > 0, so their sum needs no unwrapping."""
    s = 1j * omega
    phase = np.full(omega.shape, 0.0 if F.gain > 0 else -np.pi) - F.theta * omega
    for rows, sign in ((F.num, 1), (F.den, -1)):
        for a, b, c in rows:
            phase += sign * np.angle(c - a * omega**2 + 1j * b * omega)
    return BodeCurve(omega, np.abs(F(s)), np.rad2deg(phase))
