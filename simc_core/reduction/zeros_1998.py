"""The rules of 1998 for positive numerator time constants [SK98]: simpler than T1-T3, and without fixed points."""

import math
from collections.abc import Callable
from dataclasses import replace

from simc_core.reduction.zeros import Lag, LineInTheta, Removal, RuleApplied, no_lag

NO_LAG = -2  # a zero that met no lag but the delay


def remove_leads_1998(
    leads: list[tuple[int, float]], lags: list[Lag], integrators: int, delay: Callable[[list[Lag], int], float]
) -> Removal:
    """Step A by the simpler rules of 1998 [SK98], largest zero first; delay(lags, integrators): theta of the half rule.

    A zero T0 <= theta is subtracted from theta. A larger one makes (T0 s+1)/(tau0 s+1) = 1/((tau0 - T0) s+1) of the
    closest larger lag; where there is none the largest lag is cancelled, with the gain T0/tau0, or an integrator,
    with the gain T0.
    """
    lags, matches, gain, subtracted = list(lags), [], 1.0, 0.0
    for index, T0 in sorted(leads, key=lambda lead: -lead[1]):
        lags.sort(key=lambda lag: -lag.tau.at)
        above = [lag for lag in lags if lag.tau.at >= T0]
        if delay(lags, integrators) - subtracted >= T0:
            subtracted += T0
            matches.append(RuleApplied("1998 small", index, T0, NO_LAG, 0.0, 0.0, 1.0))
        elif above:
            lag = above[-1]
            rest = lag.tau.at - T0
            matches.append(RuleApplied("1998 large", index, T0, lag.index, lag.tau.at, rest, 1.0))
            lags[lags.index(lag)] = replace(lag, tau=LineInTheta(rest))
        elif integrators:
            integrators -= 1
            matches.append(RuleApplied("1998 cancel", index, T0, -1, math.inf, 0.0, T0))
            gain *= T0
        elif lags:
            lag = lags.pop(0)
            matches.append(RuleApplied("1998 cancel", index, T0, lag.index, lag.tau.at, 0.0, T0 / lag.tau.at))
            gain *= T0 / lag.tau.at
        else:
            raise no_lag(T0)
    kept = sorted((lag for lag in lags if lag.tau.at), key=lambda lag: -lag.tau.at)
    return Removal(tuple(kept), integrators, gain, tuple(matches), subtracted)
