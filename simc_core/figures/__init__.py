"""Figures made from result records, as plain dicts in plotly's JSON schema; see palette.py."""

from simc_core.figures.budget import budget_figure
from simc_core.figures.frequency import (
    bode_figure,
    model_error_figure,
    nested_sensitivity_figure,
    open_loop_figure,
    sensitivity_figure,
)
from simc_core.figures.nyquist import nested_nyquist_figure, nyquist_figure, plant_nyquist_figure
from simc_core.figures.palette import Figure, config
from simc_core.figures.polezero import pole_zero_figure
from simc_core.figures.rules import trade_off_figure
from simc_core.figures.schedule import schedule_figure
from simc_core.figures.time import (
    built_input_figure,
    built_output_figure,
    inner_output_figure,
    inner_setpoint_figure,
    input_figure,
    output_figure,
    plant_step_figure,
)
