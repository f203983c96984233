"""Frequency figures: Bode of plants and of L with its margins, |S| and |T| with their peaks, model error."""

import math
from collections.abc import Sequence

import numpy as np

from simc_core.figures import palette
from simc_core.figures.curves import BodeCurve, bode_curve
from simc_core.figures.palette import Figure, Trace
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.frequency_response import FrequencyResponse
from simc_core.plants.plant import Plant
from simc_core.sensitivity.crossings import Crossings
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.wording import Numeral, Text, joined, said

PHASE_VIEW = -540.0  # degrees; dead time winds on for ever, the eye need not follow it
GAIN_VIEW = (1e-3, 1e3)  # widest span of |L| drawn round 1
DEEP = 1e-3  # smallest |S|, |T| and relative error drawn


def bode_figure(plant: Plant, model: Plant | None = None, height: int | None = None) -> Figure:
    """Magnitude above, phase below: the full plant, and its reduced model where there is one."""
    functions = [plant.factored] if model is None else [plant.factored, model.factored]
    omega = omega_grid(functions)
    curves = [bode_curve(F, omega) for F in functions]
    traces = [
        trace
        for name, curve, style in zip(("G", said("model")), curves, palette.FULL_AND_REDUCED, strict=False)
        for trace in _bode(name, curve, *style)
    ]
    return _bode_layout(traces, "|G|  [y/u]", "∠G  [°]", curves[0], height)


def open_loop_figure(
    curves: Sequence[tuple[str, BodeCurve]], margins: Margins, crossings: Crossings, height: int | None = None
) -> Figure:
    """Bode diagram of L, present design first, with GM (both limits), PM and the delay margin drawn in."""
    traces = [
        trace
        for position, (name, curve) in reversed(list(enumerate(curves)))
        for trace in _bode(name, curve, *palette.shade(palette.Y, position))
    ]
    present = curves[0][1]
    if margins.stable:
        traces += [
            *_gain_margins(margins, crossings),
            *_phase_margin(margins, crossings, present),
            *_delay_margin(margins, crossings),
        ]
    figure = _bode_layout(traces, "|L|  [–]", "∠L  [°]", present, height)
    figure["layout"]["shapes"] = [_level(1), _level(-180, "y2")]
    if not margins.stable:
        figure["layout"]["annotations"] = [palette.note(said("Loop not stable: no margins"))]
    return figure


def sensitivity_figure(
    curves: Sequence[tuple[str, FrequencyResponse]], margins: Margins, height: int | None = None
) -> Figure:
    """|S| solid and |T| long-dashed over omega, peaks Ms and Mt of the present design marked."""
    traces: list[Trace] = []
    for position, (name, record) in reversed(list(enumerate(curves))):
        suffix = [" ", name] if position else []
        color, dash, width = palette.shade(palette.S, position)
        pair = [_magnitude(record.omega, record.S, joined(["|S|", *suffix], ""), color, dash, width)]
        color, dash, width = palette.shade(palette.Y, position)
        pair.append(
            _magnitude(
                record.omega, record.T, joined(["|T|", *suffix], ""), color, dash if position else "longdash", width
            )
        )
        traces += [trace | {"showlegend": position == 0} for trace in pair]  # the other figures name the pinned ones
    present = curves[0][1]
    ends = float(present.omega[0]), float(present.omega[-1])
    if margins.stable:
        traces.append(_peak(margins.omega_Ms, margins.Ms, "Ms", palette.S, ends))
        traces.append(_peak(margins.omega_Mt, margins.Mt, "Mt", palette.Y, ends))
    top = max(2.5, 1.6 * float(np.nanmax(np.abs(np.concatenate([present.S, present.T])))))
    return palette.figure(
        traces,
        palette.log_axis(palette.FREQUENCY, hoverformat=".4g", range=_logs(*ends)),
        palette.log_axis("|S|, |T|  [–]", range=_logs(0.02, min(top, 100.0))),
        height,
        shapes=[_level(1)],
        annotations=[] if margins.stable else [palette.note(said("Loop not stable: peaks mean nothing"))],
    )


def nested_sensitivity_figure(
    outer: FrequencyResponse, inner: FrequencyResponse, judged: tuple[Margins, Margins], height: int | None = None
) -> Figure:
    """|S| of the outer and of the inner loop, each with its peak; judged: their margins, in this order."""
    traces: list[Trace] = []
    ends = float(outer.omega[0]), float(outer.omega[-1])
    for (name, color, dash), record, margins in zip(palette.LOOPS, (outer, inner), judged, strict=True):
        traces.append(_magnitude(record.omega, record.S, f"|S{name}|", color, dash, 2.2))
        if margins.stable:
            traces.append(_peak(margins.omega_Ms, margins.Ms, f"Ms{name}", color, ends))
    top = 1.6 * float(np.nanmax(np.abs(np.concatenate([outer.S, inner.S]))))
    stable = all(margins.stable for margins in judged)
    return palette.figure(
        traces,
        palette.log_axis(palette.FREQUENCY, hoverformat=".4g", range=_logs(*ends)),
        palette.log_axis("|Sa|, |Sb|  [–]", range=_logs(0.02, min(max(2.5, top), 100.0))),
        height,
        shapes=[_level(1)],
        annotations=[] if stable else [palette.note(said("Cascade not sound: peaks mean nothing"))],
    )


def model_error_figure(
    omega: np.ndarray, error: np.ndarray, bound: np.ndarray | None, height: int | None = None
) -> Figure:
    """|G - Gr|/|Gr| against 1/|T| [RMS86 eq. 10]: the loop designed on Gr is stable where the error stays below.

    bound: 1/|T| of the loop round the model, None where there is no stable one.
    """
    traces = [palette.line(omega, error, "|G − Gr|/|Gr|", palette.Y, hovertemplate="%{y:.4g}")]
    if bound is not None:
        traces.append(palette.line(omega, bound, "1/|T|", palette.S, "dash", hovertemplate="%{y:.4g}"))
    return palette.figure(
        traces,
        palette.log_axis(palette.FREQUENCY, hoverformat=".4g"),
        palette.log_axis(said("relative error  [–]"), range=_logs(DEEP, 100.0)),
        height,
    )


def _magnitude(omega: np.ndarray, F: np.ndarray, name: str, color: str, dash: str, width: float) -> Trace:
    return palette.line(omega, np.abs(F), name, color, dash, width, hovertemplate="%{y:.4g}")


def _peak(omega: float, height: float, symbol: str, color: str, ends: tuple[float, float]) -> Trace:
    """A marked peak; one at omega = 0 or infinity is marked at that end of the picture."""
    at = min(max(omega, ends[0]), ends[1])
    label = said("{symbol} {height:.3g}", symbol=symbol, height=height)
    hover = said(
        "{symbol} = {height:.4g} at ω = {omega:.4g} {unit}<extra></extra>",
        symbol=symbol,
        height=height,
        omega=omega,
        unit=palette.FREQUENCY_UNIT,
    )
    left = (symbol == "Mt" and at > ends[0]) or at == ends[1]
    return palette.marker(at, height, label, color, symbol, "top left" if left else "top right", hovertemplate=hover)


def _bode(name: str, curve: BodeCurve, color: str, dash: str, width: float) -> tuple[Trace, Trace]:
    gain = palette.line(curve.omega, curve.magnitude, name, color, dash, width, hovertemplate="%{y:.4g}")
    phase = palette.line(curve.omega, curve.phase_deg, name, color, dash, width, hovertemplate="%{y:.4g}°")
    return gain, phase | {"yaxis": "y2", "showlegend": False}


def _bode_layout(traces: list[Trace], gain: str, phase: str, curve: BodeCurve, height: int | None) -> Figure:
    finite = curve.magnitude[np.isfinite(curve.magnitude) & (curve.magnitude > 0)]
    span = _logs(max(finite.min(initial=1.0), GAIN_VIEW[0] * min(1.0, finite.max())) / 2, min(finite.max(), 1e6) * 2)
    highest, lowest = float(curve.phase_deg.max()), max(float(curve.phase_deg.min()), PHASE_VIEW)
    return palette.figure(
        traces,
        palette.log_axis(
            palette.FREQUENCY, hoverformat=".4g", range=_logs(curve.omega[0], curve.omega[-1]), anchor="y2"
        ),
        palette.log_axis(gain, domain=[0.54, 1], range=span),
        height,
        yaxis2=palette.axis(phase, domain=[0, 0.47], range=[lowest - 15, max(highest, lowest + 45) + 15], dtick=90),
    )


def _gain_margins(margins: Margins, crossings: Crossings) -> list[Trace]:
    """A stroke from |L| = 1/GM up, or 1/GM_lower down, to 1 where L is real and negative."""
    strokes = []
    for name, limit in (("GM", margins.GM), (said("GM lower"), margins.GM_lower)):
        if crossings.phase_gain.size and 0 < limit < math.inf:
            at = int(np.argmin(np.abs(np.log(crossings.phase_gain * limit))))
            omega, place = float(crossings.phase_omega[at]), "top right" if name == "GM" else "bottom left"
            strokes.append(
                _stroke(omega, 1.0, 1 / limit, said("{name} {limit:.3g}", name=name, limit=limit), "y", place)
            )
    return strokes


def _phase_margin(margins: Margins, crossings: Crossings, curve: BodeCurve) -> list[Trace]:
    """A stroke from the odd multiple of 180 degrees that counts to the phase where |L| = 1."""
    if not crossings.gain_omega.size:
        return []
    at = int(np.argmin(np.abs(crossings.gain_phase)))
    omega = float(crossings.gain_omega[at])
    phase = float(np.interp(omega, curve.omega, curve.phase_deg))
    limit = phase - math.degrees(crossings.gain_phase[at])
    return [_stroke(omega, limit, phase, said("PM {PM_deg:.3g}°", PM_deg=margins.PM_deg), "y2", "bottom left")]


def _delay_margin(margins: Margins, crossings: Crossings) -> list[Trace]:
    """The gain crossing the delay margin belongs to, which need not be that of the phase margin."""
    if not crossings.gain_omega.size:
        return []
    at = int(np.argmin(crossings.gain_phase % (2 * math.pi) / crossings.gain_omega))
    label = said("delay margin {delay_margin:.3g}", delay_margin=margins.delay_margin)
    point = palette.marker(float(crossings.gain_omega[at]), 1.0, label, palette.U, said("delay margin"), "bottom left")
    return [point | {"hovertemplate": _at(label, "%{x:.4g}")}]


def _stroke(omega: float, start: float, end: float, label: str, axis: str, place: str) -> Trace:
    return palette.line([omega, omega], [start, end], label, palette.U, "solid", 2.5) | {
        "mode": "lines+markers+text",
        "text": [label, ""],
        "textposition": place,
        "marker": {"color": palette.U, "size": 6},
        "hovertemplate": _at(label, Numeral(f"{omega:.4g}")),
        "showlegend": False,
        "yaxis": axis,
    }


def _at(label: str, omega: str) -> Text:
    """The hover text of a mark."""
    return said("{label} at ω = {omega} {unit}<extra></extra>", label=label, omega=omega, unit=palette.FREQUENCY_UNIT)


def _level(value: float, axis: str = "y") -> dict:
    stroke = {"color": palette.NEUTRAL, "width": 1, "dash": "dot"}
    return {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "yref": axis, "y0": value, "y1": value, "line": stroke}


def _logs(low: float, high: float) -> list[float]:
    return [math.log10(low), math.log10(high)]
