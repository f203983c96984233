"""Nyquist curve of L, with what the margins mean in it.

|S| = Ms on the circle of radius 1/Ms round -1: a curve that stays outside has a smaller peak
|T| = Mt on the circle of radius Mt/|Mt^2-1| round -Mt^2/(Mt^2-1); Mt = 1: the line Re L = -1/2
"""

import math
from collections.abc import Sequence

import numpy as np

from simc_core.figures import palette
from simc_core.figures.palette import Figure, Trace
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.frequency_response import FrequencyResponse
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.studies.bands import CIRCLES
from simc_core.wording import Numeral, said

REFERENCES = tuple(zip(CIRCLES, (110.0, 160.0, 60.0), strict=True))  # and where the label interrupts, degrees
LABEL, HEIGHT = 0.14, 0.04  # half length of the interruption, and what a label covers to either side, in units of L
FLAT = 1e-6  # |Mt - 1| below this: the circle is a line to the eye
VIEW_X, VIEW_Y = (-2.2, 0.7), (-1.4, 0.85)
OMEGA_AND_L = said(
    "ω = {omega} {unit}<br>L = %{{x:.4g}} %{{y:+.4g}} j", omega="%{customdata:.4g}", unit=palette.FREQUENCY_UNIT
)
FARTHEST_LEFT = -4.0


def nyquist_figure(
    curves: Sequence[tuple[str, FrequencyResponse]], margins: Margins, height: int | None = None
) -> Figure:
    """L(j omega), 1:1, -1 marked. curves: present design first, then the pinned ones. margins: of the present one."""
    traces = [*_ms_circle(margins, ""), *_mt_circle(margins.Mt)] if margins.stable else []
    shades = [palette.shade(palette.Y, position) for position in range(len(curves))]
    traces += reversed(
        [_curve(name, each.omega, each.L, shade) for (name, each), shade in zip(curves, shades, strict=True)]
    )
    return _plane(traces, [margins], height)


def plant_nyquist_figure(plant: Plant, height: int | None = None) -> Figure:
    """G(j omega), 1:1: L with a proportional controller of gain 1, not judged."""
    omega = omega_grid([plant.factored])
    return _plane([_curve("G", omega, plant.response(1j * omega), palette.shade(palette.Y, 0))], [], height)


def nested_nyquist_figure(
    outer: FrequencyResponse, inner: FrequencyResponse, judged: tuple[Margins, Margins], height: int | None = None
) -> Figure:
    """La (inner loop closed) and Lb, each with the circle of its own Ms in its own colour and dash.

    judged: margins of the outer and of the inner loop.
    """
    traces = []
    for (name, color, dash), record, margins in zip(palette.LOOPS, (outer, inner), judged, strict=True):
        traces.append(_curve(f"L{name}", record.omega, record.L, (color, dash, 2.2)) | {"showlegend": True})
        if margins.stable:
            traces += [
                circle | {"line": {"color": color, "dash": dash, "width": 1.2}, "showlegend": False}
                for circle in _ms_circle(margins, name)
            ]
    return _plane(traces, judged, height)


def _plane(traces: list[Trace], judged: Sequence[Margins], height: int | None) -> Figure:
    """The plane of L, 1:1, with the circles of well-known Ms and the critical point.

    Where a loop's own circle would run through the label of a well-known one, that one is left out.
    """
    stable = all(margins.stable for margins in judged)
    own = [1 / margins.Ms for margins in judged if margins.stable]
    clear = [(Ms, angle) for Ms, angle in REFERENCES if all(abs(1 / Ms - radius) > HEIGHT for radius in own)]
    circles = [trace for Ms, angle in clear for trace in _reference(Ms, angle)]
    return palette.figure(
        [*circles, *traces, critical_point()],
        palette.axis("Re L  [–]", range=_view(judged), zeroline=True, constrain="range"),
        palette.axis("Im L  [–]", range=list(VIEW_Y), zeroline=True, scaleanchor="x", scaleratio=1),
        height,
        hovermode="closest",
        annotations=[] if stable else [palette.note(said("Loop not stable: no margins"))],
    )


def critical_point() -> Trace:
    """The red cross at -1."""
    cross = {"width": 2.5, "color": palette.ALARM}
    return palette.marker(-1, 0, "−1", palette.NEUTRAL, said("critical point"), "bottom left", hoverinfo="skip") | {
        "marker": {"color": palette.ALARM, "size": 10, "symbol": "cross-thin", "line": cross}
    }


def circle(centre: float, radius: float, points: int = 181) -> tuple[np.ndarray, np.ndarray]:
    """x, y of a circle round a point on the real axis, closed, shape (points,)."""
    angle = np.linspace(0.0, 2 * np.pi, points)
    return centre + radius * np.cos(angle), radius * np.sin(angle)


def mt_circle(Mt: float) -> tuple[np.ndarray, np.ndarray]:
    """x, y of the curve |L/(1+L)| = Mt; for Mt = 1 the line Re L = -1/2."""
    if abs(Mt - 1) < FLAT:
        return np.array([-0.5, -0.5]), np.array([-20.0, 20.0])
    return circle(-Mt * Mt / (Mt * Mt - 1), Mt / abs(Mt * Mt - 1), 721)


def _curve(name: str, omega: np.ndarray, L: np.ndarray, style: tuple[str, str, float]) -> Trace:
    return palette.line(
        L.real,
        L.imag,
        name,
        *style,
        customdata=omega,
        showlegend=False,  # the time responses name the designs
        hovertemplate=OMEGA_AND_L,
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
        "text": [Numeral(f"{Ms:.1f}")],
        "textfont": {"size": 11, "color": palette.NEUTRAL},
        "textposition": "middle center",
        "showlegend": False,
        "hoverinfo": "skip",
    }
    name = said("Ms {Ms:.1f}", Ms=Ms)
    return palette.line(x, y, name, palette.NEUTRAL, "dot", 1.0, showlegend=False, hoverinfo="skip"), label


def _ms_circle(margins: Margins, of: str) -> list[Trace]:
    if not math.isfinite(margins.Ms):
        return []
    x, y = circle(-1.0, 1 / margins.Ms)
    text = said("Ms{of} = {Ms:.4g}", of=of, Ms=margins.Ms)
    return [palette.line(x, y, text, palette.S, "solid", 1.6, hovertemplate=text, meta="Ms circle")]


def _mt_circle(Mt: float) -> list[Trace]:
    if not math.isfinite(Mt):
        return []
    x, y = mt_circle(Mt)
    text = said("Mt = {Mt:.4g}", Mt=Mt)
    return [palette.line(x, y, text, palette.Y, "longdash", 1.4, hovertemplate=text, meta="Mt circle")]


def _view(judged: Sequence[Margins]) -> list[float]:
    """Room for the lower gain limit of a conditionally stable loop, which crosses to the left of -1."""
    limits = [margins.GM_lower for margins in judged if margins.stable and margins.GM_lower > 0]
    left = min([VIEW_X[0], *(-1.15 / limit for limit in limits)])
    return [max(left, FARTHEST_LEFT), VIEW_X[1]]
