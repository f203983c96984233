"""A process of one's own that does one thing at a time, and may end, or be ended, without taking anything along.

Not multiprocessing: that runs the main script again in the new process, which in a web server is a page.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from threading import Event, Timer
from typing import Any

from simc_core.wording import said

READY = b"ready"  # said once, when everything is loaded


class WorkerGone(Exception):
    """The process ended without an answer."""


class TookTooLong(WorkerGone):
    """It took longer than it may, and was ended."""


class WorkFailed(Exception):
    """What was done there has raised: the name of the error, and what it says."""


class Worker:
    """The process is started when it is first needed, and anew when it has ended.

    nice: by how much it gives way to others that want the processor, 0 to 19.
    """

    def __init__(self, nice: int = 0) -> None:
        self._nice = nice
        self._process: subprocess.Popen[bytes] | None = None

    def call(self, function: Callable[[Any], Any], argument: Any, longest: float | None = None) -> Any:
        """function(argument), done there; both must be such as can be pickled.

        longest: seconds, the start of the process apart.   Raises WorkerGone, and WorkFailed with what the function
        has raised.
        """
        question = pickle.dumps((function, argument))
        process = self._begin()
        assert process.stdin is not None
        assert process.stdout is not None
        timer, over = None, Event()
        if longest is not None:

            def end() -> None:
                over.set()
                process.kill()

            timer = Timer(longest, end)
            timer.start()
        try:
            process.stdin.write(question)
            process.stdin.flush()
            good, answer = pickle.load(process.stdout)
        except (EOFError, OSError, pickle.UnpicklingError) as error:
            self.end()
            raise (TookTooLong if over.is_set() else WorkerGone)(said("its process ended without an answer")) from error
        finally:
            if timer is not None:
                timer.cancel()
        if not good:
            raise WorkFailed(answer)
        return answer

    def end(self) -> None:
        """End the process, if there is one."""
        if self._process is not None:
            self._process.kill()
            self._process.communicate()
        self._process = None

    def _begin(self) -> "subprocess.Popen[bytes]":
        if self._process is None:
            paths = os.pathsep.join(path or os.getcwd() for path in sys.path)
            self._process = subprocess.Popen(
                [sys.executable, "-c", f"from {__name__} import work; work({self._nice})"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                env=os.environ | {"PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1"},
            )
            assert self._process.stdout is not None
            self._process.stdout.read(len(READY))
        return self._process


def work(nice: int = 0) -> None:
    """What the process does: functions and arguments in, answers out, until nobody asks."""
    if nice and hasattr(os, "nice"):
        os.nice(nice)
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what anything prints must not stand between answers
    answers.write(READY)
    answers.flush()
    while True:
        try:
            function, argument = pickle.load(sys.stdin.buffer)
            answer = pickle.dumps((True, function(argument)))
        except EOFError:
            return
        except Exception as error:
            answer = pickle.dumps((False, f"{type(error).__name__}: {error}"))
        answers.write(answer)
        answers.flush()
