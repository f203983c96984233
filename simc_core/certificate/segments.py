"""Frequencies of many loops in one row: ascending for each loop, with the number of the loop beside each.

Neighbours bound a segment, unless they belong to different loops or to segments that are done with.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MOST_PIECES = 16  # of one segment in one pass
SPLIT_TOGETHER = 3000  # segments; their nodes make one row


@dataclass(frozen=True, slots=True, eq=False)
class Nodes:
    """omega, owner: shape (N,); owner is the number of the loop.   live: (N-1,), whether neighbours bound a segment."""

    omega: np.ndarray
    owner: np.ndarray
    live: np.ndarray


def geometric(first: float, last: float, per_decade: float) -> np.ndarray:
    """From first to last, both of them exactly."""
    span = math.log(last) - math.log(first)
    intervals = int(per_decade / math.log(10.0) * span) + 1
    omega = first * np.exp(np.arange(intervals + 1) * (span / intervals))
    omega[-1] = last
    return omega


def geometric_rows(first: np.ndarray, last: np.ndarray, per_decade: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """0 and `geometric` of each loop, as of `side_by_side`."""
    span = np.log(last) - np.log(first)
    intervals = (per_decade / math.log(10.0) * span).astype(int) + 1
    owner, place = ragged(intervals + 2)
    omega, ends = first[owner] * np.exp((place - 1) * (span / intervals)[owner]), (intervals + 2).cumsum() - 1
    omega[place == 0], omega[ends] = 0.0, last
    return omega, owner, ends


def side_by_side(grids: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frequencies of all loops in one row, the number of the loop beside each, and the index at which each ends."""
    if len(grids) == 1:
        return grids[0], np.zeros(grids[0].size, dtype=int), np.array([grids[0].size - 1])
    sizes = np.array([grid.size for grid in grids])
    return np.concatenate(grids), np.arange(sizes.size).repeat(sizes), sizes.cumsum() - 1


def ragged(counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For rows of counts[i] entries, one behind the other: the row of each entry, and its place in the row."""
    row = np.arange(counts.size).repeat(counts)
    return row, np.arange(row.size) - (counts.cumsum() - counts)[row]


def split(nodes: Nodes, going: np.ndarray, excess: np.ndarray) -> list[Nodes]:
    """The segments `going`, each in ceil(excess) parts, 2 to MOST_PIECES; geometric where they span a factor > 2."""
    at = np.flatnonzero(going)
    parts = [at[i : i + SPLIT_TOGETHER] for i in range(0, at.size, SPLIT_TOGETHER)]
    return [_split(nodes, part, excess[part]) for part in parts]


def _split(nodes: Nodes, at: np.ndarray, excess: np.ndarray) -> Nodes:
    pieces = np.clip(np.ceil(excess), 2, MOST_PIECES).astype(int)
    segment, place = ragged(pieces + 1)
    a, b = nodes.omega[at][segment], nodes.omega[at + 1][segment]
    part = place / pieces[segment]
    wide = (a > 0) & (b > 2 * a)
    ratio = np.divide(b, a, out=np.ones_like(b), where=wide)
    omega = np.where(wide, a * ratio**part, a + (b - a) * part)
    omega = np.where(part == 1, b, omega)
    return Nodes(omega, nodes.owner[at][segment], place[1:] > 0)
