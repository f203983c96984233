"""How long the next element of a march may be, and when a tuning has arrived.

An element is good if the last Chebyshev coefficients of y and u are below TAIL of their largest values so far. Those
of an exponential fall like c_k ~ (rate length)^k/k!. Where the last are next to nothing, the MIDDLE ones tell the rate,
and so how many times longer the next element may be. A length that has served PATIENCE times is doubled as well; one
that is not good is halved, and then patience grows.
"""

import math
from dataclasses import dataclass

from simc_core.errors import InvalidParameter
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.wording import said

TAIL = 1e-11
ROOM, SMALL, AIM = 1e-3, 0.03, 0.1  # of TAIL
MIDDLE, OF_MIDDLE = 9, math.factorial(9)  # degree
REACH = (AIM * TAIL * math.factorial(P - 1)) ** (1 / (P - 1))  # rate times length for which c_{P-1} is that
PATIENCE, MOST_PATIENCE = 4, 16
LOWEST, HIGHEST = -48, 60  # levels
LEAST = 1e-16  # of a coefficient: rounding
REST = 1e-10  # of the largest value: nearer than this to where it ends, a response is at rest
STIFF_ROUNDING = 1e-6  # a stiff loop that comes no nearer than this has reached its rounding errors,
GONE = 25.0  # if so many time constants of its slowest mode have passed: otherwise it is that mode


@dataclass(slots=True)
class StepControl:
    """Of one tuning. t: where it is.   level, before: of the next element and of the one before.

    good: elements since the last change of level.   mark, away_at_mark: a former time, and how far from rest it was.
    """

    t: float = 0.0
    level: int = 0
    before: int = 0
    good: int = 0
    patience: int = PATIENCE
    mark: float = 0.0
    away_at_mark: float = math.inf
    at_rest: bool = False

    def shorten(self) -> None:
        """The element was not good. Raises InvalidParameter where no length is short enough."""
        if self.level <= LOWEST:
            raise InvalidParameter(said("the response must have a time scale that can be resolved, found none"))
        self.level, self.good = self.level - 1, 0
        self.patience = min(2 * self.patience, MOST_PATIENCE)

    def lengthen(self, judged: int, middle: float, tail: float, done: float, left: float | None) -> None:
        """An element of level `judged` was good; its middle and last coefficients. done, left: time so far, and what is
        left to the end, in units of level 0; left is None where there is no end.
        """
        self.good += 1
        longer = self.level + (tail < ROOM * TAIL)
        if tail < SMALL * TAIL and self.patience == PATIENCE:
            longer = max(longer, min(judged + _doublings(middle), 1 + math.floor(math.log2(done))))
        if longer > self.level:
            self.level, self.good, self.patience = min(longer, HIGHEST), 0, PATIENCE
        elif self.good >= self.patience:
            self.level, self.good = min(self.level + 1, HIGHEST), 0
        if left is not None:  # an unstable response is not computed far beyond its end
            self.level = min(self.level, max(math.floor(math.log2(left)), 0) if left > 0 else 0)

    def stalls(self, away: float) -> bool:
        """Whether the last element, within `away` of where the response ends, is hardly nearer than long before."""
        if self.t < 2 * self.mark:
            return False
        found = 0.5 * self.away_at_mark < away <= STIFF_ROUNDING
        self.mark, self.away_at_mark = self.t, away
        return found


def _doublings(middle: float) -> int:
    """How often an element with this middle coefficient may be doubled."""
    rate = (max(middle, LEAST) * OF_MIDDLE) ** (1 / MIDDLE)
    return math.floor(math.log2(REACH / rate))
