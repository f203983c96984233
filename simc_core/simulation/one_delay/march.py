"""Unit step responses of one plant under many controllers at once: the method of steps on elements that grow.

    w(t) = z(t - theta)      z = u + d from w: maps of the plant (process_maps.py), the law of the controllers

The maps are the same for all tunings of a plant.

Intervals. Over [k theta, (k+1) theta] w is known from the interval before. Jumps and kinks sit at k theta, on edges,
and cost no accuracy; a mesh that is fine at its start holds the fast modes that they excite.
Elements. A jump comes back smoother by the relative degree of L each time. Once it is smooth, elements of length
theta 2^level take over, each tuning at its own pace. The part of w beyond theta is then the element itself:

    w = H + B z,   z = Z w + z_x x     =>     w = (1 - B Z)^-1 (H + B z_x x)

with H from the element before and B the interpolation at t - theta. Without dead time B = 1, H = 0. What an element
does to w and to the state x of loop and inputs is one matrix, see closed_element.py.
How long an element may be, see step_control.py. A horizon of 10^6 dead times costs a few elements more than one of ten.
"""

import math
from collections.abc import Sequence
from typing import NoReturn

import numpy as np
from scipy.linalg.lapack import dgesv

from simc_core.certificate.poles import dominant_poles
from simc_core.controllers.forms import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.loops.well_posed import require_well_posed
from simc_core.plants.plant import Plant
from simc_core.sensitivity.log_response import FactoredResponse
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.one_delay.closed_element import END, PARTS, ClosedElements, Z
from simc_core.simulation.one_delay.element_sizes import ElementSizes, levels
from simc_core.simulation.one_delay.final_values import final_values
from simc_core.simulation.one_delay.limits import (
    LIKELY,
    LOOK,
    MOST_HELD,
    MOST_OF_ALL,
    MOST_TO_END,
    MOST_TO_REST,
    oscillation,
    together,
    too_much,
)
from simc_core.simulation.one_delay.process_maps import Chosen
from simc_core.simulation.one_delay.step_control import GONE, REST, TAIL, StepControl
from simc_core.simulation.one_delay.unit_responses import Batch, UnitResponses, course
from simc_core.wording import said

SMOOTH = 7  # order of derivative from which a jump is left to the tails
MOST_INTERVALS = 3 * SMOOTH  # of theta that are stepped over first
COARSE, FINEST = 1e-10, 4  # a tail on the mesh that is too large, and how often the mesh is halved for it
CUT_OFF = 1e150  # an unstable response is cut off here


def march(plant: Plant, forms: Sequence[ParallelPid], t_end: float | None, most: float | None = None) -> UnitResponses:
    """The first tunings, as many as limits.py lets march together, from rest to t_end, or to their rest (t_end = None,
    for stable loops).

    forms: controllers with one tau_F.   most: elements of one tuning, after which it is left where it is on its way to
    rest; on the way to t_end what all may take on average.
    Raises InvalidParameter: derivative action without filter where y or r may jump; an ill-posed loop without dead
    time; a t_end that needs more than MOST_TO_END elements.
    """
    check(plant, forms)
    most = most or (MOST_TO_REST if t_end is None else MOST_OF_ALL)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for finer in range(FINEST + 1):
            derivative = any(form.Kd for form in forms)
            sizes = levels(plant, forms[0].tau_F, derivative, finer)
            marching = March([plant], forms, np.ones(1), sizes, t_end, most, finer == FINEST)
            if marching.arrives():
                break
    return course(marching.batches, [control.at_rest for control in marching.controls[: marching.n_left]])


def check(plant: Plant, forms: Sequence[ParallelPid]) -> None:
    """Raises InvalidParameter where `march` does before it begins."""
    for form in forms:
        if form.Kd and form.c and not form.tau_F:
            raise InvalidParameter(said("tau_F must be > 0 for derivative action on a set-point step (c > 0), found 0"))
        if not plant.theta:
            L = plant.factored * form.factored
            if L.relative_degree == 0:
                require_well_posed(1 + FactoredResponse(L).at_infinity.gain)


class _TooCoarse(Exception):
    """Echoes of a neutral loop have become rougher than the modes of the plant, which the mesh was made for."""


class March:
    """State of the march: x (n, size, 2) as in closed_element.py, z at the nodes of the step before,
    the step control of each tuning.

    A step is some intervals or one element: what G makes of (w, x), one array (k, END + size, 2) for each element.
    """

    def __init__(
        self,
        plants: Sequence[Plant],
        forms: Sequence[ParallelPid],
        units: np.ndarray,
        sizes: ElementSizes,
        t_end: float | None,
        most: float,
        finest: bool,
    ):
        self.proportional, self.derivative = any(form.Kp for form in forms), sizes.chain.derivative
        self.levels = sizes
        self.count = self._count(sizes.theta, t_end)
        at_first = self.count * len(self.levels.mesh)
        if at_first > MOST_TO_END:
            raise InvalidParameter(
                said(
                    "the first {count} dead times must need at most {most_to_end} elements, found {at_first}: "
                    "modes of the plant are too fast for its dead time",
                    count=self.count,
                    most_to_end=MOST_TO_END,
                    at_first=at_first,
                )
            )
        forms = forms[: together(at_first)]
        n = self.n_left = len(forms)
        self.plants, self.forms, self.units = plants, forms, units
        self.most, self.on_average = (most if t_end is None else MOST_TO_END), most
        self.closed = ClosedElements(forms, self.levels, units)
        self.coarse = math.inf if finest else COARSE  # tail of an interval that asks for a finer mesh
        self.theta, self.t_end, self.n = sizes.theta, math.inf if t_end is None else t_end, n
        self.to_rest = t_end is None
        if self.to_rest:
            final = [final_values(self._plant(i), form) for i, form in enumerate(forms)]
            self.final = np.array(final).repeat(P, axis=1)  # y and z at the nodes
            self.final[:, P:, 1] += 1.0
        self.mesh = [self.theta * part for part in self.levels.shape]
        self.x = self.closed.start()
        self.places = [slice(e * P, (e + 1) * P) for e in range(max(len(self.mesh), 1))]  # of the elements in z
        self.z = np.zeros((n, self.places[-1].stop, 2))
        self.largest = np.full((n, 2, 2), 1e-300)
        self.controls = [StepControl() for _ in range(n)]
        self.active = dict.fromkeys(range(n))
        self.batches: list[Batch] = []
        self.held = 0  # elements in them
        self.rates: dict[int, float] = {}

    def _plant(self, i: int) -> Plant:
        """The plant of a tuning."""
        return self.plants[i if len(self.plants) > 1 else 0]

    def _unit(self, i: int) -> float:
        """Its unit of time."""
        return float(self.units[i if len(self.plants) > 1 else 0])

    def _loop(self, i: int) -> Loop:
        return Loop(self._plant(i), self.forms[i])

    def arrives(self) -> bool:
        """The whole way; False as soon as the mesh turns out to be too coarse."""
        try:
            if self.theta:
                self.intervals()
            self.elements()
        except _TooCoarse:
            return False
        return True

    def intervals(self) -> None:
        """The first intervals of theta, all tunings together, until what comes back is smooth."""
        everyone = list(range(self.n))
        self._decide(everyone, slice(None), 0, self._intervals(everyone, slice(None), self.count))

    def _count(self, theta: float, t_end: float | None) -> int:
        """Intervals of theta that are stepped over first."""
        degree = self._degree()
        count = 2 + math.ceil(SMOOTH / degree) if degree else MOST_INTERVALS
        if theta and t_end is not None:
            count = min(count, math.floor(t_end / theta * (1 + 1e-12)) + 1)
        return max(count, 1)

    def _degree(self) -> int:
        """Least relative degree of the loops."""
        chain = self.levels.chain
        if self.derivative:
            return chain.relative_degree - (not chain.filtered)
        return chain.relative_degree + chain.filtered + (not self.proportional)

    def elements(self) -> None:
        """On at every tuning's own pace."""
        work, looked = 0, False
        while self.active and work < self.most:
            groups: dict[tuple[bool, int], list[int]] = {}
            for i in self.active:
                control = self.controls[i]
                groups.setdefault((control.before == 0, control.level), []).append(i)
            self._groups(groups)
            work += 1 if not self.theta or all(level for _, level in groups) else len(self.mesh)
            while self.held > MOST_HELD and self.n_left > 1:
                self._leave_half()
            if work >= LOOK and not looked:
                looked = True
                self._drop_endless()
        if self.active and not self.to_rest:
            self._refuse(min(self.controls[i].t for i in self.active))

    def _refuse(self, covered: float) -> NoReturn:
        raise InvalidParameter(
            said(
                "t_end must need at most {most_to_end} elements, found {t_end:.4g}, of which they cover "
                "{covered:.4g}: the loop oscillates too fast for it",
                most_to_end=MOST_TO_END,
                t_end=self.t_end,
                covered=covered,
            )
        )

    def _leave_half(self) -> None:
        """Half of the tunings that are left are for another march."""
        self.n_left = math.ceil(self.n_left / 2)
        self.active = {i: None for i in self.active if i < self.n_left}
        self.batches = [each.first(self.n_left) for each in self.batches if each.which[0] < self.n_left]
        self.held = sum(len(each.which) * len(each.values) for each in self.batches)

    def _drop_endless(self) -> None:
        """Stop where even the least number of elements is too many, or the likely one of all tunings."""
        likely = 0.0
        for i in list(self.active):
            per_time, duration = oscillation(self._loop(i))
            end = duration if self.to_rest else min(duration, self.t_end)
            likely += LIKELY * per_time * end
            if per_time * end > self.most:
                if not self.to_rest:
                    self._refuse(self.most / per_time)
                del self.active[i]
        if not self.to_rest and likely > self.on_average * self.n:
            raise InvalidParameter(too_much(self.t_end))

    def _groups(self, groups: dict[tuple[bool, int], list[int]]) -> None:
        """One batch each. Keys: whether it follows an interval on the mesh, and its level."""
        for (_, level), which in groups.items():
            at = slice(None) if len(which) == self.n else np.array(which)
            on_mesh = level == 0 and self.theta
            self._decide(
                which, at, level, self._intervals(which, at, 1) if on_mesh else self._element(which, at, level)
            )

    def _intervals(self, which: list[int], at: Chosen, count: int) -> list[np.ndarray]:
        """Some intervals of theta, each on its mesh: w is z of the interval before."""
        x, step, matrices = self.x[at], [], [self.closed[level].G[at] for level in self.levels.mesh]
        known = self._history(which, 0) @ self.z[at, -P:] if self.controls[which[0]].before else self.z[at]
        ahead = [known[:, places] for places in self.places]
        for i in range(count * len(matrices)):
            out = matrices[i % len(matrices)] @ np.concatenate([ahead[i], x], axis=1)
            x = out[:, END:]
            ahead.append(out[:, Z])
            step.append(out)
        return step

    def _element(self, which: list[int], at: Chosen, level: int) -> list[np.ndarray]:
        """One element of theta 2^level, w and z together."""
        x, closed = self.x[at], self.closed.known(level, which, lambda: self._as_short(level))
        right = closed.begun[at] @ x
        if self.theta:
            right += self._history(which, level) @ (self.z[at, -P:] if self.controls[which[0]].before else self.z[at])
        return [closed.G[at] @ np.concatenate([_solved(closed.one_less[at], right), x], axis=1)]

    def _as_short(self, level: int) -> list[int]:
        """Tunings on their way whose elements are not longer than this yet."""
        return [i for i in self.active if self.controls[i].level <= level]

    def _history(self, which: list[int], level: int) -> np.ndarray:
        """levels.history for each tuning, one matrix where all are alike."""
        before = [self.controls[i].before for i in which]
        if before.count(before[0]) == len(before):
            return self.levels.history(before[0], level)
        return np.array([self.levels.history(each, level) for each in before])

    def _decide(self, which: list[int], at: Chosen, level: int, step: list[np.ndarray]) -> None:
        """Keep what is good enough, shorten what is not; choose the level of the next element."""
        on_mesh, parts = level == 0 and self.theta > 0, self._parts(level)
        sizes = [np.maximum.reduceat(np.abs(out[:, :END]), PARTS, axis=1) for out in step]
        found = _largest(sizes[-len(parts) :]).reshape(-1, 3, 2, 2)
        # of all outputs of the step, not of its last elements alone: what rounding leaves is measured against it
        largest = np.maximum(_largest(sizes).reshape(-1, 3, 2, 2)[:, 0], self.largest[at])
        _, middles, tails = np.maximum.reduce(found / largest[:, None], axis=(2, 3)).T.tolist()
        if on_mesh and max(tails) > self.coarse:
            raise _TooCoarse
        good = range(len(which)) if on_mesh else [j for j, tail in enumerate(tails) if tail <= TAIL]
        if len(good) < len(which):
            for j in set(range(len(which))) - set(good):
                self.controls[which[j]].shorten()
            if not good:
                return
            which, middles, tails = ([each[j] for j in good] for each in (which, middles, tails))
            step, largest, at = [out[good] for out in step], largest[good], np.array(which)
        self._keep(which, at, level, step, parts)
        self.largest[at] = largest
        judged, unit = self.levels.mesh[-1] if on_mesh else level, self.levels.unit
        reached = self._sizes(at, step[-len(parts) :], largest)
        for i, middle, tail, size in zip(which, middles, tails, reached, strict=True):
            control = self.controls[i]
            left = None if self.to_rest else (self.t_end - control.t) / unit
            control.lengthen(judged, middle, tail, control.t / unit, left)
            # what is asked for at t_end is the right-hand limit
            if self._rests(i, size) if self.to_rest else control.t > self.t_end * (1 + 1e-12) or not size < CUT_OFF:
                del self.active[i]

    def _rests(self, i: int, away: float) -> bool:
        """Whether a response within `away` of its end has arrived; what does not get nearer may be a slow mode."""
        control = self.controls[i]
        control.at_rest = away <= REST or (
            control.stalls(away) and self._slowest(i) * control.t * self._unit(i) >= GONE
        )
        return control.at_rest

    def _slowest(self, i: int) -> float:
        """Rate at which the slowest mode of a tuning decays; infinite where it is not known."""
        if i not in self.rates:
            poles = dominant_poles(self._loop(i), most=1)
            self.rates[i] = -poles[0].s.real if poles else math.inf
        return self.rates[i]

    def _sizes(self, at: Chosen, last: list[np.ndarray], largest: np.ndarray) -> list[float]:
        """How far from rest each response gets, over its largest value; on the way to t_end how large it has been."""
        if not self.to_rest:
            return largest.max(axis=(1, 2)).tolist()
        final = self.final[at]
        away = _largest([np.maximum.reduceat(np.abs(out[:, : 2 * P] - final), (0, P), axis=1) for out in last])
        return np.maximum.reduce(away / largest, axis=(1, 2)).tolist()

    def _keep(self, which: list[int], at: Chosen, level: int, step: list[np.ndarray], parts: list[float]) -> None:
        """Enter a batch, and go on from its end."""
        controls, intervals = [self.controls[i] for i in which], len(step) // len(parts)
        self.batches.append(Batch(which, [control.t for control in controls], parts * intervals, step))
        self.held += len(which) * len(step)
        self.x[at] = step[-1][:, END:]
        for places, out in zip(self.places[-len(parts) :], step[-len(parts) :], strict=True):
            self.z[at, places] = out[:, Z]
        for control in controls:
            control.t += intervals * self.levels.length(level)
            control.before = level

    def _parts(self, level: int) -> list[float]:
        """Lengths of the elements of one step of the march."""
        return self.mesh if level == 0 and self.theta else [self.levels.length(level)]


def _largest(arrays: list[np.ndarray]) -> np.ndarray:
    return arrays[0] if len(arrays) == 1 else np.maximum.reduce(arrays)


def _solved(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """matrix^-1 right, (k, P, P) and (k, P, 2); a single one without the detour that costs more than solving it."""
    if len(matrix) == 1:
        return dgesv(matrix[0], right[0])[2][None]
    return np.linalg.solve(matrix, right)
