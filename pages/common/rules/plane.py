"""The plane of Kc and tau_I as the live instrument shows it: contours, rules, and where the point stands. Pure."""

import math
from collections.abc import Sequence

import numpy as np

from pages.common.live import Ground
from pages.common.rules import curves
from pages.common.rules.table import Question, key_of
from pages.common.studies.single import Study
from pages.common.words import number, translated, words
from simc_core.controllers.forms import IdealPid
from simc_core.optimal.robust_gains import sign_of_gain
from simc_core.studies.comparison import Row
from simc_core.studies.tuning_plane import TuningPlane, tuning_plane

DIGITS = 6  # of what is drawn
ROOM = 1.05  # beyond what must be seen

Line = dict[str, list[float]]


def ground(question: Question, rows: Sequence[Row], chosen: Row | None, present: Study | None, mine: bool) -> Ground:
    """What the point stands on: my settings where they are PI, else the rule that was picked, else the middle.

    mine: whether this is the plant of the design.
    """
    plane = tuning_plane(question.plant)
    offered = [present.controller if present else None, chosen.controller if chosen else None]
    start = next((each for each in offered if each and curves.plane_pair(each)), _middle(question, plane))
    form = start.to_ideal()
    Kc, tau_I = (
        _limits(ends, size) for ends, size in ((plane.Kc[[0, -1]], abs(form.Kc)), (plane.tau_I[[0, -1]], form.tau_I))
    )
    known = mine and present is not None and curves.plane_pair(present.controller) is not None
    drawn = _drawn(question, rows, chosen, plane, Kc, tau_I) | {
        "name": words("my settings") if known else words("settings to try")
    }
    return Ground(question.plant, form, mine, Kc, tau_I, drawn)


def _middle(question: Question, plane: TuningPlane) -> IdealPid:
    Kc, tau_I = (float(np.exp(np.log(values).mean())) for values in (plane.Kc, plane.tau_I))
    return IdealPid(sign_of_gain(question.plant) * Kc, tau_I)


def _limits(ends: np.ndarray, size: float) -> tuple[float, float]:
    low, high = ends.tolist()
    return min(low, size / ROOM), max(high, size * ROOM)


def _drawn(
    question: Question,
    rows: Sequence[Row],
    chosen: Row | None,
    plane: TuningPlane,
    Kc: tuple[float, float],
    tau_I: tuple[float, float],
) -> dict[str, object]:
    """See panel.js."""
    limit = np.clip(plane.limit, *tau_I)
    finite = np.pad(np.isfinite(plane.limit), 1)
    seen = finite[:-2] | finite[1:-1] | finite[2:]  # up to where no integral time is long enough
    around = np.append(plane.Kc, plane.Kc[[-1, 0]]), np.append(limit, [tau_I[0]] * 2)
    best, path = curves.best_settings(question), curves.simc_settings(question)
    return {
        "x": list(Kc),
        "y": list(tau_I),
        "region": _line(*around),
        "limit": _line(plane.Kc[seen], limit[seen]),
        "contours": _contours(plane),
        "best": _line(best.x, best.y),
        "path": _line(path.x, path.y),
        "points": [
            {"key": each.key, "name": translated(each.name), "x": each.x, "y": each.y}
            for each in curves.plane_points(rows)
            if math.isfinite(each.x) and math.isfinite(each.y)
        ],
        "chosen": "" if chosen is None else key_of(chosen),
    }


def _contours(plane: TuningPlane) -> list[dict[str, object]]:
    """Upper edges with their level at the end, then lower ones where there are any."""
    found: list[dict[str, object]] = []
    for level, lower, upper in plane.contours:
        known = np.isfinite(upper)
        found.append(_line(upper[known], plane.tau_I[known]) | {"level": number(level)})
        above = known & (lower > 0)
        if above.any():
            found.append(_line(lower[above], plane.tau_I[above]) | {"level": ""})
    return found


def _line(x: np.ndarray, y: np.ndarray) -> Line:
    return {"x": [_short(value) for value in x.tolist()], "y": [_short(value) for value in y.tolist()]}


def _short(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
