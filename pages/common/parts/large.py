"""A figure for the last row of a lecture hall: all its letters at one size."""

from typing import Any

from simc_core.figures import Figure

LETTERS = 28  # px, about 10 minutes of arc from the last row on a screen of 1920 x 1080
HEIGHT = 620  # px at the least: on a screen of 1366 x 768 it is in sight whole
WIDER = 1.8  # lines


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
