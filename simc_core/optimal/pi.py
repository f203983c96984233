"""The best PI controllers under bounds of max(Ms, Mt): a search over log tau_I for each, with Kc at its upper edge.

Where the criterion falls when Kc is reduced the bound does not matter: then Kc is searched too, below the edge.
The set point of an integrating plant is best followed without integral action, tau_I = inf.

The criterion does not know the bound, so the searches for several bounds walk together: a march of sixty controllers
costs little more than ten of one. No |e| has a smaller integral than e: where that alone, tau_I/Kc, is more than what
was found, nothing is simulated.
"""

import math
from collections.abc import Generator, Sequence
from typing import NamedTuple

import numpy as np

from simc_core.optimal.problem import Found, Problem
from simc_core.optimal.valley import lowest

SHAPES, WIDER = 15, 3  # integral times of the first look; how often it looks further where the best is the last
LEAST, MOST = 0.15, 15.0  # of these, in units of the scale, or up to all times of the plant
POINTS, ZOOMS = 7, 6  # of a closer look at the gain alone
INSIDE = 0.998  # of Kc at the edge: where a bound that matters makes the criterion worse
BELOW = 0.8  # log Kc below the edge, of the first look there
CLOSER, ROUNDS = 0.4, 9  # what each look at Kc and tau_I together is narrowed by, and how many there are


class Asked(NamedTuple):
    """Integral times, and the part of Kc at the edge; answered by the criterion and its lower bound."""

    log_tau_I: np.ndarray
    part: float = 1.0
    simulated: bool = True


class Edge(NamedTuple):
    """Where the criterion is smallest along the edge; whether the bound holds it there.   step: of the first look."""

    log_tau_I: float
    value: float
    active: bool
    step: float


Walk = Generator[Asked, np.ndarray, Edge | None]


def best_pi(problems: Sequence[Problem]) -> list[Found | None]:
    """Of each bound, of one plant and criterion; None where no integral time allows a stable loop with it."""
    found = []
    for problem, edge in zip(problems, _together(problems), strict=True):
        each = [_without(problem)]
        if edge is not None:
            each.append(_at(problem, edge) if edge.active else _free(problem, edge.log_tau_I, edge.step))
        found.append(min([one for one in each if one is not None], key=lambda one: one.value, default=None))
    return found


def _at(problem: Problem, edge: Edge) -> Found:
    tau_I = math.exp(edge.log_tau_I)
    return Found(float(problem.edges(tau_I)[1][0]), tau_I, 0.0, edge.value)


def _together(problems: Sequence[Problem]) -> list[Edge | None]:
    """All walks, each step of them as one."""
    one, bounds = problems[0], np.array([problem.M for problem in problems])
    found: dict[int, Edge | None] = {}
    asked: dict[int, Asked] = {}
    walks = [_along_the_edge(problem) for problem in problems]

    def answer(i: int, value: np.ndarray | None) -> None:
        try:
            asked[i] = next(walks[i]) if value is None else walks[i].send(value)
        except StopIteration as end:
            found[i] = end.value

    for i in range(len(walks)):
        answer(i, None)
    while asked:
        which, asked_now = list(asked), list(asked.values())
        asked.clear()
        sizes = [len(each.log_tau_I) for each in asked_now]
        tau_I = np.exp(np.concatenate([each.log_tau_I for each in asked_now]))
        high = one.gains.highest(one.shapes(tau_I), bounds[which].repeat(sizes))[1]
        Kc = high * np.repeat([each.part for each in asked_now], sizes)
        simulated = np.repeat([each.simulated for each in asked_now], sizes)
        values = np.empty(len(Kc))
        values[simulated] = one.values(Kc[simulated], tau_I[simulated])
        values[~simulated] = one.least(Kc[~simulated], tau_I[~simulated])
        for i, value in zip(which, np.split(values, np.cumsum(sizes)[:-1]), strict=True):
            answer(i, value)
    return [found[i] for i in range(len(walks))]


def _along_the_edge(problem: Problem) -> Walk:
    """The walk of one bound."""
    low, high = LEAST * problem.scale, max(MOST * problem.scale, 2 * problem.times)
    x = np.linspace(math.log(low), math.log(high), SHAPES)
    step = float(x[1] - x[0])
    values = yield from _where_it_may_be(x)
    for _ in range(WIDER):
        i = int(values.argmin())
        if not np.isfinite(values[i]) or 0 < i < len(x) - 1:
            break
        more = step * np.arange(1, 1 + SHAPES // 2)
        further = x[0] - more[::-1] if i == 0 else x[-1] + more
        sides = [(further, (yield Asked(further))), (x, values)][:: 1 if i == 0 else -1]
        x, values = (np.concatenate(parts) for parts in zip(*sides, strict=True))
    if not np.isfinite(values).any():
        return None
    closer = lowest(list(zip(x.tolist(), values.tolist(), strict=True)))
    try:
        places = next(closer)
        while True:
            places = closer.send((yield Asked(places)))
    except StopIteration as end:
        best, value = end.value
    inside = yield Asked(np.array([best]), INSIDE)
    return Edge(best, value, bool(inside[0] >= value), step)


def _where_it_may_be(x: np.ndarray) -> Generator[Asked, np.ndarray, np.ndarray]:
    """The criterion at these places; where it cannot be smallest, a lower bound of it."""
    values = (yield Asked(x, simulated=False)).copy()
    known = ~np.isfinite(values)
    while True:
        best = values[known].min(initial=math.inf)
        i = int(np.where(known, math.inf, values).argmin())
        if known[i] or values[i] >= best:
            break
        near = np.flatnonzero(~known & (np.abs(np.arange(len(x)) - i) <= 1 + (best == math.inf)))
        values[near] = yield Asked(x[near])
        known[near] = True
    i = int(values.argmin())
    beside = np.array([j for j in range(max(i - 2, 0), min(i + 3, len(x))) if not known[j]], dtype=int)
    if beside.size:
        values[beside] = yield Asked(x[beside])
    return values


def _free(problem: Problem, x: float, wide: float) -> Found:
    """Kc and tau_I where the criterion is smallest of all, at or below the edge; x: log tau_I to begin with."""
    y, deep = -BELOW / 2, BELOW / 2  # log Kc, from the edge
    steps = np.linspace(-1, 1, POINTS)
    for _ in range(ROUNDS):
        tau_I = np.exp(x + wide * steps).repeat(POINTS)
        below = np.minimum(np.tile(y + deep * steps, POINTS), 0.0)
        Kc = problem.edges(tau_I[::POINTS])[1].repeat(POINTS) * np.exp(below)
        values = problem.values(Kc, tau_I)
        best = int(values.argmin())
        i, j = divmod(best, POINTS)
        x, y = math.log(tau_I[best]), float(below[best])
        wide *= CLOSER if 0 < i < POINTS - 1 else 1.0
        deep *= CLOSER if 0 < j < POINTS - 1 else 1.0
    return Found(float(Kc[best]), float(tau_I[best]), 0.0, float(values[best]))


def _without(problem: Problem) -> Found | None:
    """Proportional action alone."""
    if not problem.plant.integrators or problem.criterion.name != "setpoint":
        return None
    high = float(problem.edges(math.inf)[1][0])
    if not math.isfinite(high):
        return None
    low, up = math.log(high) - BELOW, math.log(high)
    for _ in range(ZOOMS):
        y = np.linspace(low, up, POINTS)
        values = problem.values(np.exp(y), math.inf)
        i = int(values.argmin())
        low, up = y[max(i - 1, 0)], y[min(i + 1, POINTS - 1)]
    return Found(math.exp(y[i]), math.inf, 0.0, float(values[i]))
