"""Stability margins and sensitivity peaks, exact dead time, every crossing accounted for.

    GM          smallest factor > 1 on the gain at which the loop reaches the stability limit
    GM_lower    largest factor < 1 that does; 0.0 where the gain may fall to nothing
    PM_deg      smallest phase change, in either direction, that does: min |arg(-L)| where |L| = 1
    delay_margin  smallest additional dead time that does: min (arg(-L) mod 2 pi)/omega over all gain crossings
    Ms, Mt      largest |1/(1+L)|, |L/(1+L)|; Mt may sit at omega = 0, Ms at infinity

omega_180 belongs to GM, omega_c to PM_deg, omega_Ms and omega_Mt to the peaks. GM and delay_margin are at the same time
the largest relative change of k, and the largest change of theta, that the loop survives.
A limit that does not exist is math.inf, its frequency math.nan. Margins of a loop that is not stable mean
nothing: they are all math.nan.
"""

import math
from dataclasses import dataclass
from functools import singledispatch

import numpy as np

from simc_core.crossings import Crossings, search
from simc_core.logresponse import FactoredResponse, Response
from simc_core.loop import Loop
from simc_core.stability import stability


@dataclass(frozen=True, slots=True)
class Margins:
    """See the module docstring. omega in rad per time unit; stable: False means nan everywhere else."""

    GM: float
    GM_lower: float
    PM_deg: float
    delay_margin: float
    Ms: float
    Mt: float
    omega_180: float
    omega_c: float
    omega_Ms: float
    omega_Mt: float
    stable: bool


ROUNDING = 1e-12
BEYOND = 1e-6  # what the envelope is good for

NOT_STABLE = Margins(*[math.nan] * 10, stable=False)


@singledispatch
def margins(loop: Loop) -> Margins:
    """Margins of a single loop; all nan where it is not stable."""
    if stability(loop).verdict != "stable":
        return NOT_STABLE
    return margins_of(FactoredResponse(loop.L))


@singledispatch
def crossings(loop: Loop) -> Crossings:
    """Every crossing and peak, also of a loop that is not stable: for drawing."""
    return search(FactoredResponse(loop.L))


def margins_of(response: Response) -> Margins:
    """Margins of any loop transfer function that is known to be stable when closed."""
    found = search(response)
    GM, GM_lower, omega_180 = _gain_margins(response, found)
    PM, omega_c = _phase_margin(found)
    Ms, omega_Ms = _peak(found.S_peak, found.S_omega, _ends(response, lambda L: 1 / (1 + L)), found.envelope[0])
    Mt, omega_Mt = _peak(found.T_peak, found.T_omega, _ends(response, lambda L: L / (1 + L)), found.envelope[1])
    return Margins(
        GM=GM,
        GM_lower=GM_lower,
        PM_deg=math.degrees(PM),
        delay_margin=_delay_margin(response, found),
        Ms=Ms,
        Mt=Mt,
        omega_180=omega_180,
        omega_c=omega_c,
        omega_Ms=omega_Ms,
        omega_Mt=omega_Mt,
        stable=True,
    )


def _limits(response: Response) -> tuple[float, float]:
    """L(0) and L(inf), real, perhaps infinite; at infinity -|L| for a neutral loop, which gets there at any phase."""
    at = []
    for (gain, power), sign in ((response.at_zero, 1), (response.at_infinity, -1)):
        at.append(gain if power == 0 else 0.0 if power * sign > 0 else math.inf)
    return at[0], -abs(at[1]) if response.theta else at[1]


def _gain_margins(response: Response, found: Crossings) -> tuple[float, float, float]:
    at_zero, at_infinity = _limits(response)
    gains, omegas = list(found.phase_gain), list(found.phase_omega)
    for limit, omega in ((at_zero, 0.0), (at_infinity, math.inf)):
        if -math.inf < limit < 0:
            gains.append(-limit)
            omegas.append(omega)
    above = [(1 / gain, omega) for gain, omega in zip(gains, omegas, strict=True) if gain < 1]
    below = [1 / gain for gain in gains if gain >= 1]
    GM, omega_180 = min(above, default=(math.inf, math.nan))
    return float(GM), float(max(below, default=0.0)), float(omega_180)


def _phase_margin(found: Crossings) -> tuple[float, float]:
    if not found.gain_omega.size:
        return math.inf, math.nan
    at = np.argmin(np.abs(found.gain_phase))
    return float(abs(found.gain_phase[at])), float(found.gain_omega[at])


def _delay_margin(response: Response, found: Crossings) -> float:
    if response.theta == 0 and abs(_limits(response)[1]) >= 1:
        return 0.0  # any dead time at all makes it a neutral loop with |L(inf)| >= 1
    return float(np.min((found.gain_phase % (2 * math.pi)) / found.gain_omega, initial=math.inf))


def _ends(response: Response, of) -> list[tuple[float, float]]:
    """|of(L)| at omega = 0 and at infinity."""
    ends = zip(_limits(response), (0.0, math.inf), strict=True)
    return [(abs(of(L if math.isfinite(L) else 1e300)), omega) for L, omega in ends]


def _peak(peaks: np.ndarray, omegas: np.ndarray, ends, envelope: float) -> tuple[float, float]:
    """The largest of the peaks, the ends and the envelope beyond the grid, and where it is."""
    best = max(ends)
    if peaks.size and peaks.max() > best[0] * (1 + ROUNDING):  # else it is rounding on the way to an end
        at = int(np.argmax(peaks))
        best = float(peaks[at]), float(omegas[at])
    return (envelope, math.inf) if envelope > best[0] * (1 + BEYOND) else best
