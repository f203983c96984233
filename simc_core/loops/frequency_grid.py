"""Frequencies at which curves are drawn; margins and peaks have a finer search of their own."""

import math
from collections.abc import Iterable, Sequence

import numpy as np

from simc_core.algebra.factors import Factored

BEYOND = 10.0  # the grid reaches this far past the slowest and the fastest corner
TURNS = 30.0  # largest omega theta drawn: beyond it the phase of the dead time only winds on
WINDING = 0.1  # largest step of omega theta, so that a spiral stays a spiral
LOGARITHMIC = 300  # points
AROUND_RESONANCE = np.tan(np.linspace(-1.45, 1.45, 25))  # half widths of a resonance, close together at its top


def omega_grid(functions: Sequence[Factored], marks: Iterable[float] = ()) -> np.ndarray:
    """Increasing omega > 0 for drawing `functions`, scaled with their corners and dead times; shape (n,).

    marks: frequencies the grid must hold, such as those of the margins; zero, infinite ones and nan are left out.
    """
    roots = np.concatenate([part for F in functions for part in (F.poles, F.zeros)])
    theta = max(F.theta for F in functions)
    given = [mark for mark in marks if 0 < mark < math.inf]
    corners = np.array([*np.abs(roots[roots != 0]), *([1 / theta] if theta else []), *given])
    low, high = (corners.min() / BEYOND, corners.max() * BEYOND) if corners.size else (0.01, 100.0)
    if theta:
        high = min(high, max([TURNS / theta, *(3 * mark for mark in given)]))
    parts = [np.geomspace(low, high, LOGARITHMIC), np.array(given)]
    if theta:
        parts.append(np.arange(1.0, TURNS, WINDING) / theta)
    parts += [abs(p.imag) + abs(p.real) * AROUND_RESONANCE for p in roots if abs(p.imag) > abs(p.real)]
    omega = np.unique(np.concatenate(parts))
    return omega[(omega >= low) & (omega <= high)]
