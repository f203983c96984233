"""Bundles: the responses and Nyquist curves of a family of plants round one controller."""

from collections.abc import Sequence

import numpy as np

from simc_core.figures import palette
from simc_core.figures.nyquist import VIEW_X, VIEW_Y, circle, critical_point
from simc_core.figures.palette import Figure, Trace
from simc_core.simulation import TimeResponse
from simc_core.studies.plant_family import Robustness
from simc_core.wording import said

FAR = (-4.0, 6.0)  # of y: what grows beyond stays outside the picture


def bundle_figure(
    nominal: TimeResponse, family: Sequence[TimeResponse], worst: TimeResponse, height: int | None = None
) -> Figure:
    """y of all plants, thin; of the worst, dashed; of the nominal one on top."""
    traces = [
        _bundle([(each.t, each.y) for each in family], said("changed plants")),
        palette.line(nominal.t, nominal.r, "r", palette.R, "dash", 1.4, hoverinfo="skip"),
        palette.line(worst.t, worst.y, said("worst"), palette.ALARM, "dash", 2.0, hovertemplate="%{y:.4g}"),
        palette.line(nominal.t, nominal.y, said("nominal"), palette.Y, "solid", 2.2, hovertemplate="%{y:.4g}"),
    ]
    values = np.concatenate([each.y for each in (nominal, *family)])
    low, high = max(float(values.min()), FAR[0]), min(float(values.max()), FAR[1])
    room = 0.05 * (high - low)
    return palette.figure(
        traces,
        palette.axis(palette.TIME, hoverformat=".4g"),
        palette.axis(palette.OUTPUT, range=[low - room, high + room]),
        height,
    )


def band_figure(found: Robustness, nominal: np.ndarray, omega: np.ndarray, height: int | None = None) -> Figure:
    """L of all plants, thin; worst and nominal on top; the circle is the worst Ms. nominal: L at omega, complex."""
    curves = [case.loop.L(1j * omega) for case in (*found.corners, *found.samples)]
    worst = found.worst.loop.L(1j * omega)
    traces = [
        _bundle([(L.real, L.imag) for L in curves], said("changed plants")),
        palette.line(worst.real, worst.imag, said("worst"), palette.ALARM, "dash", 2.0, hoverinfo="skip"),
        palette.line(nominal.real, nominal.imag, said("nominal"), palette.Y, "solid", 2.2, hoverinfo="skip"),
        critical_point(),
    ]
    if found.worst.stable:
        x, y = circle(-1.0, 1 / found.worst.Ms)
        traces.append(
            palette.line(
                x, y, said("worst Ms = {Ms:.4g}", Ms=found.worst.Ms), palette.S, "solid", 1.6, hoverinfo="skip"
            )
        )
    return palette.figure(
        traces,
        palette.axis("Re L  [–]", range=list(VIEW_X), zeroline=True, constrain="range"),
        palette.axis("Im L  [–]", range=list(VIEW_Y), zeroline=True, scaleanchor="x", scaleratio=1),
        height,
        hovermode="closest",
    )


def _bundle(curves: Sequence[tuple[np.ndarray, np.ndarray]], name: str) -> Trace:
    """All curves as one trace, with gaps between them."""
    x = np.concatenate([np.append(each, np.nan) for each, _ in curves])
    y = np.concatenate([np.append(each, np.nan) for _, each in curves])
    return palette.line(x, y, name, palette.Y, "solid", 0.8, opacity=0.35, hoverinfo="skip", connectgaps=False)
