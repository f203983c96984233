"""The closed-loop characteristic function of one or several feedback terms, scaled to be harmless on the contour.

Closed-loop poles are the zeros of 1 + sum_i F_i(s), F_i = g_i N_i(s)/D_i(s) e^{-theta_i s}, and the open-loop poles
that a zero cancels: over the common denominator D, with nothing cancelled, all of them are the zeros of

    D(s) + sum_i g_i N_i(s) R_i(s) e^{-theta_i s},      R_i = D/D_i.

Divided by D*, which is D with every factor replaced by a well damped one in the left half plane, this is

    f(s) = sum_k P_k(s),     P_0 = D/D*,   P_i = g_i N_i R_i e^{-theta_i s}/D*,

analytic in the right half plane and on its boundary, bounded there, with the same zeros. Factors
that D and D* share cancel exactly, and so does a stable zero of N_i that meets the same factor of D*: f is not
changed by that, and the pole it belongs to is in the left half plane.
"""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.factors import Factored, factors

WELL_DAMPED = math.sqrt(2.0)  # b >= sqrt(2 a c): |a s^2 + b s + c| grows with omega all along the axis

Row = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Characteristic:
    """f = sum of `terms`, each with a denominator in the open left half plane (module docstring).

    limit: what the terms without dead time tend to at infinity.   delayed: sum of |limit| of the others.
    """

    terms: tuple[Factored, ...]
    limit: float
    delayed: float

    @property
    def neutral(self) -> float:
        """|L(inf)| of the delayed part: the loop is neutral where it is > 0, and hopeless where it is > 1."""
        if self.delayed == 0:
            return 0.0
        return self.delayed / abs(self.limit) if self.limit else math.inf


def characteristic(terms: Sequence[Factored]) -> Characteristic:
    """f for 1 + sum of `terms`. Factors that several terms have in common are taken to be the same block."""
    denominators = [Counter(_rows(term.den)) for term in terms]
    common: Counter[Row] = Counter()
    for rows in denominators:
        common |= rows
    corner = _corner(terms, common)
    starred = Counter(_starred(row, corner) for row in common.elements())
    products = [_over(1.0, common, starred, 0.0)]
    for term, rows in zip(terms, denominators, strict=True):
        products.append(_over(term.gain, Counter(_rows(term.num)) + (common - rows), starred, term.theta))
    products = _proper([product for product in products if product.gain], corner)
    limits = [limit_at_infinity(product) for product in products]
    return Characteristic(
        tuple(products),
        math.fsum(value for value, product in zip(limits, products, strict=True) if product.theta == 0),
        math.fsum(abs(value) for value, product in zip(limits, products, strict=True) if product.theta > 0),
    )


def shifted(term: Factored, sigma: float) -> Factored:
    """F(s + sigma): what was at Re s = sigma is now on the imaginary axis."""
    move = np.array([[1.0, 2 * sigma, sigma**2], [0.0, 1.0, sigma], [0.0, 0.0, 1.0]])
    return Factored(term.gain * math.exp(-term.theta * sigma), term.num @ move, term.den @ move, term.theta)


def log_leading(term: Factored) -> float:
    """log |c| of F ~ c s^{-n} e^{-theta s} at infinity."""
    return math.log(abs(term.gain)) + _log_sizes(term.num) - _log_sizes(term.den)


def sign_leading(term: Factored) -> float:
    """Sign of that c."""
    return float(np.prod(np.sign(_leading(term.num))) * np.prod(np.sign(_leading(term.den))) * np.sign(term.gain))


def limit_at_infinity(term: Factored) -> float:
    """Limit of F e^{theta s} at infinity, signed; 0 where F is strictly proper."""
    return 0.0 if term.relative_degree > 0 else sign_leading(term) * math.exp(log_leading(term))


def limit_at_origin(term: Factored) -> float:
    """k of F ~ k s^n at the origin, signed."""
    constants = [c or b for rows in (term.num, term.den) for _, b, c in _rows(rows)]
    return math.copysign(math.exp(_log_gain(term)), term.gain * math.prod(map(np.sign, constants)))


def _rows(array: np.ndarray) -> list[Row]:
    """Rows as tuples; s (a s + b) is taken apart, so that every zero at the origin is a factor of its own."""
    rows: list[Row] = []
    for a, b, c in array.tolist():
        if a and c == 0:
            rows += [(0.0, 1.0, 0.0), (0.0, a, b)]
        else:
            rows.append((a, b, c))
    return rows


def _starred(row: Row, corner: float) -> Row:
    """The same degree and size, all roots well inside the left half plane."""
    a, b, c = (abs(value) for value in row)
    if a:
        return a, max(b, WELL_DAMPED * math.sqrt(a * c)), c
    return (0.0, b, c or corner * b) if b else (0.0, 0.0, c)


def _corner(terms: Sequence[Factored], common: Counter[Row]) -> float:
    """Frequency at which the integrators of the loop have gain 1: there s becomes s + corner."""
    at_origin = sum(times for (*_, c), times in common.items() if c == 0)
    gains = [_log_gain(term) for term in terms if _at_origin(term.den) == at_origin and not _at_origin(term.num)]
    if at_origin and gains:
        return math.exp(max(gains) / at_origin)
    return 1 / max((term.theta for term in terms if term.theta), default=1.0)


def _at_origin(rows: np.ndarray) -> int:
    return sum(c == 0 for *_, c in _rows(rows))


def _log_gain(term: Factored) -> float:
    """log |k| of F ~ k/s^n at the origin."""
    top, bottom = ([abs(c or b) for _, b, c in _rows(rows)] for rows in (term.num, term.den))
    return math.log(abs(term.gain)) + math.fsum(map(math.log, top)) - math.fsum(map(math.log, bottom))


def _over(gain: float, top: Counter[Row], bottom: Counter[Row], theta: float) -> Factored:
    return Factored(gain, factors(*(top - bottom).elements()), factors(*(bottom - top).elements()), theta)


def _proper(products: list[Factored], corner: float) -> list[Factored]:
    """All products over further factors s/corner + 1, until none of them grows at infinity."""
    excess = max(0, *(-product.relative_degree for product in products))
    extra = factors(*[(0.0, 1 / corner, 1.0)] * excess)
    return [Factored(p.gain, p.num, np.concatenate([p.den, extra]), p.theta) for p in products]


def _leading(rows: np.ndarray) -> np.ndarray:
    return np.where(rows[:, 0] != 0, rows[:, 0], np.where(rows[:, 1] != 0, rows[:, 1], rows[:, 2]))


def _log_sizes(rows: np.ndarray) -> float:
    return float(np.sum(np.log(np.abs(_leading(rows)))))
