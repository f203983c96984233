"""Unit step responses of one plant under many controllers at once: the method of steps on elements that grow.

    w(t) = z(t - theta)      z = u + d from w: the plant's maps (measured.py, levels.py), the controllers' law (law.py)

The maps are the same for all tunings of a plant.

Intervals. Over [k theta, (k+1) theta] w is known from the interval before. Jumps and kinks sit at k theta, on edges,
and cost no accuracy; a mesh that is fine at its start holds the fast modes that they excite.
Elements. A jump comes back smoother by the relative degree of L each time. Once it is smooth, elements of length
theta 2^level take over, each tuning at its own pace. The part of w beyond theta is then the element itself:

    w = H + B z,   z = c - Z w     =>     w = (1 + B Z)^-1 (H + B c)

with H from the element before and B the interpolation at t - theta. Without dead time B = 1, H = 0.
How long an element may be, see pace.py. A horizon of 10^6 dead times costs a few elements more than one of ten.
"""

import math
from collections.abc import Sequence

import numpy as np
from scipy.linalg.lapack import dgesv

from simc_core.controllers import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.logresponse import FactoredResponse
from simc_core.plant import Plant
from simc_core.simulation.course import Course, Stretch, course
from simc_core.simulation.elements import TO_CHEBYSHEV, P
from simc_core.simulation.law import Law
from simc_core.simulation.levels import EYE, levels
from simc_core.simulation.pace import ROUNDING, TAIL, Pace

SMOOTH = 7  # order of derivative from which a jump is left to the tails
COARSE, FINEST = 1e-10, 4  # a tail on the mesh that is too large, and how often the mesh is halved for it
MOST_TO_END, MOST_TO_REST = 12_000, 6_000  # elements of one tuning, 30 us each
LARGEST = 1e150  # an unstable response is cut off here
WELL_POSED = 1e-12
VALUES_AND_LAST = np.concatenate([EYE, TO_CHEBYSHEV[-2:]])  # of nodal values: these and the last two coefficients


def march(plant: Plant, forms: Sequence[ParallelPid], t_end: float | None) -> Course:
    """All tunings from rest to t_end, or to their rest (t_end = None, for stable loops).

    forms: controllers with one tau_F. Raises InvalidParameter: derivative action without filter where y or r may jump;
    an ill-posed loop without dead time; a t_end that needs more than MOST_TO_END elements.
    """
    _check(plant, forms)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for finer in range(FINEST + 1):
            walk = _Walk(plant, forms, t_end, finer)
            if walk.arrives():
                break
    return course(walk.stretches, [pace.at_rest for pace in walk.paces])


def final_values(plant: Plant, form: ParallelPid) -> np.ndarray:
    """Where y and u (rows) end after unit steps of r and of d (columns), if the loop is stable."""
    if form.Ki:
        return np.array([[1.0, 0.0], [0.0 if plant.integrators else 1 / plant.k, -1.0]])
    if plant.integrators:
        return np.array([[form.b, 1 / form.Kp if form.Kp else math.inf], [0.0, -1.0]])
    S = 1 / (1 + plant.k * form.Kp)
    return np.array([[form.b * (1 - S), plant.k * S], [form.b * form.Kp * S, S - 1]])


def _check(plant: Plant, forms: Sequence[ParallelPid]) -> None:
    for form in forms:
        if form.Kd and form.c and not form.tau_F:
            raise InvalidParameter(
                f"tau_F must be > 0 where the derivative acts on the set point (c > 0), got {form.tau_F:g}"
            )
        if not plant.theta:
            L = plant.factored * form.factored
            if L.relative_degree == 0 and abs(1 + FactoredResponse(L).at_infinity.gain) < WELL_POSED:
                raise InvalidParameter("1 + L(inf) must not be 0 in a loop without dead time, got 0: u is not defined")


class _TooCoarse(Exception):
    """Echoes of a neutral loop have become rougher than the modes of the plant, which the mesh was made for."""


class _Walk:
    """State of the march: x (n, n_x, 2), xi (n, 2), z at the nodes of the element before, the pace of each tuning."""

    def __init__(self, plant: Plant, forms: Sequence[ParallelPid], t_end: float | None, finer: int):
        n = len(forms)
        self.levels = levels(plant, forms[0].tau_F, any(form.Kd for form in forms), finer)
        self.law = Law(forms, self.levels)
        self.coarse = math.inf if finer == FINEST else COARSE  # tail of an interval that asks for a finer mesh
        self.theta, self.t_end, self.n = plant.theta, t_end, n
        self.final = np.array([final_values(plant, form).ravel() for form in forms])
        self.final[:, 3] += 1.0  # of z
        self.x, self.xi = np.zeros((n, self.levels.chain.n, 2)), np.zeros((n, 2))
        self.z = np.zeros((n, P * max(len(self.levels.mesh), 1), 2))
        self.largest = np.full((n, 4), 1e-300)
        self.paces = [Pace() for _ in range(n)]
        self.active = dict.fromkeys(range(n))
        self.stretches: list[Stretch] = []

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
        everyone, degree = list(range(self.n)), self._degree()
        count = 2 + math.ceil(SMOOTH / degree) if degree else 3 * SMOOTH
        if self.t_end is not None:
            count = min(count, math.floor(self.t_end / self.theta * (1 + 1e-12)) + 1)
        for _ in range(max(count - 1, 0)):
            self._keep(everyone, slice(None), 0, self.theta, *self._interval(everyone, slice(None)))
        self._groups({(True, 0): everyone})

    def _degree(self) -> int:
        """Least relative degree of the loops."""
        chain, (Kp, Kd, _) = self.levels.chain, self.law.gains.T
        if Kd.any():
            return chain.relative_degree - (not chain.tau_F)
        return chain.relative_degree + (chain.tau_F > 0) + (not Kp.any())

    def elements(self) -> None:
        """On at every tuning's own pace."""
        work, most = 0, MOST_TO_REST if self.t_end is None else MOST_TO_END
        while self.active and work < most:
            groups: dict[tuple[bool, int], list[int]] = {}
            for i in self.active:
                pace = self.paces[i]
                groups.setdefault((pace.before == 0, pace.level), []).append(i)
            self._groups(groups)
            on_mesh = self.theta > 0 and any(level == 0 for _, level in groups)
            work += len(self.levels.mesh) if on_mesh else 1
        if self.active and self.t_end is not None:
            raise InvalidParameter(
                f"t_end must need at most {MOST_TO_END} elements, got {self.t_end:.4g}, of which they cover "
                f"{min(self.paces[i].t for i in self.active):.4g}: the loop oscillates too fast for it"
            )

    def _groups(self, groups: dict[tuple[bool, int], list[int]]) -> None:
        """One stretch each. Keys: whether it follows an interval on the mesh, and its level."""
        for (_, level), which in groups.items():
            at = slice(None) if len(which) == self.n else np.array(which)
            if level == 0 and self.theta:
                self._decide(which, at, 0, self.theta, *self._interval(which, at))
            else:
                self._decide(which, at, level, self.levels[level].length, *self._element(which, at, level))

    def _interval(self, which: list[int], at):
        """One interval of theta on the mesh: w is z of the interval before. As _element."""
        x, xi, w, values = self.x[at], self.xi[at], self.z[at], []
        if self.paces[which[0]].before:
            w = self._history(which, 0) @ w[:, -P:]
        begin = [self.paces[i].t for i in which]
        for e, level in enumerate(self.levels.mesh):
            known = self.law.known(at, level, begin, xi)
            own, x, xi = self._answer(at, level, begin, xi, known, x, w[:, e * P : (e + 1) * P])
            values.append(own)
            begin = [each + self.levels[level].length for each in begin]
        return np.concatenate(values, axis=1) if len(values) > 1 else values[0], x, xi

    def _element(self, which: list[int], at, level: int):
        """One element of theta 2^level, w and z together: y and z at its nodes (k, P, 4), x and xi at its end."""
        made, x, xi, n = self.levels[level], self.x[at], self.xi[at], self.levels.chain.n
        begin, feedback = [self.paces[i].t for i in which], self.law[level].feedback[at]
        known = self.law.known(at, level, begin, xi)
        right = made.B @ (known - feedback[:, :, :n] @ x)
        if self.theta:
            right += self._history(which, level) @ (self.z[at, -P:] if self.paces[which[0]].before else self.z[at])
        w = _solved(EYE + made.B @ feedback[:, :, n:], right)
        return self._answer(at, level, begin, xi, known, x, w)

    def _history(self, which: list[int], level: int) -> np.ndarray:
        """levels.history for each tuning, one matrix where all are alike."""
        before = [self.paces[i].before for i in which]
        if before.count(before[0]) == len(before):
            return self.levels.history(before[0], level)
        return np.array([self.levels.history(each, level) for each in before])

    def _answer(self, at, level: int, begin: list[float], xi: np.ndarray, known: np.ndarray, x: np.ndarray, w):
        made, given = self.levels[level], np.concatenate([x, w], axis=1)
        z = known - self.law[level].feedback[at] @ given
        out = made.outcome @ given
        return (
            np.concatenate([out[:, :P], z], axis=2),
            out[:, P + 1 :],
            self.law.integral(at, begin, xi, made.length, out[:, P]),
        )

    def _decide(self, which: list[int], at, level: int, length: float, values, x, xi) -> None:
        """Keep what is good enough, shorten what is not; choose the level of the next element."""
        k = len(which)
        on_mesh = level == 0 and self.theta > 0
        sizes = (
            np.abs(VALUES_AND_LAST @ values.reshape(k, -1, P, 4)).max(axis=1)
            if on_mesh
            else np.abs(VALUES_AND_LAST @ values)
        )
        sizes, tails = np.maximum.reduceat(sizes, (0, P), axis=1).transpose(1, 0, 2)
        largest = np.maximum(self.largest[at], sizes)
        tails = (tails / largest).max(axis=1).tolist()
        if on_mesh and max(tails) > self.coarse:
            raise _TooCoarse
        good = [j for j, tail in enumerate(tails) if tail <= TAIL or on_mesh]
        if len(good) < k:
            for j in set(range(k)) - set(good):
                self.paces[which[j]].shorten()
            if not good:
                return
            which, tails = [which[j] for j in good], [tails[j] for j in good]
            values, x, xi, largest = values[good], x[good], xi[good], largest[good]
            at = np.array(which)
        self._keep(which, at, level, length, values, x, xi)
        self.largest[at] = largest
        away = self._away(at, values, largest) if self.t_end is None else tails
        for i, tail, far, size in zip(which, tails, away, largest.max(axis=1).tolist(), strict=True):
            pace = self.paces[i]
            pace.lengthen(tail, None if self.t_end is None else (self.t_end - pace.t) / self.levels.unit)
            # what is asked for at t_end is the right-hand limit
            arrived = pace.rests(far) if self.t_end is None else pace.t > self.t_end * (1 + 1e-12)
            if arrived or not size < LARGEST:
                del self.active[i]

    def _away(self, at, values: np.ndarray, largest: np.ndarray) -> list[float]:
        """How far from its final value each response gets in the element, over its largest value; inf where far."""
        final = self.final[at]
        near = (np.abs(values[:, -1] - final) <= ROUNDING * largest).all(axis=1)
        if not near.any():
            return [math.inf] * len(values)
        return (np.abs(values - final[:, None]).max(axis=1) / largest).max(axis=1).tolist()

    def _keep(self, which: list[int], at, level: int, length: float, values, x, xi) -> None:
        """Enter a stretch, and go on from its end."""
        lengths = tuple(self.theta * part for part in self.levels.shape) if level == 0 and self.theta else (length,)
        self.stretches.append(Stretch(which, [self.paces[i].t for i in which], lengths, values))
        self.x[at], self.xi[at] = x, xi
        self.z[at, -values.shape[1] :] = values[:, :, 2:]
        for i in which:
            self.paces[i].t += length
            self.paces[i].before = level


def _solved(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """matrix^-1 right, (k, P, P) and (k, P, 2); a single one without the detour that costs more than solving it."""
    if len(matrix) == 1:
        return dgesv(matrix[0], right[0])[2][None]
    return np.linalg.solve(matrix, right)
