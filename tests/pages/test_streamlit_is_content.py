"""Links that open a view of a page: Streamlit has no objection to how its widgets are filled."""

from types import SimpleNamespace

import pytest
from streamlit.elements.lib import policies
from streamlit.testing.v1 import AppTest

from tests.pages.tools import ROOT


@pytest.fixture
def objections(monkeypatch, caplog):
    """Streamlit looks only where a server runs, and says it once."""
    monkeypatch.setattr(policies, "runtime", SimpleNamespace(exists=lambda: True))
    monkeypatch.setattr(policies, "_shown_default_value_warning", False)
    return lambda: [text for text in caplog.messages if "default value" in text]


@pytest.mark.parametrize("link", ["rules plane", "tuning figures", "tuning open loop", "take_home", "cascade", "plant"])
def test_no_widget_has_a_default_and_a_value(link, objections):
    page, _, view = link.partition(" ")
    app = AppTest.from_file(str(ROOT / "pages" / f"{page}.py"), default_timeout=30)
    app.query_params.update({"plant": "exp(-s)/(8s+1)"} | ({"view": view} if view else {}))
    app.run().run()
    assert not objections()


def test_the_look_itself_sees_such_a_widget(objections):
    def script():
        import streamlit as st

        st.session_state["x"] = "a"
        st.segmented_control("x", ["a", "b"], default="b", key="x")

    AppTest.from_function(script).run()
    assert objections()
