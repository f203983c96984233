"""From what the user has decided to everything the pages show of it. Pure: no streamlit."""

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace

import numpy as np

from pages.common.session.design import Design
from pages.common.session.excitation import Excitation
from pages.common.session.tuning import Tuning
from pages.common.shared import shared
from simc_core.controllers.forms import Controller
from simc_core.errors import NotStable, SimcError
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.frequency_response import FrequencyResponse, frequency_response
from simc_core.loops.loop import Loop
from simc_core.metrics.performance import Performance, performance
from simc_core.metrics.step_records import StepMetrics
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.reduction.records import Reduction
from simc_core.sensitivity.margins import margins
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.simulation import TimeResponse, simulate
from simc_core.simulation.horizon import times
from simc_core.studies.tuned import Tuned, tuned

STUDIES = 128  # that are kept for whoever asks again, some kB each
UNKNOWN = StepMetrics(*[math.nan] * len(StepMetrics.__slots__))


@dataclass(frozen=True, slots=True, eq=False)
class Study:
    """A controller, how it came about, and what the loop around the FULL plant does.

    tuned: how SIMC made it; None for settings that were typed.
    performance: None where the loop is not stable; all nan where it is too near its limit to come to rest.
    """

    tuning: Tuning
    tuned: Tuned | None
    loop: Loop
    margins: Margins
    performance: Performance | None

    @property
    def reduction(self) -> Reduction | None:
        """How the model came about."""
        return self.tuned and self.tuned.reduction

    @property
    def tau_c(self) -> float | None:
        """The one in use."""
        return self.tuned and self.tuned.tau_c

    @property
    def model(self) -> Model | None:
        """The reduced model."""
        return self.tuned and self.tuned.model

    @property
    def controller(self) -> Controller:
        """The controller, with set-point weight and derivative filter."""
        return self.loop.controller

    @property
    def stable(self) -> bool:
        """Whether margins and metrics mean anything."""
        return self.margins.stable


@shared(STUDIES)
def study(plant: Plant, tuning: Tuning) -> Study:
    """Reduce, tune, close the loop, judge it. Raises SimcError, in words, where one of these is impossible."""
    found = tuned(plant, **asdict(tuning))
    return Study(tuning, found, found.loop, found.margins, _measured(found.loop) if found.margins.stable else None)


def attempt(make: Callable[[], Study]) -> tuple[Study | None, SimcError | None]:
    """A study, or why there is none."""
    try:
        return make(), None
    except SimcError as error:
        return None, error


def present_study(design: Design) -> Study:
    """The controller the design has chosen: by SIMC, or my settings. Raises SimcError as study does."""
    if design.source == "own":
        return study_of_settings(design.plant, design.own)
    return study(design.plant, design.tuning)


@shared(STUDIES)
def study_of_settings(plant: Plant, controller: Controller) -> Study:
    """Settings that were typed, around this plant: no model and no rule stand behind them."""
    found = judged_settings(plant, controller)
    return replace(found, performance=_measured(found.loop)) if found.stable else found


def judged_settings(plant: Plant, controller: Controller) -> Study:
    """The same with its margins alone: also of a controller whose u a set-point step would make infinite."""
    loop = Loop(plant, controller)
    return Study(Tuning(), None, loop, margins(loop), None)


def _measured(loop: Loop) -> Performance:
    try:
        return performance(loop)
    except NotStable:  # an integral exists, but not within reach
        return Performance(UNKNOWN, UNKNOWN)


def time_responses(studies: list[Study], excitation: Excitation) -> list[TimeResponse]:
    """Set point and load, begun and ended at the same instants for all; the horizon suits the first study."""
    begins, t_end = times(studies[0].loop, excitation.scenario())
    asked = excitation.scenario(disturbance_time=begins, t_end=t_end)
    return [simulate(each.loop, asked) for each in studies]


def common_grid(studies: list[Study]) -> np.ndarray:
    """One grid for the loops of all studies, which holds the frequencies of their margins."""
    return omega_grid([each.loop.L for each in studies], [omega for each in studies for omega in _marks(each.margins)])


def frequency_responses(studies: list[Study]) -> list[FrequencyResponse]:
    """L, S, T of all studies at the same frequencies."""
    omega = common_grid(studies)
    return [frequency_response(each.loop, omega) for each in studies]


def _marks(judged: Margins) -> tuple[float, ...]:
    return judged.omega_180, judged.omega_c, judged.omega_Ms, judged.omega_Mt
