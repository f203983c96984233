"""Figures and tables for the last row of a lecture hall: all letters at one size, and room for them."""

from typing import Any

from pages.common.session.lecture import lecturing
from simc_core.figures import Figure

LETTERS = 28  # px, about 10 minutes of arc from the last row on a screen of 1920 x 1080
USUAL = 16  # px, of a page
HEIGHT = 620  # px at the least: on a screen of 1366 x 768 it is in sight whole
WIDER = 1.8  # lines


def roomy(size: int) -> int:
    """px of a table or field, which grow with the letters while this page is a lecture."""
    return round(size * LETTERS / USUAL) if lecturing() else size


def large(figure: Figure) -> Figure:
    """The same figure with letters of 28 px and wide lines; what came is left as it was."""
    layout = dict(figure["layout"])
    for name, part in layout.items():
        if name[1:5] == "axis":
            layout[name] = _axis(part)
    layout["legend"] = layout.get("legend", {}) | {"font": {"size": LETTERS}}
    layout["font"] = layout.get("font", {}) | {"size": LETTERS}
    layout["annotations"] = [_lettered(each, "font") for each in layout.get("annotations", ())]
    layout["height"] = max(HEIGHT, layout.get("height") or 0)
    return {**figure, "layout": layout, "data": [_trace(trace) for trace in figure["data"]]}


def _axis(axis: dict[str, Any]) -> dict[str, Any]:
    titled = {"title": _lettered(axis["title"], "font")} if isinstance(axis.get("title"), dict) else {}
    return axis | titled | {"tickfont": {"size": LETTERS}}


def _trace(trace: dict[str, Any]) -> dict[str, Any]:
    wider = {"line": trace["line"] | {"width": WIDER * trace["line"].get("width", 2.0)}} if "line" in trace else {}
    return _lettered(trace, "textfont") | wider


def _lettered(part: dict[str, Any], name: str) -> dict[str, Any]:
    return part | {name: part.get(name, {}) | {"size": LETTERS}}
