"""The closed-loop characteristic function of one or several feedback terms, scaled to be harmless on the contour.

Closed-loop poles are the zeros of 1 + sum_i F_i(s), F_i = g_i N_i(s)/D_i(s) e^{-theta_i s}, and the open-loop poles
that a zero cancels: over the common denominator D, with nothing cancelled, all of them are the zeros of

    D(s) + sum_i g_i N_i(s) R_i(s) e^{-theta_i s},      R_i = D/D_i.

Divided by D*, which is D with every factor replaced by a well damped one in the left half plane, this is

    f(s) = sum_k P_k(s),     P_0 = D/D*,   P_i = g_i N_i R_i e^{-theta_i s}/D*,

analytic in the right half plane and on its boundary, bounded there, with the same zeros. Factors
that D and D* share cancel exactly, and so does a stable zero of N_i that meets the same factor of D*: f is not
changed by that, and the pole it belongs to is in the left half plane.

The P_k have most of their factors in common. They are kept as one list of factors q_m and a table of exponents,

    P_k = g_k e^{-theta_k s} prod_m q_m(s)^{e_km},

so that each factor is evaluated once, and loops with the same table together.
"""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.algebra.factors import Factored, Row, product, rows_of

WELL_DAMPED = math.sqrt(2.0)  # b >= sqrt(2 a c): |a s^2 + b s + c| grows with omega all along the axis


@dataclass(frozen=True, slots=True)
class Characteristic:
    """f of the module docstring. rows: M factors (a, b, c).   exponents: K rows of M.   gains, thetas: K each.

    At infinity P_k e^{theta_k s} ~ leading_k s^(zeros - poles), the pair of degrees_k.
    limit: what the terms without dead time tend to at infinity.   delayed: sum of |limit| of the others.
    """

    rows: tuple[Row, ...]
    exponents: tuple[tuple[int, ...], ...]
    gains: tuple[float, ...]
    thetas: tuple[float, ...]
    leading: tuple[float, ...]
    degrees: tuple[tuple[int, int], ...]
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
    tops, bottoms = [rows_of(term.num) for term in terms], [rows_of(term.den) for term in terms]
    common = _union(bottoms)
    corner = _corner(terms, tops, bottoms, common)
    starred = [_starred(row, corner) for row in common]
    above = [common, *[top + _difference(common, bottom) for top, bottom in zip(tops, bottoms, strict=True)]]
    products = [_powers(each, starred) for each in above]
    gains = (1.0, *[term.gain for term in terms])
    ends = [_at_infinity(gain, powers) for gain, powers in zip(gains, products, strict=True)]
    excess = max([zeros - poles for _, (zeros, poles) in ends])
    if excess > 0:  # over s/corner + 1, until none of them grows at infinity
        extra = (0.0, 1 / corner, 1.0)
        for powers in products:
            powers[extra] = powers.get(extra, 0) - excess
        ends = [_at_infinity(gain, powers) for gain, powers in zip(gains, products, strict=True)]
    thetas = (0.0, *[term.theta for term in terms])
    flat = [(c, theta) for (c, (zeros, poles)), theta in zip(ends, thetas, strict=True) if zeros == poles]
    rows = tuple({row: None for powers in products for row, power in powers.items() if power})
    return Characteristic(
        rows,
        tuple([tuple([powers.get(row, 0) for row in rows]) for powers in products]),
        gains,
        thetas,
        tuple([leading for leading, _ in ends]),
        tuple([degrees for _, degrees in ends]),
        math.fsum([c for c, theta in flat if theta == 0]),
        math.fsum([abs(c) for c, theta in flat if theta > 0]),
    )


def shifted(term: Factored, sigma: float) -> Factored:
    """F(s + sigma): what was at Re s = sigma is now on the imaginary axis."""
    move = np.array([[1.0, 2 * sigma, sigma**2], [0.0, 1.0, sigma], [0.0, 0.0, 1.0]])
    return Factored(term.gain * math.exp(-term.theta * sigma), term.num @ move, term.den @ move, term.theta)


def _powers(top: Iterable[Row], bottom: Iterable[Row]) -> dict[Row, int]:
    """Exponent of each factor of a product over another."""
    powers: dict[Row, int] = {}
    for row in top:
        powers[row] = powers.get(row, 0) + 1
    for row in bottom:
        powers[row] = powers.get(row, 0) - 1
    return powers


def _at_infinity(gain: float, powers: dict[Row, int]) -> tuple[float, tuple[int, int]]:
    """c of P ~ c s^n e^{-theta s} at infinity, and the degrees of numerator and denominator, n their difference."""
    top, bottom, above, below = [], [], 0, 0
    for (a, b, c), power in powers.items():
        order = 2 if a else 1 if b else 0
        if power > 0:
            top += [a or b or c] * power
            above += order * power
        else:
            bottom += [a or b or c] * -power
            below -= order * power
    return product(gain, top, bottom), (above, below)


def _union(lists: Sequence[list[Row]]) -> list[Row]:
    """Smallest list that holds each of `lists`."""
    if len(lists) == 1:
        return lists[0]
    found: Counter[Row] = Counter()
    for rows in lists:
        found |= Counter(rows)
    return list(found.elements())


def _difference(rows: list[Row], less: list[Row]) -> list[Row]:
    left = list(rows)
    for row in less:
        left.remove(row)
    return left


def _starred(row: Row, corner: float) -> Row:
    """The same degree and size, all roots well inside the left half plane."""
    a, b, c = row
    if a:
        return abs(a), max(abs(b), WELL_DAMPED * math.sqrt(abs(a * c))), abs(c)
    return (0.0, abs(b), abs(c) or corner * abs(b)) if b else (0.0, 0.0, abs(c))


def _corner(terms: Sequence[Factored], tops: list[list[Row]], bottoms: list[list[Row]], common: list[Row]) -> float:
    """Frequency at which the integrators of the loop have gain 1: there s becomes s + corner."""
    at_origin = _at_origin(common)
    if at_origin:
        gains = [
            abs(product(term.gain, [c or b for _, b, c in top], [c or b for _, b, c in bottom]))
            for term, top, bottom in zip(terms, tops, bottoms, strict=True)
            if _at_origin(bottom) == at_origin and not _at_origin(top)
        ]
        if gains:
            return max(gains) ** (1 / at_origin)
    return 1 / max((term.theta for term in terms if term.theta), default=1.0)


def _at_origin(rows: list[Row]) -> int:
    return [c for _, _, c in rows].count(0.0)
