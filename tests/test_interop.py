"""Out to python-control and scipy.signal and back; what goes out has the frequency response of the formula."""

import control
import numpy as np
import pytest
from scipy import signal

from simc_core import (
    FormError,
    IController,
    InvalidParameter,
    Loop,
    ParallelPid,
    Plant,
    Scenario,
    SeriesPid,
    margins,
    simulate,
)
from simc_core.interop import closed_loop, controller_from, plant_from, to_scipy, to_ss, to_tf

PLANTS = [
    Plant(2.0, 0.5, (10.0, 3.0)),
    Plant(-1.5, 0.5, (10.0, 3.0, 0.1, 0.01), (-1.0, 2.0, 0.3), integrators=1),
    Plant(1.0, 2.0, (-20.0, 4.0), (), 0, ((2.0, 0.1),), ((3.0, 0.2),)),
]
CONTROLLERS = [
    SeriesPid(2.0, 8.0),
    SeriesPid(2.0, 8.0, 1.0, 0.1),
    SeriesPid(2.0, np.inf, 1.0, 0.1),
    SeriesPid(2.0, 8.0, 1.0, 0.1, b=0.5, c=0.3),
    ParallelPid(-1.0, 0.3),
    IController(0.3),
]
S = 1j * np.logspace(-3, 2, 60)


def pade(theta, order):
    """Pade approximation by its own formula: sum of (2n-k)! n!/((2n)! k! (n-k)!) (-+ theta s)^k."""
    n = order
    weight, top, bottom = 1.0, 0.0, 0.0
    for k in range(n + 1):
        top, bottom = top + weight * (-theta * S) ** k, bottom + weight * (theta * S) ** k
        weight *= (n - k) / ((2 * n - k) * (k + 1))
    return top / bottom


@pytest.mark.parametrize("plant", PLANTS)
def test_every_form_has_the_response_of_the_rational_part_times_pade(plant):
    expected = plant.response(S) * np.exp(plant.theta * S) * pade(plant.theta, 4)
    zpk = to_scipy(plant, 4)
    _, by_scipy = signal.freqs_zpk(zpk.zeros, zpk.poles, zpk.gain, S.imag)
    for given in (to_tf(plant, 4)(S), to_ss(plant, 4)(S), by_scipy):
        np.testing.assert_allclose(given, expected, rtol=1e-8)


@pytest.mark.parametrize("convert", [to_tf, to_ss, to_scipy])
@pytest.mark.parametrize("plant", PLANTS)
def test_a_plant_comes_back(plant, convert):
    rational = Plant(plant.k, 0.0, plant.lags, plant.leads, plant.integrators, plant.lag_pairs, plant.lead_pairs)
    again = plant_from(convert(rational), plant.theta)
    assert again.theta == plant.theta
    assert again.integrators == plant.integrators
    np.testing.assert_allclose(again.response(S), plant.response(S), rtol=1e-9)


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_a_controller_comes_back(controller):
    form = controller.to_parallel()
    wanted = [form.Kp, form.Ki, form.Kd, form.tau_F]
    for convert in (to_tf, to_ss, to_scipy):
        again = controller_from(convert(controller))
        np.testing.assert_allclose([again.Kp, again.Ki, again.Kd, again.tau_F], wanted, rtol=1e-9, atol=1e-12)


@pytest.mark.filterwarnings("ignore::scipy.signal.BadCoefficients")  # of what scipy makes on the way
@pytest.mark.parametrize("form", ["to_tf", "to_ss", "to_zpk"])
def test_all_forms_of_scipy_come_back(form):
    """Plants and controllers; whatever scipy itself makes of them on the way."""
    for plant in PLANTS:
        rational = Plant(plant.k, 0.0, plant.lags, plant.leads, plant.integrators, plant.lag_pairs, plant.lead_pairs)
        again = plant_from(getattr(to_scipy(rational), form)(), plant.theta)
        np.testing.assert_allclose(again.response(S), plant.response(S), rtol=1e-8)
    for controller in CONTROLLERS:
        again = controller_from(getattr(to_scipy(controller), form)())
        np.testing.assert_allclose(again.response(S), controller.response(S), rtol=1e-8)


@pytest.mark.parametrize("order", [1, 2, 5, 10])
def test_the_order_of_the_pade_approximation_is_the_one_asked_for(order):
    """Through it the way back gives a rational plant of that many more poles."""
    plant = Plant(2.0, 0.5, (10.0, 3.0))
    for convert in (to_tf, to_ss, to_scipy):
        again = plant_from(convert(plant, order))
        assert (again.order, again.theta) == (2 + order, 0.0)
        np.testing.assert_allclose(again.response(S), plant.response(S) * np.exp(0.5 * S) * pade(0.5, order), rtol=1e-6)


def test_an_order_of_twelve_keeps_its_small_time_constants_in_state_space():
    plant = Plant(1.0, 0.0, tuple(np.geomspace(100, 0.01, 12)))
    np.testing.assert_allclose(to_ss(plant)(S), plant.response(S), rtol=1e-10)


def test_python_control_as_the_second_opinion():
    """Without dead time both are exact: time responses and margins."""
    loop, t = Loop(Plant(1.0, 0.0, (6.0, 3.0, 0.5), (-0.4,)), SeriesPid(1.1, 6.0, 1.0, 0.05)), np.linspace(0, 40, 401)
    inputs = np.array([np.ones_like(t), 0.5 * np.ones_like(t)])
    theirs = control.forced_response(closed_loop(loop), t, inputs).outputs
    ours = simulate(loop, Scenario(1.0, 0.5, 0.0, t=t))
    np.testing.assert_allclose([ours.y, ours.u], theirs, rtol=0, atol=1e-9)
    L = control.series(to_ss(loop.plant), to_ss(loop.controller))
    GM, PM, _, omega_180, omega_c, _ = control.stability_margins(L)
    found = margins(loop)
    assert (found.GM, found.PM_deg, found.omega_180, found.omega_c) == pytest.approx(
        (GM, PM, omega_180, omega_c), rel=1e-6
    )


def test_pade_approaches_the_exact_response():
    """Smaller and smaller errors, but never small near theta: the reason why the engine does without it."""
    loop, t = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 8.0)), np.linspace(0, 30, 301)
    exact = simulate(loop, Scenario(disturbance=0, t=t)).y
    errors = []
    for order in (2, 5, 10):
        theirs = control.forced_response(closed_loop(loop, order), t, np.array([np.ones_like(t), 0 * t]))
        errors.append(np.max(np.abs(theirs.outputs[0] - exact)))
    assert errors[0] > errors[1] > errors[2] > 1e-4
    assert errors[2] < 0.01


def test_derivative_action_without_a_filter_is_a_transfer_function_but_no_state_space():
    controller = SeriesPid(2.0, 8.0, 1.0)
    assert controller_from(to_tf(controller)) == controller.to_parallel()
    with pytest.raises(FormError, match="tau_F must be > 0"):
        to_ss(controller)


@pytest.mark.parametrize("controller", [*CONTROLLERS, SeriesPid(2.0, 8.0, 1.0)])
def test_the_closed_loop_is_the_block_diagram(controller):
    for plant in (Plant(1.0, 1.0, (4.0, 2.0)), Plant(1.0, 1.0, (4.0,)), Plant(0.3, 0.0, (4.0, 2.0), (1.0,))):
        G = to_ss(plant, 4)(S)
        through = 1 / (1 + G * controller.response(S))
        feed = controller.setpoint_response(S)
        expected = np.array([[G * feed, G], [feed, -G * controller.response(S)]]) * through
        np.testing.assert_allclose(closed_loop(Loop(plant, controller), 4)(S), expected, rtol=1e-8, atol=1e-9)


def test_what_has_no_equivalent_is_refused():
    with pytest.raises(InvalidParameter, match=r"pade_order must be given where theta = 0\.5"):
        to_tf(PLANTS[0])
    with pytest.raises(InvalidParameter, match="pade_order must be >= 1, found 0"):
        to_ss(PLANTS[0], 0)
    with pytest.raises(FormError, match="found degree 0 over degree 3"):
        controller_from(control.tf([1.0], [1.0, 2.0, 3.0, 1.0]))
    with pytest.raises(InvalidParameter, match="one input and one output, found 2"):
        plant_from(control.ss(-np.eye(2), np.eye(2), np.eye(2), np.zeros((2, 2))))
    with pytest.raises(InvalidParameter, match="continuous time"):
        plant_from(control.tf([1.0], [1.0, -0.5], dt=0.1))
    with pytest.raises(InvalidParameter, match="found str"):
        plant_from("1/(s+1)")
    with pytest.raises(FormError, match="tau_F must be > 0"):
        closed_loop(Loop(Plant(1.0, 0.0, (4.0,), (1.0,)), SeriesPid(2.0, 8.0, 1.0)))
