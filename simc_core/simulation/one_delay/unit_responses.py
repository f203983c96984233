"""What the march leaves behind: responses of n tunings as pieces of polynomials, each tuning with pieces of its own."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import NamedTuple

import numpy as np

from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.collocation.elements import TO_CHEBYSHEV
from simc_core.simulation.collocation.pieces import NEAR, Pieces, chebyshev_basis


class Batch(NamedTuple):
    """Elements of `lengths` one after the other, for some of the tunings.

    which, begin: the k tunings and when it begins for each.   values: of each element (k, 2 P or more, 2), y and then
    z = u + d at the nodes, for r and for d.
    """

    which: list[int]
    begin: list[float]
    lengths: list[float]
    values: list[np.ndarray]

    def first(self, n: int) -> "Batch":
        """Of the tunings below n, which there must be."""
        k = sum(i < n for i in self.which)  # in increasing order
        if k == len(self.which):
            return self
        return Batch(self.which[:k], self.begin[:k], self.lengths, [own[:k].copy() for own in self.values])


@dataclass(frozen=True, slots=True, eq=False)
class UnitResponses:
    """Unit step responses of n tunings. Piece j belongs to tuning owner[j]; pieces in order of owner and time.

    begin, length: (m,).   coefficients: (2, 2, m, P), Chebyshev: y, u for steps of r, d.   first: (n + 1,), where the
    pieces of each tuning begin.   at_rest: (n,), whether it came to rest.
    """

    owner: np.ndarray
    begin: np.ndarray
    length: np.ndarray
    coefficients: np.ndarray
    first: np.ndarray
    at_rest: np.ndarray

    def pieces(self, i: int) -> Pieces:
        """One tuning: values [y, u] x [r, d]."""
        own = slice(self.first[i], self.first[i + 1])
        begin, length = self.begin[own], self.length[own]
        return Pieces(
            np.concatenate([begin, begin[-1:] + length[-1:]]), self.coefficients[:, :, own].transpose(2, 3, 0, 1)
        )

    def __call__(self, t: np.ndarray) -> np.ndarray:
        """y, u at t (q,), shape (n, 2, 2, q); zero before 0, right-hand limits at jumps, the last value after the end.

        Tunings whose pieces coincide are evaluated together.
        """
        found = np.zeros((len(self.first) - 1, 2, 2, len(t)))
        begin, end = self.begin, self.begin + self.length
        end[self.first[1:] - 1] = np.inf
        low = np.searchsorted(t, begin * (1 - NEAR), side="left")
        high = np.searchsorted(t, end * (1 - NEAR), side="left")
        coinciding: dict[tuple[float, float, float], list[int]] = {}
        for j, key in enumerate(zip(begin.tolist(), self.length.tolist(), end.tolist(), strict=True)):
            if low[j] < high[j]:
                coinciding.setdefault(key, []).append(j)
        for same in coinciding.values():
            j = same[0]
            points = slice(low[j], high[j])
            x = np.clip(2 * (t[points] - begin[j]) / self.length[j] - 1, -1.0, 1.0)
            values = self.coefficients[:, :, same] @ chebyshev_basis(x)
            found[self.owner[same], :, :, points] = values.transpose(2, 0, 1, 3)
        return found


def course(batches: Sequence[Batch], at_rest: Sequence[bool]) -> UnitResponses:
    """Batches sorted by tuning and time, their values as polynomials."""
    n = len(at_rest)
    owners: list[int] = []
    begins: list[float] = []
    lengths: list[float] = []
    nodal: list[np.ndarray] = []
    for batch in batches:
        starts = accumulate(batch.lengths[:-1], initial=0.0)
        for own, start, h in zip(batch.values, starts, batch.lengths, strict=True):
            owners += batch.which
            begins += [each + start for each in batch.begin]
            lengths += [h] * len(batch.which)
            nodal.append(own)
    values = np.concatenate(nodal)[:, : 2 * P].reshape(-1, 2, P, 2)
    owner, begin, length = np.array(owners), np.array(begins), np.array(lengths)
    if n > 1:
        order = np.argsort(owner, kind="stable")
        owner, begin, length, values = owner[order], begin[order], length[order], values[order]
    rows = values.transpose(1, 3, 0, 2).reshape(-1, P)
    coefficients = (rows @ TO_CHEBYSHEV.T).reshape(2, 2, -1, P)
    coefficients[1, 1, :, 0] -= 1.0  # u = z - d
    return UnitResponses(owner, begin, length, coefficients, owner.searchsorted(np.arange(n + 1)), np.array(at_rest))
