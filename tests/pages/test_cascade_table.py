"""The tables of the cascade instrument: curves read between rows against the exact engine, and what is not sound."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pages.common.live.cascade import rows as cascade_rows
from pages.common.live.cascade import table as cascade_table
from pages.common.session.cascade import Cascade
from pages.common.session.sheet import Sheet
from pages.common.studies.cascade import designed, study
from simc_core import Plant, stability
from simc_core.cascade.pairs import PAIRS
from simc_core.studies.tau_table import read
from tests.pages.test_live_table import unpacked

WORST = 2e-3  # of a curve's range: issue 5
SEED, SPEEDS = 5, 3
PEAKS = {5: {"Ms_outer": 3.5}, 8: {"Ms_inner": 5.0, "Ms_outer": 3.0}, 9: {"Ms_outer": 3.0}, 10: {"Ms_outer": 3.05}}


@pytest.fixture(autouse=True)
def no_hurry(monkeypatch):
    """What a table may cost depends on the machine, and what is in it does not."""
    monkeypatch.setattr(cascade_rows, "thread_time", lambda: 0.0)


def nothing() -> None: ...


def made(cascade: Cascade):
    found = study(cascade)
    return found, cascade_table.subject_of(found), cascade_table.grid_of(found)


def cascade_of(pair: int) -> Cascade:
    """SIMC for four of the pairs, direct synthesis for the others."""
    primary, secondary = PAIRS[pair]
    if pair in (1, 3, 4, 10):
        return Cascade(primary, secondary)
    return Cascade(primary, secondary, method="synthesis", **PEAKS.get(pair, {}))


@pytest.mark.parametrize(("pair", "loop"), [(pair, cascade_table.LOOPS[pair % 2]) for pair in PAIRS])
def test_curves_between_rows_are_right_to_a_fifth_of_a_per_cent(pair, loop):
    _, subject, grid = made(cascade_of(pair))
    found, unsound, _ = cascade_rows.sections(
        subject.held, loop, *cascade_table.bounds(subject.rest)[loop], grid, nothing
    )
    rng = np.random.default_rng([SEED, pair])
    for section in found:
        curves = np.array([row.curves for row in section.rows], dtype=np.float32).astype(float)  # as they travel
        for x in rng.uniform(section.nodes.x[0], section.nodes.x[-1], SPEEDS):
            exact = cascade_rows.course(cascade_rows.at(subject.held, loop, math.exp(x)).loop, grid)
            for i, curve in enumerate(exact):
                assert np.max(np.abs(read(section.nodes, curves[:, i], x) - curve)) <= WORST * np.ptp(curve)
    low, high = cascade_table.bounds(subject.rest)[loop]
    spans = [(s.nodes.x[0], s.nodes.x[-1]) for s in found] + [(math.log(a), math.log(b)) for a, b in unsound]
    assert sum(b - a for a, b in spans) == pytest.approx(math.log(high / low), abs=1e-3)


@pytest.mark.parametrize(("pair", "loop"), [(6, "inner"), (8, "outer")])
def test_ranges_end_where_the_verdict_changes(pair, loop):
    _, subject, grid = made(cascade_of(pair))
    low, high = cascade_table.bounds(subject.rest)[loop]
    _, unsound, _ = cascade_rows.sections(subject.held, loop, low, high, grid, nothing)
    assert unsound
    for begin, end in unsound:
        for edge, outwards in ((begin, 0.999), (end, 1.001)):
            if low * 1.001 < edge < high / 1.001:
                assert stability(cascade_rows.at(subject.held, loop, edge * outwards).loop).sound
                assert not stability(cascade_rows.at(subject.held, loop, edge / outwards).loop).sound


def test_sums_of_a_row_are_near_the_exact_metrics():
    found, _, grid = made(cascade_of(1))
    exact = found.performance
    wanted = exact.setpoint.IAE, exact.disturbance.IAE, exact.disturbance2.IAE
    assert cascade_rows.IAE_by_sums(found.loop, float(grid.t[-1])) == pytest.approx(wanted, rel=0.01)


def test_a_table_holds_what_its_header_says():
    _, subject, grid = made(Cascade())
    header, blocks = unpacked(cascade_table.table(subject, grid, "inner", nothing))
    rows = len(header["log_tau_c"])
    assert header["held"] is None  # the outer loop follows
    assert {blocks[name].shape for name in cascade_table.CURVES} == {(rows, len(grid.t))}
    assert blocks["parameters"].shape == (rows, 8)
    follows = [designed(replace(subject.held, tau_c_inner=math.exp(x))).tau_c_outer for x in header["log_tau_c"]]
    assert blocks["outer_speed"][:, 0] == pytest.approx(follows, rel=1e-6)
    setup, parts = unpacked(cascade_table.setup(subject, grid))
    G = Plant(2.0, 2.0, (5.0,)).response(1j * np.array(setup["omega"]))
    np.testing.assert_allclose(parts["Ga_re"][0] + 1j * parts["Ga_im"][0], G, rtol=1e-5, atol=1e-6)


def test_a_cascade_that_is_not_sound_has_no_numbers():
    """Gb = e^{-s}/(20 s - 1) with lambda far too small for its dead time."""
    cascade = replace(cascade_of(6), tau_c_inner=0.21, tau_c_outer=4.0)
    found, subject, grid = made(cascade)
    assert not found.sound
    assert cascade_table.grid_of(found, shown=50.0).t[-1] == 50.0  # what grows does not change the axis
    header, _ = unpacked(cascade_table.exact(subject, grid, found, 0, Sheet()))
    assert set(header["metrics"].values()) == {None}


def test_a_table_can_be_left_half_way():
    """As Streamlit ends a run: the exception of the pause goes through."""
    calls = []

    def pause() -> None:
        calls.append(1)
        if len(calls) == 10:
            raise KeyboardInterrupt

    _, subject, grid = made(Cascade())
    with pytest.raises(KeyboardInterrupt):
        cascade_table.table(subject, grid, "outer", pause)
    assert len(calls) == 10


def test_a_table_is_left_out_where_its_work_is_not_worth_it(monkeypatch):
    """One second for a look at one speed, of 25 at least: nothing is computed behind the second look."""
    _, subject, grid = made(Cascade())
    seconds = iter(range(100))
    monkeypatch.setattr(cascade_rows, "thread_time", lambda: float(next(seconds)))
    assert cascade_table.table(subject, grid, "inner", nothing) == b""
    assert next(seconds) == 3  # begun, and asked before each of two looks


@pytest.mark.parametrize("many", [Plant(1, 1, (2.0,) * 31), Plant(1, 1, lag_pairs=((1.0, 0.5),) * 16)])
def test_a_table_of_many_lags_or_pairs_is_not_begun(monkeypatch, many):
    """62 and 64 poles in both blocks; one may have 40."""
    monkeypatch.setattr(cascade_rows, "_state", lambda *_: pytest.fail("it was begun"))
    with pytest.raises(cascade_rows.TooSlow):
        cascade_rows.sections(Cascade(primary=many, secondary=many), "inner", 1.0, 2.0, None, nothing)
