"""The best PID controller in ideal form under a bound of max(Ms, Mt): sequential quadratic programming.

Variables: log Kc, log tau_I, log tau_D. Every local peak of |S| and |T| near the bound M is one constraint, with

    d log|S|/dx = -Re(T c),   d log|T|/dx = Re(S c),   c = d log C/dx,   C = Kc (1 + 1/(tau_I s) + tau_D s)

so that a solution where two or three peaks are active is met like any other. A neutral loop has |L(inf)| <= 1 - 1/M
besides. The objective is the logarithm of the criterion, its gradient that of forward differences: four tunings of one
march. The start is the best of a few shapes, each at nearly its largest robust gain. What is asked of the peaks is
a little less than M, so that the end, which may be where largest and smallest gain meet, keeps the bound.
"""

import math
from contextlib import suppress

import numpy as np
from scipy.optimize import minimize

from simc_core.optimal.problem import Found, Problem

TIMES_I = (0.6, 1.2, 2.4, 4.8, 9.6)  # shapes that are tried first, in units of the scale
TIMES_D = (0.2, 0.4, 0.8)
AROUND = (0.5, 1.0, 2.0)  # and in units of a first guess
BEGIN = 0.99  # of the largest robust gain
LOOSER = 1.15  # factor on M until some shape has a robust gain
MOST_M = 30.0
DIFFERENCE = 1e-4  # of the variables, for the gradient
PEAKS = 4  # of |S| and of |T|
LOW = 0.5  # of M: peaks that matter
CRITERION_SETTLED, VIOLATED = 3e-6, 2e-6  # relative: change of the criterion, peaks beyond what is asked
ASIDE = 3e-6  # relative: what is asked, below M
ITERATIONS, EVALUATIONS = 45, 60
AROUND_END, LOOKS = 0.02, 6  # logarithms of tau_I and tau_D about the end of a search, and how often
BEND_ROUNDING = 1e-13  # second difference of log|S| that is rounding
SLACK = 1.0  # of a constraint that is not there
REACH = math.log(1e4)  # of each variable from where it begins
ZOOM = np.linspace(0.0, 1.0, 9)
SERIES = math.log(4.0)  # log tau_I - log tau_D of a double zero


def best_pid(
    problem: Problem, series: bool = False, guess: tuple[float, float] | None = None, warm: Found | None = None
) -> Found | None:
    """None where no controller was found that meets the bound.

    guess: tau_I and tau_D to look around, besides the usual shapes.   warm: an optimum for a larger bound.
    The set point of an integrating plant may be followed without integral action: tau_I = inf.
    """
    integral = [True]
    if problem.plant.integrators and problem.criterion.name == "setpoint":
        integral = [False] if problem.plant.integrators > 1 else [True, False]
    found = []
    for each in integral:
        search = _Search(problem, series and each, each)
        x = _start(problem, search, guess, warm if warm and math.isfinite(warm.tau_I) == each else None)
        if x is not None:
            search.run(x)
            found.append(search.found)
    return min([each for each in found if each is not None], key=lambda each: each.value, default=None)


class _Stop(Exception):
    """Enough evaluations."""


class _Search:
    """Function, constraints and their gradients at one point after the other; the best that meets the bound.

    integral: False for tau_I = inf, which leaves log Kc and log tau_D.
    """

    def __init__(self, problem: Problem, series: bool = False, integral: bool = True):
        self.problem, self.series, self.integral = problem, series, integral
        self.left = EVALUATIONS
        self.last = np.full(3, math.nan)
        self.best: tuple[float, np.ndarray] = (math.inf, self.last)
        self.accepted = math.inf

    def run(self, x: np.ndarray) -> None:
        """Walk from x, and back inside the bound."""
        reach = np.array([REACH, REACH if self.integral else 0.0, REACH])
        with suppress(_Stop):
            minimize(
                lambda x: self._at(x).f,
                x,
                jac=lambda x: self._at(x).slope,
                method="SLSQP",
                bounds=np.array([x - reach, x + reach]).T,
                constraints={"type": "ineq", "fun": lambda x: self._at(x).g, "jac": lambda x: self._at(x).G},
                callback=self._settled,
                options={"maxiter": ITERATIONS, "ftol": 1e-10},
            )
        self._pull_back()
        if self.problem.criterion.name == "setpoint":
            self._look_around()

    def settings(self, x: np.ndarray) -> list[np.ndarray]:
        """Kc, tau_I, tau_D; x may be rows of points."""
        Kc, tau_I, tau_D = np.exp(x).T
        return [Kc, tau_I if self.integral else np.full_like(tau_I, math.inf), tau_D]

    @property
    def found(self) -> Found | None:
        """The best point of all."""
        value, x = self.best
        if not math.isfinite(value):
            return None
        Kc, tau_I, tau_D = map(float, self.settings(x))
        return Found(Kc, tau_I, tau_D, math.exp(value))

    def _pull_back(self) -> None:
        """The last point may be better than the best, but for a gain that is a little too large."""
        x = self.last.copy()
        _, tau_I, tau_D = self.settings(x)
        high = float(self.problem.edges(tau_I, tau_D)[1][0])
        if high < math.exp(x[0]):
            x[0] = math.log(high) - ASIDE
            value = math.log(self.problem.values(*self.settings(x))[0])
            if value < self.best[0]:
                self.best = value, x

    def _look_around(self) -> None:
        """Kinks hold the search up: closer and closer grids about its end, with the gain at its edge."""
        wide, steps = AROUND_END, np.linspace(-1, 1, 5)
        for _ in range(LOOKS if math.isfinite(self.best[0]) else 0):
            x = np.repeat(self.best[1][None], 25 if self.integral else 5, axis=0)
            x[:, 2] += wide * (np.tile(steps, 5) if self.integral else steps)
            x[:, 1] += wide * steps.repeat(5) if self.integral else 0.0
            _, tau_I, tau_D = self.settings(x)
            high = self.problem.edges(tau_I, tau_D)[1] * (1 - ASIDE)
            allowed = np.isfinite(high) & (not self.series or x[:, 1] - x[:, 2] >= SERIES)
            values = self.problem.values(np.where(allowed, high, math.nan), tau_I, tau_D)
            i = int(values.argmin())
            if math.log(values[i]) < self.best[0]:
                self.best = math.log(values[i]), np.array([math.log(high[i]), *x[i, 1:]])
            wide /= 2

    def _settled(self, x: np.ndarray) -> None:
        """After each accepted step."""
        at = self._at(x)
        if abs(at.f - self.accepted) < CRITERION_SETTLED and at.g.min() > -VIOLATED:
            raise StopIteration
        self.accepted = at.f

    def _at(self, x: np.ndarray) -> "_Search":
        if not np.array_equal(x, self.last):
            if not self.left:
                raise _Stop
            self.left -= 1
            self.last = x.copy()
            self.f, self.slope = self._criterion(x)
            self.g, self.G = self._constraints(x)
            if self.g.min() > -VIOLATED and self.f < self.best[0]:
                self.best = self.f, self.last
        return self

    def _criterion(self, x: np.ndarray) -> tuple[float, np.ndarray]:
        points = x + DIFFERENCE * np.concatenate([np.zeros((1, 3)), np.eye(3)])
        values = np.log(np.minimum(self.problem.values(*self.settings(points)), 1e300))
        return float(values[0]), (values[1:] - values[0]) / DIFFERENCE

    def _constraints(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """What is left to each bound, in logarithms, and the gradients."""
        problem = self.problem
        Kc, tau_I, tau_D = map(float, self.settings(x))
        g, G = np.full(2 * PEAKS + 2, SLACK), np.zeros((2 * PEAKS + 2, 3))
        omega, peak, of_T = self._peaks(x)
        for kind in (False, True):
            own = np.flatnonzero(of_T == kind)
            own = np.sort(own[np.argsort(-peak[own], kind="stable")[:PEAKS]])
            rows = slice(kind * PEAKS, kind * PEAKS + len(own))
            s = 1j * omega[own]
            form = 1 + 1 / tau_I / s + tau_D * s
            S = 1 / (1 + problem.gains.G(s) * problem.sign * Kc * form / (problem.tau_F * s + 1))
            c = np.array([np.ones_like(s), -1 / tau_I / s / form, tau_D * s / form])
            g[rows] = math.log(problem.M) - ASIDE - peak[own]
            G[rows] = (-(S * c).real if kind else ((1 - S) * c).real).T
        cap = float(problem.gains.cap(problem.shapes(tau_I, tau_D), problem.M)[0])
        if math.isfinite(cap):
            g[-2], G[-2] = math.log(cap) - ASIDE - x[0], (-1.0, 0.0, -1.0)
        if self.series:
            g[-1], G[-1] = x[1] - x[2] - SERIES, (0.0, 1.0, -1.0)
        return g, G

    def _peaks(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Frequencies of local maxima of |S| and |T|, log of these, and whether it is |T|; ascending for each."""
        problem, gains = self.problem, self.problem.gains
        Kc, tau_I, tau_D = map(float, self.settings(x))
        omega, shape = gains.omega, problem.shapes(tau_I, tau_D)
        logs = _log_peaks(Kc * gains.on_grid * shape.over(1j * omega)[0])
        inner = (logs[:, 1:-1] >= logs[:, :-2]) & (logs[:, 1:-1] > logs[:, 2:])
        of_T, column = np.nonzero(inner & gains.resolved[1:-1] & (logs[:, 1:-1] > math.log(LOW * problem.M)))
        left, right, every = omega[column], omega[column + 2], np.arange(len(column))
        for _ in range(2):
            w = left[:, None] + (right - left)[:, None] * ZOOM
            s = 1j * w
            fine = _log_peaks(Kc * gains.G(s) * shape.at(s, np.zeros(len(s), int)))[of_T, every]
            i = np.clip(fine.argmax(axis=1), 1, len(ZOOM) - 2)
            left, right = w[every, i - 1], w[every, i + 1]
        before, middle, after = (fine[every, i + shift] for shift in (-1, 0, 1))
        bend = np.minimum(before - 2 * middle + after, -BEND_ROUNDING)
        shift = np.clip((before - after) / (2 * bend), -1.0, 1.0)
        return w[every, i] + shift * (right - left) / 2, middle + shift * (after - before) / 4, of_T == 1


def _log_peaks(L: np.ndarray) -> np.ndarray:
    """log|S| and log|T|, (2, ...)."""
    log_S = -np.log(np.abs(1 + L))
    return np.array([log_S, log_S + np.log(np.abs(L))])


def _start(
    problem: Problem, search: _Search, guess: tuple[float, float] | None, warm: Found | None
) -> np.ndarray | None:
    """Logarithms of Kc, tau_I, tau_D, of tau_I = 1 in place of inf."""
    if warm is not None:
        edge = float(problem.edges(warm.tau_I, warm.tau_D)[1][0])
        if math.isfinite(edge):
            return np.log([min(BEGIN * edge, warm.Kc), warm.tau_I if search.integral else 1.0, warm.tau_D])
    pairs = [(i * problem.scale, d * problem.scale) for i in TIMES_I for d in TIMES_D]
    if problem.criterion.name != "load":
        pairs += [(i * problem.times, d * problem.scale) for i in (0.5, 1.0) for d in TIMES_D]
    if guess is not None:
        pairs += [(i * guess[0], d * guess[1]) for i in AROUND for d in AROUND]
    if search.series:
        pairs = [(tau_I, tau_D) for tau_I, tau_D in pairs if tau_I >= 4 * tau_D]
    if not search.integral:
        pairs = [(1.0, tau_D) for tau_D in sorted({tau_D for _, tau_D in pairs})]
    x = np.log([(1.0, *pair) for pair in pairs])
    _, tau_I, tau_D = search.settings(x)
    M = problem.M
    while M < MOST_M:
        high = problem.gains.highest(problem.shapes(tau_I, tau_D), M)[1]
        values = problem.values(BEGIN * high, tau_I, tau_D)
        i = int(values.argmin())
        if math.isfinite(values[i]):
            return np.array([math.log(BEGIN * high[i]), *x[i, 1:]])
        M *= LOOSER
    return None
