"""A closed loop of which PV and SP were written down: OP from the controller, and the process from it."""

import numpy as np
import pytest

from simc_core import (
    DataError,
    IController,
    IdealPid,
    NotIdentifiable,
    ParallelPid,
    SeriesPid,
    Trend,
    identify,
    op_of_controller,
    read_trend,
)
from tests.identification.simulated import closed_loop

FINE, EVERY = 0.05, 10  # the controller works at 0.05, the record is written every 0.5


def logged(noise: float = 0.01, seed: int = 0, setpoint: bool = True, k: float = 2.0) -> tuple[Trend, Trend]:
    """A PI loop around k e^{-3.2s}/(12 s + 1): as it was, and as it was logged, without OP."""
    n = 6000
    r = np.where(np.arange(n) * FINE >= 30, 1.0, 0.0) if setpoint else np.zeros(n)
    held = np.repeat(noise * np.random.default_rng(seed).normal(size=n // EVERY), EVERY)
    Kc = 0.9 * 2 / k
    whole = closed_loop(n, FINE, k, 3.2, 12.0, Kc, 12.0, r, held, np.zeros(n))
    kept = slice(None, None, EVERY)
    return whole, Trend(whole.t[kept], whole.y[kept], np.zeros(n // EVERY), r=r[kept])


def test_op_is_what_the_controller_gave():
    whole, record = logged(noise=0.0)
    found = op_of_controller(record, IdealPid(0.9, 12.0))
    truth = whole.u[np.searchsorted(whole.t, found.t_u + 0.0625, "right") - 1]  # in the middle of each part
    off = np.abs(found.u - found.u[0] - truth)
    assert np.median(off) < 0.9 * FINE / 12  # what one sample of the controller adds to its integral
    assert np.quantile(off, 0.97) < 0.02  # but for the jump of SP, between two samples


@pytest.mark.parametrize("k", [2.0, -2.0])
@pytest.mark.parametrize("seed", range(3))
def test_the_process_is_found_without_op(k, seed):
    _, record = logged(0.01, seed, k=k)
    found = identify(op_of_controller(record, IdealPid(0.9 * 2 / k, 12.0)))
    for name, value in {"k": k, "theta": 3.2, "tau1": 12.0}.items():
        assert found.parameters[name] == pytest.approx(value, rel=0.06), name
        low, high = found.intervals[name]
        assert low - 0.3 * abs(value) < value < high + 0.3 * abs(value)


def test_all_forms_of_one_controller_give_one_op():
    _, record = logged(0.01)
    series = SeriesPid(0.8, 10.0, 2.0, 0.5)
    ours = op_of_controller(record, series).u
    assert op_of_controller(record, series.to_ideal()).u == pytest.approx(ours)
    assert op_of_controller(record, series.to_parallel()).u == pytest.approx(ours)


def test_a_filter_is_that_of_a_first_order_lag():
    """A step of SP on P control with a filter: 1 - e^{-t/tau_F}."""
    t = np.linspace(0, 10, 201)
    r = (t >= 1).astype(float)
    found = op_of_controller(Trend(t, np.zeros(201), r, r=r), ParallelPid(2.0, 0.0, 0.0, 0.7))
    middle = found.t_u + 0.00625
    assert found.u == pytest.approx(2 * -np.expm1(-np.maximum(middle - 1, 0) / 0.7), abs=0.003)


def test_integral_action_alone():
    t = np.arange(5.0)
    found = op_of_controller(Trend(t, np.zeros(5), t, r=[0.0, 1, 1, 1, 1]), IController(0.5))
    assert found.u[-1] == pytest.approx(0.5 * (2 + 0.875))


def test_a_set_point_that_never_moves_is_refused():
    _, record = logged(setpoint=False)
    with pytest.raises(NotIdentifiable, match="the set point never moves"):
        op_of_controller(record, IdealPid(0.9, 12.0))


def test_a_file_without_op_is_read_with_the_controller():
    _, record = logged(0.01)
    rows = "\n".join(f"{t:.1f},{r:.0f},{y:.4f}" for t, r, y in zip(record.t, record.r, record.y, strict=True))
    text = "Time (s),SP,PV\n" + rows
    with pytest.raises(DataError, match=r"tell the controller, controller="):
        read_trend(text)
    found = identify(read_trend(text, controller=IdealPid(0.9, 12.0)))
    assert found.parameters["k"] == pytest.approx(2, rel=0.05)
    assert any("OP was computed" in note for note in read_trend(text, controller=IdealPid(0.9, 12.0)).notes)
