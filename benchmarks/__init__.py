"""Scripts that print ratios; never part of the test run."""

import os

# Before numpy is loaded: threads of the linear algebra would wait for each other on the one core that is measured.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
