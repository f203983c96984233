"""Dominant closed-loop poles of a loop with dead time, with their damping.

With L = (C (s - A)^-1 B + D) e^{-theta s} the loop is x' = A x - B z(t - theta), z = C x - D z(t - theta). What it
remembers is x and z on [t - theta, t]. On Chebyshev nodes 1 = u_0 > ... > u_N = -1 of that interval z is transported,
dz_j/dt = (2/theta) sum_k D_jk z_k with the Chebyshev differentiation matrix, fed at u_0 by z_0 = C x - D z_N:

    d/dt [x; z_1..z_N] = [[A, -B e_N'], [d C, D_11 - d D e_N']] [x; z_1..z_N],      d = column 0 of the matrix

(Breda, Maset and Vermiglio 2005: the discretised generator). Its eigenvalues approach the rightmost poles faster than
any power of N. Those of high frequency, a chain with one pole per turn of the dead time, start from their asymptotes
instead. Newton on 1 + L(s) = 0 takes all to full precision, and drops what is no pole. Poles that a zero of
the controller cancels are not in 1 + L: they are known exactly, and reported as well.
"""

from collections import Counter
from dataclasses import dataclass

import numpy as np

from simc_core.factors import Factored, factors
from simc_core.loop import Loop
from simc_core.realisation import chain

FEWEST_NODES, MOST_NODES = 20, 120
NODES_PER_RADIAN = 1.0  # beyond FEWEST_NODES, for theta omega of the fastest oscillation worth seeing
NEWTON_STEPS = 12
CHAIN_STEPS = 3
FAR_LEFT = -(2.0 ** np.arange(0.0, 6.0, 0.25))  # theta s of real poles that the discretisation has not resolved
SETTLED = 1e-12


@dataclass(frozen=True, slots=True)
class ClosedLoopPole:
    """s: the pole, Im s >= 0 (its conjugate is implied). zeta = -Re s/|s|, omega_n = |s|; zeta 0 at the origin.

    cancelled: a zero of the controller hides it from the set-point response; a load disturbance excites it.
    """

    s: complex
    zeta: float
    omega_n: float
    cancelled: bool = False


def dominant_poles(loop: Loop, most: int = 8) -> tuple[ClosedLoopPole, ...]:
    """At most `most` rightmost poles, from right to left, real ones and one of each complex pair.

    For display and cross-checks; `stability` does not rely on it. A loop without dynamics has none,
    nor has an improper one.
    """
    L = loop.L
    if L.relative_degree < 0:
        return ()
    reduced, hidden = _without_common(L)
    found = _polished(
        reduced, np.concatenate([rightmost(reduced)[: 16 + 4 * most], _chain_start(reduced, 8 + 2 * most)])
    )
    poles = [_described(s, False) for s in found] + [_described(s, True) for s in hidden if s.imag >= 0]
    return tuple(sorted(poles, key=_from_right)[:most])


def rightmost(L: Factored) -> np.ndarray:
    """Eigenvalues of the discretised generator, unpolished, from right to left: the closed-loop poles on the right
    are among them, those far to the left are not to be trusted. Exact where there is no dead time.
    """
    unit = L.theta or 1.0
    A, B, C, D = chain(L, unit)
    if L.theta == 0:
        generator = A - np.outer(B, C) / (1 + D)
    else:
        N = _nodes(L)
        derivative = 2 * _differentiation(N)
        n = len(A)
        generator = np.zeros((n + N, n + N))
        generator[:n, :n], generator[:n, -1] = A, -B
        generator[n:, :n] = np.outer(derivative[1:, 0], C)
        generator[n:, n:] = derivative[1:, 1:]
        generator[n:, -1] -= derivative[1:, 0] * D
    values = np.linalg.eigvals(generator) / unit
    return values[np.argsort(-values.real, kind="stable")]


def _nodes(L: Factored) -> int:
    """Enough Chebyshev nodes for the oscillations the loop can sustain: where |L| >= 1/2, and its resonances."""
    roots = np.abs(np.concatenate([L.poles, L.zeros, [1 / L.theta]]))
    omega = np.geomspace(0.1 / L.theta, max(roots.max(), 10 / L.theta), 60)
    sustained = omega[np.abs(L(1j * omega)) >= 0.5]
    resonances = [abs(pole) for pole in L.poles if abs(pole.real) < 0.3 * abs(pole.imag)]
    fastest = L.theta * max([*sustained, *resonances], default=0.0)
    return int(min(FEWEST_NODES + NODES_PER_RADIAN * fastest, MOST_NODES))


def _differentiation(N: int) -> np.ndarray:
    """Chebyshev differentiation matrix on cos(pi j/N), j = 0..N (Trefethen 2000, ch. 6)."""
    j = np.arange(N + 1)
    x = np.cos(np.pi * j / N)
    weight = np.where((j == 0) | (j == N), 2.0, 1.0) * (-1.0) ** j
    matrix = np.outer(weight, 1 / weight) / (x[:, None] - x + np.eye(N + 1))
    return matrix - np.diag(matrix.sum(axis=1))


def _without_common(L: Factored) -> tuple[Factored, np.ndarray]:
    """L without the factors its numerator and denominator share, and the poles these are."""
    top, bottom = (Counter(map(tuple, rows.tolist())) for rows in (L.num, L.den))
    reduced = Factored(L.gain, factors(*(top - bottom).elements()), factors(*(bottom - top).elements()), L.theta)
    return reduced, Factored(1.0, factors(), factors(*(top & bottom).elements())).poles


def _polished(L: Factored, start: np.ndarray) -> list[complex]:
    """Solutions of 1 + L = 0 in the upper half plane that Newton finds from `start`, each once."""
    s = start[start.imag >= 0].astype(complex)  # a copy
    step = np.zeros_like(s)
    with np.errstate(all="ignore"):
        for _ in range(NEWTON_STEPS):
            value = L(s)
            step = (1 + value) / (value * _log_derivative(L, s))
            s = s - step
            if np.all(np.abs(step) <= SETTLED * np.abs(s)):
                break
        good = np.abs(step) <= 1e-9 * np.abs(s)
    found: list[complex] = []
    for value in s[good]:
        value = complex(value.real, 0.0 if abs(value.imag) <= 1e-10 * abs(value) else abs(value.imag))
        if all(abs(value - other) > 1e-7 * abs(value) for other in found):
            found.append(value)
    return found


def _chain_start(L: Factored, count: int) -> np.ndarray:
    """First guesses for the poles that dead time adds, one per turn of its phase: theta s = log(-P(s)) + 2 pi j n,
    P = L e^{theta s}, by fixed-point steps, which contract at high frequency; n = 0 is on the real axis, far left.
    """
    if L.theta == 0:
        return np.array([], dtype=complex)
    P = Factored(L.gain, L.num, L.den)
    turns = 2j * np.pi * np.arange(1, count + 1)
    s = turns / L.theta
    for _ in range(CHAIN_STEPS):
        s = (np.log(-P(s)) + turns) / L.theta
    return np.concatenate([s[np.isfinite(s)], FAR_LEFT / L.theta])


def _log_derivative(L: Factored, s: np.ndarray) -> np.ndarray:
    """L'/L."""
    total = np.full_like(s, -L.theta)
    for rows, sign in ((L.num, 1), (L.den, -1)):
        for a, b, c in rows:
            total += sign * (2 * a * s + b) / ((a * s + b) * s + c)
    return total


def _described(s: complex, cancelled: bool) -> ClosedLoopPole:
    s = complex(s)
    return ClosedLoopPole(s, -s.real / abs(s) if s else 0.0, abs(s), cancelled)


def _from_right(pole: ClosedLoopPole) -> tuple[float, float]:
    """Rightmost first; of those in one line, which a neutral loop has, the slowest first."""
    return -float(f"{pole.s.real:.9g}"), pole.s.imag
