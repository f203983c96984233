"""Rows one at a time in a process of their own, which may end, or take too long, without taking others along."""

from collections.abc import Callable, Mapping, Sequence
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import Any

from simc_core.many.result import Result, refused

LONGEST = 30.0  # seconds that a row may take when it is alone
START = 60.0  # and those in which a process must have begun
ATTEMPTS = 2  # a process may have been ended from outside


class Alone:
    """A process that is started when it is first needed, and anew when it has ended."""

    def __init__(self, tune: Callable[[Sequence[Mapping[str, Any]]], list[Result]]):
        self.tune = tune
        self._process: Any = None
        self._pipe: Connection | None = None

    def __enter__(self) -> "Alone":
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    def result(self, row: Mapping[str, Any]) -> Result:
        """The row's result; a refusal where its process ends twice, or takes longer than LONGEST."""
        for _ in range(ATTEMPTS):
            pipe = self._begin()
            try:
                pipe.send(row)
                if not pipe.poll(LONGEST):
                    self._end()
                    return refused(row, f"the row must take at most {LONGEST:g} s, and took longer")
                return pipe.recv()
            except (EOFError, OSError):
                self._end()
            except Exception as error:  # the row, or its result, cannot be sent
                self._end()
                return refused(row, error)
        return refused(row, f"its process ended without an answer, {ATTEMPTS} times")

    def _begin(self) -> Connection:
        if self._pipe is None:
            context = get_context("spawn")
            self._pipe, theirs = context.Pipe()
            self._process = context.Process(target=_work, args=(theirs, self.tune), daemon=True)
            self._process.start()
            theirs.close()
            if self._pipe.poll(START):
                self._pipe.recv()
        return self._pipe

    def _end(self) -> None:
        if self._pipe is not None:
            self._pipe.close()
            self._process.terminate()
            self._process.join()
        self._pipe = None


def _work(pipe: Connection, tune: Callable[[Sequence[Mapping[str, Any]]], list[Result]]) -> None:
    """What the process does: rows in, results out, until nobody listens."""
    pipe.send(None)  # it has begun
    try:
        while True:
            row = pipe.recv()
            try:
                found = tune([row])[0]
            except Exception as error:
                found = refused(row, error)
            pipe.send(found)
    except (EOFError, OSError):
        return
