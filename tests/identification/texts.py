"""The trend that the tests of reading write as text: told by hand beside it, never by the reader itself."""

import numpy as np
import pytest

TIMES = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
PV = [20.5, 20.25, 20.5, 20.5, 21.75, 22.5, 23.25, 23.5]
OP = [30.0, 30.0, 42.5, 42.5, 42.5, 42.5, 42.5, 42.5]
SP = [20.0] * 4 + [25.0] * 4


def rows(times=TIMES, separator="\t", decimal=".", series=(PV, OP)):
    def text(value) -> str:
        return value if isinstance(value, str) else str(value).replace(".", decimal)

    return "\n".join(separator.join([text(t), *(text(each[i]) for each in series)]) for i, t in enumerate(times)) + "\n"


def check(trend, times=TIMES, pv=PV, op=OP):
    """The very numbers of the file."""
    assert trend.t.tolist() == pytest.approx(times, abs=1e-6)
    assert trend.y.tolist() == pv
    held = trend.u[np.maximum(np.searchsorted(trend.instants_of_u, trend.t, "right") - 1, 0)]
    assert held.tolist() == op
