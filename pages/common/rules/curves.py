"""Fronts, paths and points of the two pictures, from the rows of the table. Pure: no streamlit."""

import math
from collections.abc import Sequence

import numpy as np

from pages.common.rules.table import Question, key_of, title_of, value_of
from pages.common.session.compared import KINDS, OPTIMAL
from pages.common.studies.single import Study
from simc_core.controllers.forms import Controller, IController
from simc_core.errors import SimcError
from simc_core.figures.rules import Path, Point
from simc_core.optimal.under_ms import Optimum, criterion_of
from simc_core.studies.comparison import Row
from simc_core.studies.optimum import front, scale_of
from simc_core.studies.simc_path import simc_path
from simc_core.wording import said

BOTH = KINDS[:2]
PRESENT_NAME = said("my design")


def fronts(question: Question) -> list[Path]:
    """Least error over the peak, of PI and of PID controllers; what does not exist is left out."""
    found = []
    for kind in BOTH:
        best = _front(question, kind)
        if best:
            x = np.array([max(each.Ms, each.Mt) for each in best])
            found.append(Path(said("best {kind}", kind=kind), kind, x, np.array([each.value for each in best])))
    return found


def simc_over_tau_c(question: Question) -> list[Path]:
    """What SIMC comes to at each tau_c, of the kinds that are compared."""
    found = []
    for kind in question.kinds:
        path = simc_path(question.plant, kind, question.criterion, question.tau_F)
        if path.peak.size:
            found.append(Path(said("SIMC {kind} over τc", kind=kind), kind, path.peak, path.value))
    return found


def rule_points(question: Question, rows: Sequence[Row]) -> list[Point]:
    """Each rule that has a stable loop, in the trade-off."""
    return [
        Point(key_of(row), title_of(row), row.kind, row.Mst, value)
        for row in rows
        if row.key != OPTIMAL and math.isfinite(value := value_of(row, question.criterion))
    ]


def trade_off_point(question: Question, study: Study, name: str = PRESENT_NAME) -> Point | None:
    """A design in the trade-off; None where its loop is not stable or keeps an offset."""
    if not study.stable:
        return None
    try:
        value = float(
            criterion_of(question.plant, question.criterion, scale_of(question.plant))(
                [study.controller.to_parallel()]
            )[0]
        )
    except SimcError:
        return None
    peak = max(study.margins.Ms, study.margins.Mt)
    return Point("", name, kind_of(study.controller), peak, value) if math.isfinite(value) else None


def best_settings(question: Question) -> Path:
    """Kc and tau_I of the best PI controllers."""
    pairs = [plane_pair(each.controller) for each in _front(question, "PI")]
    return _settings_path(said("best PI"), [each for each in pairs if each])


def simc_settings(question: Question) -> Path:
    """Kc and tau_I of SIMC over tau_c."""
    path = simc_path(question.plant, "PI", question.criterion, question.tau_F)
    pairs = [plane_pair(each) for each in path.controllers]
    return _settings_path(said("SIMC over τc"), [each for each in pairs if each])


def plane_points(rows: Sequence[Row]) -> list[Point]:
    """Each PI rule in the plane of |Kc| and tau_I."""
    return [
        Point(key_of(row), title_of(row), "PI", *pair)
        for row in rows
        if row.kind == "PI" and row.key != OPTIMAL and row.controller and (pair := plane_pair(row.controller))
    ]


def plane_pair(controller: Controller) -> tuple[float, float] | None:
    """|Kc| and tau_I of a PI controller, None of any other."""
    if kind_of(controller) != "PI" or isinstance(controller, IController):
        return None
    form = controller.to_ideal()
    return (abs(form.Kc), form.tau_I) if math.isfinite(form.tau_I) else None


def kind_of(controller: Controller) -> str:
    """PI, or PID where there is derivative action."""
    return "PID" if controller.derivative else "PI"


def _front(question: Question, kind: str) -> list[Optimum]:
    tau_F = question.tau_F if kind == "PID" else None
    found = [best for _, best in front(question.plant, kind, question.criterion, tau_F)]
    return [best for i, best in enumerate(found) if i == 0 or found[i - 1] != best]


def _settings_path(name: str, pairs: Sequence[tuple[float, float]]) -> Path:
    x, y = np.array(pairs).T if pairs else np.zeros((2, 0))
    return Path(name, "PI", x, y)
