"""What is measured on the response to a unit step: what everybody needs, and what is computed when it is asked for."""

import math
from dataclasses import dataclass

from simc_core.loops.on_demand import OnDemand


@dataclass(frozen=True, slots=True)
class StepQuality:
    """Further measures of a unit step, which StepMetrics has too. Times in the user's unit, from the step on.

    Attributes
    ----------
    IE : float
        Integral of r - y after a set point, of y after a load, in output units and time.
    ITSE : float
        int t e^2, in output units squared and time squared.
    settling_1, settling_5 : float
        As StepMetrics.settling_time, to 1 % and 5 %.
    first_arrival : float
        When y first passes its end after a set-point step; nan where it never does, and after a load.
    decay_ratio : float
        Second peak over the first; nan without overshoot, 0 where there is no second peak.
    period : float
        From the first peak to the second, nan where there is none.
    largest_u : float
        Largest abs(u), in input units.
    """

    IE: float
    ITSE: float
    settling_1: float
    settling_5: float
    first_arrival: float
    decay_ratio: float
    period: float
    largest_u: float


NO_QUALITY = StepQuality(*[math.nan] * len(StepQuality.__slots__))


@dataclass(frozen=True, slots=True)
class StepMetrics(OnDemand[StepQuality]):
    """What is measured on the response to a unit step.

    Computed when asked for: `IE`, `ITSE`, `settling_1`, `settling_5`, `first_arrival`, `decay_ratio`, `period` and
    `largest_u`.

    Attributes
    ----------
    IAE, ISE, ITAE : float
        Integrals of abs(e), e^2 and t abs(e) over all times.
    TV : float
        Total variation of u, jumps included, in input units.
    overshoot : float
        Of a set-point step, beyond 1 as a fraction; of a load step, beyond 0 on the other side as a fraction of the
        peak.
    peak, peak_time : float
        Largest y of a set-point step, largest abs(y) of a load step (with its sign), and when. A set-point step without
        overshoot has no peak_time: nan.
    rise_time : float
        From 10 % to 90 %, nan for a load step. Times in the user's unit, from the step on.
    settling_time : float
        Within 2 % of the step, of the peak for a load step.
    """

    IAE: float
    ISE: float
    ITAE: float
    TV: float
    overshoot: float
    peak: float
    peak_time: float
    rise_time: float
    settling_time: float

    @property
    def quality(self) -> StepQuality:
        """All of these."""
        return self._asked(NO_QUALITY)

    @property
    def IE(self) -> float:
        """Integral of r - y after a set point, of y after a load, where it is tau_I/Kc."""
        return self.quality.IE

    @property
    def ITSE(self) -> float:
        """Integral of t e^2."""
        return self.quality.ITSE

    @property
    def settling_1(self) -> float:
        """As settling_time, within 1 %."""
        return self.quality.settling_1

    @property
    def settling_5(self) -> float:
        """As settling_time, within 5 %."""
        return self.quality.settling_5

    @property
    def first_arrival(self) -> float:
        """When y first passes its end after a set-point step; nan where it never does, and after a load."""
        return self.quality.first_arrival

    @property
    def decay_ratio(self) -> float:
        """Second peak beyond the end over the first; nan without overshoot, 0 where there is no second peak."""
        return self.quality.decay_ratio

    @property
    def period(self) -> float:
        """From the first peak beyond the end to the second, nan where there is none."""
        return self.quality.period

    @property
    def largest_u(self) -> float:
        """Largest abs(u), jumps included, in input units."""
        return self.quality.largest_u
