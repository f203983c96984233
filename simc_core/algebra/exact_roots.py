"""Simple roots of a polynomial with rational coefficients, as exact as doubles can say them.

Eigenvalues are good for the polynomial with rounded coefficients, and a root can be far more sensitive than that: of
prod (s + i), i = 1..36, half of them come back as complex pairs. With whole numbers for coefficients and roots,
multiples of 2^-bits, nothing is lost [Aberth 1973]:

    z_i <- z_i - N_i/(1 - N_i sum_{j != i} 1/(z_i - z_j))      N = p(z)/p'(z)

which converges from anywhere; a root on the real axis is reached from beside it.
"""

import cmath
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from simc_core.algebra.square_free import Polynomial

GOOD_ROOT = 1e-13  # relative distance to the nearest root, by one step of Newton: such an eigenvalue is left as it is
MOST_STEPS = 80
MOST_BITS = 4000  # of a root, beyond which it would take too long
LAST_STEP = 2.0**-60  # relative size of a last step
REAL = 2.0**-50  # relative: an imaginary part that is none
TURNED = 0.01  # radians: the first guesses leave the symmetry about the real axis, in which no pair could part

Whole = tuple[int, int]  # real and imaginary part


def polished(polynomial: Polynomial, guesses: Sequence[complex]) -> list[complex]:
    """The roots of `polynomial`, all of them simple, from as many guesses.

    polynomial: ascending powers of s, shape (n + 1,).   Returns n roots, in conjugate pairs; the guesses themselves
    where they are good, or where no better ones are found.
    """
    bits = _bits(polynomial)
    if bits > MOST_BITS:
        return list(guesses)
    p = [int(c * 2**bits) for c in polynomial]
    z = [_whole(each, bits) for each in guesses]
    if all(abs(_newton(p, each, bits)) <= GOOD_ROOT * abs(guess) for each, guess in zip(z, guesses, strict=True)):
        return list(guesses)
    z = [_whole(each * cmath.exp(1j * TURNED * (1 + i / len(z))), bits) for i, each in enumerate(guesses)]
    if not _settled(p, z, bits):
        return list(guesses)
    return _in_pairs([complex(x / 2**bits, y / 2**bits) for x, y in z]) or list(guesses)


def _bits(polynomial: Polynomial) -> int:
    """Enough for a value of the polynomial to be right near a root."""
    sizes = [abs(c.numerator).bit_length() - c.denominator.bit_length() for c in polynomial if c]
    return 200 + 3 * (max(sizes) - min(sizes))


def _settled(p: list[int], z: list[Whole], bits: int) -> bool:
    """Moves z to the roots; whether it has arrived."""
    moving = set(range(len(z)))
    for _ in range(MOST_STEPS):
        for i in list(moving):
            x, y = z[i]
            others = sum(_inverse(x - u, y - v, bits) for j, (u, v) in enumerate(z) if j != i)
            newton = _newton(p, z[i], bits)
            step = newton / (1 - newton * others)
            dx, dy = _whole(step, bits)
            z[i] = x - dx, y - dy
            if abs(step) <= LAST_STEP * abs(complex(x / 2**bits, y / 2**bits)):
                moving.discard(i)
        if not moving:
            return True
    return False


def _newton(p: list[int], z: Whole, bits: int) -> complex:
    """p(z)/p'(z)."""
    x, y = z
    a, b, da, db = p[-1], 0, 0, 0
    for c in reversed(p[:-1]):
        da, db = ((da * x - db * y) >> bits) + a, ((da * y + db * x) >> bits) + b
        a, b = ((a * x - b * y) >> bits) + c, (a * y + b * x) >> bits
    size = da * da + db * db
    return complex((a * da + b * db) / size, (b * da - a * db) / size) if size else 0j


def _inverse(x: int, y: int, bits: int) -> complex:
    size = x * x + y * y
    return complex((x << bits) / size, -(y << bits) / size) if size else 0j


def _whole(z: complex, bits: int) -> Whole:
    return int(Fraction(z.real) * 2**bits), int(Fraction(z.imag) * 2**bits)


def _in_pairs(roots: list[complex]) -> list[complex]:
    """Real ones without imaginary part, the others and their conjugates; empty where these are not as many."""
    real = [complex(z.real) for z in roots if abs(z.imag) <= REAL * abs(z)]
    upper = [z for z in roots if z.imag > REAL * abs(z)]
    found = [*real, *upper, *np.conj(upper).tolist()]
    return found if len(found) == len(roots) else []
