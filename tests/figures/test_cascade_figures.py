"""Figures of cascades against geometry, published integrals and the plain transfer functions."""

import numpy as np
import plotly.graph_objects as go
import pytest
from scipy.integrate import trapezoid

from simc_core import figures, frequency_response, margins, simulate
from simc_core.cascade.by_simc import single_loop
from simc_core.cascade.by_synthesis import synthesis_cascade
from simc_core.cascade.pairs import PAIRS, ROWS
from simc_core.controllers.forms import ParallelPid
from simc_core.figures import palette
from simc_core.figures.curves import nested_bode_curve
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.nested import CascadeLoop
from simc_core.simulation import Scenario

from .test_figures import labels, trace

# [PSB] row 1a with the lambdas behind it; Msa 2.0060, IAE_d1 9.4664, IAE_d2 2.3074 are what its settings give
ROW_1A = synthesis_cascade(*PAIRS[1], lambda_inner=1.04275, lambda_outer=2.05, b=0.3).loop
MSA, IAE_D1, IAE_D2 = 2.0060, 9.4664, 2.3074
UNSTABLE_INSIDE = CascadeLoop(*PAIRS[1], ROW_1A.outer, ParallelPid(9.0, 2.0, 6.0, 0.05))
LOOPS = (ROW_1A, UNSTABLE_INSIDE)


def drawn(loop):
    """Responses of the outer and the inner loop, and their margins."""
    judged = margins(loop.outer_loop), margins(loop.inner_loop)
    omega = omega_grid([loop.outer_loop.own, loop.inner_loop.L], [each.omega_Ms for each in judged])
    return frequency_response(loop.outer_loop, omega), frequency_response(loop.inner_loop, omega), judged


@pytest.mark.parametrize("loop", LOOPS)
def test_every_figure_is_valid_plotly_with_units(loop):
    outer, inner, judged = drawn(loop)
    curves = [
        ("cascade", simulate(loop, Scenario(t_end=60.0))),
        ("single loop", simulate(single_loop(*PAIRS[1]), Scenario(t_end=60.0))),
    ]
    for figure in (
        figures.output_figure(curves),
        figures.input_figure(curves),
        figures.inner_output_figure(curves),
        figures.inner_setpoint_figure(curves),
        figures.nested_nyquist_figure(outer, inner, judged, 250),
        figures.nested_sensitivity_figure(outer, inner, judged, 250),
    ):
        go.Figure(figure)
        assert all("[" in figure["layout"][axis]["title"]["text"] for axis in ("xaxis", "yaxis"))


def test_the_area_under_the_drawn_load_responses_is_the_published_iae():
    record = simulate(ROW_1A, Scenario(setpoint=0.0, disturbance_time=0.0, disturbance2_time=150.0, t_end=300.0))
    (curve,) = [each for each in figures.output_figure([("cascade", record)])["data"] if each["name"] == "cascade"]
    t, y = curve["x"], np.abs(curve["y"])
    first = t < 150.0
    assert trapezoid(y[first], t[first]) == pytest.approx(IAE_D1, rel=2e-3)
    assert trapezoid(y[~first], t[~first]) == pytest.approx(IAE_D2, rel=2e-3)


def test_each_curve_touches_the_circle_of_its_own_ms():
    outer, inner, judged = drawn(ROW_1A)
    figure = figures.nested_nyquist_figure(outer, inner, judged)
    assert figure["layout"]["yaxis"]["scaleanchor"] == "x"
    assert figure["layout"]["yaxis"]["scaleratio"] == 1
    for index, Ms in (("a", MSA), ("b", 2.0)):
        curve, circle = trace(figure, f"L{index}"), trace(figure, f"Ms{index} = ")
        distance = np.hypot(curve["x"] + 1, curve["y"])
        radius = np.hypot(circle["x"] + 1, circle["y"])
        assert radius == pytest.approx(np.full(radius.shape, 1 / Ms), rel=1e-3)
        assert distance.min() == pytest.approx(radius[0], rel=1e-9)
        assert circle["line"]["dash"] == curve["line"]["dash"]
    assert trace(figure, "La")["line"]["dash"] != trace(figure, "Lb")["line"]["dash"]


def test_the_peaks_of_both_sensitivities_are_marked_where_they_are():
    outer, inner, judged = drawn(ROW_1A)
    figure = figures.nested_sensitivity_figure(outer, inner, judged)
    for index, Ms in (("a", MSA), ("b", 2.0)):
        curve, mark = trace(figure, f"|S{index}|"), trace(figure, f"Ms{index}")
        assert mark["y"][0] == pytest.approx(Ms, rel=1e-3)
        at = np.argmax(curve["y"])
        assert (curve["x"][at], curve["y"][at]) == pytest.approx((mark["x"][0], mark["y"][0]), rel=1e-9)


def test_no_margin_is_drawn_of_loops_that_are_not_sound():
    outer, inner, judged = drawn(UNSTABLE_INSIDE)
    for figure in (
        figures.nested_nyquist_figure(outer, inner, judged),
        figures.nested_sensitivity_figure(outer, inner, judged),
    ):
        assert not [text for text in labels(figure) if text.startswith("Ms")]
        assert not [each for each in figure["data"] if "circle" in str(each.get("meta", ""))]
        assert figure["layout"]["annotations"]


def test_the_inner_output_is_drawn_with_its_set_point():
    record = simulate(ROW_1A, Scenario(t_end=60.0))
    figure = figures.inner_output_figure([("cascade", record)])
    assert trace(figure, "r2")["y"] == pytest.approx(record.us[1])
    assert trace(figure, "r2")["line"]["dash"] == "dash"
    assert trace(figure, "cascade")["y"] == pytest.approx(record.ys[0])
    assert trace(figure, "cascade")["line"]["color"] == palette.INNER


@pytest.mark.parametrize("row", [row for row in ROWS if row.method == "synthesis"], ids=lambda row: row.name)
def test_the_bode_curve_of_the_outer_loop_is_that_of_the_transfer_functions_and_unbroken(row):
    Ga, Gb = row.blocks
    loop = synthesis_cascade(Ga, Gb, row.Ms_inner, row.Ms_outer, row.inner, row.outer, N_outer=row.N_outer).loop
    omega = omega_grid([loop.outer_loop.own, loop.inner_loop.L])
    s = 1j * omega
    Lb = Gb.response(s) * loop.inner.response(s)
    La = loop.outer.response(s) * Ga.response(s) * Lb / (1 + Lb)
    curve = nested_bode_curve(loop.outer_loop, omega)
    assert curve.magnitude * np.exp(1j * np.deg2rad(curve.phase_deg)) == pytest.approx(La, rel=1e-8)
    assert np.abs(np.diff(curve.phase_deg)).max() < 60
