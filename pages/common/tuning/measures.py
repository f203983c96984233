"""Further numbers of a design, each computed only where it is chosen."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import streamlit as st

from pages.common.studies.single import Study
from simc_core import Bandwidth, Quality, StaticErrors, bandwidth, static_errors, step_quality
from simc_core.errors import NotStable
from simc_core.metrics.step_metrics import StepMetrics
from simc_core.notation import number


class Measured:
    """What is known of a stable loop, as far as it is asked for."""

    def __init__(self, study: Study):
        self.study = study

    @cached_property
    def band(self) -> Bandwidth:
        """Bandwidths and noise gain."""
        return bandwidth(self.study.loop)

    @cached_property
    def steps(self) -> Quality:
        """Of unit steps."""
        return step_quality(self.study.loop)

    @cached_property
    def rest(self) -> StaticErrors:
        """In the long run."""
        return static_errors(self.study.loop)

    @property
    def setpoint(self) -> StepMetrics:
        """Of a unit step of the set point."""
        return self.study.performance.setpoint

    @property
    def load(self) -> StepMetrics:
        """Of a unit step of the load."""
        return self.study.performance.disturbance


@dataclass(frozen=True, slots=True)
class Measure:
    """unit: see unit_of.   of: from what is known to the number."""

    unit: str
    of: Callable[[Measured], float]


MEASURES = {
    "settling to 5 %, set point": Measure("time", lambda known: known.steps.setpoint.settling_5),
    "settling to 5 %, load": Measure("time", lambda known: known.steps.disturbance.settling_5),
    "settling to 1 %, set point": Measure("time", lambda known: known.steps.setpoint.settling_1),
    "settling to 1 %, load": Measure("time", lambda known: known.steps.disturbance.settling_1),
    "rise from 10 to 90 %": Measure("time", lambda known: known.setpoint.rise_time),
    "first arrival, set point": Measure("time", lambda known: known.steps.setpoint.first_arrival),
    "peak time, set point": Measure("time", lambda known: known.setpoint.peak_time),
    "decay ratio, set point": Measure("", lambda known: known.steps.setpoint.decay_ratio),
    "decay ratio, load": Measure("", lambda known: known.steps.disturbance.decay_ratio),
    "period, set point": Measure("time", lambda known: known.steps.setpoint.period),
    "period, load": Measure("time", lambda known: known.steps.disturbance.period),
    "largest |u|, set point": Measure("OP", lambda known: known.steps.setpoint.largest_u),
    "largest |u|, load": Measure("OP", lambda known: known.steps.disturbance.largest_u),
    "IE, set point": Measure("PV time", lambda known: known.rest.IE_setpoint),
    "IE, load": Measure("PV time", lambda known: known.rest.IE_load),
    "ISE, set point": Measure("", lambda known: known.setpoint.ISE),
    "ISE, load": Measure("", lambda known: known.load.ISE),
    "ITAE, set point": Measure("", lambda known: known.setpoint.ITAE),
    "ITAE, load": Measure("", lambda known: known.load.ITAE),
    "ITSE, set point": Measure("", lambda known: known.steps.setpoint.ITSE),
    "ITSE, load": Measure("", lambda known: known.steps.disturbance.ITSE),
    "bandwidth of S": Measure("rad/time", lambda known: known.band.omega_bS),
    "bandwidth of T": Measure("rad/time", lambda known: known.band.omega_bT),
    "largest |KS|": Measure("OP/PV", lambda known: known.band.max_KS),
    "loop type": Measure("", lambda known: known.rest.type),
    "error after a set-point step": Measure("PV", lambda known: known.rest.step),
    "error behind a set-point ramp of 1 per time": Measure("PV", lambda known: known.rest.ramp),
    "error after a load step": Measure("PV", lambda known: known.rest.load_step),
    "error behind a load ramp of 1 per time": Measure("PV", lambda known: known.rest.load_ramp),
}
MEANINGS = (
    "Settling and decay are of unit steps; arrival is the first time y is at its end value, decay ratio the second "
    "over the first peak beyond it. IE is the integral of the error, for a load $\\tau_I/K_c$. Bandwidth: $|S|$ rises "
    "through $1/\\sqrt{2}$ for the first time, $|T|$ falls through it for the last."
)


def choose() -> list[str]:
    """Which further numbers are listed."""
    return st.multiselect(
        "More numbers",
        list(MEASURES),
        key="measures",
        persist_state="session",
        placeholder="settling to 5 %, decay ratio, bandwidth, IE, largest u …",
        help=MEANINGS,
    )


def values(study: Study, labels: Sequence[str]) -> dict[str, str]:
    """The numbers as shown, a dash where there is none."""
    if not study.stable or not labels:
        return {}
    known = Measured(study)
    return {label: number(_value(MEASURES[label], known)) for label in labels}


def _value(measure: Measure, known: Measured) -> float:
    try:
        return measure.of(known)
    except NotStable:  # an offset, or too near the limit: no integral and no settling
        return math.nan
