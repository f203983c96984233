"""Unit step responses put together to a scenario: on which instants, with both limits where something jumps."""

import math
from bisect import bisect_right
from collections.abc import Sequence

import numpy as np

from simc_core.simulation.collocation.pieces import Pieces
from simc_core.simulation.scenario import Scenario

JUMP = 1e-9  # of the largest value; smaller steps between pieces are rounding
MOST_JUMPS = 400


def superposed(
    pieces: Pieces, heights: Sequence[float], starts: Sequence[float], t_end: float, scenario: Scenario
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """t (n,), inputs (sources, n), outputs (signals, n).

    pieces: values signals x sources, unit steps at t = 0. Instants of the scenario, or its number of points up to
    t_end; there each jump is two instants, the first with the left-hand limits.
    """
    used = [i for i, height in enumerate(heights) if height]
    if scenario.t is not None:
        t, left = scenario.t, np.zeros(len(scenario.t), dtype=bool)
    else:
        jumping = jump_times(pieces)
        jumps = sorted({*starts, *[edge + starts[i] for i in used for edge in jumping[i]]})
        jumps = jumps[: min(bisect_right(jumps, t_end), MOST_JUMPS)]
        t, left = doubled(np.linspace(0.0, t_end, scenario.points), jumps)
    first, inputs = t.searchsorted(starts).tolist(), np.zeros((len(starts), len(t)))
    for source, height, i in zip(inputs, heights, first, strict=True):
        source[i:] = height
        source[i : i + 1][left[i : i + 1]] = 0.0  # the left-hand limit
    outputs = np.zeros((pieces.coefficients.shape[2], len(t)))
    if used:  # one row of instants for all sources, each from where it begins
        since = np.concatenate([t[first[i] :] - starts[i] for i in used])
        values = pieces(since, np.concatenate([left[first[i] :] for i in used]))
        begin = 0
        for i in used:
            end = begin + len(t) - first[i]
            outputs[:, first[i] :] += heights[i] * values[begin:end, :, i].T
            begin = end
    return t, inputs, outputs


def held(t: np.ndarray, begins: float, height: float) -> np.ndarray:
    """A step of `height` at t = begins."""
    return np.where(t >= begins, height, 0.0)


def doubled(t: np.ndarray, jumps: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
    """t with each of `jumps` in it twice, and which are the first of the two."""
    grid = np.sort(np.concatenate([t, jumps, jumps]), kind="stable")  # which knows sorted runs
    third = np.zeros(len(grid), dtype=bool)
    third[2:] = grid[2:] == grid[:-2]  # t had this instant already
    grid = grid[~third]
    left = np.zeros(len(grid), dtype=bool)
    left[:-1] = grid[1:] == grid[:-1]
    return grid, left


def jump_times(pieces: Pieces) -> list[list[float]]:
    """For each source, where a signal jumps, t = 0 included."""
    size, right = pieces.ends()
    scale = np.maximum.reduce(np.abs(right), axis=0) + math.ulp(0.0)
    size[1:] -= right[:-1]
    jumping = np.logical_or.reduce(np.abs(size) > JUMP * scale, axis=1)
    return [pieces.edges[:-1][each].tolist() for each in jumping.T]
