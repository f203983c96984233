"""A state space for a product of factors, as a chain of sections: never through polynomials of high order.

    x' = A x + B u,   y = C x + D u

Each section of order two or one is in controllable form and drives the next; u and y are scalar.
"""

import numpy as np

from simc_core.factors import Factored


def chain(F: Factored, unit: float = 1.0) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """A (n, n), B (n,), C (n,), D of F without its dead time, F proper; time is measured in `unit`."""
    num, den = _sections(F.num, unit), _sections(F.den, unit)
    num += [(0.0, 0.0, 1.0)] * (len(den) - len(num))
    n = sum(2 if a else 1 for a, _, _ in den)
    A, B, C, D, used = np.zeros((n, n)), np.zeros(n), np.zeros(n), 1.0, 0
    for (b2, b1, b0), (a, b, c) in zip(num, den, strict=True):
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


def _sections(rows: np.ndarray, unit: float) -> list[tuple[float, float, float]]:
    """Factors as quadratics, first-order ones multiplied in pairs, at most one of first order left, at the end.

    With both lists in this order no numerator section has a higher degree than its denominator.
    """
    scaled = [(a / unit**2, b / unit, c) for a, b, c in rows]
    quadratics = [row for row in scaled if row[0]]
    linear = [row for row in scaled if not row[0]]
    while len(linear) > 1:
        (_, b1, c1), (_, b2, c2) = linear.pop(0), linear.pop(0)
        quadratics.append((b1 * b2, b1 * c2 + b2 * c1, c1 * c2))
    return quadratics + linear
