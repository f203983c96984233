"""Settings of all tests."""

import os

from hypothesis import settings

# Before numpy is loaded: on a busy machine threads of the linear algebra wait for each other, forty times as long.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# the machine is shared: how long one example takes says nothing about the program
settings.register_profile("shared machine", deadline=None)
settings.load_profile("shared machine")
