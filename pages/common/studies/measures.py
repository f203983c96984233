"""Further numbers of a design, each computed only where it is chosen. Pure: no streamlit."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

from pages.common.words import translated
from simc_core import Loop, Margins, Performance, StaticErrors, StepMetrics, noise_variance, static_errors
from simc_core.errors import NotStable
from simc_core.wording import said


@dataclass(frozen=True)
class Measured:
    """What is known of a stable loop. performance: None where it is too near its limit to come to rest."""

    loop: Loop
    margins: Margins
    performance: Performance | None

    @cached_property
    def rest(self) -> StaticErrors:
        """In the long run."""
        return static_errors(self.loop)

    @property
    def setpoint(self) -> StepMetrics:
        """Of a unit step of the set point."""
        return self._steps.setpoint

    @property
    def load(self) -> StepMetrics:
        """Of a unit step of the load."""
        return self._steps.disturbance

    @property
    def _steps(self) -> Performance:
        if self.performance is None:
            raise NotStable(said("the loop does not come to rest"))
        return self.performance


@dataclass(frozen=True, slots=True)
class Measure:
    """unit: see unit_of.   of: from what is known to the number."""

    unit: str
    of: Callable[[Measured], float]


MEASURES = {
    said("settling to 5 %, set point"): Measure("time", lambda known: known.setpoint.settling_5),
    said("settling to 5 %, load"): Measure("time", lambda known: known.load.settling_5),
    said("settling to 1 %, set point"): Measure("time", lambda known: known.setpoint.settling_1),
    said("settling to 1 %, load"): Measure("time", lambda known: known.load.settling_1),
    said("rise from 10 to 90 %"): Measure("time", lambda known: known.setpoint.rise_time),
    said("first arrival, set point"): Measure("time", lambda known: known.setpoint.first_arrival),
    said("peak time, set point"): Measure("time", lambda known: known.setpoint.peak_time),
    said("decay ratio, set point"): Measure("", lambda known: known.setpoint.decay_ratio),
    said("decay ratio, load"): Measure("", lambda known: known.load.decay_ratio),
    said("period, set point"): Measure("time", lambda known: known.setpoint.period),
    said("period, load"): Measure("time", lambda known: known.load.period),
    said("largest |u|, set point"): Measure("OP", lambda known: known.setpoint.largest_u),
    said("largest |u|, load"): Measure("OP", lambda known: known.load.largest_u),
    said("IE, set point"): Measure("PV time", lambda known: known.setpoint.IE),
    said("IE, load"): Measure("PV time", lambda known: known.load.IE),
    said("ISE, set point"): Measure("", lambda known: known.setpoint.ISE),
    said("ISE, load"): Measure("", lambda known: known.load.ISE),
    said("ITAE, set point"): Measure("", lambda known: known.setpoint.ITAE),
    said("ITAE, load"): Measure("", lambda known: known.load.ITAE),
    said("ITSE, set point"): Measure("", lambda known: known.setpoint.ITSE),
    said("ITSE, load"): Measure("", lambda known: known.load.ITSE),
    said("bandwidth of S"): Measure("rad/time", lambda known: known.margins.omega_bS),
    said("bandwidth of T"): Measure("rad/time", lambda known: known.margins.omega_bT),
    said("largest |KS|"): Measure("OP/PV", lambda known: known.margins.max_KS),
    said("variance of u, white noise"): Measure("OP²/(PV² time)", lambda known: noise_variance(known.loop)),
    said("loop type"): Measure("", lambda known: known.rest.type),
    said("error after a set-point step"): Measure("PV", lambda known: known.rest.step),
    said("error behind a set-point ramp of 1 per time"): Measure("PV", lambda known: known.rest.ramp),
    said("error after a load step"): Measure("PV", lambda known: known.rest.load_step),
    said("error behind a load ramp of 1 per time"): Measure("PV", lambda known: known.rest.load_ramp),
}
MEANINGS = said(
    "Settling and decay are of unit steps; arrival is the first time y is at its end value, decay ratio the second "
    "over the first peak beyond it. IE is the integral of the error, for a load $\\tau_I/K_c$. Bandwidth: $|S|$ rises "
    "through $1/\\sqrt{2}$ for the first time, $|T|$ falls through it for the last. The variance of $u$, "
    "$\\int_0^\\infty |KS|^2 d\\omega/\\pi$, is finite only where all of $C$ is filtered, and its derivative twice."
)
EXAMPLES = said("settling to 5 %, decay ratio, bandwidth, IE, largest u …")
NAMES = {name: name for name in MEASURES}


def told(name: str) -> str:
    """The name of a measure in the language in use."""
    return translated(NAMES[name])


def values(known: Measured, labels: Sequence[str]) -> dict[str, float]:
    """The numbers by their labels, nan where there is none."""
    return {label: _value(MEASURES[label], known) for label in labels}


def _value(measure: Measure, known: Measured) -> float:
    try:
        return measure.of(known)
    except NotStable:  # an offset, or too near the limit: no integral and no settling
        return math.nan
