"""Unit step responses put together to a scenario: on which instants, with both limits where something jumps."""

import math
from collections.abc import Sequence

import numpy as np

from simc_core.simulation.pieces import Pieces
from simc_core.simulation.scenario import Scenario

JUMP = 1e-9  # of the largest value; smaller steps between pieces are rounding
MOST_JUMPS = 400


def superposed(
    pieces: Pieces, heights: Sequence[float], starts: Sequence[float], t_end: float, scenario: Scenario
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """t (n,), inputs (sources, n), outputs (n, signals).

    pieces: values signals x sources, unit steps at t = 0. Instants of the scenario, or its number of points up to
    t_end; there each jump is two instants, the first with the left-hand limits.
    """
    if scenario.t is not None:
        t, left = scenario.t, np.zeros(0, dtype=int)
    else:
        used = [i for i, height in enumerate(heights) if height]
        jumps = np.concatenate([starts, *(jump_times(pieces, i) + starts[i] for i in used)])
        t, left = doubled(np.linspace(0.0, t_end, scenario.points), np.unique(jumps[jumps <= t_end])[:MOST_JUMPS])
    inputs = np.array([held(t, start, height) for start, height in zip(starts, heights, strict=True)])
    outputs = np.zeros((len(t), pieces.coefficients.shape[2]))
    for i, (start, height) in enumerate(zip(starts, heights, strict=True)):
        if height:
            outputs += height * pieces.of_source(i)(t - start, left)
        inputs[i, left[t[left] == start]] = 0.0
    return t, inputs, outputs


def held(t: np.ndarray, begins: float, height: float) -> np.ndarray:
    """A step of `height` at t = begins."""
    return np.where(t >= begins, height, 0.0)


def doubled(t: np.ndarray, jumps: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """t with each of `jumps` in it twice, and the indices of the first of the two."""
    grid = np.sort(np.concatenate([t, jumps, jumps]))
    third = np.zeros(len(grid), dtype=bool)
    third[2:] = grid[2:] == grid[:-2]  # t had this instant already
    grid = grid[~third]
    return grid, np.flatnonzero(grid[1:] == grid[:-1])


def jump_times(pieces: Pieces, source: int) -> np.ndarray:
    """Where a signal jumps under this input, t = 0 included."""
    coefficients = pieces.coefficients[..., source]
    right = coefficients.sum(axis=1)
    size = (-1.0) ** np.arange(coefficients.shape[1]) @ coefficients
    size[1:] -= right[:-1]
    scale = np.abs(right).max(axis=0) + math.ulp(0.0)
    return pieces.edges[:-1][(np.abs(size) > JUMP * scale).any(axis=1)]
