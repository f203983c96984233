"""Rows of a table over the speed of one loop of a cascade, while the other one is held. Pure: no streamlit.

The outer design follows the inner one as the method says. Where the cascade is not sound there are no rows; neither
does a stencil reach across a speed at which a rule changes branch: tau_I of SIMC, the order of lags in the half rule.
"""

import math
from bisect import bisect
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from time import thread_time

import numpy as np

from pages.common.session.cascade import Cascade
from pages.common.studies.cascade import designed
from simc_core.cascade.design import CascadeDesign
from simc_core.errors import SimcError
from simc_core.loops.nested import CascadeLoop
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.simulation import Scenario, simulate
from simc_core.simulation.simulate_nested import unit_steps
from simc_core.studies.tau_table import Rows, first_rows, kinks, refined

PER_DECADE = 3
MOST_ROWS = 30  # of one section; a usual one needs 20
MOST_WORK = 1.0  # s of processor; a usual table takes a quarter of it
MOST_ROOTS = 60  # lags and zeros of both blocks: the first look alone would take longer
LOOKED_AT = 25  # speeds at which a change of branch or of the verdict is looked for
NEAR = 1e-5  # relative: to which its place is known
FIRST = 1e-4  # of the horizon, for the sums over it
SAMPLES = 300
PARAMETERS = ("Kp", "Ki", "Kd", "tau_F")


class TooSlow(Exception):
    """A table would take more work than a slider is worth: its curves come when it is released."""


@dataclass(slots=True)
class Work:
    """The work of one table: `within` is called before each speed. other: called then too, a newer wish may end all."""

    other: Callable[[], None]
    begun: float
    speeds: int = 0

    def within(self) -> None:
        """Raises TooSlow where MOST_WORK is spent, or will be by the first look at all speeds."""
        self.other()
        spent = thread_time() - self.begun
        if self.speeds and spent > MOST_WORK / 5 and spent * max(1.0, LOOKED_AT / self.speeds) > MOST_WORK:
            raise TooSlow
        self.speeds += 1


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """The instants at which all curves are computed, and when d1 and d2 begin."""

    t: np.ndarray
    d1: float
    d2: float


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """One speed: curves (y1, y2, u) at the instants, IAE of r, d1 and d2 by sums."""

    design: CascadeDesign
    curves: np.ndarray
    IAE: tuple[float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Section:
    """A range of speeds in which the cascade is sound, and its rows."""

    nodes: Rows
    rows: list[Row]


def at(held: Cascade, loop: str, speed: float) -> CascadeDesign:
    """The design with this speed of this loop. Raises SimcError."""
    return designed(replace(held, **{f"tau_c_{loop}": speed}))


def sections(
    held: Cascade, loop: str, low: float, high: float, grid: Grid, pause: Callable[[], None]
) -> tuple[list[Section], list[tuple[float, float]], bool]:
    """Rows; ranges that are not sound; whether there the inner loop is always stable. pause: called now and then.

    Raises TooSlow.
    """
    if sum(map(_roots, (held.primary, held.secondary))) > MOST_ROOTS:
        raise TooSlow
    pause = Work(pause, thread_time()).within
    seen: list[bool] = []

    def state(speed: float):
        pause()
        found = _state(held, loop, speed)
        seen.append(found[0] != "inner")
        return found

    found, unsound = [], []
    for (a, b), sound in _ranges(state, low, high):
        if sound:
            found.append(_section(held, loop, a, b, grid, pause))
        elif unsound and unsound[-1][1] >= a * (1 - 2 * NEAR):
            unsound[-1] = (unsound[-1][0], b)
        else:
            unsound.append((a, b))
    return found, unsound, all(seen)


def _roots(block: Plant) -> int:
    """How many poles and zeros, those at 0 left out."""
    return len(block.lags) + len(block.leads) + 2 * (len(block.lag_pairs) + len(block.lead_pairs))


def course(loop: CascadeLoop, grid: Grid) -> np.ndarray:
    """y1, y2, u after steps of r, d1 and d2, shape (3, points). Raises SimcError where it cannot be computed."""
    scenario = Scenario(disturbance_time=grid.d1, disturbance2_time=grid.d2, t_end=float(grid.t[-1]), t=grid.t)
    found = simulate(loop, scenario)
    return np.array([found.y, found.y2, found.u])


def IAE_by_sums(loop: CascadeLoop, end: float) -> tuple[float, float, float]:
    """Of r, d1, d2, good to a per cent or so: sums up to `end`, and what is left taken to have one sign.

    int e dt of a step of r is (r2(inf) - Kp (b - 1))/Ki, of one of d1 -1/Ki, of one of d2 0: outer Kp, Ki and b.
    """
    t = np.union1d(np.linspace(0.0, end, SAMPLES), np.geomspace(FIRST * end, end, SAMPLES))
    form = loop.outer.to_parallel()
    at_rest = 0.0 if loop.primary.integrators else 1 / loop.primary.k
    totals = np.array([(at_rest - form.Kp * (form.b - 1)) / form.Ki, -1 / form.Ki, 0.0])
    y_r, y_d2, y_d1 = unit_steps(loop.nested, t).T
    e = np.array([1 - y_r, -y_d1, -y_d2])
    return tuple(np.trapezoid(np.abs(e), t) + np.abs(totals - np.trapezoid(e, t)))


def _section(held: Cascade, loop: str, low: float, high: float, grid: Grid, pause: Callable[[], None]) -> Section:
    made: dict[float, Row] = {}

    def compute(speeds: np.ndarray) -> list[np.ndarray]:
        found = []
        for speed in speeds.tolist():
            pause()
            design = at(held, loop, speed)
            curves = course(design.loop, grid)
            made[_key(speed)] = Row(design, curves, IAE_by_sums(design.loop, float(grid.t[-1])))
            found.append(curves)
        return list(np.moveaxis(np.array(found), 1, 0))

    nodes, _ = refined(first_rows(low, high, [], PER_DECADE), compute, most=MOST_ROWS)
    return Section(nodes, [made[_key(speed)] for speed in nodes.tau_c.tolist()])


def _key(speed: float) -> float:
    return round(math.log(speed), 10)


def _ranges(state: Callable, low: float, high: float) -> list[tuple[tuple[float, float], bool]]:
    """Ranges of one state, in order, and whether it is sound there; ends that meet are NEAR each other."""
    speeds = np.geomspace(low, high, LOOKED_AT).tolist()
    states = [state(speed) for speed in speeds]
    begin, found = low, []
    for (a, b), (now, then) in zip(pairwise(speeds), pairwise(states), strict=True):
        if now == then:
            continue
        while b / a > 1 + NEAR:
            middle = math.sqrt(a * b)
            a, b = (middle, b) if state(middle) == now else (a, middle)
        found.append(((begin, a), now[0] == "sound"))
        begin = b
    return [*found, ((begin, high), states[-1][0] == "sound")]


def _state(held: Cascade, loop: str, speed: float) -> tuple:
    """Verdict in a word, and for a sound cascade the branch of the rules it is on."""
    try:
        design = at(held, loop, speed)
        verdict = design.stability
    except SimcError:  # no such design, or too wild a one for the certificate
        return ("none",)
    if verdict.inner.verdict != "stable":
        return ("inner",)
    if not verdict.sound:
        return ("outer",)
    if design.models is None:
        return ("sound",)
    speeds = design.tau_c_inner, design.tau_c_outer
    branches = [_branch(model, tau_c) for model, tau_c in zip(design.models, speeds, strict=True)]
    return ("sound", *branches, bisect(sorted(map(abs, held.primary.lags)), design.tau_c_inner))


def _branch(model: Model, tau_c: float) -> tuple:
    return type(model), [tau_c < kink for kink in kinks(model)]
