"""One palette, one set of dashes, one way to write an axis, for every figure of the program.

A figure is a plain dict in plotly's JSON schema, {"data": [...], "layout": {...}}: twenty times cheaper to make than
a go.Figure, and `plotly.graph_objects.Figure(figure)` turns it into one. Backgrounds are transparent and lines
are mid-tones, so that a figure reads well on a light page and on a dark one; text takes the colour of the theme.
Colours are those of Okabe and Ito, safe for colour-blind eyes, and never stand alone: a dash or a label says the same.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

Figure = dict[str, Any]
Trace = dict[str, Any]

Y = "#0072B2"  # output, and T = y/r
U = "#D55E00"  # input
R = "#8A9096"  # set point
D = "#CC79A7"  # disturbance
REDUCED = "#009E73"  # reduced model
INNER = "#009E73"  # inner loop of a cascade, where no reduced model is drawn
S = "#C77C00"  # sensitivity, its peak Ms and the circle of it
NEUTRAL = "#8A9096"  # axes through zero, reference lines, the point -1
GRID = "rgba(138,144,150,0.22)"

# Designs set aside, first pinned first: lighter shades of the hue, and a dash of their own.
PIN_DASHES = ("dash", "dot", "dashdot", "longdash")
PIN_SHADES = {
    Y: ("#4C9FD0", "#6FB3DB", "#8CC3E3", "#A5D0EA"),
    U: ("#E68A4A", "#ECA06C", "#F0B38A", "#F4C4A4"),
    S: ("#D99A3A", "#E0AC5C", "#E7BE80", "#EDCEA0"),
    INNER: ("#45B898", "#6AC6AD", "#8AD2BE", "#A6DDCD"),
}

# The loops of a cascade: index, colour, dash.
LOOPS = (("a", Y, "solid"), ("b", INNER, "dash"))

FULL_AND_REDUCED = ((Y, "solid", 2.2), (REDUCED, "dash", 2.0))

CALM, ATTENTION, ALARM = "#009E73", "#C77C00", "#C8442E"

TIME = "t  [time unit]"
FREQUENCY = "ω  [rad/time unit]"


def config(name: str) -> dict[str, Any]:
    """Settings of plotly's mode bar: zoom, pan, reset, and an SVG export under `name`."""
    return {
        "displaylogo": False,
        "toImageButtonOptions": {"format": "svg", "filename": name},
        "modeBarButtonsToRemove": ["select2d", "lasso2d", "zoomIn2d", "zoomOut2d"],
        "doubleClick": "reset",
    }


def line(x, y, name: str, color: str, dash: str = "solid", width: float = 2.0, **more) -> Trace:
    """A curve through every one of its points: simplification would put kinks in it."""
    return {
        "type": "scatter",
        "mode": "lines",
        "x": np.asarray(x),
        "y": np.asarray(y),
        "name": name,
        "line": {"color": color, "dash": dash, "width": width, "simplify": False},
    } | more


def marker(x: float, y: float, label: str, color: str, name: str, position: str = "top right", **more) -> Trace:
    """One point with its label beside it."""
    return {
        "type": "scatter",
        "mode": "markers+text",
        "x": [x],
        "y": [y],
        "text": [label],
        "textposition": position,
        "name": name,
        "marker": {"color": color, "size": 8},
        "cliponaxis": False,
        "showlegend": False,
    } | more


def shade(color: str, position: int) -> tuple[str, str, float]:
    """Colour, dash and width of the design at `position`: 0 is the present one, 1 to 4 are pinned."""
    if position == 0:
        return color, "solid", 2.2
    return PIN_SHADES[color][position - 1], PIN_DASHES[position - 1], 1.6


def axis(title: str, **more) -> dict[str, Any]:
    """A linear axis with name and unit."""
    return {
        "title": {"text": title, "standoff": 14, "font": {"size": 12}},
        "gridcolor": GRID,
        "zerolinecolor": GRID,
        "linecolor": NEUTRAL,
        "tickfont": {"size": 11},
        "ticks": "outside",
        "ticklen": 3,
        "automargin": True,
        "zeroline": False,
    } | more


def log_axis(title: str, **more) -> dict[str, Any]:
    """A logarithmic axis, decades as powers of ten."""
    return axis(title, type="log", exponentformat="power", dtick=1) | more


def figure(traces: Sequence[Trace], xaxis: dict, yaxis: dict, height: int | None = None, **layout) -> Figure:
    """The figure dict. height in px, None to fill what the page gives."""
    return {
        "data": list(traces),
        "layout": {
            "xaxis": xaxis,
            "yaxis": yaxis,
            "paper_bgcolor": "rgba(0,0,0,0)",
            "plot_bgcolor": "rgba(0,0,0,0)",
            "margin": {"l": 8, "r": 8, "t": 8, "b": 8},
            "hovermode": "x unified",
            "legend": {
                "orientation": "h",
                "x": 1,
                "xanchor": "right",
                "y": 1,
                "yanchor": "bottom",
                "font": {"size": 11},
                "bgcolor": "rgba(0,0,0,0)",
            },
            "dragmode": "zoom",
        }
        | ({"height": height} if height else {})
        | layout,
    }


def note(text: str, background: str = ALARM) -> dict[str, Any]:
    """A banner across the figure, for what the curves themselves must not be taken for."""
    return {
        "text": f"<b>{text}</b>",
        "xref": "paper",
        "yref": "paper",
        "x": 0.5,
        "y": 0.02,
        "xanchor": "center",
        "yanchor": "bottom",
        "showarrow": False,
        "font": {"size": 12, "color": "white"},
        "bgcolor": background,
        "borderpad": 3,
    }
