"""Rows in chunks, here or by somebody's workers: order kept, bounded numbers of rows on their way, none lost.

A chunk that fails, because its process is gone, is done again row by row in a process of its own, so that only the row
that ends its process is refused.
"""

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor
from itertools import islice
from typing import Any

from simc_core.errors import WrongType
from simc_core.many.processes import Processes
from simc_core.many.result import Result, refused
from simc_core.many.tune_rows import tune_chunk
from simc_core.many.worker import Worker, WorkerGone

ROWS = 1000  # of a chunk: a second; with fewer, too few loops have the same structure
ON_THEIR_WAY = 8  # chunks given to workers and not yet fetched

LONGEST = 60.0  # seconds that a row may take when it is alone, the start of its process with it
ATTEMPTS = 2

Row = Mapping[str, Any]
TuneChunk = Callable[[Sequence[Row]], list[Result]]


def tune_many(
    rows: Iterable[Row], executor: Any = None, chunk: int = ROWS, tune: TuneChunk = tune_chunk
) -> Iterator[Result]:
    """Many loops tuned, judged and compared with their present settings, one result a row, in the order of the rows.

    Parameters
    ----------
    rows : iterable of mappings
        As of `tune_row`. Read as far as results are asked for, and a bounded number of chunks ahead.
    executor : None, ProcessPoolExecutor, dask.distributed.Client or whatever has `submit` or `map`
        Who does the work; None: this process. A pool that breaks is replaced by one of our own.
    chunk : int
        Rows that are worked on together.
    tune : callable
        What is done with a chunk: `tune_chunk`, or a function of one's own that can be pickled.

    Returns
    -------
    iterator of Result
        As of `tune_row`. A row that fails is a Result with a refusal.

    Raises
    ------
    WrongType
        `executor` has neither `submit` nor `map`.

    References
    ----------
    [SK03]

    Examples
    --------
    >>> from simc_core import tune_many
    >>> rows = [{"tag": "A", "k": 1, "theta": 1, "tau1": 8}, {"tag": "B", "k": "two", "theta": 1, "tau1": 8}]
    >>> [(result.tag, result.controller is None) for result in tune_many(rows)]
    [('A', False), ('B', True)]
    """
    chunks = _chunks(rows, chunk)
    if executor is None:
        return _flat(_here(tune, each) for each in chunks)
    if hasattr(executor, "submit"):
        return _submitted(chunks, executor, tune)
    if hasattr(executor, "map"):
        return _flat(executor.map(tune, chunks))
    raise WrongType(f"executor must have submit or map, found {type(executor).__name__}")


def _chunks(rows: Iterable[Row], size: int) -> Iterator[list[Row]]:
    left = iter(rows)
    while some := list(islice(left, size)):
        yield some


def _flat(chunks: Iterable[list[Result]]) -> Iterator[Result]:
    for each in chunks:
        yield from each


def _here(tune: TuneChunk, rows: list[Row]) -> list[Result]:
    """A chunk in this process; what fails as a whole is done row by row."""
    try:
        return tune(rows)
    except Exception:
        return [_one(tune, row) for row in rows]


def _one(tune: TuneChunk, row: Row) -> Result:
    try:
        return tune([row])[0]
    except Exception as error:
        return refused(row, error)


def _submitted(chunks: Iterator[list[Row]], executor: Any, tune: TuneChunk) -> Iterator[Result]:
    """Chunks by an executor with `submit`, results in order."""
    own: Processes | None = None
    alone = Worker()
    waiting: deque[tuple[list[Row], Any]] = deque()
    try:
        for rows in chunks:
            try:
                future = (own or executor).submit(tune, rows)
            except BrokenExecutor:
                own = Processes(_workers(executor))
                future = own.submit(tune, rows)
            waiting.append((rows, future))
            if len(waiting) >= ON_THEIR_WAY:
                yield from _fetched(*waiting.popleft(), tune, alone)
        while waiting:
            yield from _fetched(*waiting.popleft(), tune, alone)
    finally:
        for _, future in waiting:
            future.cancel()
        alone.end()
        if own is not None:
            own.shutdown()


def _workers(executor: Any) -> int:
    """As many as the executor that is replaced, where it tells."""
    return getattr(executor, "_max_workers", None) or os.cpu_count() or 1


def _fetched(rows: list[Row], future: Any, tune: TuneChunk, alone: Worker) -> list[Result]:
    try:
        return future.result()
    except Exception:  # a process that is gone, or whatever else the executor makes of it
        return [_alone(row, tune, alone) for row in rows]


def _alone(row: Row, tune: TuneChunk, worker: Worker) -> Result:
    """A row in a process of its own; a refusal where that ends every time: once it may have been ended from outside."""
    for _ in range(ATTEMPTS):
        try:
            return worker.call(tune, [row], LONGEST)[0]
        except WorkerGone:
            continue
        except Exception as error:
            return refused(row, error)
    return refused(row, f"its process ended without an answer within {LONGEST:g} s, {ATTEMPTS} times")
