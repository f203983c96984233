"""Polynomials as people type them, taken apart into gain, integrators, time constants and pairs."""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import inf, log, sqrt

import numpy as np

from simc_core import checks
from simc_core.algebra.exact_roots import polished
from simc_core.algebra.factors import quadratic_roots
from simc_core.algebra.square_free import Polynomial, square_free
from simc_core.errors import InvalidParameter
from simc_core.wording import said

CLUSTER_RADII = (0.1, 0.03, 0.01, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)  # relative; tried from coarse to fine
SAME_POLYNOMIAL = 1e-11  # two polynomials are one if every coefficient agrees to this


@dataclass(frozen=True, slots=True)
class Factors:
    """constant s^at_origin prod(times_i s + 1) prod(tau^2 s^2 + 2 zeta tau s + 1)."""

    constant: float
    at_origin: int
    times: tuple[float, ...]
    pairs: tuple[tuple[float, float], ...]


def factorise(name: str, polynomials: Iterable) -> Factors:
    """The product of `polynomials` (descending powers of s) as Factors.

    Factors of degree 1 and 2 are exact, and so are multiplicities of roots above that (square_free); roots that are one
    multiple root within rounding are taken as such, and others come from the companion matrix, polished (exact_roots).
    Raises InvalidParameter: empty, zero or non-finite coefficients, degree above checks.MOST_FACTORS.
    """
    constant, at_origin = 1.0, 0
    times: list[float] = []
    pairs: list[tuple[float, float]] = []
    for polynomial in polynomials:
        coefficients = _trimmed(name, polynomial)
        while coefficients[-1] == 0:
            coefficients, at_origin = coefficients[:-1], at_origin + 1
        constant *= coefficients[-1]
        _check_sizes(name, coefficients)
        exact = tuple(Fraction(c) for c in coefficients.tolist()[::-1])  # doubles are, and whole numbers stay whole
        more_times, more_pairs = _time_constants(_roots(exact))
        times += more_times
        pairs += more_pairs
    return Factors(checks.real(said("gain of the {name}", name=name), constant), at_origin, tuple(times), tuple(pairs))


def factorise_exact(name: str, polynomial: Polynomial) -> Factors:
    """The same of one polynomial in exact fractions, ascending powers of s, constant term 1."""
    _check_sizes(name, np.array([float(c) for c in reversed(polynomial)]))
    times, pairs = _time_constants(_roots(polynomial))
    return Factors(1.0, 0, tuple(times), tuple(pairs))


def _time_constants(roots: list[complex]) -> tuple[list[float], list[tuple[float, float]]]:
    times = [-1 / root.real for root in roots if root.imag == 0]
    return times, [(1 / abs(root), -root.real / abs(root)) for root in roots if root.imag > 0]


def _trimmed(name: str, polynomial: object) -> np.ndarray:
    given = checks.items(name, polynomial, checks.MOST_FACTORS + 1)
    values = [checks.real(said("{name} coefficient", name=name), value) for value in given]
    coefficients = np.trim_zeros(np.array(values), "f")
    if coefficients.size == 0:
        raise InvalidParameter(said("{name} must not be zero or empty, found {values}", name=name, values=values))
    return coefficients


def _check_sizes(name: str, coefficients: np.ndarray) -> None:
    """Refuse what no time constants within bounds can give, before it overflows."""
    degree = len(coefficients) - 1
    # logarithms: a product of forty of the longest times is no double any more
    sizes = [log(abs(c)) - log(abs(coefficients[-1])) if c else -inf for c in coefficients.tolist()]
    unit, room = log(checks.LONGEST_TIME), degree * log(2)
    too_large = any(size > room + (degree - i) * unit for i, size in enumerate(sizes))
    if degree > 1 and (too_large or sizes[0] < -degree * unit):
        raise InvalidParameter(
            said(
                "time constants of the {name} must be between {low:g} and {high:g}: "
                "coefficients of one polynomial must be of comparable size, found {first:g} to {last:g}",
                name=name,
                low=1 / checks.LONGEST_TIME,
                high=checks.LONGEST_TIME,
                first=coefficients[0],
                last=coefficients[-1],
            )
        )


def _roots(exact: Polynomial) -> list[complex]:
    """Of a polynomial in ascending powers of s."""
    coefficients = np.array([float(c) for c in reversed(exact)])
    degree = len(coefficients) - 1
    if degree == 0:
        return []
    if degree == 1:
        return [complex(-coefficients[1] / coefficients[0])]
    if degree == 2:
        return _quadratic(*coefficients)
    parts = square_free(exact)
    if len(parts) > 1 or parts[0][1] > 1:
        return [root for part, multiplicity in parts for root in _roots(part) for _ in range(multiplicity)]
    with np.errstate(all="ignore"):
        scale = (abs(coefficients[-1]) / abs(coefficients[0])) ** (1 / degree)
        scaled = coefficients * scale ** np.arange(degree, -1.0, -1.0)
        scaled = scaled / np.max(np.abs(scaled))
    if not np.all(np.isfinite(scaled)) or scaled[0] == 0:
        sizes = said("{first:g} to {last:g}", first=coefficients[0], last=coefficients[-1])
        raise InvalidParameter(
            said("coefficients of one polynomial must be of comparable size, found {sizes}", sizes=sizes)
        )
    roots = np.roots(scaled)
    merged = _merged(roots, scaled)
    if merged is not None:
        return [complex(root) * scale for root in merged]
    unit = Fraction(scale)
    apart = polished(tuple(c * unit**i for i, c in enumerate(exact)), roots.tolist())
    return [root * scale for root in apart]


def _quadratic(a: float, b: float, c: float) -> list[complex]:
    roots = quadratic_roots(a, b, c)
    if abs(roots[0] - roots[1]) < 1e-7 * abs(roots[0]):  # (10 s + 1)^2 typed as 100 s^2 + 20 s + 1
        double = -np.sign(b) * sqrt(c / a)
        return [complex(double)] * 2
    return list(roots)


def _merged(roots: np.ndarray, coefficients: np.ndarray) -> np.ndarray | None:
    """Roots with clusters replaced by their mean, where there are some and that is the same polynomial."""
    for radius in CLUSTER_RADII:
        candidate = _clustered(roots, radius)
        if len(np.unique(candidate)) == len(candidate):
            return None
        product = np.real(np.poly(candidate)) * coefficients[0]
        if np.allclose(product, coefficients, rtol=SAME_POLYNOMIAL, atol=0):
            return candidate
    return None


def _clustered(roots: np.ndarray, radius: float) -> np.ndarray:
    upper = roots[roots.imag >= 0]
    merged = []
    left = list(upper)
    while left:
        seed = left[0]
        near = [root for root in left if abs(root - seed) <= radius * abs(seed)]
        left = [root for root in left if abs(root - seed) > radius * abs(seed)]
        if any(abs(root.imag) <= radius * abs(root) for root in near):
            # a cluster on the real axis: its mirror images belong to it
            members = [*near, *(root.conjugate() for root in near if root.imag > 0)]
            merged += [complex(np.mean(members).real)] * len(members)
        else:
            centre = complex(np.mean(near))
            merged += [centre, centre.conjugate()] * len(near)
    return np.array(merged)
