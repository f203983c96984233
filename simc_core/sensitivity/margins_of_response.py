"""Stability margins and sensitivity peaks from L on the imaginary axis, every crossing accounted for.

    GM          smallest factor > 1 on the gain at which the loop reaches the stability limit
    GM_lower    largest factor < 1 that does; 0.0 where the gain may fall to nothing
    PM_deg      smallest phase change, in either direction, that does: min |arg(-L)| where |L| = 1
    delay_margin  smallest additional dead time that does: min (arg(-L) mod 2 pi)/omega over all gain crossings
    Ms, Mt      largest |1/(1+L)|, |L/(1+L)|; Mt may sit at omega = 0, Ms at infinity

omega_180 belongs to GM, omega_c to PM_deg, omega_Ms and omega_Mt to the peaks. GM and delay_margin are at the same time
the largest relative change of k, and the largest change of theta, that the loop survives.
A limit that does not exist is math.inf, its frequency math.nan. Margins of a loop that is not stable mean
nothing: they are all math.nan.

omega_bS, omega_bT, max_KS and omega_KS are in bandwidth.py: they cost more than the rest, and wait until asked for.
"""

import math
from dataclasses import dataclass, fields

import numpy as np

from simc_core.loops.on_demand import OnDemand
from simc_core.sensitivity.bandwidth import NO_BANDWIDTH, Bandwidth
from simc_core.sensitivity.crossings import Crossings, search
from simc_core.sensitivity.log_response import Ends, Response


@dataclass(frozen=True, slots=True)
class Margins(OnDemand[Bandwidth]):
    """Margins and peaks of a loop; the module docstring defines them. nan everywhere where the loop is not stable.

    Computed when asked for, nan of a sampled loop: `omega_bS`, `omega_bT`, `max_KS`, `omega_KS`.

    Attributes
    ----------
    GM, GM_lower : float
        Factors on the gain at which the loop reaches its limit, > 1 and < 1; math.inf and 0.0 where there is none.
    PM_deg : float
        Phase margin, in degrees.
    delay_margin : float
        Additional dead time at which the loop reaches its limit, in the user's time unit.
    Ms, Mt : float
        Largest abs(1/(1 + L)) and abs(L/(1 + L)).
    omega_180, omega_c, omega_Ms, omega_Mt : float
        Where GM, PM_deg, Ms and Mt are, in rad per time unit.
    stable : bool
        Whether the loop is.
    """

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

    @property
    def bandwidth(self) -> Bandwidth:
        """All of these."""
        return self._asked(NO_BANDWIDTH)

    @property
    def omega_bS(self) -> float:
        """Bandwidth of S: where abs(S) rises through 1/sqrt 2 for the first time, in rad per time unit."""
        return self.bandwidth.omega_bS

    @property
    def omega_bT(self) -> float:
        """Bandwidth of T: where abs(T) falls through 1/sqrt 2 for the last time, in rad per time unit."""
        return self.bandwidth.omega_bT

    @property
    def max_KS(self) -> float:
        """Largest abs(K S), from noise in y to u, in input units per output unit."""
        return self.bandwidth.max_KS

    @property
    def omega_KS(self) -> float:
        """Where that is, in rad per time unit."""
        return self.bandwidth.omega_KS


SAME_LIMIT = 1e-12  # relative: gain margins, or peaks, that differ by rounding alone
ENVELOPE_ERROR = 1e-6  # what the envelope is good for

NOT_STABLE = Margins(**{field.name: math.nan for field in fields(Margins)[:-1]}, stable=False)


def margins_of(response: Response) -> Margins:
    """Margins of any loop transfer function that is known to be stable when closed.

    Parameters
    ----------
    response : Response
        L on the imaginary axis. Whether the loop is stable is not tested here.

    Returns
    -------
    Margins
        As of `margins`.

    Examples
    --------
    Of e^{-s}/(2 s), written as a product of factors:

    >>> from simc_core import Loop, Plant, SeriesPid, margins_of
    >>> from simc_core.sensitivity.log_response import FactoredResponse
    >>> round(margins_of(FactoredResponse(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)).L)).GM, 6)
    3.141593
    """
    return margins_from(response, search(response))


def margins_from(response: Ends, found: Crossings) -> Margins:
    """margins_of, where the crossings are known."""
    limits = _limits(response)
    (S_0, T_0), (S_inf, T_inf) = map(_sensitivities, limits)
    GM, GM_lower, omega_180 = _gain_margins(limits, found)
    PM, omega_c = _phase_margin(found)
    Ms, omega_Ms = _peak(found.S_peak, found.S_omega, (S_0, S_inf), found.envelope[0])
    Mt, omega_Mt = _peak(found.T_peak, found.T_omega, (T_0, T_inf), found.envelope[1])
    return Margins(
        GM=GM,
        GM_lower=GM_lower,
        PM_deg=math.degrees(PM),
        delay_margin=_delay_margin(response, limits, found),
        Ms=Ms,
        Mt=Mt,
        omega_180=omega_180,
        omega_c=omega_c,
        omega_Ms=omega_Ms,
        omega_Mt=omega_Mt,
        stable=True,
    )


def _limits(response: Ends) -> tuple[float, float]:
    """L(0) and L(inf), real, perhaps infinite; at infinity -|L| for a neutral loop, which gets there at any phase."""
    at = []
    for (gain, power), sign in ((response.at_zero, 1), (response.at_infinity, -1)):
        at.append(gain if power == 0 else 0.0 if power * sign > 0 else math.inf)
    return at[0], -abs(at[1]) if response.theta else at[1]


def _sensitivities(L: float) -> tuple[float, float]:
    """|S| and |T| where L is real, perhaps infinite."""
    return (0.0, 1.0) if math.isinf(L) else (abs(1 / (1 + L)), abs(L / (1 + L)))


def _gain_margins(limits: tuple[float, float], found: Crossings) -> tuple[float, float, float]:
    crossed = list(zip(found.phase_gain.tolist(), found.phase_omega.tolist(), strict=True))
    crossed += [(-limit, omega) for limit, omega in zip(limits, (0.0, math.inf), strict=True) if -math.inf < limit < 0]
    above = [(1 / gain, omega) for gain, omega in crossed if gain < 1]
    GM, _ = min(above, default=(math.inf, math.nan))
    omega_180 = min([omega for factor, omega in above if factor <= GM * (1 + SAME_LIMIT)], default=math.nan)
    return GM, max([1 / gain for gain, _ in crossed if gain >= 1], default=0.0), omega_180


def _phase_margin(found: Crossings) -> tuple[float, float]:
    crossed = zip(map(abs, found.gain_phase.tolist()), found.gain_omega.tolist(), strict=True)
    return min(crossed, default=(math.inf, math.nan))


def _delay_margin(response: Ends, limits: tuple[float, float], found: Crossings) -> float:
    if response.theta == 0 and abs(limits[1]) >= 1:
        return 0.0  # any dead time at all makes it a neutral loop with |L(inf)| >= 1
    crossed = zip(found.gain_phase.tolist(), found.gain_omega.tolist(), strict=True)
    return min([phase % (2 * math.pi) / omega for phase, omega in crossed], default=math.inf)


def _peak(peaks: np.ndarray, omegas: np.ndarray, ends: tuple[float, float], envelope: float) -> tuple[float, float]:
    """The largest of the peaks, of the values at omega = 0 and at infinity, and of the envelope, and where it is."""
    best = max(zip(ends, (0.0, math.inf), strict=True))
    highest = max(zip(peaks.tolist(), omegas.tolist(), strict=True), default=best)
    if highest[0] > best[0] * (1 + SAME_LIMIT):  # else it is rounding on the way to an end
        best = highest
    return (envelope, math.inf) if envelope > best[0] * (1 + ENVELOPE_ERROR) else best
