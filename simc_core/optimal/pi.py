"""The best PI controller under a bound of max(Ms, Mt): one search over log tau_I with Kc at its upper edge.

Where the criterion falls when Kc is reduced the bound does not matter: then Kc is searched too, below the edge.
The set point of an integrating plant is best followed without integral action, tau_I = inf.

Searches go by several controllers at a time, closer and closer: a march of seven costs little more than one, and
minima are often kinks (tau_I = tau1), where parabolas do not help.
"""

import math

import numpy as np

from simc_core.optimal.problem import Found, Problem

SHAPES, WIDER = 15, 3  # integral times of the first look; how often it looks further where the best is the last
LEAST, MOST = 0.15, 15.0  # of these, in units of the scale, or up to all times of the plant
POINTS, ZOOMS = 7, 6  # of a closer look
EQUALLY_GOOD = 1e-7  # relative; the neighbours of a minimum that are as good as it
INSIDE = 0.998  # of Kc at the edge: where a bound that matters makes the criterion worse
BELOW = 0.8  # log Kc below the edge, of the first look there
CLOSER, ROUNDS = 0.4, 9  # what each look at Kc and tau_I together is narrowed by, and how many there are


def best_pi(problem: Problem) -> Found | None:
    """None where no integral time allows a stable loop with the bound."""
    found = [each for each in (_with_integral(problem), _without(problem)) if each is not None]
    return min(found, key=lambda each: each.value, default=None)


def _with_integral(problem: Problem) -> Found | None:
    x, values = _first_look(problem)
    if not np.isfinite(values).any():
        return None
    i = int(values.argmin())
    low, high = x[max(i - 1, 0)], x[min(i + 1, len(x) - 1)]
    wide = (high - low) / 2
    best = x[i], values[i]
    for _ in range(ZOOMS):
        closer = np.linspace(low, high, POINTS + 2)[1:-1]
        values = _at_edge(problem, closer)
        i = int(values.argmin())
        best = min(best, (closer[i], values[i]), key=lambda each: each[1])
        low, high = closer[max(i - 1, 0)], closer[min(i + 1, POINTS - 1)]
        around = values[max(i - 1, 0) : i + 2]
        if around.max() <= values[i] * (1 + EQUALLY_GOOD):
            break
    tau_I, value = math.exp(best[0]), float(best[1])
    Kc = float(problem.edges(tau_I)[1][0])
    if problem.values(INSIDE * Kc, tau_I)[0] >= value:
        return Found(Kc, tau_I, 0.0, value)
    return _free(problem, best[0], wide)


def _at_edge(problem: Problem, x: np.ndarray) -> np.ndarray:
    """The criterion of each tau_I = e^x at the largest Kc."""
    return problem.values(problem.edges(np.exp(x))[1], np.exp(x))


def _first_look(problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """log tau_I, and the criterion at the edge of each."""
    low, high = LEAST * problem.scale, max(MOST * problem.scale, 2 * problem.times)
    x = np.linspace(math.log(low), math.log(high), SHAPES)
    values, more = _at_edge(problem, x), (x[1] - x[0]) * np.arange(1, 1 + SHAPES // 2)
    for _ in range(WIDER):
        i = int(values.argmin())
        if not np.isfinite(values[i]) or 0 < i < len(x) - 1:
            break
        further = x[0] - more[::-1] if i == 0 else x[-1] + more
        sides = [(further, _at_edge(problem, further)), (x, values)][:: 1 if i == 0 else -1]
        x, values = (np.concatenate(parts) for parts in zip(*sides, strict=True))
    return x, values


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
