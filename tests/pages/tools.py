"""Running the app and single pages without a browser."""

import json
from pathlib import Path

from streamlit.testing.v1 import AppTest

ROOT = Path(__file__).parents[2]


def run_app(**parameters: str) -> AppTest:
    """The whole app, from its router, with query parameters."""
    return _run(ROOT / "pages" / "common" / "shell" / "router.py", parameters)


def run_page(name: str, view: str = "", tabs: str = "views", **parameters: str) -> AppTest:
    """One page alone, without the router. view: the tab of `tabs` that is open, where a page makes that one only."""
    return _run(ROOT / "pages" / f"{name}.py", parameters, view, tabs)


def _run(script: Path, parameters: dict[str, str], view: str = "", tabs: str = "views") -> AppTest:
    app = AppTest.from_file(str(script), default_timeout=30)
    if (tabs, view) == ("views", "Figures"):
        parameters = parameters | {"view": "figures"}  # as former links had it
    elif view:
        app.session_state[tabs] = view
    app.query_params.update(parameters)
    app.run()
    assert not app.exception, app.exception
    return app


def unfold(app: AppTest, *keys: str) -> AppTest:
    """Open what stands folded on a page: expanders and popovers by their keys, as a click on each does."""
    for key in keys:
        app.session_state[key] = True
        app.run()
        assert not app.exception, app.exception
    return app


def fold(app: AppTest, key: str) -> AppTest:
    """And close it."""
    app.session_state[key] = False
    return app.run()


def address(app: AppTest) -> dict[str, str]:
    """The query parameters, each with its one value."""
    return {name: value[0] if isinstance(value, list) else value for name, value in app.query_params.items()}


def copyables(app: AppTest) -> list[str]:
    """The texts that have a button to copy them: the address, settings of controllers."""
    found = [item.proto for item in app.get("bidi_component") if item.proto.component_name == "simc_copyable"]
    return [json.loads(proto.json)["text"] for proto in found]


def texts(app: AppTest) -> str:
    """All markdown, captions, warnings and errors, one after the other."""
    return "\n".join(item.value for kind in ("markdown", "caption", "warning", "error") for item in app.get(kind))
