"""Collocation elements: what a short stretch of time does to states and signals, as constant matrices.

On an element of length h the states are a polynomial that satisfies x' = A x + B w + E v at the p Radau nodes
0 < c_1 < ... < c_p = 1 (Radau IIA, stiffly accurate, Hairer and Wanner, Solving ODE II, IV.5), w its values there:

    X_i = x_0 + h sum_j a_ij (A X_j + B w_j + E v)        a_ij = int_0^{c_i} l_j

Elements after a jump are short and grow. Mode lambda is resolved to TOLERANCE where e^{Re lambda t} (|lambda| h e/4p)^p
is: a Chebyshev expansion of e^{lambda h s} of p terms leaves about that much of what is left of the mode at t.
"""

import math

import numpy as np
from numpy.polynomial import chebyshev, legendre

from simc_core.errors import InvalidParameter
from simc_core.wording import said

NODES_PER_ELEMENT = 20  # P in the shapes of arrays
TOLERANCE = 1e-14
MOST_ELEMENTS = 4000


def _radau_nodes(p: int) -> np.ndarray:
    """Roots of P_{p-1}(x) - P_p(x) turned to (0, 1], the right Radau points."""
    difference = np.zeros(p + 1)
    difference[p - 1], difference[p] = 1.0, -1.0
    roots = np.sort(legendre.legroots(difference).real)
    slope, value = legendre.legder(difference), difference
    for _ in range(3):
        inner = roots[:-1]
        roots[:-1] = inner - legendre.legval(inner, value) / legendre.legval(inner, slope)
    roots[-1] = 1.0
    return (roots + 1) / 2


NODES = _radau_nodes(NODES_PER_ELEMENT)
TO_CHEBYSHEV = np.linalg.inv(chebyshev.chebvander(2 * NODES - 1, NODES_PER_ELEMENT - 1))  # nodal values -> coefficients
_INTEGRALS = np.array(
    [
        chebyshev.chebval(2 * NODES - 1, chebyshev.chebint(np.eye(NODES_PER_ELEMENT)[j], lbnd=-1)) / 2
        for j in range(NODES_PER_ELEMENT)
    ]
).T
COLLOCATION = _INTEGRALS @ TO_CHEBYSHEV  # a_ij


def mesh(modes: np.ndarray, length: float) -> np.ndarray:
    """Lengths of elements that fill `length` after a jump at its start which excites `modes` (complex, rad per time).

    Powers of two of `length`, growing.
    """
    size = np.abs(modes)
    modes, size = modes[size * length > 1e-3], size[size * length > 1e-3]
    if not len(modes):
        return np.array([length])
    reach = (4 * NODES_PER_ELEMENT / math.e * TOLERANCE ** (1 / NODES_PER_ELEMENT) / size).tolist()
    decay = (np.maximum(-modes.real, 0.0) / NODES_PER_ELEMENT).tolist()
    ends, steps = 0.0, []
    while ends < length * (1 - 1e-12):
        allowed = min([at * math.exp(min(rate * ends, 700.0)) for at, rate in zip(reach, decay, strict=True)])
        step = length * 2.0 ** math.floor(math.log2(min(allowed / length, 1.0)))
        while step > length - ends + 1e-12 * length:
            step /= 2
        steps.append(step)
        ends += step
        if len(steps) > MOST_ELEMENTS:
            radians = float(np.max(size)) * length
            raise InvalidParameter(
                said(
                    "the horizon must be at most about {most_elements} radians, found {radians:.3g}",
                    most_elements=4 * MOST_ELEMENTS,
                    radians=radians,
                )
            )
    return np.array(steps)
