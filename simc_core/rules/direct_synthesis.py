"""Direct synthesis of PI and PID controllers by a Maclaurin expansion, under a constraint on Ms [PSB].

The response to the set point is asked to be, for a process with n poles and dead time tau,

    Tz(s) = N(s) e^{-tau s}/(lambda s + 1)^p        N = 1 + eta_1 s + ... + eta_n s^n

which the controller C* = (1/Gp) Tz/(1 - Tz) would give. eta_j: F = (lambda s + 1)^p - e^{-tau s} N vanishes at every
pole of the block, so that C* cancels none of them, stable or not: a pole at 0 of multiplicity m is an (m + 1)-fold
zero of F, any other one of multiplicity m an m-fold zero. With s C* = h0 + h1 s + h2 s^2 + ...

    PI    ki = h0   k = h1                            k + ki/s
    PID   ki = h0   k = h1 + Tf h0   kd = h2 + Tf h1  (k + ki/s + kd s)/(Tf s + 1)   Tf = lambda/N

p = 2 n for a loop on its own. The next loop out sees its block behind the closed loop inside, Gp = G T with
the exact T, of which the expansion needs the first terms only; tau is the sum of all dead times, p = 2 n + 1.
"""

import math
from collections import Counter
from functools import lru_cache

import numpy as np

from simc_core import checks
from simc_core.algebra.laurent import TERMS, Laurent, expansion, exponential, polynomial
from simc_core.controllers.forms import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.loops.nested import NestedLoops
from simc_core.plants.plant import Plant
from simc_core.wording import said

KINDS = ("PI", "PID")
MOST_POLES = 6  # of a block: the expansion is cut off at TERMS, and needs 2 n + 3


def direct_synthesis(
    process: Plant,
    lambda_: float,
    kind: str = "PID",
    N: float = 20.0,
    inside: Loop | NestedLoops | None = None,
    tau_F: float | None = None,
    b: float = 1.0,
) -> ParallelPid:
    """Controller of `process` by direct synthesis; the module docstring has the equations.

    kd <= 0 may come out where N is large: a slower filter helps.

    Parameters
    ----------
    process : Plant
        The block that is controlled.
    lambda_ : float
        Time constant of the desired closed loop, > 0, in the user's time unit.
    kind : str
        "PI" or "PID".
    N : float
        ``tau_F = lambda_/N`` for a PID, unless tau_F is given.
    inside : Loop or NestedLoops, optional
        The closed loop that drives the process.
    tau_F : float, optional
        Filter time constant of a PID, in the user's time unit.
    b : float
        Set-point weight.

    Returns
    -------
    ParallelPid
        Its form in the paper.

    Raises
    ------
    InvalidParameter
        ``lambda_``, N or kind out of bounds, more than MOST_POLES poles, or a block with a zero at s = 0.

    References
    ----------
    [PSB].

    Examples
    --------
    The inner loop of pair 1; the paper prints k = 3.3928, ki = 0.8250, kd = 3.7773:

    >>> from simc_core import Plant, direct_synthesis
    >>> pid = direct_synthesis(Plant(1, 1, (2, 3)), 1.04275)
    >>> [round(value, 3) for value in (pid.Kp, pid.Ki, pid.Kd)]
    [3.393, 0.825, 3.777]
    """
    lambda_ = checks.positive_time("lambda_", lambda_)
    checks.one_of("kind", kind, KINDS)
    h0, h1, h2 = _coefficients(process, lambda_, inside)
    if kind == "PI":
        return ParallelPid(h1, h0, b=b)
    Tf = lambda_ / checks.real("N", N, 1e-3, 1e6) if tau_F is None else checks.optional_time("tau_F", tau_F)
    return ParallelPid(h1 + Tf * h0, h0, h2 + Tf * h1, Tf, b)


def numerator(process: Plant, lambda_: float, inside: Loop | NestedLoops | None = None) -> np.ndarray:
    """1, eta_1, ..., eta_n: N(s) in ascending powers."""
    return _numerator(process, lambda_, *_order(process, inside))


def _order(process: Plant, inside: Loop | NestedLoops | None) -> tuple[float, int]:
    """tau and p."""
    if process.order > MOST_POLES:
        raise InvalidParameter(
            said(
                "a block for direct synthesis may have at most {most} poles, found {order}",
                most=MOST_POLES,
                order=process.order,
            )
        )
    if inside is None:
        return process.theta, max(2 * process.order, 1)
    blocks = (inside.plant,) if isinstance(inside, Loop) else inside.blocks
    return process.theta + sum(block.theta for block in blocks), 2 * process.order + 1


def _coefficients(process: Plant, lambda_: float, inside: Loop | NestedLoops | None) -> np.ndarray:
    """h0, h1, h2."""
    tau, p = _order(process, inside)
    N = _numerator(process, lambda_, tau, p)
    delayed = (polynomial(N) * exponential(-tau)).c
    F = _power(lambda_, p) - delayed
    zeros = process.integrators + 1  # these coefficients of F vanish; what is left of them is rounding
    rest = np.zeros(TERMS)
    rest[: TERMS - zeros] = F[zeros:]
    C = _inverse(process, inside, tau) * polynomial(N) * Laurent(zeros, rest).inverse()
    return C.c[:3]


@lru_cache(maxsize=32)  # a search for lambda asks for the same one a hundred times
def _inverse(process: Plant, inside: Loop | NestedLoops | None, tau: float) -> Laurent:
    """1/Gp without the dead time tau."""
    Gp = expansion(process.factored)
    if inside is not None:
        Gp = Gp * _chain(inside)
    return (Gp * exponential(tau)).inverse()


def _chain(inside: Loop | NestedLoops) -> Laurent:
    """The closed loop `inside` as a series."""
    if isinstance(inside, Loop):
        inside = NestedLoops((inside.plant,), (inside.controller,))
    L = expansion(inside.own)
    return (L if inside.inside is None else L * _chain(inside.inside)).closed()


def _power(lambda_: float, p: int) -> np.ndarray:
    """(lambda s + 1)^p, ascending, TERMS coefficients."""
    return np.array([math.comb(p, i) * lambda_**i for i in range(TERMS)])


def _numerator(process: Plant, lambda_: float, tau: float, p: int) -> np.ndarray:
    """The linear equations for eta, one a pole; time in units of the slowest pole, for good conditioning."""
    n = process.order
    if n == 0:
        return np.ones(1)
    wanted = (polynomial(_power(lambda_, p)) * exponential(tau)).c
    poles = Counter(complex(pole) for pole in process.poles if pole)
    unit = max([*(1 / abs(pole) for pole in poles), lambda_])
    rows, right = [], []
    for i in range(1, process.integrators + 1):
        rows.append(np.eye(n)[i - 1])
        right.append(wanted[i] / unit**i)
    for pole, times in poles.items():
        q, ends = pole * unit, _derivatives(pole, lambda_, tau, p, times)
        for j in range(times):
            rows.append([math.perm(i, j) * q ** (i - j) if i >= j else 0.0 for i in range(1, n + 1)])
            right.append(ends[j] / unit**j - (j == 0))
    eta = np.linalg.solve(np.array(rows, dtype=complex), np.array(right, dtype=complex)).real
    return np.concatenate([[1.0], eta * unit ** np.arange(1.0, n + 1)])


def _derivatives(q: complex, lambda_: float, tau: float, p: int, count: int) -> list[complex]:
    """e^{tau s} (lambda s + 1)^p and its first derivatives at q, by Leibniz."""
    powers = [math.perm(p, j) * lambda_**j * (lambda_ * q + 1) ** (p - j) if j <= p else 0.0 for j in range(count)]
    grown = np.exp(tau * q)
    return [grown * sum(math.comb(j, i) * tau ** (j - i) * powers[i] for i in range(j + 1)) for j in range(count)]
