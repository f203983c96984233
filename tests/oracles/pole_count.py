"""Closed-loop poles right of an axis by Mikhailov's criterion, by brute force: the phase of f on a grid fine enough.

f(s) = den(s) + num(s) e^{-theta s}, of degree n:      zeros with Re s > sigma = n/2 - (arg f over 0..inf)/pi
"""

import math

import numpy as np

from simc_core.algebra.factors import Factored

TURN = 0.3  # radians between two points
ROUNDS = 40


def unstable(L: Factored, sigma: float = 0.0) -> int | None:
    """For a loop with fewer zeros than poles; None where the grid would need too many points."""
    sizes = np.abs(np.concatenate([L.poles, L.zeros, [1 / (L.theta or 1.0), sigma]]))
    sizes = sizes[sizes > 0]
    gain = max(abs(L.gain), 1.0) * math.exp(max(-L.theta * sigma, 0.0))
    omega = np.geomspace(sizes.min() * 1e-6, sizes.max() * gain * 1e6, 6000)
    loud = omega[np.abs(_without_delay(L, sigma + 1j * omega)) > 0.3]
    omega = np.concatenate([[0.0], omega])
    if loud.size and L.theta:
        turns = loud.max() * L.theta / TURN
        if turns > 300_000:
            return None
        omega = np.union1d(omega, np.linspace(0.0, loud.max(), math.ceil(turns) + 1))
    for _ in range(ROUNDS):
        f = _f(L, sigma + 1j * omega)
        steps = np.angle(f[1:] / f[:-1])
        wide = np.flatnonzero(np.abs(steps) > TURN)
        if not wide.size:
            break
        omega = np.insert(omega, wide + 1, (omega[wide] + omega[wide + 1]) / 2)
    n = sum(2 if a else 1 if b else 0 for a, b, _ in L.den.tolist())
    return round(n / 2 - float(steps.sum()) / math.pi)


def _f(L: Factored, s: np.ndarray) -> np.ndarray:
    """f over its size, which does not count."""
    below, above = (_product(rows, s) for rows in (L.den, L.num))
    f = below + L.gain * above * np.exp(-L.theta * s)
    return f / np.abs(f)


def _without_delay(L: Factored, s: np.ndarray) -> np.ndarray:
    return L.gain * _product(L.num, s) / _product(L.den, s) * np.exp(-L.theta * s.real)


def _product(rows: np.ndarray, s: np.ndarray) -> np.ndarray:
    found = np.ones_like(s)
    for a, b, c in rows.tolist():
        found = found * ((a * s + b) * s + c)
    return found
