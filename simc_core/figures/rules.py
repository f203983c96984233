"""Tuning rules in a picture: the error over the peak of |S| and |T|."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.figures import palette
from simc_core.figures.palette import Figure, Trace
from simc_core.wording import joined, said

PEAK = said("Mst = max(Ms, Mt)  [–]")
STYLES = {"PI": (palette.Y, "circle", "solid"), "PID": (palette.REDUCED, "diamond", "dash")}
WIDEST = 4.0  # peaks that are shown at first
HIGHEST = 20.0  # values that are shown at first, over the smallest
ROOM = 1.08
SIZE = 9  # px


@dataclass(frozen=True, slots=True)
class Point:
    """A controller in a picture. key: what a click on it tells; "" for none.   kind: "PI" or "PID"."""

    key: str
    name: str
    kind: str
    x: float
    y: float


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """A line of controllers: "best PI", "SIMC over tau_c"."""

    name: str
    kind: str
    x: np.ndarray
    y: np.ndarray


def trade_off_figure(
    fronts: Sequence[Path],
    paths: Sequence[Path],
    points: Sequence[Point],
    chosen: Point | None,
    present: Point | None,
    title: str,
    height: int | None = None,
) -> Figure:
    """The error over max(Ms, Mt): nothing lies below the fronts. title: of the error, with its unit."""
    traces = [
        palette.line(each.x, each.y, each.name, STYLES[each.kind][0], STYLES[each.kind][2], 2.4, hovertemplate=HOVER)
        for each in fronts
    ]
    traces += [_path(each) for each in paths]
    traces += [*_points(points, said("Mst %{x:.4g}, error %{y:.4g}"))]
    shown = [each for each in (*points, present) if each is not None]
    low, high, widest = _view(fronts, shown)
    middle = (1 + widest) / 2
    return palette.figure(
        [*traces, *_marks(chosen, present, middle)],
        palette.axis(PEAK, range=[1.0, widest]),
        palette.short_log_axis(title, low, high),
        height,
        hovermode="closest",
    )


HOVER = "%{x:.4g}, %{y:.4g}"


def _path(each: Path) -> Trace:
    return palette.line(each.x, each.y, each.name, palette.U, "dot", 2.0, hovertemplate=HOVER)


def _points(points: Sequence[Point], told: str) -> list[Trace]:
    """One trace a kind; a click tells the key."""
    traces = []
    for kind, (color, symbol, _) in STYLES.items():
        own = [each for each in points if each.kind == kind]
        if own:
            traces.append(
                {
                    "type": "scatter",
                    "mode": "markers",
                    "x": [each.x for each in own],
                    "y": [each.y for each in own],
                    "name": said("{kind} rules", kind=kind),
                    "text": [each.name for each in own],
                    "customdata": [each.key for each in own],
                    "hovertemplate": joined(("<b>%{text}</b><br>", told, "<extra></extra>"), ""),
                    "marker": {"color": color, "symbol": symbol, "size": SIZE, "line": {"width": 0}},
                    "selected": {"marker": {"opacity": 1}},
                    "unselected": {"marker": {"opacity": 1}},
                }
            )
    return traces


def _marks(chosen: Point | None, present: Point | None, middle: float) -> list[Trace]:
    """A ring round the rule that is drawn, and a cross for the present design, both with their names.

    middle: beyond it names stand on the left.
    """
    found = []
    if present is not None:
        cross = {"color": palette.U, "symbol": "x", "size": 10}
        found.append(_mark(present, palette.U, marker=cross, position=_beside("bottom", present, middle)))
    if chosen is not None:
        ring = {"color": palette.ALARM, "symbol": "circle-open", "size": 17, "line": {"width": 2.5}}
        found.append(_mark(chosen, palette.ALARM, marker=ring, position=_beside("top", chosen, middle)))
    return found


def _beside(where: str, point: Point, middle: float) -> str:
    return f"{where} {'left' if point.x > middle else 'right'}"


def _mark(point: Point, color: str, marker: dict, position: str) -> Trace:
    return palette.marker(
        point.x, point.y, point.name, color, point.name, position, marker=marker, hoverinfo="skip", cliponaxis=True
    )


def _view(fronts: Sequence[Path], points: Sequence[Point]) -> tuple[float, float, float]:
    """Least and largest value, and largest peak, that are shown at first."""
    widest = min(max([2.0, *(each.x for each in points)]) * ROOM, WIDEST)
    shown = [each.y for each in points if each.x <= widest]
    least = [*shown, *(y for each in fronts for y in each.y[each.x <= widest].tolist())]
    if not least:
        return 0.1, 10.0, widest
    low = min(least)
    return low / ROOM, min(max(shown or least), HIGHEST * low) * ROOM, widest
