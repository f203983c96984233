"""A bar of progress stands there for those who wait longer than a moment, and for nobody else."""

from itertools import count

import pytest
from streamlit.testing.v1 import AppTest

from pages.common.parts import in_sight

SCRIPT = """
import streamlit as st
from pages.common.parts.in_sight import in_sight
for part in in_sight(["a", "b", "c", "d"], "Working"):
    st.write(part)
    if part == "{last}":
        st.stop()
"""


@pytest.mark.parametrize(("step", "last", "shown"), [(1.0, "c", ["Working: 2 of 4"]), (0.1, "c", []), (1.0, "z", [])])
def test_the_bar(monkeypatch, step, last, shown):
    clock = count(0.0, step)
    monkeypatch.setattr(in_sight, "monotonic", lambda: next(clock))
    app = AppTest.from_string(SCRIPT.format(last=last)).run()
    assert not app.exception
    assert [bar.proto.text for bar in app.get("progress")] == shown
