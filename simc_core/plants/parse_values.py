"""Transfer functions in exact fractions, as the parser builds them: products of polynomials and one dead time."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from simc_core import checks
from simc_core.algebra.polynomials import factorise_exact
from simc_core.algebra.square_free import square_free
from simc_core.errors import InvalidParameter
from simc_core.plants.plant import Plant
from simc_core.wording import said

MOST_PARTS = 200  # factors of a product, before the plant's own bound on poles speaks
MOST_BITS = 20_000  # of a coefficient on its way through powers and products

Polynomial = tuple[Fraction, ...]  # ascending powers of s
ONE: Polynomial = (Fraction(1),)
S: Polynomial = (Fraction(0), Fraction(1))


@dataclass(frozen=True, slots=True)
class Value:
    """prod(num)/prod(den) e^{-theta s}; at: where the first exponential stands."""

    num: tuple[Polynomial, ...]
    den: tuple[Polynomial, ...] = ()
    theta: Fraction = Fraction(0)
    at: int = 0


MINUS_ONE = Value(((Fraction(-1),),))


def plant_of(value: Value) -> Plant:
    """`value` as a plant; factors of first order and complex pairs to the last bit.

    Raises InvalidParameter where it is out of a plant's bounds.
    """
    if is_zero(value):
        raise InvalidParameter(said("k must not be zero, found 0"))
    gain = Fraction(1)
    found: dict[str, tuple[int, list[float], list[tuple[float, float]]]] = {}
    for name, polynomials in ((said("numerator"), value.num), (said("denominator"), value.den)):
        at_origin = 0
        times: list[float] = []
        pairs: list[tuple[float, float]] = []
        for polynomial in polynomials:
            zeros = next(i for i, c in enumerate(polynomial) if c)
            at_origin += zeros
            constant = polynomial[zeros]
            gain = gain * constant if name == "numerator" else gain / constant
            more_times, more_pairs = _time_constants(name, tuple(c / constant for c in polynomial[zeros:]))
            times += more_times
            pairs += more_pairs
        found[name] = (at_origin, times, pairs)
    (zeros, leads, lead_pairs), (poles, lags, lag_pairs) = found["numerator"], found["denominator"]
    if zeros > poles:
        raise InvalidParameter(
            said("numerator must not vanish at s = 0 (no gain to control with), found s^{zeros}", zeros=zeros - poles)
        )
    return Plant(
        _float("k", gain),
        _float("theta", value.theta),
        tuple(lags),
        tuple(leads),
        poles - zeros,
        tuple(lag_pairs),
        tuple(lead_pairs),
    )


def _time_constants(name: str, polynomial: Polynomial) -> tuple[list[float], list[tuple[float, float]]]:
    """Time constants and pairs of a polynomial with constant term 1; exact to the last bit up to degree 2."""
    field = said("coefficient of the {name}", name=name)
    if len(polynomial) == 1:
        return [], []
    if len(polynomial) == 2:
        return [_float(field, polynomial[1])], []
    if len(polynomial) == 3 and polynomial[1] ** 2 < 4 * polynomial[2]:
        tau = checks.positive_time("tau", math.sqrt(_float(field, polynomial[2])))
        return [], [(tau, float(polynomial[1] / (2 * Fraction(tau))))]
    for coefficient in polynomial:
        _float(field, coefficient)
    parts = square_free(polynomial)
    if len(parts) == 1 and parts[0][1] == 1:
        factors = factorise_exact(name, polynomial)
        return list(factors.times), list(factors.pairs)
    times: list[float] = []
    pairs: list[tuple[float, float]] = []
    for part, multiplicity in parts:
        more_times, more_pairs = _time_constants(name, tuple(c / part[0] for c in part))
        times += more_times * multiplicity
        pairs += more_pairs * multiplicity
    return times, pairs


def _float(name: str, value: Fraction) -> float:
    try:
        return float(value)
    except OverflowError:
        raise InvalidParameter(
            said(
                "|{name}| must be <= {largest_gain:g}, found more than 1e308",
                name=name,
                largest_gain=checks.LARGEST_GAIN,
            )
        ) from None


def constant(number: Fraction) -> Value:
    """A number as a value."""
    return Value(((number,),))


def polynomial(descending: Sequence[Fraction]) -> Value:
    """A polynomial given by its coefficients in descending powers of s."""
    return Value((_trimmed(tuple(reversed(descending))),))


def number_of(value: Value) -> Fraction | None:
    """The number that `value` is; None if s or a dead time is in it."""
    if value.theta or degree(value):
        return None
    return expanded(value.num)[0] / expanded(value.den)[0]


def is_zero(value: Value) -> bool:
    """Whether one of the factors above is zero."""
    return any(not any(polynomial) for polynomial in value.num)


def degree(value: Value) -> int:
    """Degrees of all polynomials together."""
    return sum(len(polynomial) - 1 for polynomial in (*value.num, *value.den))


def too_large(value: Value) -> str:
    """What is too large to go on working with, in words; empty if nothing is."""
    if len(value.num) > MOST_PARTS or len(value.den) > MOST_PARTS:
        return said("a product must have at most {most_parts} factors", most_parts=MOST_PARTS)
    for polynomial in (*value.num, *value.den):
        if len(polynomial) > checks.MOST_FACTORS + 1:
            return said("the degree of a polynomial must be <= {most_factors}", most_factors=checks.MOST_FACTORS)
        if any(c.numerator.bit_length() + c.denominator.bit_length() > MOST_BITS for c in polynomial):
            return said("numbers here grow beyond all bounds")
    return ""


def times(a: Value, b: Value) -> Value:
    """a b, with the factors kept apart."""
    return Value(a.num + b.num, a.den + b.den, a.theta + b.theta, a.at if a.theta else b.at)


def inverse(value: Value) -> Value:
    """1/value."""
    return Value(value.den or (ONE,), value.num, -value.theta, value.at)


def plus(a: Value, b: Value, sign: int) -> Value:
    """a + sign b over the common denominator, for equal dead times."""
    top_a, top_b = expanded(a.num + b.den), expanded(b.num + a.den)
    size = max(len(top_a), len(top_b))
    padded = [(*p, *[Fraction(0)] * (size - len(p))) for p in (top_a, top_b)]
    total = tuple(x + sign * y for x, y in zip(*padded, strict=True))
    return Value((_trimmed(total),), a.den + b.den, a.theta, a.at)


def expanded(polynomials: tuple[Polynomial, ...]) -> Polynomial:
    """The product, multiplied out."""
    product = ONE
    for polynomial in polynomials:
        terms = [Fraction(0)] * (len(product) + len(polynomial) - 1)
        for i, x in enumerate(product):
            for j, y in enumerate(polynomial):
                terms[i + j] += x * y
        product = tuple(terms)
    return product


def _trimmed(polynomial: Polynomial) -> Polynomial:
    size = next((i + 1 for i in range(len(polynomial) - 1, -1, -1) if polynomial[i]), 1)
    return polynomial[:size]
