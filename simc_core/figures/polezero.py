"""Pole-zero map of a plant. Dead time has neither poles nor zeros; it is named in the title of the axis."""

from collections import Counter

import numpy as np

from simc_core.figures import palette
from simc_core.figures.palette import Figure, Trace
from simc_core.plants.plant import Plant
from simc_core.wording import said

SAME_POLE_DIGITS = 10  # significant digits to which two poles are one multiple pole


def pole_zero_figure(plant: Plant, height: int | None = None) -> Figure:
    """Poles x and zeros o in the s plane; multiplicity beside them, the right half plane shaded."""
    traces = [
        *_points(plant.poles, said("poles"), palette.U, "x-thin"),
        *_points(plant.zeros, said("zeros"), palette.Y, "circle-open"),
    ]
    everything = np.concatenate([plant.poles, plant.zeros])
    reach = 1.25 * max(1e-12, float(np.max(np.abs(everything.real), initial=0.0))) if everything.size else 1.0
    high = 1.25 * float(np.max(np.abs(everything.imag), initial=0.0)) or reach
    right = max(0.25 * reach, 1.25 * float(np.max(everything.real, initial=0.0)))
    shading = {"type": "rect", "x0": 0, "x1": right, "y0": -high, "y1": high, "layer": "below"}
    return palette.figure(
        traces,
        palette.axis(
            said("Re s  [1/{unit}]", unit=palette.TIME_UNIT),
            range=[-reach, right],
            zeroline=True,
            zerolinecolor=palette.NEUTRAL,
        ),
        palette.axis(
            said("Im s  [1/{unit}]", unit=palette.TIME_UNIT),
            range=[-high, high],
            zeroline=True,
            zerolinecolor=palette.NEUTRAL,
        ),
        height,
        hovermode="closest",
        shapes=[shading | {"fillcolor": "rgba(200,68,46,0.08)", "line": {"width": 0}}],
        annotations=[]
        if everything.size
        else [palette.note(said("No poles, no zeros: dead time alone"), palette.NEUTRAL)],
    )


def _points(roots: np.ndarray, name: str, color: str, symbol: str) -> list[Trace]:
    if not roots.size:
        return []
    counted = Counter(complex(f"{root:.{SAME_POLE_DIGITS}g}") for root in roots)
    return [
        {
            "type": "scatter",
            "mode": "markers+text",
            "x": [root.real for root in counted],
            "y": [root.imag for root in counted],
            "text": ["" if many == 1 else f"×{many}" for many in counted.values()],
            "textposition": "top center",
            "name": name,
            "marker": {"color": color, "size": 11, "symbol": symbol, "line": {"color": color, "width": 2}},
            "hovertemplate": "%{x:.4g} %{y:+.4g} j",
        }
    ]
