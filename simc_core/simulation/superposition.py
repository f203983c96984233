"""Unit step responses put together to a scenario: on which instants, with both limits where something jumps.

An input that rises evenly for a time T is the mean of steps over that time, so its response is the mean of the step
response over the last T: exact, from the integral of its pieces.
"""

import math
from bisect import bisect_right
from collections.abc import Sequence

import numpy as np

from simc_core.simulation.collocation.pieces import Pieces
from simc_core.simulation.rise import risen
from simc_core.simulation.scenario import Scenario

JUMP = 1e-9  # of the largest value; smaller steps between pieces are rounding
MOST_JUMPS = 400


def superposed(
    pieces: Pieces,
    heights: Sequence[float],
    starts: Sequence[float],
    t_end: float,
    scenario: Scenario,
    ramps: Sequence[float] | None = None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """t (n,), inputs (sources, n), outputs (signals, n).

    pieces: values signals x sources, unit steps at t = 0. Instants of the scenario, or its number of points up to
    t_end; there each jump is two instants, the first with the left-hand limits.
    ramps: times in which the inputs reach their heights, 0 for steps; None for steps alone.
    """
    ramps = ramps or [0.0] * len(heights)
    used = [i for i, height in enumerate(heights) if height]
    if scenario.t is not None:
        t, left = scenario.t, np.zeros(len(scenario.t), dtype=bool)
    else:
        jumping = jump_times(pieces)
        corners = [start + ramp for start, ramp in zip(starts, ramps, strict=True)]
        at_once = [i for i in used if not ramps[i]]
        jumps = sorted({*starts, *corners, *[edge + starts[i] for i in at_once for edge in jumping[i]]})
        jumps = jumps[: min(bisect_right(jumps, t_end), MOST_JUMPS)]
        t, left = doubled(np.linspace(0.0, t_end, scenario.points), jumps)
    first, inputs = t.searchsorted(starts).tolist(), np.zeros((len(starts), len(t)))
    for source, height, start, ramp, i in zip(inputs, heights, starts, ramps, first, strict=True):
        if ramp:
            source[i:] = height * risen(t[i:] - start, ramp)
            continue
        source[i:] = height
        source[i : i + 1][left[i : i + 1]] = 0.0  # the left-hand limit
    outputs = np.zeros((pieces.coefficients.shape[2], len(t)))
    for i in used:
        if ramps[i]:
            outputs[:, first[i] :] += heights[i] * ramp_response(pieces, ramps[i], t[first[i] :] - starts[i])[:, :, i].T
    used = [i for i in used if not ramps[i]]
    if used:  # one row of instants for all sources, each from where it begins
        since = np.concatenate([t[first[i] :] - starts[i] for i in used])
        values = pieces(since, np.concatenate([left[first[i] :] for i in used]))
        begin = 0
        for i in used:
            end = begin + len(t) - first[i]
            outputs[:, first[i] :] += heights[i] * values[begin:end, :, i].T
            begin = end
    return t, inputs, outputs


def ramp_response(pieces: Pieces, ramp: float, t: np.ndarray) -> np.ndarray:
    """Values at t (n,), shape (n, ...), for inputs that rise evenly from 0 at t = 0 to 1 at `ramp`."""
    area = pieces.integral(float(np.max(t, initial=0.0)))
    return (area(t) - area(t - ramp)) / ramp


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
