"""Settings of all tests."""

import os
import sys

from hypothesis import settings

# Before numpy is loaded: on a busy machine threads of the linear algebra wait for each other, forty times as long.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# What is compiled is kept, where the environment (of a container, often) forbids it too: dozens of processes that tests
# start, and each worker, would compile all that they import again, which takes longer than the import.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False
# the machine is shared: how long one example takes says nothing about the program
settings.register_profile("shared machine", deadline=None)
settings.load_profile("shared machine")
