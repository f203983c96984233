"""A process of one's own that does one thing at a time, and may end, or be ended, without taking anything along.

Not multiprocessing: that runs the main script again in the new process, which in a web server is a page.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from threading import Timer
from typing import Any


class WorkerGone(Exception):
    """The process ended without an answer, or took too long and was ended."""


class Worker:
    """The process is started when it is first needed, and anew when it has ended."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None

    def call(self, function: Callable[[Any], Any], argument: Any, longest: float | None = None) -> Any:
        """function(argument), done there; both must be such as can be pickled.

        longest: seconds.   Raises WorkerGone, and RuntimeError with what the function has raised.
        """
        question = pickle.dumps((function, argument))
        process = self._begin()
        assert process.stdin is not None
        assert process.stdout is not None
        timer = None if longest is None else Timer(longest, process.kill)
        if timer is not None:
            timer.start()
        try:
            process.stdin.write(question)
            process.stdin.flush()
            good, answer = pickle.load(process.stdout)
        except (EOFError, OSError, pickle.UnpicklingError) as error:
            self.end()
            raise WorkerGone("its process ended without an answer") from error
        finally:
            if timer is not None:
                timer.cancel()
        if not good:
            raise RuntimeError(answer)
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
                [sys.executable, "-c", f"from {__name__} import work; work()"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                env=os.environ | {"PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1"},
            )
        return self._process


def work() -> None:
    """What the process does: functions and arguments in, answers out, until nobody asks."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what anything prints must not stand between answers
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
