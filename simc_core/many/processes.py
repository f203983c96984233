"""Processes of one's own behind `submit`, as tune_many wants it; one that ends is replaced."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from threading import local
from typing import Any

from simc_core.many.worker import Worker


class Processes:
    """n processes, each driven by a thread that waits for it.   nice: as of Worker."""

    def __init__(self, n: int, nice: int = 0):
        self._nice, self._max_workers = nice, n  # the second as a ProcessPoolExecutor has it
        self._threads = ThreadPoolExecutor(n)
        self._own = local()
        self._workers: list[Worker] = []

    def __enter__(self) -> "Processes":
        return self

    def __exit__(self, *_: object) -> None:
        self.shutdown()

    def submit(self, function: Callable[[Any], Any], argument: Any, longest: float | None = None) -> "Future[Any]":
        """function(argument), in one of the processes; one that takes longer than so many seconds is ended."""
        return self._threads.submit(self._call, function, argument, longest)

    def shutdown(self) -> None:
        """End all processes, whatever they are at."""
        self._threads.shutdown(wait=False, cancel_futures=True)
        for worker in list(self._workers):
            worker.end()
        self._threads.shutdown()

    def _call(self, function: Callable[[Any], Any], argument: Any, longest: float | None) -> Any:
        if not hasattr(self._own, "worker"):
            self._own.worker = Worker(self._nice)
            self._workers.append(self._own.worker)
        return self._own.worker.call(function, argument, longest)
