"""SIMC tuning of PI/PID controllers, with exact dead time. See README for a ten-line example."""

from simc_core.autotuning.auto_tune import AutoTuned, auto_tune
from simc_core.cascade.by_simc import simc_cascade
from simc_core.cascade.by_synthesis import synthesis_cascade
from simc_core.cascade.design import CascadeDesign
from simc_core.certificate.poles import ClosedLoopPole, dominant_poles
from simc_core.certificate.verdict import NestedStability, Stability, count_unstable, stability, stability_many
from simc_core.controllers.forms import IController, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import (
    BoxError,
    DataError,
    FormError,
    InvalidParameter,
    NoOptimum,
    NotIdentifiable,
    NotReducible,
    NotStable,
    OutOfDomain,
    ParseError,
    RuleEnds,
    SimcError,
    WrongType,
)
from simc_core.identification.cloud_peaks import ms_of_plants
from simc_core.identification.experiments.known_controller import op_of_controller
from simc_core.identification.experiments.relay import Relay, relay_from_trend, relay_test
from simc_core.identification.experiments.retune_oscillation import retune_oscillation
from simc_core.identification.experiments.setpoint_overshoot import setpoint_overshoot
from simc_core.identification.frequency_band import FrequencyBand, frequency_band
from simc_core.identification.graphical import ByHand, by_hand
from simc_core.identification.identified import Identified
from simc_core.identification.identify import identify
from simc_core.identification.moves import find_moves
from simc_core.identification.operating_points import OperatingPoint, operating_points
from simc_core.identification.rank import identify_all
from simc_core.identification.reading.reader import read_trend
from simc_core.identification.robust_tau_c import ms_of_cloud, robust_tau_c
from simc_core.identification.trend import Trend
from simc_core.identification.uncertainty import Uncertainty, uncertainty_of
from simc_core.implementation.boxes.box import Box
from simc_core.implementation.boxes.catalogue import BOXES
from simc_core.implementation.boxes.convert import Typed, from_box, to_box
from simc_core.implementation.exports.export import export
from simc_core.implementation.exports.schedule import export_schedule
from simc_core.implementation.gain_schedule import GainSchedule
from simc_core.implementation.sampled_margins import longest_sampling_period, sampled_margins
from simc_core.implementation.schedule_table import ScheduleTable
from simc_core.loops.frequency_response import FrequencyResponse, frequency_response
from simc_core.loops.loop import Loop
from simc_core.loops.nested import CascadeLoop, NestedLoops
from simc_core.loops.static_errors import StaticErrors, static_errors
from simc_core.many.read_list import LoopList, read_list
from simc_core.many.result import Judged, Result
from simc_core.many.run import tune_many
from simc_core.many.tune_rows import tune_chunk, tune_row
from simc_core.metrics.nested_performance import NestedPerformance
from simc_core.metrics.noise import noise_variance
from simc_core.metrics.performance import Performance, performance, step_quality
from simc_core.metrics.step_quality import Quality
from simc_core.metrics.step_records import StepMetrics, StepQuality
from simc_core.numbers import read_number, read_numbers
from simc_core.optimal.robust_region import gain_intervals, robust_region
from simc_core.optimal.stability_limit import stability_limit
from simc_core.optimal.under_ms import Optimum
from simc_core.plants.models import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    OscillatingDelay,
    SecondOrderDelay,
    UnstableDelay,
)
from simc_core.plants.parse import parse_plant
from simc_core.plants.plant import Plant
from simc_core.plants.ultimate_point import Ultimate
from simc_core.read_back import read_back
from simc_core.reduction.half_rule import half_rule
from simc_core.reduction.records import BudgetEntry, Candidate, Reduction, Step
from simc_core.rules.catalogue import RULES, Rule
from simc_core.rules.direct_synthesis import direct_synthesis
from simc_core.rules.simc import simc, tau_c_presets
from simc_core.sensitivity.bandwidth import Bandwidth
from simc_core.sensitivity.margins import bandwidth, crossings, margins, margins_many
from simc_core.sensitivity.margins_of_response import Margins, margins_of
from simc_core.sensitivity.ultimate import ultimate
from simc_core.simulation import Actuation, NestedResponse, Scenario, TimeResponse, simulate
from simc_core.studies.comparison import comparison
from simc_core.studies.equal_robustness import EqualRobustness, at_equal_robustness
from simc_core.studies.optimum import optimal, trade_off
from simc_core.studies.sweep import Sweep, sweep
from simc_core.studies.tune import tune

__all__ = [
    "BOXES",
    "RULES",
    "Actuation",
    "AutoTuned",
    "Bandwidth",
    "Box",
    "BoxError",
    "BudgetEntry",
    "ByHand",
    "Candidate",
    "CascadeDesign",
    "CascadeLoop",
    "ClosedLoopPole",
    "DataError",
    "DoubleIntegratingDelay",
    "EqualRobustness",
    "FirstOrderDelay",
    "FormError",
    "FrequencyBand",
    "FrequencyResponse",
    "GainSchedule",
    "IController",
    "IdealPid",
    "Identified",
    "IntegratingDelay",
    "InvalidParameter",
    "Judged",
    "Loop",
    "LoopList",
    "Margins",
    "NestedLoops",
    "NestedPerformance",
    "NestedResponse",
    "NestedStability",
    "NoOptimum",
    "NotIdentifiable",
    "NotReducible",
    "NotStable",
    "OperatingPoint",
    "Optimum",
    "OscillatingDelay",
    "OutOfDomain",
    "ParallelPid",
    "ParseError",
    "Performance",
    "Plant",
    "Quality",
    "Reduction",
    "Relay",
    "Result",
    "Rule",
    "RuleEnds",
    "Scenario",
    "ScheduleTable",
    "SecondOrderDelay",
    "SeriesPid",
    "SimcError",
    "Stability",
    "StaticErrors",
    "Step",
    "StepMetrics",
    "StepQuality",
    "Sweep",
    "TimeResponse",
    "Trend",
    "Typed",
    "Ultimate",
    "Uncertainty",
    "UnstableDelay",
    "WrongType",
    "at_equal_robustness",
    "auto_tune",
    "bandwidth",
    "by_hand",
    "comparison",
    "count_unstable",
    "crossings",
    "direct_synthesis",
    "dominant_poles",
    "export",
    "export_schedule",
    "find_moves",
    "frequency_band",
    "frequency_response",
    "from_box",
    "gain_intervals",
    "half_rule",
    "identify",
    "identify_all",
    "longest_sampling_period",
    "margins",
    "margins_many",
    "margins_of",
    "ms_of_cloud",
    "ms_of_plants",
    "noise_variance",
    "op_of_controller",
    "operating_points",
    "optimal",
    "parse_plant",
    "performance",
    "read_back",
    "read_list",
    "read_number",
    "read_numbers",
    "read_trend",
    "relay_from_trend",
    "relay_test",
    "retune_oscillation",
    "robust_region",
    "robust_tau_c",
    "sampled_margins",
    "setpoint_overshoot",
    "simc",
    "simc_cascade",
    "simulate",
    "stability",
    "stability_limit",
    "stability_many",
    "static_errors",
    "step_quality",
    "sweep",
    "synthesis_cascade",
    "tau_c_presets",
    "to_box",
    "trade_off",
    "tune",
    "tune_chunk",
    "tune_many",
    "tune_row",
    "ultimate",
    "uncertainty_of",
]
