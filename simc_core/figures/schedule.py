"""Ms over the scheduling value: what a gain schedule does between the rows it was made for."""

from collections.abc import Mapping

import numpy as np

from simc_core.figures import palette
from simc_core.figures.palette import Figure
from simc_core.wording import said

DASHES = ("solid", "dash")
HIGHEST = 5.0  # Ms beyond it is off the picture: such a loop is near its limit


def schedule_figure(
    peaks: Mapping[str, tuple[np.ndarray, np.ndarray]],
    rows: tuple[np.ndarray, np.ndarray],
    limit: float,
    height: int | None = None,
) -> Figure:
    """Ms between the rows.

    Parameters
    ----------
    peaks : mapping of str to (x, Ms)
        Curves by what is assumed of the plant; Ms is inf where the loop is not stable.
    rows : (x, Ms)
        At the rows.
    limit : float
        Ms above which a warning is due.
    height : int, optional
        In px.
    """
    traces = [
        palette.line(x, np.where(np.isfinite(Ms), Ms, np.nan), name, palette.S, dash, hovertemplate="%{y:.4g}")
        for (name, (x, Ms)), dash in zip(peaks.items(), DASHES, strict=False)
    ]
    x = next(iter(peaks.values()))[0][[0, -1]]
    traces.append(palette.line(x, [limit, limit], said("warning"), palette.NEUTRAL, "dot", 1.4, hoverinfo="skip"))
    traces.append(
        palette.line(*rows, said("rows"), palette.S, mode="markers", marker={"color": palette.S, "size": 8})
        | {"hovertemplate": "%{y:.4g}"}
    )
    finite = [float(np.max(Ms[np.isfinite(Ms)], initial=limit)) for _, Ms in (*peaks.values(), rows)]
    top = min(max(*finite, limit) * 1.05, HIGHEST)
    lost = any(np.any(~np.isfinite(Ms)) for _, Ms in peaks.values())
    return palette.figure(
        traces,
        palette.axis(said("scheduling value"), hoverformat=".4g"),
        palette.axis("Ms", range=[1.0, top]),
        height,
        annotations=[palette.note(said("Not stable where the curve is missing"))] if lost else [],
    )
