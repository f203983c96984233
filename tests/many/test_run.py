"""Executors: the same results from all of them, and no row lost by a process that is gone."""

from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from functools import partial
from itertools import count, islice
from multiprocessing import get_context

import pytest

from simc_core import tune_many
from simc_core.errors import InvalidParameter, WrongType
from simc_core.many import run
from simc_core.many.processes import Processes
from tests.many.lists import mixed_rows
from tests.many.workers import divides_by_zero, ends_its_process, fails_together, hangs, killed_once

ROW = {"k": 1, "theta": 1, "tau1": 8}


def pool() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(1, get_context("spawn"))


class Client:
    """As a Dask client behaves: submit gives a future whose result may raise, map gives a list of futures."""

    def submit(self, function, *args):
        future: Future = Future()
        try:
            future.set_result(function(*args))
        except Exception as error:
            future.set_exception(error)
        return future

    def map(self, function, things):
        return [self.submit(function, thing) for thing in things]


class Mapper:
    """Has `map` alone."""

    map = staticmethod(map)


def told(results) -> list[tuple]:
    return [
        (result.tag, result.controller, result.margins and repr(result.margins), result.refusal) for result in results
    ]


def test_all_executors_give_the_same():
    rows, _ = mixed_rows(40, 4, seed=3)
    here = told(tune_many(rows, chunk=7))
    assert [each[0] for each in here] == [row["tag"] for row in rows]
    assert told(tune_many(rows, Client(), chunk=7)) == here
    assert told(tune_many(rows, Mapper(), chunk=7)) == here
    with ThreadPoolExecutor(2) as threads:
        assert told(tune_many(rows, threads, chunk=7)) == here
    with pool() as processes:
        assert told(tune_many(rows, processes, chunk=7)) == here
    with Processes(1) as processes:
        assert told(tune_many(rows, processes, chunk=7)) == here


@pytest.mark.parametrize("pool", [pool, partial(Processes, 1)])
def test_a_row_that_ends_its_process_is_refused_alone(pool):
    rows = [{"tag": f"L{i}", **ROW} for i in range(30)]
    rows[12]["tag"] = "deadly"
    with pool() as processes:
        results = list(tune_many(rows, processes, chunk=5, tune=ends_its_process))
    assert [result.row for result in results] == rows
    assert [result.tag for result in results if result.refusal] == ["deadly"]
    assert "process ended" in results[12].refusal


@pytest.mark.parametrize("pool", [pool, partial(Processes, 1)])
def test_a_worker_that_is_killed_loses_no_row(tmp_path, pool):
    rows = [{"tag": f"L{i}", **ROW} for i in range(30)]
    rows[17]["kill"] = str(tmp_path / "killed")
    with pool() as processes:
        results = list(tune_many(rows, processes, chunk=5, tune=killed_once))
    assert (tmp_path / "killed").exists()
    assert [result.row for result in results] == rows
    assert not any(result.refusal for result in results)


@pytest.mark.parametrize("pool", [pool, partial(Processes, 1)])
def test_a_row_that_hangs_is_refused_alone(pool, monkeypatch):
    """And the pool can be left afterwards."""
    monkeypatch.setattr(run, "LONGEST", 1.0)
    rows = [{"tag": f"L{i}"} for i in range(20)]
    rows[7]["tag"] = "endless"
    with pool() as processes:
        results = list(tune_many(rows, processes, chunk=5, tune=hangs))
    assert [result.row for result in results] == rows
    assert [result.tag for result in results if result.refusal] == ["endless"]
    assert results[7].refusal == "it took longer than 1.25 s and was ended"


@pytest.mark.parametrize("executor", [None, Client()])
def test_a_chunk_that_fails_is_done_row_by_row(executor):
    rows = [{"tag": f"L{i}", **ROW} for i in range(6)]
    results = list(tune_many(rows, executor, chunk=3, tune=fails_together))
    assert [result.tag for result in results] == [row["tag"] for row in rows]
    assert not any(result.refusal for result in results)


def test_rows_are_read_as_they_are_asked_for():
    """An endless list, and the first results of it."""
    endless = ({"tag": str(i), **ROW} for i in count())
    assert [result.tag for result in islice(tune_many(endless, Client(), chunk=2), 3)] == ["0", "1", "2"]


def test_an_executor_that_is_none():
    with pytest.raises(WrongType, match="submit or map"):
        tune_many([], executor=3)


@pytest.mark.parametrize("chunk", [0, -3, 1001, 2.5])
def test_a_chunk_out_of_bounds_is_refused_and_loses_no_row(chunk):
    with pytest.raises(InvalidParameter, match="chunk"):
        tune_many([ROW], chunk=chunk)


@pytest.mark.parametrize("executor", [None, Client(), Mapper()])
def test_a_fault_of_a_tune_is_told_as_one(executor):
    (result,) = tune_many([ROW], executor, tune=divides_by_zero)
    assert result.refusal == "a fault of this program, not of the row: ZeroDivisionError: division by zero"
