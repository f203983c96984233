"""What a figure shows, in words with numbers, for those who do not see it: the ends, the highest and lowest points."""

import math
from typing import Any

import numpy as np

from pages.common.words import number, translated, words
from simc_core.figures import Figure
from simc_core.wording import said

MOST = 8  # curves or groups of points that are told
MOST_POINTS = 4  # of one group
DIGITS = 3
HIGHEST = said("highest {y} at {across} {x}", y="", across="", x="")
LOWEST = said("lowest {y} at {across} {x}", y="", across="", x="")


def in_words(title: str, figure: Figure) -> str:
    """The title, then a sentence a curve: where it begins, its highest and lowest point, where it ends.

    A curve that is no function, such as Nyquist's, has its ranges told. What has no name is an aid to the eye.
    """
    traces = [trace for trace in figure["data"] if trace.get("name") and trace.get("visible") != "legendonly"]
    traces = [trace for trace in traces if trace.get("hoverinfo") != "skip"] or traces
    names = [trace["name"] for trace in traces]
    told = [each for trace in traces if (each := _trace(trace, figure["layout"], names.count(trace["name"]) > 1))]
    more = words("and {n} more", n=len(told) - MOST) if len(told) > MOST else ""
    return ". ".join([title, *told[:MOST], *([more] if more else [])]) + "."


def _trace(trace: dict[str, Any], layout: dict[str, Any], again: bool) -> str:
    """again: another curve has the same name, so its axis is told too."""
    name, kind = trace["name"], trace.get("type", "scatter")
    if kind == "bar":
        return f"{name}: {', '.join(map(str, list(trace.get('text', ()))[:MOST]))}"
    if kind != "scatter":
        return ""
    x, y = (np.asarray(trace.get(side, ())) for side in "xy")
    if not len(x) or len(x) != len(y):
        return ""
    across, up = (_axis(layout, trace.get(f"{side}axis", side)) for side in "xy")
    if "lines" not in trace.get("mode", "lines"):
        points = [f"{_text(a)}, {_text(b)}" for a, b in zip(x, y, strict=True)][:MOST_POINTS]
        return (
            words("{name}: {n} points", name=name, n=len(x))
            if len(x) > MOST_POINTS
            else words("{name} at {points}", name=name, points=words(" and at ").join(points))
        )
    try:
        return f"{name}{f', {up}' if again else ''}: {_curve(x.astype(float), y.astype(float), across, up)}"
    except (TypeError, ValueError):  # dates or words on an axis
        return ""


def _curve(x: np.ndarray, y: np.ndarray, across: str, up: str) -> str:
    known = np.isfinite(x) & np.isfinite(y)
    x, y = x[known], y[known]
    if not len(x):
        return words("nothing")
    if np.any(np.diff(x) < 0) and np.any(np.diff(x) > 0):
        return words(
            "{across} from {left} to {right}, {up} from {low} to {high}",
            across=across,
            left=_text(x.min()),
            right=_text(x.max()),
            up=up,
            low=_text(y.min()),
            high=_text(y.max()),
        )
    if y.max() == y.min():
        return words("{y} throughout", y=_text(y[0]))
    high, low = int(np.argmax(y)), int(np.argmin(y))
    inner = [
        translated(told.put(y=_text(y[at]), across=across, x=_text(x[at])))
        for told, at in ((HIGHEST, high), (LOWEST, low))
        if y[at] not in (y[0], y[-1])
    ]
    return ", ".join(
        [
            words("from {y} at {across} {x}", y=_text(y[0]), across=across, x=_text(x[0])),
            *inner,
            words("to {y} at {across} {x}", y=_text(y[-1]), across=across, x=_text(x[-1])),
        ]
    )


def _axis(layout: dict[str, Any], name: str) -> str:
    """The name of an axis, its unit left out."""
    title = layout.get(f"{name[0]}axis{name[1:]}", {}).get("title", {}).get("text", "")
    return title.split("  [")[0].strip() or name[0]


def _text(value: object) -> str:
    if isinstance(value, int | float | np.number):
        return number(float(value), DIGITS) if math.isfinite(float(value)) else words("infinite")
    return str(value)
