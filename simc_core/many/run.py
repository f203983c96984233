"""Rows in chunks, here or by somebody's workers: order kept, bounded numbers of rows on their way, none lost.

A chunk that fails, because its process is gone or takes too long, is done again row by row in a process of its own, so
that only the row that ends its process, or hangs in it, is refused. A pool with a process that hangs is ended, and
replaced as one that is broken.
"""

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from functools import partial
from itertools import islice
from typing import Any

from simc_core import checks
from simc_core.errors import WrongType
from simc_core.many.processes import Processes
from simc_core.many.result import Result, refused
from simc_core.many.tune_rows import MOST_ROWS, tune_chunk
from simc_core.many.worker import TookTooLong, Worker, WorkerGone
from simc_core.wording import said

ON_THEIR_WAY = 8  # chunks given to workers and not yet fetched, at least; two a worker where there are more

LONGEST = 60.0  # seconds that a row may take when it is alone; of a chunk one row may, and
A_ROW = 0.25  # each further one so many, `weight` times that where a tune of one's own says so
ATTEMPTS = 2

Row = Mapping[str, Any]
TuneChunk = Callable[[Sequence[Row]], list[Result]]


def tune_many(
    rows: Iterable[Row], executor: Any = None, chunk: int = MOST_ROWS, tune: TuneChunk = tune_chunk
) -> Iterator[Result]:
    """Many loops tuned, judged and compared with their present settings, one result a row, in the order of the rows.

    Parameters
    ----------
    rows : iterable of mappings
        As of `tune_row`. Read as far as results are asked for, and a bounded number of chunks ahead.
    executor : None, ProcessPoolExecutor, dask.distributed.Client or whatever has `submit` or `map`
        Who does the work; None: this process. A pool that breaks is replaced by one of our own.
    chunk : int
        Rows that are worked on together, 1 to 1000.
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
    InvalidParameter
        `chunk` is out of its bounds.

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
    chunks = _chunks(rows, checks.whole("chunk", chunk, 1, MOST_ROWS))
    if executor is None:
        return _flat(_here(tune, each) for each in chunks)
    if hasattr(executor, "submit"):
        return _submitted(chunks, executor, tune)
    if hasattr(executor, "map"):
        return _flat(executor.map(partial(_here, tune), chunks))
    raise WrongType(said("executor must have submit or map, found {what}", what=type(executor).__name__))


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
    most = max(ON_THEIR_WAY, 2 * _workers(executor))
    try:
        for rows in chunks:
            try:
                future = _submit(own or executor, tune, rows)
            except BrokenExecutor:
                own = Processes(_workers(executor))
                future = _submit(own, tune, rows)
            waiting.append((rows, future))
            if len(waiting) >= most:
                yield from _fetched(*waiting.popleft(), tune, alone, executor)
        while waiting:
            yield from _fetched(*waiting.popleft(), tune, alone, executor)
    finally:
        for _, future in waiting:
            future.cancel()
        alone.end()
        if own is not None:
            own.shutdown()


def _workers(executor: Any) -> int:
    """Of the executor, where it tells."""
    if hasattr(executor, "ncores"):  # a Dask client: by the addresses of its workers
        return max(sum(executor.ncores().values()), 1)
    return getattr(executor, "_max_workers", None) or os.cpu_count() or 1


def _submit(executor: Any, tune: TuneChunk, rows: list[Row]) -> Any:
    if isinstance(executor, Processes):  # which end what takes too long
        return executor.submit(tune, rows, _longest(tune, rows))
    return executor.submit(tune, rows)


def _longest(tune: TuneChunk, rows: Sequence[Row]) -> float:
    """Seconds that a chunk may take."""
    return LONGEST + A_ROW * len(rows) * getattr(tune, "weight", 1.0)


def _fetched(rows: list[Row], future: Any, tune: TuneChunk, alone: Worker, executor: Any) -> list[Result]:
    try:
        # chunks are fetched in the order in which they were given: this one is being worked on, or next
        return future.result(None if isinstance(executor, Processes) else _longest(tune, rows))
    except TimeoutError:
        _end(executor)
    except Exception:  # a process that is gone, or whatever else the executor makes of it
        pass
    return [_alone(row, tune, alone) for row in rows]


def _end(executor: Any) -> None:
    """End the processes of a pool, one of which hangs: nothing else ends them, not even the end of the program."""
    if isinstance(executor, ProcessPoolExecutor):
        for process in list((executor._processes or {}).values()):
            process.kill()


def _alone(row: Row, tune: TuneChunk, worker: Worker) -> Result:
    """A row in a process of its own; a refusal where that ends every time: once it may have been ended from outside."""
    longest = _longest(tune, [row])
    for _ in range(ATTEMPTS):
        try:
            return worker.call(tune, [row], longest)[0]
        except TookTooLong:
            return refused(row, f"it took longer than {longest:g} s and was ended")
        except WorkerGone:
            continue
        except Exception as error:
            return refused(row, error)
    return refused(row, f"its process ended without an answer, {ATTEMPTS} times")
