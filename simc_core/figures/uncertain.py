"""Bands: what a trend leaves open of the frequency response, and of the responses of the loop."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from simc_core.figures import palette
from simc_core.figures.palette import Figure, Trace
from simc_core.identification.frequency_band import FrequencyBand
from simc_core.wording import said

Array = NDArray[np.float64]
LOWEST_PHASE = -360.0  # degrees; dead time winds on for ever
SEEN = 0.6  # opacity of a band, on top of the half that plotly fills with
FAR = (-4.0, 6.0)  # of y: what grows beyond stays outside the picture


def band_bode_figure(found: FrequencyBand, height: int | None = None) -> Figure:
    """Magnitude above, phase below, each with its band; where the phase passes -180 degrees is marked."""
    omega = found.omega
    seen = found.phase >= LOWEST_PHASE
    traces = [
        _band(omega, found.magnitude_low, found.magnitude_high, palette.Y),
        palette.line(omega, np.abs(found.G), "|G|", palette.Y, hovertemplate="%{y:.4g}"),
        _band(omega, found.phase_low, found.phase_high, palette.U) | {"yaxis": "y2"},
        palette.line(omega[seen], found.phase[seen], "∠G", palette.U, yaxis="y2", hovertemplate="%{y:.4g}"),
    ]
    shapes = [_level(-180.0)]
    nominal, low, high = found.omega_180
    if np.isfinite(nominal) and np.isfinite(low):
        shapes.append(palette.stripe(low, high))
    return palette.figure(
        traces,
        palette.log_axis(palette.FREQUENCY, hoverformat=".4g", anchor="y2"),
        palette.log_axis("|G|  [y/u]", domain=[0.47, 1.0]),
        height,
        yaxis2=palette.axis(
            "∠G  [°]", domain=[0.0, 0.4], range=[LOWEST_PHASE, 0.0], tickvals=[-360, -270, -180, -90, 0]
        ),
        shapes=shapes,
        showlegend=False,
    )


def response_band_figure(
    t: Array,
    nominal: Array,
    family: Sequence[Array],
    axis: str,
    color: str,
    r: Array | None = None,
    share: float = 0.9,
    height: int | None = None,
) -> Figure:
    """A signal of the loop over time, and between what it lies for the plants that a trend does not tell apart.

    Parameters
    ----------
    t, nominal : array, shape (n,)
    family : sequence of array, shape (n,) each
    axis : str
        Title of the axis of the signal.
    color : str
    r : array, shape (n,), optional
        The set point.
    share : float
        Of the plants that are within the band at each instant.
    height : int, optional
        In px.
    """
    every = np.array([nominal, *family])
    low, high = np.quantile(every, [(1 - share) / 2, (1 + share) / 2], axis=0)
    traces = [_band(t, low, high, color)]
    if r is not None:
        traces.append(palette.line(t, r, "r", palette.R, "dash", 1.4, hoverinfo="skip"))
    traces.append(palette.line(t, nominal, said("model"), color, "solid", 2.2, hovertemplate="%{y:.4g}"))
    middle = max(1.0, float(np.abs(nominal).max()))
    bottom = max(float(low.min()), FAR[0] * middle)
    top = min(float(high.max()), FAR[1] * middle)
    room = 0.06 * max(top - bottom, 1e-9)
    return palette.figure(
        traces,
        palette.axis(palette.TIME, hoverformat=".4g"),
        palette.axis(axis, range=[bottom - room, top + room]),
        height,
    )


def peak_band_figure(omega: Array, nominal: Array, family: Array, limit: float, height: int | None = None) -> Figure:
    """|S| over omega, shape (m,), and between what it lies for `family`, shape (n, m); limit: of Ms, drawn in."""
    low, high = np.quantile(family, [0.05, 0.95], axis=0)
    traces = [
        _band(omega, low, high, palette.S),
        palette.line(omega, nominal, "|S|", palette.S, hovertemplate="%{y:.4g}"),
        palette.line(omega[[0, -1]], [limit, limit], said("limit"), palette.NEUTRAL, "dot", 1.4, hoverinfo="skip"),
    ]
    top = float(np.clip(1.2 * high.max(), 2.5, 6.0))
    return palette.figure(
        traces,
        palette.log_axis(palette.FREQUENCY, hoverformat=".4g"),
        palette.axis("|S|  [–]", range=[0.0, top]),
        height,
    )


def _band(x: Array, low: Array, high: Array, color: str) -> Trace:
    """What lies between two curves, filled."""
    return {
        "type": "scatter",
        "mode": "lines",
        "x": np.concatenate([x, x[::-1]]),
        "y": np.concatenate([high, low[::-1]]),
        "fill": "toself",
        "line": {"width": 0, "color": color},
        "opacity": SEEN,
        "hoverinfo": "skip",
        "showlegend": False,
    }


def _level(y: float) -> dict[str, object]:
    return {
        "type": "line",
        "xref": "paper",
        "yref": "y2",
        "x0": 0,
        "x1": 1,
        "y0": y,
        "y1": y,
        "line": {"color": palette.NEUTRAL, "width": 1, "dash": "dot"},
        "layer": "below",
    }
