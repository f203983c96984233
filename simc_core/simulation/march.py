"""Unit step responses of one plant under many controllers at once: the method of steps on elements that grow.

    w(t) = z(t - theta),   z = u + d,   u = f(t) + xi - Kp p - Kd p' - Ki int p     (measured.py: w -> y, p, p', int p)

f is what the set point does, known in closed form; xi is the integral at the start of the element. All that differs
between tunings are the gains in this law: the plant's maps are one matrix product for all of them.

Intervals. Over [k theta, (k+1) theta] w is known from the interval before. Jumps and kinks sit at k theta, on edges,
and cost no accuracy; a mesh that is fine at its start holds the fast modes that they excite.
Elements. A jump comes back smoother by the relative degree of L each time. Once it is smooth, elements of length
theta 2^level take over, each tuning at its own pace. The part of w beyond theta is then the element itself:

    w = H + B z,   z = c - Z w     =>     w = (1 + B Z)^-1 (H + B c)

with H from the element before and B the interpolation at t - theta. Without dead time B = 1, H = 0.
An element is good if the last Chebyshev coefficients of y and u are below TAIL of their largest values so far; else
it is halved. A horizon of 10^6 dead times costs a few elements more than one of ten.
"""

import math
from collections.abc import Sequence

import numpy as np

from simc_core.characteristic import limit_at_infinity
from simc_core.controllers import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.plant import Plant
from simc_core.simulation.course import Course, Stretch, course
from simc_core.simulation.elements import TO_CHEBYSHEV, P
from simc_core.simulation.levels import EYE, levels
from simc_core.simulation.measured import SIGNALS

TAIL = 1e-12
ROOM = 3e-3  # of TAIL: so small a tail lets the next element be longer at once
PATIENCE, MOST_PATIENCE = 4, 16  # elements of one length before a longer one is tried
SMOOTH = 7  # order of derivative from which a jump is left to the tails
REST = 1e-11  # of the largest value: nearer than this to where it ends, a response is at rest
COARSE, FINEST = 1e-10, 4  # a tail on the mesh that is too large, and how often the mesh is halved for it
ROUNDING = 1e-6  # a stiff loop that comes no nearer than this has reached its rounding errors
MOST_ROUNDS, MOST_TO_REST = 12_000, 5_000  # elements of one tuning
LOWEST, HIGHEST = -48, 60  # levels
FORGOTTEN = 40.0  # time constants of the filter after which the step has gone through it
LARGEST = 1e150  # an unstable response is cut off here
WELL_POSED = 1e-12
LAST = TO_CHEBYSHEV[-2:]
STEP_R, STEP_D = np.array([1.0, 0.0]), np.array([0.0, 1.0])  # columns: unit step of r, unit step of d


def march(plant: Plant, forms: Sequence[ParallelPid], t_end: float | None) -> Course:
    """All tunings from rest to t_end, or to their rest (t_end = None, for stable loops).

    forms: controllers with one tau_F. Raises InvalidParameter: derivative action without filter where y or r may jump;
    an ill-posed loop without dead time; a t_end that needs more than MOST_ROUNDS elements.
    """
    _check(plant, forms)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for finer in range(FINEST + 1):
            walk = _Walk(plant, forms, t_end, finer)
            if walk.arrives():
                break
    return course(walk.stretches, len(forms), walk.at_rest)


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
            if L.relative_degree == 0 and abs(1 + limit_at_infinity(L)) < WELL_POSED:
                raise InvalidParameter("1 + L(inf) must not be 0 in a loop without dead time, got 0: u is not defined")


class _TooCoarse(Exception):
    """Echoes of a neutral loop have become rougher than the modes of the plant, which the mesh was made for."""


class _Walk:
    """State of the march: x (n_x, n, 2), xi (n, 2), z at the nodes of the element before; each tuning's own pace.

    gains: Kp, Kd, Ki, (3, n, 1).
    """

    def __init__(self, plant: Plant, forms: Sequence[ParallelPid], t_end: float | None, finer: int):
        n = len(forms)
        self.levels = levels(plant, forms[0].tau_F, any(form.Kd for form in forms), finer)
        self.coarse = math.inf if finer == FINEST else COARSE  # tail of an interval that asks for a finer mesh
        self.chain, self.theta, self.t_end, self.n = self.levels.chain, plant.theta, t_end, n
        self.gains = np.array(
            [[[form.Kp] for form in forms], [[form.Kd] for form in forms], [[form.Ki] for form in forms]]
        )
        self.ahead = np.array([form.Kp * form.b for form in forms])  # proportional action on the set point
        self.kick = np.array([form.Kd * form.c for form in forms])
        self.final = np.array([final_values(plant, form) for form in forms]).transpose(1, 0, 2)
        self.final[1] += STEP_D  # of z
        self.x, self.xi = np.zeros((self.chain.n, n, 2)), np.zeros((n, 2))
        self.z = np.zeros((P * max(len(self.levels.mesh), 1), n, 2))
        self.largest = np.full((2, n, 2), 1e-300)
        self.at_rest = [False] * n
        self.t, self.level, self.before = [0.0] * n, [0] * n, [0] * n  # before: level of the element before
        self.good, self.patience = [0] * n, [PATIENCE] * n  # elements since the last change, and how many there must be
        self.mark, self.away_at_mark = [0.0] * n, [math.inf] * n
        self.active = dict.fromkeys(range(n))
        self.set_points: dict[int, np.ndarray] = {}
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
            found = self._interval(slice(None), np.array(self.t[:1]), 0)
            self._keep(everyone, slice(None), 0, self.theta, *found)
        self._groups({(0, 0): everyone})

    def _degree(self) -> int:
        """Least relative degree of the loops."""
        degree = self.chain.relative_degree
        if self.gains[1].any():
            return degree - (not self.chain.tau_F)
        return degree + (self.chain.tau_F > 0) + (not self.gains[0].any())

    def elements(self) -> None:
        """On at every tuning's own pace."""
        for _ in range(MOST_TO_REST if self.t_end is None else MOST_ROUNDS):
            if not self.active:
                return
            groups: dict[tuple[int, int], list[int]] = {}
            for i in self.active:
                groups.setdefault((self.before[i], self.level[i]), []).append(i)
            self._groups(groups)
        if self.t_end is not None:
            raise InvalidParameter(
                f"t_end must need at most {MOST_ROUNDS} elements, got {self.t_end:.4g}, of which they cover "
                f"{min(self.t[i] for i in self.active):.4g}: the loop oscillates too fast for it"
            )

    def _groups(self, groups: dict[tuple[int, int], list[int]]) -> None:
        for (before, level), which in groups.items():
            at = slice(None) if len(which) == self.n else np.array(which)
            begin = np.array([self.t[i] for i in which])
            if level == 0 and self.theta:
                self._decide(which, at, 0, self.theta, *self._interval(at, begin, before))
            else:
                self._decide(which, at, level, self.levels[level].length, *self._element(at, begin, before, level))

    def _interval(self, at, begin: np.ndarray, before: int):
        """One interval of theta on the mesh: w is z of the interval before. As _element."""
        x, xi, w = self.x[:, at], self.xi[at], self.z[:, at]
        if before:
            w = _applied(self.levels.history(before, 0), w[-P:])
        k, values = w.shape[1], np.empty((2, *w.shape))
        for e, level in enumerate(self.levels.mesh):
            made, own = self.levels[level], slice(e * P, (e + 1) * P)
            flat = made.signals @ np.concatenate([x.reshape(len(x), 2 * k), w[own].reshape(P, 2 * k)])
            signals = flat[: SIGNALS * P].reshape(SIGNALS, P, k, 2)
            values[0, own] = signals[0]
            values[1, own] = self._known(at, begin, xi, level) - self._fed_back(at, signals)
            x = flat[SIGNALS * P :].reshape(len(x), k, 2)
            xi = self._integral(at, begin, xi, made.length, signals[3, -1])
            begin = begin + made.length
        return values, x, xi

    def _element(self, at, begin: np.ndarray, before: int, level: int):
        """One element of theta 2^level, w and z together: y and z at its nodes (2, P, k, 2), x and xi at its end."""
        made, x, xi = self.levels[level], self.x[:, at], self.xi[at]
        k = x.shape[1]
        free = _applied(made.free, x)
        signals = free[: SIGNALS * P].reshape(SIGNALS, P, k, 2)
        c = self._known(at, begin, xi, level) - self._fed_back(at, signals)
        right = _applied(made.B, c)
        if self.theta:
            right += _applied(self.levels.history(before, level), self.z[-P:, at] if before else self.z[:, at])
        Z = (self.gains[:, at, 0].T @ made.back).reshape(k, P, P)
        w = np.linalg.solve(EYE + made.B @ Z, right.transpose(1, 0, 2))
        driven = _applied(made.driven, w.transpose(1, 0, 2))
        values = np.empty((2, P, k, 2))
        values[0] = signals[0] + driven[:P]
        values[1] = c - (Z @ w).transpose(1, 0, 2)
        end = free[SIGNALS * P :] + driven[P + 1 :]
        return values, end, self._integral(at, begin, xi, made.length, signals[3, -1] + driven[P])

    def _fed_back(self, at, signals: np.ndarray) -> np.ndarray:
        """Kp p + Kd p' + Ki int p."""
        Kp, Kd, Ki = self.gains[:, at]
        total = Kp * signals[1] + Ki * signals[3]
        return total + Kd * signals[2] if self.chain.derivative else total

    def _known(self, at, begin: np.ndarray, xi: np.ndarray, level: int) -> np.ndarray:
        """xi, the steps and f at the nodes, (P, k, 2): all of z that does not come back from the plant.

        f = Kp b rF + Ki int rF + Kd c rF' of a unit step that has gone through the filter.
        """
        base, s = self.set_points.get(level), self.levels[level].nodes[:, None]
        if base is None:
            base = (self.ahead + s * self.gains[2, :, 0])[:, :, None] * STEP_R + STEP_D
            self.set_points[level] = base
        known = base[:, at] + xi
        left = self._unsettled(begin)
        if left is not None:
            tau_F = self.chain.tau_F
            fall = np.exp(s / -tau_F)
            held = (self.kick[at] / tau_F - self.ahead[at]) * fall - self.gains[2, at, 0] * tau_F * (1 - fall)
            known[:, :, 0] += left * held
        return known

    def _integral(self, at, begin: np.ndarray, xi: np.ndarray, length: float, of_p: np.ndarray) -> np.ndarray:
        """xi at the end: + Ki (int rF - int p)."""
        gained, left = -of_p, self._unsettled(begin)
        gained[:, 0] += length
        if left is not None:
            gained[:, 0] += self.chain.tau_F * math.expm1(-length / self.chain.tau_F) * left
        return xi + self.gains[2, at] * gained

    def _unsettled(self, begin: np.ndarray) -> np.ndarray | None:
        """1 - rF at the start of the element; None where nothing of it is left."""
        tau_F = self.chain.tau_F
        return np.exp(begin / -tau_F) if tau_F and begin.min() < FORGOTTEN * tau_F else None

    def _decide(self, which: list[int], at, level: int, length: float, values, x, xi) -> None:
        """Keep what is good enough, shorten what is not; choose the level of the next element."""
        k = len(which)
        sizes = np.abs(values).max(axis=1)
        largest = np.maximum(self.largest[:, at], sizes)
        tails = np.abs(LAST @ values.reshape(2, -1, P, 2 * k)).max(axis=(1, 2)).reshape(2, k, 2)
        away = np.abs(values - self.final[:, None, at]).max(axis=1) if self.t_end is None else tails
        tails, away, size = (np.stack([tails / largest, away / largest, largest]).max(axis=(1, 3))).tolist()
        on_mesh = level == 0 and self.theta > 0
        if on_mesh and max(tails) > self.coarse:
            raise _TooCoarse
        good = [j for j, tail in enumerate(tails) if tail <= TAIL or on_mesh]
        if len(good) < k:
            for j in set(range(k)) - set(good):
                self._shorten(which[j], level)
            if not good:
                return
            which, tails, away, size = ([each[j] for j in good] for each in (which, tails, away, size))
            values, x, xi, largest = values[:, :, good], x[:, good], xi[good], largest[:, good]
            at = np.array(which)
        self._keep(which, at, level, length, values, x, xi)
        self.largest[:, at] = largest
        for i, tail, far, large in zip(which, tails, away, size, strict=True):
            self._lengthen(i, tail, level)
            if not large < LARGEST or self._arrived(i, far):
                del self.active[i]

    def _keep(self, which: list[int], at, level: int, length: float, values, x, xi) -> None:
        """Enter a stretch, and go on from its end."""
        lengths = tuple(self.theta * part for part in self.levels.shape) if level == 0 and self.theta else (length,)
        self.stretches.append(Stretch(which, [self.t[i] for i in which], lengths, values))
        self.x[:, at], self.xi[at] = x, xi
        self.z[-values.shape[1] :, at] = values[1]
        for i in which:
            self.t[i] += length
            self.before[i] = level

    def _shorten(self, i: int, level: int) -> None:
        if level <= LOWEST:
            raise InvalidParameter("the response must have a time scale that can be resolved, got none")
        self.level[i], self.good[i] = level - 1, 0
        self.patience[i] = min(2 * self.patience[i], MOST_PATIENCE)

    def _lengthen(self, i: int, tail: float, level: int) -> None:
        self.good[i] += 1
        if (tail < ROOM * TAIL or self.good[i] >= self.patience[i]) and level < HIGHEST:
            level, self.good[i] = level + 1, 0
            self.patience[i] = PATIENCE if tail < ROOM * TAIL else self.patience[i]
        if self.t_end is not None:  # an unstable response is not computed far beyond its end
            left = (self.t_end - self.t[i]) / self.levels.unit
            level = min(level, max(math.floor(math.log2(left)), 0) if left > 0 else 0)
        self.level[i] = level

    def _arrived(self, i: int, away: float) -> bool:
        """At t_end, or at rest: each value of the last element near where the response ends."""
        if self.t_end is not None:
            return self.t[i] > self.t_end * (1 + 1e-12)  # what is asked for at t_end is the right-hand limit
        rest = away <= REST
        if self.t[i] >= 2 * self.mark[i]:
            rest |= 0.5 * self.away_at_mark[i] < away <= ROUNDING
            self.mark[i], self.away_at_mark[i] = self.t[i], away
        self.at_rest[i] = rest
        return rest


def _applied(matrix: np.ndarray, values: np.ndarray) -> np.ndarray:
    """matrix (p, q) on the first axis of values (q, k, 2)."""
    _, k, two = values.shape
    return (matrix @ values.reshape(len(values), k * two)).reshape(len(matrix), k, two)
