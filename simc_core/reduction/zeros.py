"""Rules T1-T3 [SK03 eq. 10]: positive numerator time constants against lags.

(T0 s+1)/(tau0 s+1) is approximated, with the FINAL effective delay theta, by

    T1   T0/tau0                              T0 >= tau0 >= theta
    T1a  T0/theta                             T0 >= theta >= tau0
    T1b  1                                    theta >= T0 >= tau0
    T2   T0/tau0                              tau0 >= T0 >= 5 theta
    T3   (t/tau0)/((t - T0) s + 1)            t = min(tau0, 5 theta) >= T0

tau0 is the closest larger lag (T2, T3); the closest smaller one, tau0b (T1, T1a, T1b), if there is no larger one
or if T0/tau0b < tau0a/T0 and T0/tau0b < 1.6 (tau0a: the closest larger one). An integrator is a lag without limit,
so that (T0 s+1)/s is T0 for T0 >= 5 theta. Zeros are taken largest first, and the lags are sorted anew after each.

Since theta is not known beforehand, the rules are followed along theta: every time constant is a line
at + slope theta (T3 makes 5 theta - T0 out of a large lag), and every comparison notes the values of theta
at which it would turn out differently. Between two of those the outcome is one straight line (half_rule.py).
"""

import math
from bisect import bisect_left
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from simc_core.errors import NotReducible
from simc_core.notation import number
from simc_core.wording import said

CLOSE = 1.6  # a smaller lag counts as close to the zero below this ratio
GUARD = 1e-9  # relative; 0.08/0.05 is 1.6 on paper and 1.5999999999999999 in doubles
T2_LIMIT = 5.0  # T2 from T0 = 5 theta on


class LineInTheta(NamedTuple):
    """at + slope theta."""

    at: float
    slope: float = 0.0

    def __call__(self, theta: float) -> float:
        return self.at + self.slope * theta if self.slope else self.at


@dataclass(frozen=True, slots=True)
class Lag:
    """A lag on its way through the rules. index: which lag it was (Dynamics.lags); -1 for an integrator."""

    index: int
    tau: LineInTheta


@dataclass(frozen=True, slots=True)
class RuleApplied:
    """One application of a rule: which zero, which lag (value tau0 at that moment), what is left of it."""

    rule: str
    lead: int
    T0: float
    lag: int
    tau0: float
    rest: float
    gain: float


@dataclass(slots=True)
class Comparisons:
    """Comparisons at one theta, and the values of theta at which one of them changes."""

    theta: float
    turning_points: list[float] = field(default_factory=list)

    def at_least(self, a: LineInTheta, b: LineInTheta) -> bool:
        """a >= b at this theta, equality within the guard included."""
        (left, rise), (right, other_rise) = a, b
        if rise or other_rise:
            if rise != other_rise:
                self.turning_points.append((right - left) / (rise - other_rise))
            left, right = a(self.theta), b(self.theta)
        return left >= right or math.isclose(left, right, rel_tol=GUARD)

    def closer(self, T0: float, below: LineInTheta, above: LineInTheta) -> bool:
        """T0/below < above/T0 and T0/below < 1.6."""
        for other in (below, above):
            if other.slope:
                self.turning_points += _crossings(below, above, T0 * T0)
                break
        if below.slope:
            self.turning_points.append((T0 / CLOSE - below.at) / below.slope)
        ratio = T0 / below(self.theta)
        return ratio < above(self.theta) / T0 * (1 - GUARD) and ratio < CLOSE * (1 - GUARD)


def _crossings(a: LineInTheta, b: LineInTheta, level: float) -> list[float]:
    """theta with a(theta) b(theta) = level."""
    if math.isinf(a.at) or math.isinf(b.at):
        return []
    square, linear, constant = a.slope * b.slope, a.at * b.slope + b.at * a.slope, a.at * b.at - level
    if square == 0:
        return [-constant / linear] if linear else []
    root = linear * linear - 4 * square * constant
    if root < 0:
        return []
    return [(-linear + sign * math.sqrt(root)) / (2 * square) for sign in (-1, 1)]


@dataclass(frozen=True, slots=True)
class Removal:
    """What the rules make at one theta: lags left, sorted, largest first (integrators not among them).

    subtracted: what the rules of 1998 take off the delay.
    """

    lags: tuple[Lag, ...]
    integrators: int
    gain: float
    matches: tuple[RuleApplied, ...]
    subtracted: float = 0.0


def remove_leads(
    leads: list[tuple[int, float]], lags: list[Lag], integrators: int, comparisons: Comparisons
) -> Removal:
    """Step A of the half rule at comparisons.theta: all positive numerator time constants, largest first.

    leads: (index in the plant, T0). Raises NotReducible where a zero meets neither a lag nor an integrator.
    """
    lags, matches, gain = sorted_lags(lags, comparisons), [], 1.0
    for index, T0 in sorted(leads, key=lambda lead: -lead[1]):
        lag, smaller = _partner(T0, lags, integrators, comparisons)
        match, rest = (_smaller if smaller else _larger)(index, T0, lag, comparisons)
        matches.append(match)
        gain *= match.gain
        if math.isinf(lag.tau.at):
            integrators -= 1
        else:
            lags.remove(lag)
        if rest is not None:
            lags = sorted_lags([*lags, replace(lag, tau=rest)], comparisons)
    return Removal(tuple(lags), integrators, gain, tuple(matches))


def sorted_lags(lags: list[Lag], comparisons: Comparisons) -> list[Lag]:
    """Largest first; every pair that could change places is noted."""
    for moving in lags:
        if moving.tau.slope:
            for other in lags:
                comparisons.at_least(moving.tau, other.tau)
    return sorted(lags, key=lambda lag: -lag.tau(comparisons.theta))


def _partner(T0: float, lags: list[Lag], integrators: int, comparisons: Comparisons) -> tuple[Lag, bool]:
    """The lag that a zero T0 meets, and whether it is the smaller one. lags: sorted."""
    zero = LineInTheta(T0)
    for lag in lags:
        if lag.tau.slope:  # which may come to lie on the other side
            comparisons.at_least(lag.tau, zero)
    first = bisect_left(lags, True, key=lambda lag: not comparisons.at_least(lag.tau, zero))
    above, below = lags[:first], lags[first:]
    if integrators and not above:
        above = [Lag(-1, LineInTheta(math.inf))]
    if not above and not below:
        raise no_lag(T0)
    if not above:
        return below[0], True
    if below and comparisons.closer(T0, below[0].tau, above[-1].tau):
        return below[0], True
    return above[-1], False


def _larger(index: int, T0: float, lag: Lag, comparisons: Comparisons) -> tuple[RuleApplied, LineInTheta | None]:
    """T2 or T3. Behind an integrator the gain is that of 1/s itself: T0, or 5 theta."""
    tau0, five = lag.tau(comparisons.theta), LineInTheta(0.0, T2_LIMIT)
    scale = 1.0 if math.isinf(tau0) else tau0
    if comparisons.at_least(LineInTheta(T0), five):
        return RuleApplied("T2", index, T0, lag.index, tau0, 0.0, T0 / scale), None
    t = five if comparisons.at_least(lag.tau, five) else lag.tau
    rest = LineInTheta(t.at - T0, t.slope)
    if rest(comparisons.theta) <= GUARD * T0:
        return RuleApplied("T3", index, T0, lag.index, tau0, 0.0, t(comparisons.theta) / scale), None
    return RuleApplied("T3", index, T0, lag.index, tau0, rest(comparisons.theta), t(comparisons.theta) / scale), rest


def _smaller(index: int, T0: float, lag: Lag, comparisons: Comparisons) -> tuple[RuleApplied, None]:
    """T1, T1a or T1b."""
    theta, tau0 = LineInTheta(0.0, 1.0), lag.tau(comparisons.theta)
    if comparisons.at_least(lag.tau, theta):
        return RuleApplied("T1", index, T0, lag.index, tau0, 0.0, T0 / tau0), None
    if comparisons.at_least(LineInTheta(T0), theta):
        return RuleApplied("T1a", index, T0, lag.index, tau0, 0.0, T0 / comparisons.theta), None
    return RuleApplied("T1b", index, T0, lag.index, tau0, 0.0, 1.0), None


def no_lag(T0: float) -> NotReducible:
    """The error for a zero T0 that nothing is left for."""
    return NotReducible(
        said(
            "zero with T = {T0} has no lag left to be set against: the half rule does not cover this plant. "
            "Tune on a model of your own (for instance a fit to the step response), or by the loop's margins",
            T0=number(T0),
        )
    )
