"""SIMC tuning of PI/PID controllers, with exact dead time. See README for a ten-line example."""

from simc_core.controllers import IController, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import FormError, InvalidParameter, NotReducible, NotStable, ParseError, SimcError
from simc_core.loop import FrequencyResponse, Loop, frequency_response
from simc_core.models import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    OscillatingDelay,
    SecondOrderDelay,
    UnstableDelay,
)
from simc_core.plant import Plant
