"""Gains by which a controller may be multiplied so that the loop is stable with max(Ms, Mt) <= M, in closed form.

g = G C(j omega) for the shape C. Under the gain K, with c = 1 - 1/M^2,

    |S| > M     |g|^2 K^2 + 2 Re g K + c < 0           K from    low = c/(x |g|)  to  high = x/|g|
    |T| > M     the same for c K in place of K         K from    low/c            to  high/c

    x = p + sqrt(p^2 - c),   p = -Re g/|g|             where p > sqrt(c)

so both peaks are too high at the same frequencies: where the phase of L is near -180 degrees. Each run of such
frequencies excludes the gains from its smallest low to its largest high, and these over c; what is left are gaps. Along
a gap no pole crosses the axis: at K -> 0 the closed loop has the unstable poles of the open one and those that
integrators send to the right, and each run on the way from there adds 2 where Im g has become positive in it, -2 where
it has become negative.

The edges are extrema on a grid of frequencies, looked at closely.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from simc_core import checks
from simc_core.certificate.verdict import count_unstable
from simc_core.controllers.forms import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop, factored_plant
from simc_core.plants.plant import Plant
from simc_core.sensitivity.log_response import FactoredResponse
from simc_core.sensitivity.search_grid import LIGHT, cluster
from simc_core.wording import said

PER_DECADE = 60
LOGARITHMIC, PHASE_STEP, LAST = 3.0, 0.14, 60.0  # theta omega: where equal steps begin, their length, their end
MARGIN = 1e3  # decades below and above all corners
ENDS = 1e6  # one more node that far out stands for the limit
ZOOM, ZOOMS, FINE_ZOOMS = 9, 3, 5  # nodes between the neighbours of an extremum, and how often
NEAR_LARGEST = 1.03  # extrema of a run within this of its largest are looked at
LARGEST_M = 100.0


class Gap(NamedTuple):
    """Gains from low to high, and the number of unstable poles there."""

    low: float
    high: float
    unstable: int


@dataclass(frozen=True, slots=True, eq=False)
class Shapes:
    """n controllers (Kp + Ki/s + Kd s)/(tau_F s + 1). gains: Kp, Ki, Kd, (n, 3)."""

    gains: np.ndarray
    tau_F: float = 0.0

    @classmethod
    def ideal(cls, sign: float, tau_I: ArrayLike, tau_D: ArrayLike = 0.0, tau_F: float = 0.0) -> "Shapes":
        """Kc = sign, and arrays of tau_I and tau_D."""
        Ti, Td = np.broadcast_arrays(np.atleast_1d(tau_I), tau_D)
        return cls(sign * np.stack([np.ones(len(Ti)), 1 / Ti, Td], axis=1), tau_F)

    def over(self, s: np.ndarray) -> np.ndarray:
        """Each of them at each s, (n, len(s))."""
        return self.gains @ np.array([np.ones_like(s), 1 / s, s]) / (self.tau_F * s + 1)

    def at(self, s: np.ndarray, owner: np.ndarray) -> np.ndarray:
        """Shape owner[i] at s[i], which may be a row."""
        Kp, Ki, Kd = self.gains[owner].T.reshape(3, -1, *[1] * (s.ndim - 1))
        return (Kp + Ki / s + Kd * s) / (self.tau_F * s + 1)


class RobustGains:
    """Robust gains of many controllers round one plant.

    omega: the grid (N,), which reaches beyond the corners of the plant, and 1/slowest of its controllers.
    resolved: where it is so fine that no turn of the dead time goes unseen.
    """

    def __init__(self, plant: Plant, slowest: float = 0.0, more: Sequence[float] = ()):
        self.plant, self.G = plant, factored_plant(plant)
        self.response = FactoredResponse(self.G)
        self.omega = _grid(self.response, slowest, more)
        self.resolved = self.omega <= (LAST / plant.theta if plant.theta else math.inf)
        self.on_grid = self.G(1j * self.omega)

    def gaps(self, shapes: Shapes, M: ArrayLike, zooms: int = ZOOMS) -> list[list[Gap]]:
        """All gaps of each shape, ascending. M: one for all, or one for each."""
        c = np.broadcast_to(1 - 1 / np.square(M), len(shapes.gains))
        owner, low, high, turn = self._runs(shapes, c, zooms)
        cap = self.cap(shapes, M)
        at_first = self._at_first(shapes)
        found: list[list[Gap]] = []
        begins = owner.searchsorted(np.arange(len(shapes.gains) + 1))
        for i, (start, end) in enumerate(zip(begins[:-1].tolist(), begins[1:].tolist(), strict=True)):
            runs = list(zip(low[start:end].tolist(), high[start:end].tolist(), turn[start:end].tolist(), strict=True))
            found.append(self._between(runs, float(c[i]), float(cap[i]), at_first[i]))
        return found

    def highest(self, shapes: Shapes, M: ArrayLike, zooms: int = ZOOMS) -> tuple[np.ndarray, np.ndarray]:
        """Edges of the highest stable gap of each shape, (n,) each; nan where there is none. M as in `gaps`."""
        edges = np.full((len(shapes.gains), 2), math.nan)
        for i, gaps in enumerate(self.gaps(shapes, M, zooms)):
            stable = [gap for gap in gaps if gap.unstable == 0]
            if stable:
                edges[i] = stable[-1][:2]
        return edges[:, 0], edges[:, 1]

    def _between(self, runs: list[tuple[float, float, int]], c: float, cap: float, at_first: int) -> list[Gap]:
        excluded = sorted([(low, high) for low, high, _ in runs] + [(low / c, high / c) for low, high, _ in runs])
        gaps, reached = [], 0.0
        for low, high in [*excluded, (math.inf, math.inf)]:
            low = min(low, cap)
            if low > reached and (low < math.inf or not self.plant.theta):
                turned = sum(turn for _, end, turn in runs if end <= reached)
                gaps.append(Gap(reached, low, at_first + 2 * turned))
            reached = max(reached, high)
            if reached >= cap:
                break
        return gaps

    def _runs(self, shapes: Shapes, c: np.ndarray, zooms: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Owner, smallest low, largest high and turn (Im g from - to +: 1, from + to -: -1) of each run."""
        g = self.on_grid * shapes.over(1j * self.omega)
        N = len(self.omega)
        size = np.abs(g)
        p = -g.real / size
        at = np.flatnonzero(p > np.sqrt(c)[:, None])
        if not at.size:
            return np.zeros(0, int), np.zeros(0), np.zeros(0), np.zeros(0, int)
        own_c = c[at // N]
        x, size, above = _larger_root(p.ravel()[at], own_c), size.ravel()[at], g.imag.ravel()[at] >= 0
        log_low, log_high = np.log(own_c / (x * size)), np.log(x / size)
        new = np.concatenate([[True], (np.diff(at) > 1) | (at[1:] % N == 0)])
        first = np.flatnonzero(new)
        last = np.append(first[1:], len(at)) - 1
        turn = above[last].astype(int) - above[first]
        ends = [np.minimum.reduceat(log_low, first), -np.maximum.reduceat(log_high, first)]
        run, owner = new.cumsum() - 1, at // N
        picked = [self._extrema(values, run, end) for values, end in zip((log_low, -log_high), ends, strict=True)]
        which = np.concatenate(picked)
        upper = np.repeat([False, True], [len(each) for each in picked])
        values = self._refined(shapes, c, owner[which], at[which] % N, upper, zooms)
        for side, end in enumerate(ends):
            np.minimum.at(end, run[which[upper == side]], values[upper == side])
        low, high = np.exp(ends[0]), np.exp(-ends[1])
        if self.plant.integrators:
            low[at[first] % N == 0] = 0.0
        else:
            low[(at[first] % N == 0) & (shapes.gains[owner[first], 1] != 0)] = 0.0
        if not self.plant.theta:
            high[(at[last] % N == N - 1) & (self._degree(shapes) > 0)[owner[first]]] = math.inf
        return owner[first], low, high, turn

    def _extrema(self, values: np.ndarray, run: np.ndarray, smallest: np.ndarray) -> np.ndarray:
        """Places of the minima of each run that may be its smallest."""
        padded = np.concatenate([[math.inf], values, [math.inf]])
        before = np.where(np.diff(run, prepend=-1) > 0, math.inf, padded[:-2])
        after = np.where(np.diff(run, append=run[-1] + 1) > 0, math.inf, padded[2:])
        near = values <= smallest[run] + math.log(NEAR_LARGEST)
        return np.flatnonzero((values <= before) & (values <= after) & near)

    def _refined(
        self, shapes: Shapes, c: np.ndarray, owner: np.ndarray, column: np.ndarray, upper: np.ndarray, zooms: int
    ) -> np.ndarray:
        """log low, or -log high where `upper`, at the minimum next to a node of the grid."""
        own_c = c[owner][:, None]
        least = np.sqrt(own_c)
        omega, steps = self.omega, np.linspace(0, 1, ZOOM)
        left, right = omega[np.maximum(column - 1, 0)], omega[np.minimum(column + 1, len(omega) - 1)]
        every = np.arange(len(owner))
        for _ in range(zooms):
            s = 1j * (left[:, None] + (right - left)[:, None] * steps)
            g = self.G(s) * shapes.at(s, owner)
            size = np.abs(g)
            p = -g.real / size
            x = _larger_root(np.maximum(p, least), own_c)
            values = np.where(p > least, np.log(np.where(upper[:, None], size / x, own_c / (x * size))), np.inf)
            best = np.clip(values.argmin(axis=1), 1, ZOOM - 2)
            left, right = s.imag[every, best - 1], s.imag[every, best + 1]
        before, middle, after = (values[every, best + shift] for shift in (-1, 0, 1))
        with np.errstate(invalid="ignore", divide="ignore"):
            bend = before - 2 * middle + after
            vertex = middle - (after - before) ** 2 / (8 * bend)
        smooth = np.isfinite(vertex) & (bend > 0) & (middle <= before) & (middle <= after)
        return np.where(smooth, vertex, values.min(axis=1))

    def _degree(self, shapes: Shapes) -> np.ndarray:
        """Relative degree of each loop transfer function."""
        order = np.where(shapes.gains[:, 2] != 0, 1, np.where(shapes.gains[:, 0] != 0, 0, -1))
        return self.G.relative_degree + (shapes.tau_F > 0) - order

    def cap(self, shapes: Shapes, M: ArrayLike) -> np.ndarray:
        """What |L(inf)| <= 1 - 1/M of a neutral loop allows."""
        if not self.plant.theta:
            return np.full(len(shapes.gains), math.inf)
        degree, (gain, _) = self._degree(shapes), self.response.at_infinity
        leading = np.where(shapes.gains[:, 2] != 0, shapes.gains[:, 2], shapes.gains[:, 0])
        size = np.abs(gain * leading / (shapes.tau_F or 1.0))
        with np.errstate(divide="ignore"):
            return np.where(degree > 0, math.inf, np.where(degree < 0, 0.0, (1 - 1 / np.asarray(M)) / size))

    def _at_first(self, shapes: Shapes) -> list[int]:
        """Unstable poles of each closed loop as its gain goes to 0."""
        plant, (gain, _) = self.plant, self.response.at_zero
        if any(zeta == 0 for _, zeta in plant.lag_pairs):
            return [self._counted(row, shapes.tau_F) for row in shapes.gains.tolist()]
        found = []
        starts = self.on_grid[0] * shapes.over(1j * self.omega[:1])[:, 0]
        for (Kp, Ki, _), start in zip(shapes.gains.tolist(), starts.tolist(), strict=True):
            power = plant.integrators + (Ki != 0)
            found.append(plant.unstable_poles + _sent_right(power, gain * (Ki or Kp) > 0, start.imag > 0))
        return found

    def _counted(self, row: list[float], tau_F: float) -> int:
        """Undamped poles on the axis move as the phase there has it: the certificate knows."""
        size = np.abs(self.on_grid * Shapes(np.array([row]), tau_F).over(1j * self.omega)[0])
        Kp, Ki, Kd = row
        form = ParallelPid(Kp, Ki, Kd, tau_F).rescaled(gain=1e-6 / float(np.median(size)))
        return int(count_unstable([Loop(self.plant, form).L]).unstable_poles)


@lru_cache(maxsize=16)
def robust_gains(plant: Plant, slowest: float) -> RobustGains:
    """The grid and the plant on it, for the controllers of one study."""
    return RobustGains(plant, slowest)


def sign_of_gain(plant: Plant) -> float:
    """Of a Kc that can stabilise."""
    return math.copysign(1.0, plant.k) * (-1) ** sum(tau < 0 for tau in plant.lags)


def peak_bound(name: str, value: object) -> float:
    """A bound of max(Ms, Mt)."""
    number = checks.real(name, value, high=LARGEST_M)
    if number <= 1:
        raise InvalidParameter(
            said(
                "{name} must be > 1, the peak of every loop with dead time or more lags, found {number:g}",
                name=name,
                number=number,
            )
        )
    return number


def _larger_root(p: np.ndarray, c: np.ndarray) -> np.ndarray:
    return p + np.sqrt(np.maximum(p * p - c, 0.0))


def _sent_right(power: int, positive: bool, above: bool) -> int:
    """How many roots of s^power = -K c go to the right for small K; c > 0: `positive`, Im g > 0 at first: `above`."""
    if power == 2 and positive:
        return 2 if above else 0
    first = math.pi / power if positive and power else 0.0
    return sum(math.cos(first + 2 * math.pi * i / power) > 1e-9 for i in range(power))


def _grid(response: FactoredResponse, slowest: float, more: Sequence[float]) -> np.ndarray:
    corners = [abs(root) for root in response.roots] + [omega for omega in more if omega]
    corners += [1 / slowest] if slowest else []
    corners += [abs(gain) ** (-1 / power) for gain, power in (response.at_zero, response.at_infinity) if power]
    theta = response.theta
    corners += [1 / theta] if theta else []
    first, last = min(corners, default=1.0) / MARGIN, max(corners, default=1.0) * (10 if theta else MARGIN)
    apart = [first / ENDS, *(omega * (1 + shift) for omega in more for shift in (-1e-3, 0.0, 1e-3))]
    parts = [np.array(apart)]
    if theta:
        begin, end = LOGARITHMIC / theta, LAST / theta
        parts += [_geometric(first, begin), np.arange(LOGARITHMIC, LAST, PHASE_STEP) / theta, _geometric(end, last)]
    else:
        parts += [_geometric(first, last), np.array([last * ENDS])]
    light = [root for root in response.roots if root.imag > 0 and abs(root.real) < LIGHT * abs(root)]
    parts += [cluster(root) for root in light]
    return np.unique(np.concatenate(parts))


def _geometric(first: float, last: float) -> np.ndarray:
    if last <= first:
        return np.zeros(0)
    return np.geomspace(first, last, 2 + round(PER_DECADE * math.log10(last / first)))
