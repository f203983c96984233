"""Magnitude and unbroken phase, as Bode diagrams show them."""

from dataclasses import dataclass

import numpy as np

from simc_core.algebra.factors import Factored
from simc_core.loops.nested import NestedLoops


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


def nested_bode_curve(loop: NestedLoops, omega: np.ndarray) -> BodeCurve:
    """L of the outermost loop, the loops inside closed: L = own T, T = L'/(1 + L') of the loop inside.

    The phase of own is known factor by factor; that of 1 + L' is followed down from high frequencies, where L' is small
    and the angle near 0.
    """
    own = bode_curve(loop.own, omega)
    if loop.inside is None:
        return own
    inside = nested_bode_curve(loop.inside, omega)
    difference = 1 + inside.magnitude * np.exp(1j * np.deg2rad(inside.phase_deg))
    turned = np.rad2deg(np.unwrap(np.angle(difference[::-1]))[::-1])
    magnitude = own.magnitude * inside.magnitude / np.abs(difference)
    return BodeCurve(omega, magnitude, own.phase_deg + inside.phase_deg - turned)
