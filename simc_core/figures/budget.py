"""Picture of a model reduction: one bar per lag, zero and dead time, cut into what became of it."""

import math

from simc_core.figures import palette
from simc_core.figures.palette import Figure, Trace
from simc_core.reduction.records import BudgetEntry, Reduction
from simc_core.wording import Numeral, said

# where a part went -> (words, colour, pattern): the pattern says what the colour says
FATES = {
    "tau1": (said("kept as τ₁"), palette.REDUCED, ""),
    "tau2": (said("kept as τ₂"), palette.REDUCED_TAU2, "-"),
    "tau0": (said("kept as τ₀"), palette.REDUCED, ""),
    "theta": (said("into θ"), palette.U, "/"),
    "cancelled": (said("cancelled with a zero or lag"), palette.NEUTRAL, "x"),
    "slope": (said("into the slope k′"), palette.Y, "."),
    "integrator": (said("absorbed by the integrator"), palette.Y, "|"),
    "a": (said("kept as the unstable pole"), palette.D, "\\"),
}


def budget_figure(reduction: Reduction, height: int | None = None) -> Figure:
    """Horizontal bars, one per BudgetEntry; an integrator, a lag without limit, is drawn to the edge."""
    entries = reduction.budget
    finite = [abs(share.amount) for share in entries if math.isfinite(share.amount)]
    edge = 1.15 * max(finite, default=1.0)
    traces = [trace for fate in FATES if (trace := _bars(fate, entries, edge))]
    rows = list(range(len(entries)))
    return palette.figure(
        traces,
        palette.axis(said("time constant  [{unit}]", unit=palette.TIME_UNIT), rangemode="tozero"),
        palette.axis("", tickvals=rows, ticktext=[share.label for share in entries], autorange="reversed"),
        height or 70 + 34 * len(entries),
        barmode="stack",
        hovermode="closest",
        bargap=0.3,
    )


def fate(where: str) -> str:
    """The fate a part belongs to; rules T1 to T3 and the like take a lag and a zero out against each other."""
    return where if where in FATES else "cancelled"


def _bars(name: str, entries: tuple[BudgetEntry, ...], edge: float) -> Trace | None:
    words, color, pattern = FATES[name]
    found = [
        (row, where, time)
        for row, share in enumerate(entries)
        for where, time in share.parts
        if fate(where) == name and time
    ]
    if not found:
        return None
    return {
        "type": "bar",
        "orientation": "h",
        "y": [row for row, _, _ in found],
        "x": [min(abs(time), edge) for _, _, time in found],
        "text": [_amount(time) for _, _, time in found],
        "customdata": [said("rule {where}", where=where) if name == "cancelled" else words for _, where, _ in found],
        "textposition": "inside",
        "insidetextanchor": "middle",
        "name": words,
        "textangle": 0,
        "textfont": {"color": "white"},
        "marker": {"color": color, "pattern": {"shape": pattern, "fillmode": "overlay", "size": 6, "solidity": 0.15}},
        "hovertemplate": "%{text}: %{customdata}<extra></extra>",
    }


def _amount(time: float) -> str:
    return Numeral("∞" if math.isinf(time) else f"{time:.4g}")
