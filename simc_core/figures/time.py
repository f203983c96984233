"""Time responses: y and u of a loop or a cascade, y2 and r2 of a cascade, step response of plants.

Curves come as pairs (name, record); the first is the present design, the others are pinned ones.
A record holds both limits where a signal jumps, and so does the picture: a vertical stroke.
"""

from collections.abc import Sequence

import numpy as np

from simc_core.figures import palette
from simc_core.figures.palette import Figure, Trace
from simc_core.plants.step_response import PlantStep
from simc_core.simulation import NestedResponse, TimeResponse
from simc_core.studies.with_actuator import AsBuilt
from simc_core.wording import said

NestedCurves = Sequence[tuple[str, NestedResponse]]
Curves = Sequence[tuple[str, TimeResponse | NestedResponse]]
FAR = 10.0  # a response that leaves this many steps is growing: the view stays where the eye can read
VIEW = (-4.0, 6.0)
NEAR = 0.5  # of the range of u: a limit farther away than this would only flatten the curves


def output_figure(curves: Curves, height: int | None = None, stable: bool = True) -> Figure:
    """y(t) and the set point r(t), grey and dashed. stable=False: the figure says that the loop is not."""
    present = curves[0][1]
    traces = [_reference(present.t, present.r, "r"), *_signals(curves, "y", palette.Y)]
    return _figure(traces, palette.OUTPUT, height, stable)


def input_figure(curves: Curves, height: int | None = None, stable: bool = True) -> Figure:
    """u(t), the controller output, with its jumps. stable=False: the figure says that the loop is not."""
    return _figure(_signals(curves, "u", palette.U), palette.INPUT, height, stable)


def inner_output_figure(curves: NestedCurves, height: int | None = None, stable: bool = True) -> Figure:
    """y2(t) of cascades, and the set point r2 that the outer controller of the present one gives it."""
    present = curves[0][1]
    traces = [_reference(present.t, present.r2, "r2"), *_signals(curves, "y2", palette.INNER)]
    return _figure(traces, said("y2  [{unit}]", unit=said("unit of y2")), height, stable)


def inner_setpoint_figure(curves: NestedCurves, height: int | None = None, stable: bool = True) -> Figure:
    """r2(t), what the outer controller puts out: it shows whether that winds up."""
    return _figure(_signals(curves, "r2", palette.INNER), said("r2  [{unit}]", unit=said("unit of y2")), height, stable)


def plant_step_figure(step: PlantStep, model: PlantStep | None = None, height: int | None = None) -> Figure:
    """Open-loop response to a unit step of u: the full plant, and its reduced model where there is one."""
    found = [("G", step)] if model is None else [("G", step), (said("model"), model)]
    traces = [
        palette.line(record.t, record.y, name, *style, hovertemplate="%{y:.4g}")
        for (name, record), style in zip(found, palette.FULL_AND_REDUCED, strict=False)
    ]
    return _figure(traces, palette.OUTPUT, height, stable=True)


def built_output_figure(found: AsBuilt, height: int | None = None) -> Figure:
    """y(t) of the loop as built over that of the linear loop, dashed, and without anti-windup, dotted."""
    return output_figure(_as_built(found), height, found.numbers is not None)


def built_input_figure(found: AsBuilt, height: int | None = None) -> Figure:
    """u(t) in the same way, between the limits of the actuator."""
    curves = _as_built(found)
    u = np.concatenate([record.u for _, record in curves])
    low, high = float(u.min()), float(u.max())
    room = NEAR * (high - low)
    t = found.built.t[[0, -1]]
    limits = [
        palette.line(t, [bound, bound], name, palette.NEUTRAL, "solid", 1.2, hoverinfo="skip", showlegend=False)
        for name, bound in ((said("u min"), found.actuation.u_min), (said("u max"), found.actuation.u_max))
        if low - room <= bound <= high + room
    ]
    names = [palette.label(line["name"], float(t[-1]), float(line["y"][0]), line["name"] == "u max") for line in limits]
    figure = _figure([*limits, *_signals(curves, "u", palette.U)], palette.INPUT, height, found.numbers is not None)
    figure["layout"]["annotations"] = [*figure["layout"]["annotations"], *names]
    return figure


def _as_built(found: AsBuilt) -> Curves:
    curves = [(said("as built"), found.built), (said("linear"), found.linear)]
    return curves if found.unprotected is None else [*curves, (said("no anti-windup"), found.unprotected)]


def _reference(t: np.ndarray, r: np.ndarray, name: str) -> Trace:
    """A set point."""
    return palette.line(t, r, name, palette.R, "dash", 1.4, hovertemplate="%{y:.4g}")


def _signals(curves: Curves, field: str, color: str) -> list[Trace]:
    traces = [
        palette.line(record.t, getattr(record, field), name, *palette.shade(color, position), hovertemplate="%{y:.4g}")
        for position, (name, record) in enumerate(curves)
    ]
    return traces[1:] + traces[:1]  # the present design on top of the pinned ones


def _figure(traces: list[Trace], title: str, height: int | None, stable: bool) -> Figure:
    view = {}
    if not stable and any(np.nanmax(np.abs(trace["y"])) > FAR for trace in traces):
        view = {"range": list(VIEW)}
    return palette.figure(
        traces,
        palette.axis(palette.TIME, hoverformat=".4g"),
        palette.axis(title, **view),
        height,
        annotations=[] if stable else [palette.note(said("Loop not stable: the response grows"))],
    )
