"""Multiple roots of polynomials with rational coefficients, exactly: square-free factorisation.

p = prod p_m^m, the roots of p_m being those of multiplicity m, from greatest common divisors alone [Yun 1976]:

    g = gcd(p, p')   w = p/g   y = p'/g   then z = y - w', p_m = gcd(w, z), w = w/p_m, y = z/p_m, m = 1, 2, ...

Eigenvalues spread an n-fold root over a circle of radius eps^(1/n), 2.5 % for n = 10; a root of p_m is simple.
"""

from fractions import Fraction

Polynomial = tuple[Fraction, ...]  # ascending powers of s, the last one not zero
MOST_BITS = 4000  # of the coefficients together, beyond which divisors would cost more than they are worth


def square_free(polynomial: Polynomial) -> list[tuple[Polynomial, int]]:
    """Factors whose roots are simple, each with the multiplicity of its roots; constants apart.

    Parameters
    ----------
    polynomial : tuple of Fraction, shape (n + 1,)
        Ascending powers of s, the last one not zero.

    Returns
    -------
    list of (polynomial, multiplicity)
        Their product, each to its power, is the polynomial divided by its leading coefficient. The polynomial itself
        where it has no multiple root, or where the coefficients are too long to look for one.
    """
    degree = len(polynomial) - 1
    if degree < 2 or sum(c.numerator.bit_length() + c.denominator.bit_length() for c in polynomial) > MOST_BITS:
        return [(_monic(polynomial), 1)]
    slope = _derivative(polynomial)
    common = _gcd(polynomial, slope)
    if len(common) == 1:
        return [(_monic(polynomial), 1)]
    w, y = _divided(polynomial, common)[0], _divided(slope, common)[0]
    found, multiplicity = [], 0
    while len(w) > 1:
        multiplicity += 1
        z = _difference(y, _derivative(w))
        part = _gcd(w, z) if z else w
        if len(part) > 1:
            found.append((_monic(part), multiplicity))
        w, y = _divided(w, part)[0], _divided(z, part)[0] if z else ()
    return found


def _derivative(p: Polynomial) -> Polynomial:
    return tuple(i * c for i, c in enumerate(p))[1:]


def _difference(p: Polynomial, q: Polynomial) -> Polynomial:
    size = max(len(p), len(q))
    terms = [(p[i] if i < len(p) else Fraction(0)) - (q[i] if i < len(q) else Fraction(0)) for i in range(size)]
    return _trimmed(terms)


def _gcd(p: Polynomial, q: Polynomial) -> Polynomial:
    while q:
        p, q = q, _divided(p, q)[1]
        q = _monic(q) if q else q  # or the coefficients grow without need
    return _monic(p)


def _divided(p: Polynomial, q: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Quotient and remainder; the remainder is () where there is none."""
    rest, quotient = list(p), [Fraction(0)] * max(len(p) - len(q) + 1, 1)
    for at in range(len(p) - len(q), -1, -1):
        factor = rest[at + len(q) - 1] / q[-1]
        quotient[at] = factor
        for i, c in enumerate(q):
            rest[at + i] -= factor * c
    return _trimmed(quotient), _trimmed(rest[: len(q) - 1])


def _monic(p: Polynomial) -> Polynomial:
    return tuple(c / p[-1] for c in p)


def _trimmed(terms: list[Fraction]) -> Polynomial:
    while terms and not terms[-1]:
        terms.pop()
    return tuple(terms)
