"""Step metrics against published rows and simple closed forms; see test_metrics.py for the rest."""

import math
from dataclasses import replace

import pytest

from simc_core import IController, Loop, NotStable, ParallelPid, Plant, SeriesPid, performance
from tests.oracles.published import Published, select


def with_PI_on_the_set_point(entry: Published) -> Loop:
    """Kc (tau_I s + 1)/(tau_I s) [r - (tau_D s + 1)/(tau_F s + 1) y] in the weights b, c of the parallel form."""
    loop = entry.loop
    if not getattr(loop.controller, "tau_D", 0):
        return loop
    Kc, tau_F, form = loop.controller.Kc, loop.controller.tau_F, loop.controller.to_parallel()
    return Loop(loop.plant, replace(loop.controller, b=(Kc + form.Ki * tau_F) / form.Kp, c=Kc * tau_F / form.Kd))


@pytest.mark.parametrize("entry", select("-perf"))
def test_the_performance_columns_of_the_2003_tables(entry):
    got = performance(with_PI_on_the_set_point(entry))
    columns = {
        "S03-T3-1-perf": (got.setpoint.IAE, got.setpoint.TV),
        "S03-T3-4-perf": (got.setpoint.IAE, got.setpoint.TV, got.disturbance.IAE),
        "S03-T3-5-perf": (got.setpoint.IAE, got.disturbance.IAE, got.disturbance.TV),
    }
    every = (got.setpoint.IAE, got.setpoint.TV, got.disturbance.IAE, got.disturbance.TV)
    for i, value in enumerate(columns.get(entry.id, every)):
        assert value == entry.approx(i)


def test_a_load_response_without_change_of_sign_has_IAE_tau_I_over_Kc():
    """[SK03 sect. 6]: int e dt = tau_I/Kc for a unit step at the plant input."""
    for plant, controller in (
        (Plant(1, 1, integrators=1), SeriesPid(0.5, 8)),
        (Plant(1, 1, (4,)), SeriesPid(2, 4)),
        (Plant(1, 0, (1, 0.2)), SeriesPid(5.5, 0.8)),
    ):
        assert (
            pytest.approx(controller.tau_I / controller.Kc, rel=1e-8)
            == performance(Loop(plant, controller)).disturbance.IAE
        )


def test_a_first_order_loop_has_closed_form_metrics():
    """L = 1/(T s) without dead time: e = e^{-t/T}; IAE T, ISE T/2, ITAE T^2, rise T ln 9, settling T ln 50."""
    T = 3.0
    got = performance(Loop(Plant(1), IController(1 / T))).setpoint
    assert pytest.approx(T, rel=1e-8) == got.IAE
    assert pytest.approx(T / 2, rel=1e-8) == got.ISE
    assert pytest.approx(T**2, rel=1e-7) == got.ITAE
    assert got.rise_time == pytest.approx(T * math.log(9), rel=1e-8)
    assert got.settling_time == pytest.approx(T * math.log(50), rel=1e-8)
    assert pytest.approx(1, rel=1e-8) == got.TV  # u goes up to 1 and stays
    assert got.overshoot == 0


def test_an_offset_has_no_IAE():
    with pytest.raises(NotStable, match="offset"):
        performance(Loop(Plant(1, 1, (5,)), ParallelPid(2, 0)))


@pytest.mark.parametrize("time", [0.01, 1.0, 60.0])
def test_without_overshoot_there_is_no_peak_to_give_a_time_of(time):
    """Y = 1 - e^{-t/2} comes nearer to 1 for ever."""
    found = performance(Loop(Plant(1, 0, (8 * time,)), SeriesPid(4, 8 * time))).setpoint
    assert found.overshoot == 0
    assert math.isnan(found.peak_time)


@pytest.mark.parametrize("k", [1.5, -4.5, 0.7])
def test_of_a_flat_top_the_first_instant_counts(k):
    """A load step on pure dead time: y = k from theta to 2 theta, when the controller answers."""
    assert performance(Loop(Plant(k, 2.0), IController(0.15 / k))).disturbance.peak_time == pytest.approx(2.0)
