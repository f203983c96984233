"""A list being tuned in a process of its own, while pages go on. Pure: no streamlit.

One list of the whole server at a time, which gives way to everything else on the machine: others wait for their turn,
so that sliders of other visitors stay fast.
"""

import logging
from collections.abc import Sequence
from threading import Event, Lock, Thread

from simc_core import Result, tune_many
from simc_core.many.processes import Processes
from simc_core.many.report import report
from simc_core.many.results_csv import as_csv, cells
from simc_core.many.run import Row

CHUNK = 200  # rows between two looks at the progress
NICE = 15  # a slider that somebody moves goes before
TURN = Lock()


def files(given: tuple[Sequence[Result], str]) -> tuple[str, str]:
    """results.csv and report.html of results, and of the name of their list."""
    results, name = given
    return as_csv(results), report(map(cells, results), f"Many loops: {name}")


class Job:
    """A list on its way. results: those that are there, in order.   files: made of them at the end.

    state: "waiting" for its turn, "running", "done", "stopped", or "failed" for a fault of this program.
    """

    def __init__(self, rows: Sequence[Row], name: str):
        self.rows, self.name = rows, name
        self.files: tuple[str, str] | None = None
        self.results: list[Result] = []
        self.state = "waiting"
        self._stop = Event()
        Thread(target=self._run, daemon=True, name="many loops").start()

    @property
    def going(self) -> bool:
        """Whether there is more to come."""
        return self.state in ("waiting", "running")

    def stop(self) -> None:
        """End it; what is there stays."""
        self._stop.set()

    def _run(self) -> None:
        while not TURN.acquire(timeout=0.2):
            if self._stop.is_set():
                self.state = "stopped"
                return
        try:
            self.state = "running"
            with Processes(1, NICE) as processes:
                for result in tune_many(self.rows, processes, CHUNK):
                    self.results.append(result)
                    if self._stop.is_set():
                        break
                self.files = processes.submit(files, (self.results, self.name)).result()
            self.state = "done" if len(self.results) == len(self.rows) else "stopped"
        except Exception:
            logging.getLogger(__name__).exception("a list of loops was not tuned")
            self.state = "failed"
        finally:
            TURN.release()
