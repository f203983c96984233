"""A product of factors as a chain of sections, each driving the next: never through polynomials of high order.

    section   (b2 s^2 + b1 s + b0)/(a s^2 + b s + c), of order two or one, in controllable form

The engine of the time responses works on the sections; a state space is there for those who need one.
"""

import math

import numpy as np

from simc_core.algebra.factors import Factored

Row = tuple[float, float, float]


def sections(F: Factored, unit: float = 1.0) -> list[tuple[Row, Row]]:
    """Numerators and denominators whose product is F/gain without its dead time, F proper; time in `unit`.

    Quadratics first, first-order factors multiplied in pairs, at most one of first order left, at the end: so no
    numerator has a higher degree than its denominator, and the last section is strictly proper if F is. First-order
    factors go from slow to fast: zeros and poles of one speed are in one section, and no signal between is too large.
    """
    num, den = _paired(F.num, unit), _paired(F.den, unit)
    num += [(0.0, 0.0, 1.0)] * (len(den) - len(num))
    return list(zip(num, den, strict=True))


def chain(F: Factored, unit: float = 1.0) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """A (n, n), B (n,), C (n,), D of x' = A x + B u, y = C x + D u for F without its dead time; time in `unit`."""
    parts = sections(F, unit)
    n = sum(2 if a else 1 for _, (a, _, _) in parts)
    A, B, C, D, used = np.zeros((n, n)), np.zeros(n), np.zeros(n), 1.0, 0
    for (b2, b1, b0), (a, b, c) in parts:
        size = 2 if a else 1
        rows, last = slice(used, used + size), used + size - 1
        lead = a or b  # coefficient of the highest power
        through = b2 / a if a else b1 / b
        A[last], B[last] = C / lead, D / lead  # u of this section is y of the one before
        A[last, rows] = (-c / a, -b / a) if a else (-c / b,)
        if a:
            A[used, last] = 1.0
        C, D = through * C, through * D
        C[rows] = (b0 - through * c, b1 - through * b) if a else (b0 - through * c,)
        used += size
    return A, B, F.gain * C, F.gain * D


def _paired(rows: np.ndarray, unit: float) -> list[Row]:
    scaled = [(a / unit**2, b / unit, c) for a, b, c in rows.tolist()]
    quadratics = [row for row in scaled if row[0]]
    linear = sorted([row for row in scaled if not row[0]], key=_slowness, reverse=True)
    while len(linear) > 1:
        (_, b1, c1), (_, b2, c2) = linear.pop(0), linear.pop(0)
        quadratics.append((b1 * b2, b1 * c2 + b2 * c1, c1 * c2))
    return quadratics + linear


def _slowness(row: Row) -> float:
    return abs(row[1] / row[2]) if row[2] else math.inf
