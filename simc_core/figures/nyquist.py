"""Nyquist curve of L, with what the margins mean in it.

|S| = Ms on the circle of radius 1/Ms round -1: a curve that stays outside has a smaller peak
|T| = Mt on the circle of radius Mt/|Mt^2-1| round -Mt^2/(Mt^2-1); Mt = 1: the line Re L = -1/2
"""

import math
from collections.abc import Sequence

import numpy as np

from simc_core.figures import palette
from simc_core.figures.palette import Figure, Trace
from simc_core.loop import FrequencyResponse
from simc_core.margins import Margins

REFERENCES = ((1.4, 122.0), (1.6, 90.0), (2.0, 52.0))  # Ms, and where the label interrupts its circle, degrees
LABEL = 0.14  # half length of the interruption, in units of L
FLAT = 1e-6  # |Mt - 1| below this: the circle is a line to the eye
VIEW_X, VIEW_Y = (-2.2, 0.7), (-1.4, 0.85)
FARTHEST_LEFT = -4.0


def nyquist_figure(
    curves: Sequence[tuple[str, FrequencyResponse]], margins: Margins, height: int | None = None
) -> Figure:
    """L(j omega), 1:1, -1 marked. curves: present design first, then the pinned ones. margins: of the present one."""
    circles = [_reference(Ms, angle) for Ms, angle in REFERENCES]
    traces = [trace for pair in circles for trace in pair]
    if margins.stable:
        traces += [*_ms_circle(margins), *_mt_circle(margins.Mt)]
    traces += reversed([_curve(name, record, position) for position, (name, record) in enumerate(curves)])
    traces.append(
        palette.marker(-1, 0, "−1", palette.NEUTRAL, "critical point", "bottom left", hoverinfo="skip")
        | {
            "marker": {
                "color": palette.ALARM,
                "size": 10,
                "symbol": "cross-thin",
                "line": {"width": 2.5, "color": palette.ALARM},
            }
        }
    )
    return palette.figure(
        traces,
        palette.axis("Re L  [–]", range=_view(margins), zeroline=True, constrain="range"),
        palette.axis("Im L  [–]", range=list(VIEW_Y), zeroline=True, scaleanchor="x", scaleratio=1),
        height,
        hovermode="closest",
        annotations=[] if margins.stable else [palette.note("Loop not stable: no margins")],
    )


def circle(centre: float, radius: float, points: int = 181) -> tuple[np.ndarray, np.ndarray]:
    """x, y of a circle round a point on the real axis, closed, shape (points,)."""
    angle = np.linspace(0.0, 2 * np.pi, points)
    return centre + radius * np.cos(angle), radius * np.sin(angle)


def mt_circle(Mt: float) -> tuple[np.ndarray, np.ndarray]:
    """x, y of the curve |L/(1+L)| = Mt; for Mt = 1 the line Re L = -1/2."""
    if abs(Mt - 1) < FLAT:
        return np.array([-0.5, -0.5]), np.array([-20.0, 20.0])
    return circle(-Mt * Mt / (Mt * Mt - 1), Mt / abs(Mt * Mt - 1), 721)


def _curve(name: str, record: FrequencyResponse, position: int) -> Trace:
    return palette.line(
        record.L.real,
        record.L.imag,
        name,
        *palette.shade(palette.Y, position),
        customdata=record.omega,
        showlegend=False,  # the time responses name the designs
        hovertemplate="ω = %{customdata:.4g}<br>L = %{x:.4g} %{y:+.4g} j",
    )


def _reference(Ms: float, angle: float) -> tuple[Trace, Trace]:
    """The circle of a well-known Ms, interrupted by its label."""
    radius, middle = 1 / Ms, math.radians(angle)
    gap = LABEL / radius
    at = np.linspace(middle + gap, middle + 2 * np.pi - gap, 181)
    x, y = -1 + radius * np.cos(at), radius * np.sin(at)
    label = {
        "type": "scatter",
        "mode": "text",
        "x": [-1 + radius * math.cos(middle)],
        "y": [radius * math.sin(middle)],
        "text": [f"{Ms:.1f}"],
        "textfont": {"size": 11, "color": palette.NEUTRAL},
        "textposition": "middle center",
        "showlegend": False,
        "hoverinfo": "skip",
    }
    name = f"Ms {Ms:.1f}"
    return palette.line(x, y, name, palette.NEUTRAL, "dot", 1.0, showlegend=False, hoverinfo="skip"), label


def _ms_circle(margins: Margins) -> list[Trace]:
    if not math.isfinite(margins.Ms):
        return []
    x, y = circle(-1.0, 1 / margins.Ms)
    text = f"Ms = {margins.Ms:.4g}"
    return [palette.line(x, y, text, palette.S, "solid", 1.6, hovertemplate=text, meta="Ms circle")]


def _mt_circle(Mt: float) -> list[Trace]:
    if not math.isfinite(Mt):
        return []
    x, y = mt_circle(Mt)
    text = f"Mt = {Mt:.4g}"
    return [palette.line(x, y, text, palette.Y, "longdash", 1.4, hovertemplate=text, meta="Mt circle")]


def _view(margins: Margins) -> list[float]:
    """Room for the lower gain limit of a conditionally stable loop, which crosses to the left of -1."""
    left = VIEW_X[0]
    if margins.stable and margins.GM_lower > 0:
        left = max(min(left, -1.15 / margins.GM_lower), FARTHEST_LEFT)
    return [left, VIEW_X[1]]
