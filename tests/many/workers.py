"""What workers do in tests: tune, and die on the way."""

import os
import signal
import time
from pathlib import Path

from simc_core import Result, tune_chunk
from simc_core.errors import InvalidParameter


def ends_its_process(rows):
    """One row ends its process, every time."""
    if any(row.get("tag") == "deadly" for row in rows):
        os._exit(1)
    return tune_chunk(rows)


def killed_once(rows):
    """The first process that comes to the marked row is killed, as the system kills one that needs too much memory."""
    for row in rows:
        if flag := row.get("kill"):
            try:
                Path(flag).touch(exist_ok=False)
            except FileExistsError:
                continue
            os.kill(os.getpid(), signal.SIGKILL)
    return tune_chunk(rows)


def hangs(rows):
    """One row never comes to its end; nothing is tuned."""
    while any(row.get("tag") == "endless" for row in rows):
        time.sleep(1)
    return [Result(row) for row in rows]


def fails_together(rows):
    """A chunk that fails as a whole."""
    if len(rows) > 1:
        raise InvalidParameter("together")
    return tune_chunk(rows)


def divides_by_zero(rows):
    """A fault in the tune itself."""
    return [1 / 0 for _ in rows]
