"""Dominant closed-loop poles of a loop with dead time, with their damping.

With L = (C (s - A)^-1 B + D) e^{-theta s} the loop is x' = A x - B z(t - theta), z = C x - D z(t - theta). What it
remembers is x and z on [t - theta, t]. On Chebyshev nodes 1 = u_0 > ... > u_N = -1 of that interval z is transported,
dz_j/dt = (2/theta) sum_k D_jk z_k with the Chebyshev differentiation matrix, fed at u_0 by z_0 = C x - D z_N:

    d/dt [x; z_1..z_N] = [[A, -B e_N'], [d C, D_11 - d D e_N']] [x; z_1..z_N],      d = column 0 of the matrix

(Breda, Maset and Vermiglio 2005: the discretised generator). Its eigenvalues approach the rightmost poles faster than
any power of N. Those of high frequency, a chain with one pole per turn of the dead time, start from their asymptotes
instead, and so do those about a resonance. Newton on 1 + L(s) = 0 takes all to full precision, and drops what is no
pole. Poles that a zero of the controller cancels are not in 1 + L: they are known exactly, and reported as well.

That none is missing is for the certificate to say: with the imaginary axis moved to between two of the poles it counts
those on the right of it. The list ends where they are not as many.
"""

from bisect import bisect_left
from dataclasses import dataclass

import numpy as np

from simc_core.algebra.factors import Factored, factors, without_common
from simc_core.algebra.state_space import chain
from simc_core.certificate.characteristic import shifted
from simc_core.certificate.verdict import count_unstable
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.loops.well_posed import is_well_posed

FEWEST_NODES, MOST_NODES = 20, 120
NODES_PER_RADIAN = 1.0  # beyond FEWEST_NODES, for theta omega of the fastest oscillation worth seeing
NEWTON_STEPS = 12
CHAIN_STEPS = 3
FAR_LEFT = -(2.0 ** np.arange(0.0, 6.0, 0.25))  # theta s of real poles that the discretisation has not resolved
ABOUT = 8  # turns on either side of a resonance
BESIDE = 1e-6 * (1 + 1j)  # relative distance from an open-loop pole, on which L is infinite
LAST_STEP = 1e-12  # of Newton, relative
APART = 1e-6  # relative, of the real parts of two poles between which there is room for the axis
SAME_COEFFICIENT = 1e-14  # relative, of coefficients that were the same before they were rounded


@dataclass(frozen=True, slots=True)
class ClosedLoopPole:
    """A pole of the closed loop; of a complex pair the one above the real axis.

    Attributes
    ----------
    s : complex
        The pole, in rad per time unit, Im s >= 0.
    zeta : float
        -Re s/abs(s); 0 at the origin.
    omega_n : float
        abs(s), in rad per time unit.
    cancelled : bool
        A zero of the controller hides it from the set-point response; a load disturbance excites it.
    """

    s: complex
    zeta: float
    omega_n: float
    cancelled: bool = False


def dominant_poles(loop: Loop, most: int = 8) -> tuple[ClosedLoopPole, ...]:
    """The rightmost closed-loop poles, from right to left: real ones, and one of each complex pair.

    None is left out: the list ends early where the certificate counts more poles than were found. A loop without
    dynamics has none, nor has an improper one; of a neutral one, those to the right of its line, or on it.

    Parameters
    ----------
    loop : Loop
        A single loop.
    most : int
        How many at most.

    Returns
    -------
    tuple of ClosedLoopPole
        In rad per time unit.

    Examples
    --------
    Poles under L = e^{-s}/(2 s) solve s e^s = -1/2: Lambert's W. The lag that the controller cancels is one too:

    >>> from simc_core import Loop, Plant, SeriesPid, dominant_poles
    >>> cancelled, slowest = dominant_poles(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)), most=2)
    >>> cancelled.s, complex(round(slowest.s.real, 6), round(slowest.s.imag, 6))
    ((-0.125+0j), (-0.794024+0.770112j))
    """
    L = loop.L
    if L.relative_degree < 0:
        return ()
    reduced, hidden = _without_common(L)
    found = _polished(
        reduced, np.concatenate([rightmost(reduced)[: 16 + 4 * most], _chain_start(reduced, 8 + 2 * most)])
    )
    poles = [_described(s, False) for s in found] + [_described(s, True) for s in hidden if s.imag >= 0]
    poles.sort(key=_from_right)
    if L.theta:
        poles = poles[: _confirmed(reduced, poles, most)]
    return tuple(poles[:most])


def _confirmed(L: Factored, poles: list[ClosedLoopPole], most: int) -> int:
    """How many of the poles, from right to left, there are none missing among, by the certificate."""
    real = [pole.s.real for pole in poles]
    if L.relative_degree == 0 and poles and real[0] - real[-1] <= APART * abs(real[0]):
        return most  # the line of a neutral loop, on which they are countless
    axes = {k: (real[k - 1] + real[k]) / 2 for k in range(1, min(len(poles), most + 1))}
    axes = {k: axis for k, axis in axes.items() if real[k - 1] - axis > APART * abs(poles[k].s)}
    if 0 < len(poles) <= most:
        axes[len(poles)] = real[-1] - APART * abs(poles[-1].s)

    def missing(k: int) -> bool:
        found = sum(2 if pole.s.imag else 1 for pole in poles[:k] if not pole.cancelled)
        try:
            return count_unstable([shifted(L, axes[k])]).unstable_poles != found
        except InvalidParameter:  # too wild to be counted
            return True

    counts = [0, *axes]
    if axes and not missing(counts[-1]):
        return counts[-1]
    return counts[bisect_left(counts, True, lo=1, key=missing) - 1]


def rightmost(L: Factored) -> np.ndarray:
    """Eigenvalues of the discretised generator, unpolished, from right to left: the closed-loop poles on the right
    are among them, those far to the left are not to be trusted. Exact where there is no dead time.
    """
    unit = L.theta or 1.0
    A, B, C, D = chain(L, unit)
    if L.theta == 0 and not is_well_posed(1 + D):
        return np.zeros(0, dtype=complex)  # no loop at all
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
    """L without the factors its numerator and denominator share but for rounding, and the poles these are."""
    den = L.den.tolist()
    num = [next((row for row in den if _same(each, row)), each) for each in L.num.tolist()]
    top, bottom, common = without_common([*map(tuple, num)], [*map(tuple, den)])
    return Factored(L.gain, factors(*top), factors(*bottom), L.theta), Factored(1.0, factors(), factors(*common)).poles


def _same(one: list[float], other: list[float]) -> bool:
    return all(abs(a - b) <= SAME_COEFFICIENT * abs(b) for a, b in zip(one, other, strict=True))


def _polished(L: Factored, start: np.ndarray) -> list[complex]:
    """Solutions of 1 + L = 0 in the upper half plane that Newton finds from `start`, each once."""
    s, rows, found = start[start.imag >= 0].astype(complex), _in_pairs(L), []
    with np.errstate(all="ignore"):
        for left in range(NEWTON_STEPS - 1, -1, -1):
            value, slope = _with_log_derivative(L, rows, s)
            step = (1 + value) / (value * slope)
            kept = np.isfinite(s - step)
            s, step = (s - step)[kept], step[kept]
            settled = np.abs(step) <= (LAST_STEP if left else 1e-9) * np.abs(s)
            found.append(s[settled])
            s = s[~settled]
    s = np.concatenate(found)
    size, imag = np.abs(s), np.abs(s.imag)
    s = s.real + 1j * np.where(imag <= 1e-10 * size, 0.0, imag)
    same = np.abs(s[:, None] - s) <= 1e-7 * size
    return s[~np.tril(same, -1).any(axis=1)].tolist()


def _chain_start(L: Factored, count: int) -> np.ndarray:
    """First guesses for the poles that dead time adds, one per turn of its phase: theta s = log(-P(s)) + 2 pi j n,
    P = L e^{theta s}, by fixed-point steps, which contract at high frequency; n = 0 is on the real axis, far left.
    """
    if L.theta == 0:
        return np.array([], dtype=complex)
    P, poles = Factored(L.gain, L.num, L.den), L.poles
    resonances = np.unique(np.round(L.theta * poles.imag[poles.imag > np.abs(poles.real)] / (2 * np.pi)))
    about = (resonances[:, None] + np.arange(-ABOUT, ABOUT + 1)).ravel()
    turns = 2j * np.pi * np.unique(np.concatenate([np.arange(1, count + 1), about[about > count]]))
    s = turns / L.theta
    found = [_beside_poles(L), s[count:]]
    for _ in range(CHAIN_STEPS):
        s = (np.log(-P(s)) + turns) / L.theta
    s = np.concatenate([*found, s])
    return np.concatenate([s[np.isfinite(s)], FAR_LEFT / L.theta])


def _beside_poles(L: Factored) -> np.ndarray:
    """First guesses next to open-loop poles that the loop hardly moves: one step of Newton on 1 + 1/L = 0."""
    s = L.poles[L.poles.imag >= 0] * (1 + BESIDE)
    with np.errstate(all="ignore"):
        value, slope = _with_log_derivative(L, _in_pairs(L), s)
        return s + (1 + value) / slope


def _in_pairs(L: Factored) -> np.ndarray:
    """Factors of numerator and denominator, as many of each, shape (3, 2, pairs, 1)."""
    rows = np.zeros((2, max(len(L.num), len(L.den)), 3))
    rows[:, :, 2] = 1.0
    rows[0, : len(L.num)], rows[1, : len(L.den)] = L.num, L.den
    return np.moveaxis(rows, 2, 0)[..., None]


def _with_log_derivative(L: Factored, rows: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """L and L'/L at s, shape (n,); rows: its factors in pairs, so that no partial product overflows."""
    a, b, c = rows
    linear = a * s + b
    q = linear * s + c
    top, bottom = ((a * s + linear) / q).sum(axis=1)
    value = np.multiply.reduce(q[0] / q[1], axis=0)
    return L.gain * value * np.exp(-L.theta * s), top - bottom - L.theta


def _described(s: complex, cancelled: bool) -> ClosedLoopPole:
    s = complex(s)
    return ClosedLoopPole(s, -s.real / abs(s) if s else 0.0, abs(s), cancelled)


def _from_right(pole: ClosedLoopPole) -> tuple[float, float]:
    """Rightmost first; of those in one line, which a neutral loop has, the slowest first."""
    return -float(f"{pole.s.real:.9g}"), pole.s.imag
