"""Rules on one plant, row by row, each computed once for all sessions; and the table made of them. No streamlit."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from threading import Lock

import pandas as pd

from pages.common.parts.settings_text import sizes
from pages.common.parts.units import unit_of, with_plain_unit
from pages.common.session.compared import OPTIMAL, PRESENT, USUAL
from pages.common.session.design import Design
from pages.common.session.sheet import Sheet
from pages.common.studies.measures import MEASURES, Measured, values
from pages.common.words import number, translated, words
from simc_core import RULES, Loop, Optimum, Performance, Plant, comparison, margins_many, optimal
from simc_core.controllers.forms import Controller, IController
from simc_core.errors import SimcError
from simc_core.metrics.performance import performance_many
from simc_core.studies.comparison import Row
from simc_core.studies.optimum import FILTER, scale_of
from simc_core.wording import Text, said

EQUAL = 1e-4  # relative, to an optimum that is known to some 1e-5
KEPT = 32  # questions, of all sessions together
UNITS = {
    "Kc": "OP/PV",
    **dict.fromkeys(("τI", "τD"), "time"),
    **dict.fromkeys(("IAE load", "IAE set point"), "PV time"),
    "TV load": "OP",
    "high-freq. gain": "OP/PV",
}
OPTIMUM = said("optimum")
SHORT = {
    "chr_setpoint_0": said("CHR, set point, 0 %"),
    "chr_setpoint_20": said("CHR, set point, 20 %"),
    "chr_load_0": said("CHR, load, 0 %"),
    "chr_load_20": said("CHR, load, 20 %"),
}


@dataclass(frozen=True, slots=True)
class Question:
    """What is compared, complete: everything the rows depend on."""

    plant: Plant
    kinds: tuple[str, ...]
    Ms: float | None
    tau_F: float
    criterion: str

    @property
    def total(self) -> int:
        """How many rows there will be."""
        optima = len(self.kinds) if self.Ms is not None else 0
        return optima + sum(kind in rule.kinds for rule in RULES.values() for kind in self.kinds)


def question_of(design: Design) -> Question:
    """The question that the design asks."""
    asked = design.compared
    plant = design.plant if asked.plant == PRESENT else USUAL[asked.plant].plant
    tau_F = FILTER * scale_of(plant) if asked.tau_F is None else asked.tau_F
    return Question(plant, asked.kinds, asked.Ms, tau_F, asked.criterion)


class Rows:
    """The rows of one question, made one after the other by whoever asks first; all sessions see the same."""

    def __init__(self, question: Question):
        self._more = comparison(
            question.plant, question.kinds, question.Ms, question.tau_F, criterion=question.criterion
        )
        self._made: list[Row] = []
        self._lock = Lock()
        self.complete = False

    def __iter__(self) -> Iterator[Row]:
        i = 0
        while (row := self._row(i)) is not None:
            yield row
            i += 1

    def _row(self, i: int) -> Row | None:
        with self._lock:
            if i == len(self._made):
                row = next(self._more, None)
                if row is None:
                    self.complete = True
                    return None
                self._made.append(row)
            return self._made[i]


@lru_cache(maxsize=KEPT)
def rows_of(question: Question) -> Rows:
    """The rows of a question, as far as they are made. Raises SimcError."""
    return Rows(question)


@lru_cache(maxsize=8 * KEPT)
def best_beside(question: Question, kind: str, peak: float) -> Optimum | None:
    """The optimum with the same peak, None where none was found."""
    try:
        return optimal(question.plant, kind, peak, question.criterion, question.tau_F if kind == "PID" else None)
    except SimcError:
        return None


def key_of(row: Row) -> str:
    """What names a row in links and in clicks."""
    return f"{row.key}-{row.kind}"


def title_of(row: Row) -> Text:
    """The name of the rule, and the kind of controller."""
    if row.key == OPTIMAL:
        return said("optimum, {kind}", kind=row.kind)
    return said("{title}, {kind}", title=RULES[row.key].title, kind=row.kind)


def value_of(row: Row, criterion: str) -> float:
    """The criterion of a row."""
    return {"load": row.load, "setpoint": row.setpoint, "J": row.J}[criterion]


def frame(rows: Sequence[Row], question: Question, sheet: Sheet, more: Sequence[str] = ()) -> pd.DataFrame:
    """The table: numbers as numbers, so that they sort; columns with their units. more: measures that are shown too."""
    left_out = ("kind",) * (len(question.kinds) == 1) + ("τD",) * ("PID" not in question.kinds)
    units = UNITS | {label: MEASURES[label].unit for label in more}
    further = _further(question.plant, rows, more) if more else [{}] * len(rows)
    columns: dict[str, list] = {}
    for row, measured in zip(rows, further, strict=True):
        for name, value in _cells(row, question.Ms is not None, measured).items():
            if name not in left_out:
                columns.setdefault(with_plain_unit(name, unit_of(units.get(name, ""), sheet)), []).append(value)
    return pd.DataFrame(columns)


def _further(plant: Plant, rows: Sequence[Row], labels: Sequence[str]) -> list[dict[str, float]]:
    """Measures of each row, nan where there is no stable loop."""
    known = _measured(plant, tuple(row.controller for row in rows))
    return [dict.fromkeys(labels, math.nan) if each is None else values(each, labels) for each in known]


@lru_cache(maxsize=8)
def _measured(plant: Plant, controllers: tuple[Controller | None, ...]) -> list[Measured | None]:
    """What is known of the stable loops among these."""
    loops = [Loop(plant, each) for each in controllers if each is not None]
    judged = margins_many(loops)
    stable = [loop for loop, found in zip(loops, judged, strict=True) if found.stable]
    performed = dict(zip(stable, performance_many(stable), strict=True))
    known = {
        loop.controller: Measured(loop, found, steps if isinstance(steps := performed[loop], Performance) else None)
        for loop, found in zip(loops, judged, strict=True)
        if found.stable
    }
    return [known.get(each) if each is not None else None for each in controllers]


def _cells(row: Row, equal: bool, further: dict[str, float]) -> dict:
    Kc, tau_I, tau_D = _settings(row)
    known = {} if not equal else {"as published": row.published_Ms, "F": _none_is_nan(row.factor)}
    return {
        "rule": translated(OPTIMUM if row.key == OPTIMAL else SHORT.get(row.key) or RULES[row.key].title),
        "kind": row.kind,
        "Kc": Kc,
        "τI": tau_I,
        "τD": tau_D,
        "Mst": row.Mst,
        **known,
        "IAE load": row.load,
        "IAE set point": row.setpoint,
        "J": row.J,
        "behind, %": 100 * (0.0 if abs(row.behind) <= EQUAL else row.behind),
        "TV load": row.TV,
        "high-freq. gain": row.high_frequency_gain,
        **further,
        "in domain": "" if row.key == OPTIMAL else words("yes") if row.in_domain else words("no"),
        "source": "" if row.key == OPTIMAL else translated(RULES[row.key].source).strip("[]"),
        "remark": translated(row.refusal),
    }


def _settings(row: Row) -> tuple[float, float, float]:
    """Kc, tau_I, tau_D in ideal form; of integral action alone none of them."""
    if row.controller is None or isinstance(row.controller, IController):
        return math.nan, math.nan, math.nan
    found = sizes(row.controller.to_ideal())
    return found["Kc"], found["tau_I"], found["tau_D"]


def _none_is_nan(value: float | None) -> float:
    return math.nan if value is None else value


def shown(found: pd.DataFrame):
    """The table with four significant digits and a dash for what there is not; it sorts by the numbers behind."""
    numbers = [name for name in found.columns if found[name].dtype.kind == "f"]
    return found.style.format(number, subset=numbers)
