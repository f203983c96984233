"""A record and what was fitted to it: PV with SP and the model, OP below, the residuals at the bottom."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from simc_core.figures import palette
from simc_core.figures.palette import Figure, Trace
from simc_core.figures.thinned import held, thinned
from simc_core.identification.trend import Trend
from simc_core.wording import said

Array = NDArray[np.float64]


def trend_figure(
    trend: Trend,
    part: tuple[float, float] | None = None,
    bad: Sequence[tuple[float, float]] = (),
    moves: Sequence[float] = (),
    fitted: tuple[Array, Array, Array] | None = None,
    height: int | None = None,
    shown: tuple[float, float] | None = None,
) -> Figure:
    """PV over OP.

    Parameters
    ----------
    trend : Trend
        The whole record.
    part : (float, float), optional
        From where to where it is fitted; the rest is shaded.
    bad : sequence of (float, float)
        Stretches that are left out, shaded.
    moves : sequence of float
        Instants of moves of OP, marked.
    fitted : (t, y, residuals), optional
        The model's PV and what it leaves, each shape (n,).
    height : int, optional
        In px.
    shown : (float, float), optional
        From where to where it is drawn; all of it unless told otherwise.
    """
    whole = float(trend.t[0]), float(max(trend.t[-1], trend.instants_of_u[-1]))
    low, end = shown or whole
    t_y, y, r = _within(trend.t, low, end, trend.y, trend.y if trend.r is None else trend.r)
    t_u, u = _within(trend.instants_of_u, low, end, trend.u)
    hover: dict[str, Any] = {"hovertemplate": "%{y:.4g}"}
    traces: list[Trace] = []
    if trend.r is not None:
        traces.append(palette.line(*held(t_y, r, end), "SP", palette.R, "dash", 1.4, **hover))
    behind = 1.0 if fitted is None else 0.75  # the model is to be seen in the noise, and PV on a dark page
    traces.append(palette.line(*thinned(t_y, y), "PV", palette.Y, width=1.4, opacity=behind, **hover))
    traces.append(palette.line(*held(t_u, u, end), "OP", palette.U, width=1.6, yaxis="y2", **hover))
    domains = {"y": [0.36, 1.0], "y2": [0.0, 0.3]}
    extra = {}
    if fitted is not None:
        t, y, residuals = _within(fitted[0], low, end, *fitted[1:])
        traces.append(palette.line(*thinned(t, y), said("model"), palette.REDUCED, "dash", 2.0, **hover))
        traces.append(
            palette.line(*thinned(t, residuals), said("residual"), palette.NEUTRAL, width=1, yaxis="y3", **hover)
        )
        domains = {"y": [0.5, 1.0], "y2": [0.24, 0.45], "y3": [0.0, 0.19]}
        extra = {"yaxis3": palette.axis(said("PV − model"), domain=domains["y3"], zeroline=True, nticks=4)}
    shaded = [palette.stripe(*piece) for piece in bad]
    if part is not None:
        begin, last = whole
        shaded += [palette.stripe(a, b) for a, b in ((begin, part[0]), (part[1], last)) if b > a]
    lines = [_mark(t) for t in moves]
    at_most = {"range": list(shown)} if shown else {}
    return palette.figure(
        traces,
        palette.axis(palette.TIME, hoverformat=".5g", anchor="y3" if fitted is not None else "y2", **at_most),
        palette.axis(said("PV  [{unit}]", unit=palette.UNIT_OF_Y), domain=domains["y"]),
        height,
        yaxis2=palette.axis(said("OP  [{unit}]", unit=palette.UNIT_OF_U), domain=domains["y2"], nticks=5),
        shapes=[*shaded, *lines],
        **extra,
    )


def _within(t: Array, low: float, high: float, *values: Array) -> tuple[Array, ...]:
    """The samples from low to high, and the next one on each side."""
    first, last = max(int(np.searchsorted(t, low)) - 1, 0), int(np.searchsorted(t, high, "right")) + 1
    return t[first:last], *[each[first:last] for each in values]


def tau_c_figure(
    tau_c: Array,
    middle: Array,
    high: Array,
    limit: float,
    marked: Sequence[tuple[str, float]],
    height: int | None = None,
) -> Figure:
    """Ms against tau_c: what is expected, and what is not exceeded with the probability that was asked for.

    Parameters
    ----------
    tau_c, middle, high : array, shape (n,)
        high may be inf where too many loops are not stable.
    limit : float
        Of Ms.
    marked : sequence of (str, float)
        tau_c with names.
    """
    seen = np.isfinite(high) & (high < 4)
    hover: dict[str, Any] = {"hovertemplate": "%{y:.3f}"}
    traces = [
        palette.line(tau_c[seen], high[seen], said("upper limit"), palette.S, "dash", 2.0, **hover),
        palette.line(tau_c[middle < 4], middle[middle < 4], said("median"), palette.S, **hover),
        palette.line(tau_c[[0, -1]], [limit, limit], said("limit"), palette.NEUTRAL, "dot", 1.4, hoverinfo="skip"),
    ]
    shapes = [_mark(t) for _, t in marked]
    names = [{**palette.label(name, t, 1.0, above=False), "yref": "paper", "xanchor": "left"} for name, t in marked]
    return palette.figure(
        traces,
        palette.axis(said("τc  [{unit}]", unit=palette.TIME_UNIT), hoverformat=".4g"),
        palette.axis("Ms"),
        height,
        shapes=shapes,
        annotations=names,
    )


def relay_figure(t: Array, y: Array, u: Array, height: int | None = None) -> Figure:
    """y over u of a relay test, each shape (n,), u held from each instant on."""
    hover: dict[str, Any] = {"hovertemplate": "%{y:.4g}"}
    return palette.figure(
        [
            palette.line(*thinned(t, y), "y", palette.Y, **hover),
            palette.line(*held(t, u, float(t[-1])), "u", palette.U, width=1.6, yaxis="y2", **hover),
        ],
        palette.axis(palette.TIME, hoverformat=".5g", anchor="y2"),
        palette.axis(palette.OUTPUT, domain=[0.4, 1.0]),
        height,
        yaxis2=palette.axis(palette.INPUT, domain=[0.0, 0.32], nticks=4),
    )


def _mark(t: float) -> dict[str, object]:
    return {
        "type": "line",
        "xref": "x",
        "yref": "paper",
        "x0": t,
        "x1": t,
        "y0": 0,
        "y1": 1,
        "line": {"color": palette.NEUTRAL, "width": 1, "dash": "dot"},
        "layer": "below",
    }
