"""The data in the traces, against closed forms and geometry; every dict against plotly's schema."""

import math

import numpy as np
import plotly.graph_objects as go
import pytest

from simc_core import Loop, Plant, SeriesPid, figures, frequency_response, simc
from simc_core.figures.curves import bode_curve
from simc_core.figures.nyquist import mt_circle
from simc_core.loops.frequency_grid import omega_grid
from simc_core.plants.step_response import plant_step
from simc_core.reduction.half_rule import half_rule
from simc_core.reduction.model_error import model_error
from simc_core.sensitivity.margins import crossings, margins
from simc_core.simulation import Scenario, simulate

TIGHT = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 8.0))  # L = 0.5 e^{-s}/s, exact margins in theory.md
UNSTABLE = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(40.0, 8.0))
LAG = Plant(2.0, 3.0, (6.0, 4.0, 2.0), (-1.0,))


def drawn(loop):
    judged = margins(loop)
    marks = (judged.omega_180, judged.omega_c, judged.omega_Ms, judged.omega_Mt)
    return frequency_response(loop, omega_grid([loop.L], marks)), judged


def trace(figure, name):
    (found,) = [each for each in figure["data"] if each.get("name", "").startswith(name)]
    return found


def labels(figure):
    return [text for each in figure["data"] if "text" in each for text in each["text"]]


def all_figures():
    for loop in (TIGHT, UNSTABLE):
        record, judged = drawn(loop)
        times = [(name, simulate(loop, Scenario(t_end=40.0))) for name in ("present", "A", "B", "C", "D")]
        several = [(name, record) for name in ("present", "A", "B", "C", "D")]
        curve = bode_curve(loop.L, record.omega)
        yield figures.output_figure(times, 250, judged.stable)
        yield figures.input_figure(times, 250, judged.stable)
        yield figures.nyquist_figure(several, judged, 250)
        yield figures.sensitivity_figure(several, judged, 250)
        yield figures.open_loop_figure([("present", curve), ("A", curve)], judged, crossings(loop), 480)
    reduction = half_rule(LAG)
    compared = model_error(LAG, reduction.model, simc(reduction.model))
    yield figures.budget_figure(reduction)
    yield figures.bode_figure(LAG, reduction.model.plant)
    yield figures.plant_step_figure(compared.step, compared.model_step)
    yield figures.model_error_figure(compared.omega, compared.error, compared.bound)
    yield figures.pole_zero_figure(LAG)
    yield figures.pole_zero_figure(Plant(1.0, 2.0))
    yield figures.budget_figure(half_rule(Plant(1.0, 1.0, (3.0, 1.0), integrators=1)))


def test_every_figure_is_valid_plotly_with_names_and_units_on_its_axes():
    for figure in all_figures():
        go.Figure(figure)  # raises on anything the schema does not know
        for name, axis in figure["layout"].items():
            if name.startswith(("xaxis", "yaxis")) and axis["title"]["text"]:
                assert "[" in axis["title"]["text"]
        curves = [each for each in figure["data"] if each.get("mode") == "lines"]
        assert all(each["line"]["simplify"] is False for each in curves)


def test_nothing_is_drawn_as_a_margin_of_a_loop_that_is_not_stable():
    record, judged = drawn(UNSTABLE)
    for figure in (
        figures.nyquist_figure([("present", record)], judged),
        figures.sensitivity_figure([("present", record)], judged),
        figures.open_loop_figure([("present", bode_curve(UNSTABLE.L, record.omega))], judged, crossings(UNSTABLE)),
    ):
        assert not [text for text in labels(figure) if text.startswith(("Ms ", "Mt ", "GM", "PM", "delay"))]
        assert not [each for each in figure["data"] if "circle" in str(each.get("meta", ""))]
        assert "not stable" in figure["layout"]["annotations"][0]["text"]


def test_the_nyquist_plane_is_one_to_one_and_the_ms_circle_touches_the_curve():
    record, judged = drawn(TIGHT)
    figure = figures.nyquist_figure([("present", record)], judged)
    assert figure["layout"]["yaxis"]["scaleanchor"] == "x"
    assert figure["layout"]["yaxis"]["scaleratio"] == 1
    curve, circle = trace(figure, "present"), trace(figure, "Ms = ")
    distance = np.hypot(curve["x"] + 1, curve["y"])
    radius = np.hypot(circle["x"] + 1, circle["y"])
    assert radius == pytest.approx(np.full(radius.shape, 1 / 1.59049), rel=1e-5)  # theory.md sect. 3
    assert distance.min() == pytest.approx(radius[0], rel=1e-9)


@pytest.mark.parametrize("Mt", [0.7, 1.0, 1.0 + 1e-9, 1.3, 2.5])
def test_on_the_mt_circle_the_closed_loop_has_that_gain(Mt):
    x, y = mt_circle(Mt)
    L = x + 1j * y
    assert np.abs(L / (1 + L)) == pytest.approx(np.full(x.shape, Mt), rel=1e-6)


@pytest.mark.parametrize(("Ms", "text"), [(1.4, "1.4"), (1.7, "1.7"), (2.0, "2.0")])
def test_reference_circles_are_labelled_on_the_circle(Ms, text):
    record, judged = drawn(Loop(TIGHT.plant, SeriesPid(0.4, 10)))
    assert judged.Ms < 1.47  # its own circle is not near any of them
    figure = figures.nyquist_figure([("present", record)], judged)
    (label,) = [each for each in figure["data"] if each.get("text") == [text]]
    assert math.hypot(label["x"][0] + 1, label["y"][0]) == pytest.approx(1 / Ms)
    circle = trace(figure, f"Ms {text}")
    assert np.hypot(circle["x"] + 1, circle["y"]) == pytest.approx(np.full(181, 1 / Ms))


def test_a_reference_circle_whose_label_the_own_circle_would_cross_is_left_out():
    record, judged = drawn(Loop(Plant(1, 1, integrators=1), SeriesPid(0.5, 8)))  # SIMC, Ms 1.70 [SK03]
    names = [each["name"] for each in figures.nyquist_figure([("present", record)], judged)["data"] if "name" in each]
    assert [name for name in names if name.startswith("Ms 1") or name.startswith("Ms 2")] == ["Ms 1.4", "Ms 2.0"]


def test_the_peak_of_s_is_marked_where_it_is():
    record, judged = drawn(TIGHT)
    figure = figures.sensitivity_figure([("present", record)], judged)
    peak, curve = trace(figure, "Ms"), trace(figure, "|S|")
    assert peak["y"][0] == pytest.approx(1.59049, abs=5e-6)
    assert peak["y"][0] == pytest.approx(curve["y"].max(), rel=1e-12)
    assert peak["x"][0] == curve["x"][curve["y"].argmax()]


def test_bode_of_an_integrator_with_dead_time_is_its_closed_form():
    curve = bode_curve(TIGHT.L, drawn(TIGHT)[0].omega)
    figure = figures.open_loop_figure([("present", curve)], margins(TIGHT), crossings(TIGHT))
    gain, phase = [each for each in figure["data"] if each["name"] == "present"]
    assert gain["y"] == pytest.approx(0.5 / gain["x"], rel=1e-12)
    assert phase["y"] == pytest.approx(-90 - np.rad2deg(phase["x"]), abs=1e-9)
    stroke = trace(figure, "GM")
    assert stroke["x"][0] == pytest.approx(math.pi / 2)
    assert list(stroke["y"]) == pytest.approx([1.0, 1 / math.pi])
    stroke = trace(figure, "PM")
    assert stroke["x"][0] == pytest.approx(0.5)
    assert stroke["y"][1] - stroke["y"][0] == pytest.approx(61.3521, abs=5e-5)


def test_both_gain_limits_of_a_double_integrating_loop_are_drawn():
    loop = Loop(Plant(1.0, 1.0, integrators=2), SeriesPid(0.0625, 8.0, 8.0))
    record, judged = drawn(loop)
    figure = figures.open_loop_figure([("present", bode_curve(loop.L, record.omega))], judged, crossings(loop))
    lower = trace(figure, "GM lower")
    assert lower["y"][1] == pytest.approx(1 / 0.165, rel=5e-3)  # theory.md sect. 3
    assert loop.L(1j * lower["x"][0]) == pytest.approx(-lower["y"][1], rel=1e-6)


def test_the_lower_gain_limit_of_an_unstable_plant_is_in_sight():
    loop = Loop(Plant(-1.0, 1.0, (-5.0,)), SeriesPid(2.5, 15.5))
    record, judged = drawn(loop)
    left, right = figures.nyquist_figure([("present", record)], judged)["layout"]["xaxis"]["range"]
    assert left < -1 / judged.GM_lower < -1 < right


def test_jumps_of_u_are_drawn_as_strokes_and_the_set_point_is_dashed():
    response = simulate(TIGHT, Scenario())
    figure = figures.output_figure([("present", response)])
    assert trace(figure, "r")["line"]["dash"] == "dash"
    u = figures.input_figure([("present", response)])["data"][0]
    assert u["y"].max() == pytest.approx(response.u.max())
    assert trace(figure, "present")["y"][response.t < 1.0] == pytest.approx(0.0, abs=1e-12)  # nothing before theta


def test_pinned_designs_have_another_shade_and_another_dash():
    response = simulate(TIGHT, Scenario(t_end=20.0))
    figure = figures.output_figure([(name, response) for name in ("present", "A", "B", "C", "D")])
    lines = [each["line"] for each in figure["data"] if each["name"] != "r"]
    assert len({each["dash"] for each in lines}) == len({each["color"] for each in lines}) == 5
    assert figure["data"][-1]["name"] == "present"  # on top


def test_bars_of_the_budget_add_up_to_the_time_constants():
    reduction = half_rule(Plant(1.0, 3.0, (6.0, 4.0, 2.0)))
    figure = figures.budget_figure(reduction)
    total = np.zeros(4)
    for each in figure["data"]:
        np.add.at(total, each["y"], each["x"])
    assert figure["layout"]["yaxis"]["ticktext"] == ["lag 6", "lag 4", "lag 2", "dead time 3"]
    assert total == pytest.approx([6, 4, 2, 3])
    assert sum(trace(figure, "into")["x"]) == pytest.approx(7.0)  # theta, [V06] example 1
    assert sum(trace(figure, "kept as τ₁")["x"]) == pytest.approx(8.0)


def test_poles_and_zeros_lie_where_they_are():
    figure = figures.pole_zero_figure(Plant(1.0, 1.0, (2.0, 2.0, -4.0), (-1.0,)))
    poles, zeros = trace(figure, "poles"), trace(figure, "zeros")
    assert sorted(poles["x"]) == pytest.approx([-0.5, 0.25])
    assert poles["text"][poles["x"].index(-0.5)] == "×2"
    assert zeros["x"] == [1.0]


@pytest.mark.parametrize("plant", [LAG, Plant(1.0, 0.5, lag_pairs=((2.0, 0.05),)), Plant(1.0, 0.0, (5.0, -2.0))])
def test_the_grid_follows_the_plant_when_time_is_rescaled(plant):
    omega = omega_grid([plant.factored])
    slow = Plant(
        plant.k,
        60 * plant.theta,
        tuple(60 * tau for tau in plant.lags),
        tuple(60 * T for T in plant.leads),
        lag_pairs=tuple((60 * tau, zeta) for tau, zeta in plant.lag_pairs),
    )
    assert omega_grid([slow.factored]) == pytest.approx(omega / 60, rel=1e-9)


def test_the_phase_is_unbroken():
    plant = Plant(-2.0, 1.0, (3.0, 0.2), (-1.0,), 1, ((1.0, 0.1),))
    omega = omega_grid([plant.factored])
    curve = bode_curve(plant.factored, omega)
    value = plant.factored(1j * omega)
    assert curve.magnitude * np.exp(1j * np.deg2rad(curve.phase_deg)) == pytest.approx(value, rel=1e-9)
    assert np.abs(np.diff(curve.phase_deg)).max() < 45


def test_plant_steps_of_both_models_are_drawn_on_one_axis():
    step = plant_step(LAG)
    figure = figures.plant_step_figure(step, plant_step(half_rule(LAG).model.plant, float(step.t[-1])))
    assert [each["name"] for each in figure["data"]] == ["G", "model"]
