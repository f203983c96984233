"""Several trends fitted together: what is said where they do not show one process; the truth is a closed form."""

import numpy as np
import pytest

from simc_core import NotIdentifiable, Trend, identify, identify_all
from tests.identification.simulated import closed_loop, rise

THETA, TAU1 = 6.0, 20.0


def step(u0: float, k: float, seed: int, noise: float = 0.02, size: float = 10.0) -> Trend:
    """A step of OP from u0 at t = 60, answered by k e^{-6s}/(20s + 1); noise as a share of a gain of 1."""
    t = np.arange(300.0)
    y = 50 + k * size * rise(t - 60 - THETA, TAU1) + noise * size * np.random.default_rng(seed).normal(size=t.size)
    return Trend(t, y, [u0, u0 + size], t_u=[0.0, 60.0])


def said_of_gains(verdicts) -> list[str]:
    return [verdict for verdict in verdicts if "gain" in verdict and "record" in verdict]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("gains", [(2.0, 1.0), (1.0, 1.3), (1.0, 1.0, 4.0)])
def test_gains_that_differ_are_told_first_of_every_structure(gains, seed):
    trends = [step(20.0 + 15 * i, k, 10 * seed + i) for i, k in enumerate(gains)]
    structures = ("FOPDT", "SOPDT", "inverse")
    found = identify_all(trends, structures)
    # rounding may decide whether a structure that is right for no record is fitted at all: then its refusal tells it
    for structure in {*structures} - {each.structure for each in found}:
        with pytest.raises(NotIdentifiable, match=r"^The gain differs from record to record"):
            identify(trends, structure)
    assert {"FOPDT", "SOPDT"} <= {each.structure for each in found}
    for one in found:
        first = one.verdicts[0]
        assert "gain differs from record to record" in first
        assert "operating point" in first
        assert "gain schedule" in first
    low, high = np.argmin(gains), np.argmax(gains)
    assert f"from {20 + 15 * high:g} to {30 + 15 * high:g} in record {high + 1}" in found[0].verdicts[0]
    shown = [each.gain for each in found[0].gains]
    assert shown == pytest.approx(gains, rel=0.15)
    assert [each.record for each in found[0].gains] == list(range(len(gains)))
    assert shown[low] < shown[high]


@pytest.mark.parametrize("count", [2, 5])
def test_equal_gains_are_left_alone(count):
    for seed in range(5):
        found = identify([step(20.0 + 10 * i, 1.5, 100 * seed + i, 0.05) for i in range(count)])
        assert not said_of_gains(found.verdicts)
        assert found.parameters["k"] == pytest.approx(1.5, abs=4 * found.standard_errors["k"])


@pytest.mark.parametrize("size", [10.0, 30.0])
def test_opposite_signs_make_no_model(size):
    """Their common gain is none, or that of the record that moved more: in both cases it is said why."""
    try:
        said = identify([step(20, 2.0, 1, size=size), step(60, -2.0, 2)]).verdicts[0]
    except NotIdentifiable as error:
        said = str(error)
    assert "changes its sign" in said


def test_a_gain_that_is_not_well_known_does_not_hide_those_that_differ():
    """The largest gain is so uncertain that it differs from none; the others differ all the same."""
    faint = step(50, 1.2, 3, size=0.05)
    noise = 0.2 * np.random.default_rng(5).normal(size=faint.t.size)
    found = identify([step(20, 1.0, 1), step(35, 1.5, 2), Trend(faint.t, faint.y + noise, faint.u, t_u=faint.t_u)])
    first, second, third = found.gains
    assert third.gain > second.gain
    assert third.gain - first.gain < 3 * third.standard_error
    assert "from 20 to 30 in record 1 and 1.5 from 35 to 45 in record 2" in found.verdicts[0]


@pytest.mark.parametrize(("gains", "told"), [((1.0, 1.0), False), ((1.0, 2.0), True)])
def test_closed_loops_have_a_gain_for_each_record(gains, told):
    n = 400
    setpoint = np.where(np.arange(n) < 40, 0.0, np.where(np.arange(n) < 220, 5.0, -3.0))
    trends = []
    for i, k in enumerate(gains):
        noise = 0.05 * np.random.default_rng(i).normal(size=n)
        trends.append(closed_loop(n, 1.0, k, THETA, TAU1, 0.6, 20.0, setpoint, noise, np.zeros(n)))
    found = identify(trends)
    assert [each.record for each in found.gains] == [0, 1]
    assert [each.gain for each in found.gains] == pytest.approx(gains, rel=0.1)
    assert bool(said_of_gains(found.verdicts)) == told


def test_many_moves_in_many_records_are_compared_record_by_record():
    t = np.arange(900.0)
    at = 60.0 + 90 * np.arange(9)
    levels = 40 + 5.0 * (np.arange(10) % 2)
    trends = []
    for i, k in enumerate((1.0, 2.0)):
        y = sum(k * d * rise(t - s - THETA, TAU1) for d, s in zip(np.diff(levels), at, strict=True))
        noise = 0.05 * np.random.default_rng(i).normal(size=t.size)
        trends.append(Trend(t, y + noise, levels, t_u=np.concatenate([[0.0], at])))
    found = identify(trends)
    assert [(each.record, each.before, each.after) for each in found.gains] == [(0, 40, 45), (1, 40, 45)]
    assert "gain differs from record to record" in found.verdicts[0]
