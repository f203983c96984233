"""One palette, one set of dashes, one way to write an axis, for every figure of the program.

A figure is a plain dict in plotly's JSON schema, {"data": [...], "layout": {...}}: twenty times cheaper to make than
a go.Figure, and `plotly.graph_objects.Figure(figure)` turns it into one. Backgrounds are transparent and lines
are mid-tones, so that a figure reads well on a light page and on a dark one; text takes the colour of the theme.
Colours are those of Okabe and Ito, safe for colour-blind eyes, and never stand alone: a dash or a label says the same.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from simc_core.wording import Numeral, joined, said

Figure = dict[str, Any]
Trace = dict[str, Any]

Y = "#0072B2"  # output, and T = y/r
U = "#D55E00"  # input
R = "#8A9096"  # set point
D = "#CC79A7"  # disturbance
REDUCED = "#009E73"  # reduced model
REDUCED_TAU2 = "#5FBFA0"  # its second lag
INNER = "#009E73"  # inner loop of a cascade, where no reduced model is drawn
S = "#C77C00"  # sensitivity, its peak Ms and the circle of it
NEUTRAL = "#8A9096"  # axes through zero, reference lines, the point -1
GRID = "rgba(138,144,150,0.22)"

# Designs set aside, first pinned first: shades of the hue with 3:1 on the light page and on the dark one, and a dash
# of their own.
PIN_DASHES = ("dash", "dot", "dashdot", "longdash")
PIN_SHADES = {
    Y: ("#4A9BC8", "#0069A4", "#328ABC", "#187AB0"),
    U: ("#DC7A2D", "#A54900", "#CA6A1E", "#B7590F"),
    S: ("#CA840F", "#8D5800", "#B6750A", "#A16705"),
    INNER: ("#18A780", "#007253", "#109671", "#088362"),
}

# The loops of a cascade: index, colour, dash.
LOOPS = (("a", Y, "solid"), ("b", INNER, "dash"))

FULL_AND_REDUCED = ((Y, "solid", 2.2), (REDUCED, "dash", 2.0))

CALM, ATTENTION, ALARM = "#009E73", "#C77C00", "#C8442E"

CHOSEN = ("#0072B2", "#6DB6E4")  # small letters of what is chosen, and the ring round the focus: light page, dark page

CALM_BAND, ALARM_BAND = "rgba(0,158,115,0.14)", "rgba(200,68,46,0.13)"  # behind curves

# Open places of axes and hover texts, which a page fills with the user's own names.
TIME_UNIT = said("time unit")
UNIT_OF_Y, UNIT_OF_U = said("unit of y"), said("unit of u")
FREQUENCY_UNIT = said("[rad/{unit}]", unit=TIME_UNIT)
TIME = said("t  [{unit}]", unit=TIME_UNIT)
FREQUENCY = said("ω  [rad/{unit}]", unit=TIME_UNIT)
OUTPUT, INPUT = said("y  [{unit}]", unit=UNIT_OF_Y), said("u  [{unit}]", unit=UNIT_OF_U)


TICKS = 12  # px, of the numbers on all axes
PLOTLY_POWER = 1.25  # plotly draws powers of ten so much larger than it is told
# px of room around the axes, enough for usual numbers and for one line of a legend. Where it is not, plotly makes more
# and draws the figure a second time.
ROOM = {"l": 68, "r": 8, "t": 16, "b": 61}
LEGEND = 37


def css_variables(selector: str) -> str:
    """A CSS rule that gives the colours to styles and scripts of the pages, as --simc-y, --simc-y-pin-1, ...

    Parameters
    ----------
    selector : str
        Of the elements below which they are known.
    """
    names = {"y": Y, "u": U, "r": R, "d": D, "s": S, "inner": INNER, "grid": GRID}
    names |= {"calm": CALM, "attention": ATTENTION, "alarm": ALARM, "calm-band": CALM_BAND, "alarm-band": ALARM_BAND}
    names["chosen"] = f"light-dark({', '.join(CHOSEN)})"
    for name, hue in (("y", Y), ("u", U), ("s", S), ("inner", INNER)):
        names |= {f"{name}-pin-{i}": shade for i, shade in enumerate(PIN_SHADES[hue], start=1)}
    return f"{selector} {{{' '.join(f'--simc-{name}: {color};' for name, color in names.items())}}}\n"


def config(name: str) -> dict[str, Any]:
    """Settings of plotly's mode bar: zoom, pan, reset, and an SVG export under `name`."""
    return {
        "displaylogo": False,
        "toImageButtonOptions": {"format": "svg", "filename": name},
        "modeBarButtonsToRemove": ["select2d", "lasso2d", "zoomIn2d", "zoomOut2d"],
        "doubleClick": "reset",
    }


def line(
    x: ArrayLike, y: ArrayLike, name: str, color: str, dash: str = "solid", width: float = 2.0, **more: object
) -> Trace:
    """A curve through every one of its points: simplification would put kinks in it."""
    return {
        "type": "scatter",
        "mode": "lines",
        "x": np.asarray(x),
        "y": np.asarray(y),
        "name": name,
        "line": {"color": color, "dash": dash, "width": width, "simplify": False},
    } | more


def marker(x: float, y: float, label: str, color: str, name: str, position: str = "top right", **more: object) -> Trace:
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


def axis(title: str, **more: object) -> dict[str, Any]:
    """A linear axis with name and unit."""
    return {
        "title": {"text": title, "standoff": 14, "font": {"size": 12}},
        "gridcolor": GRID,
        "zerolinecolor": GRID,
        "linecolor": NEUTRAL,
        "tickfont": {"size": TICKS},
        "ticks": "outside",
        "ticklen": 3,
        "automargin": True,
        "zeroline": False,
    } | more


def log_axis(title: str, **more: object) -> dict[str, Any]:
    """A logarithmic axis, decades as powers of ten."""
    return axis(title, type="log", exponentformat="power", dtick=1, tickfont={"size": TICKS / PLOTLY_POWER}) | more


def short_log_axis(title: str, low: float, high: float) -> dict[str, Any]:
    """A logarithmic axis over a few decades: 1, 2, 5 of each, written out; over many only 1."""
    digits = (1, 2, 5) if high / low < 1e3 else (1,)
    exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    ticks = [digit * 10.0**exponent for exponent in exponents for digit in digits]
    shown = [tick for tick in ticks if low <= tick <= high]
    span = [math.log10(low), math.log10(high)]
    return axis(title, type="log", range=span, tickvals=shown, ticktext=[Numeral(f"{tick:g}") for tick in shown])


def _has_legend(traces: Sequence[Trace]) -> bool:
    """Whether plotly shows a legend: for one trace only when that is asked for."""
    named = [trace.get("showlegend") for trace in traces if trace.get("showlegend") is not False]
    return len(named) > 1 or True in named


def figure(traces: Sequence[Trace], xaxis: dict, yaxis: dict, height: int | None = None, **layout: object) -> Figure:
    """The figure dict. height in px, None to fill what the page gives."""
    return {
        "data": list(traces),
        "layout": {
            "xaxis": xaxis,
            "yaxis": yaxis,
            "paper_bgcolor": "rgba(0,0,0,0)",
            "plot_bgcolor": "rgba(0,0,0,0)",
            "margin": ROOM | ({"t": LEGEND} if _has_legend(traces) else {}),
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


def label(text: str, x: float, y: float, above: bool) -> dict[str, Any]:
    """The name of a horizontal line, at its right end."""
    return {
        "text": text,
        "x": x,
        "y": y,
        "xanchor": "right",
        "yanchor": "bottom" if above else "top",
        "showarrow": False,
        "font": {"size": 11},
    }


def note(text: str, background: str = ALARM) -> dict[str, Any]:
    """A banner across the figure, for what the curves themselves must not be taken for."""
    return {
        "text": joined(("<b>", text, "</b>"), ""),
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


def stripe(low: float, high: float) -> dict[str, Any]:
    """A shape: all that lies from `low` to `high` on the x axis, shaded behind the curves."""
    return {
        "type": "rect",
        "xref": "x",
        "yref": "paper",
        "x0": low,
        "x1": high,
        "y0": 0,
        "y1": 1,
        "line": {"width": 0},
        "fillcolor": GRID,
        "layer": "below",
    }
