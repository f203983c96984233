"""A case of a lesson, opened as a link is: its design, and what is known of it, each computed once. No streamlit."""

import math
from collections.abc import Mapping
from functools import cached_property, lru_cache

from pages.common.from_data.work import Work, work_on_example
from pages.common.lessons.lesson import BASE, Lesson
from pages.common.rules.table import key_of, question_of
from pages.common.session import links
from pages.common.session.design import Design
from pages.common.studies.cascade import CascadeStudy
from pages.common.studies.cascade import study as cascade_study
from pages.common.studies.single import Study, present_study
from simc_core import (
    Identified,
    Margins,
    Relay,
    StaticErrors,
    Ultimate,
    comparison,
    relay_test,
    sampled_margins,
    static_errors,
    ultimate,
)
from simc_core.errors import InvalidParameter, NotStable
from simc_core.identification.rank import USUAL
from simc_core.reduction.half_rule import half_rule
from simc_core.reduction.records import Reduction
from simc_core.studies.comparison import Row
from simc_core.studies.with_actuator import AsBuilt, as_built
from simc_core.wording import said

KEPT = 32  # designs, of all sessions


def fields_of(lesson: Lesson, case: str) -> dict[str, str]:
    """The fields of a link that opens this case: those of the design, and further ones; an empty text takes one out."""
    both = {**lesson.design, **(lesson.cases[case] if case != BASE else {})}
    return {name: text for name, text in both.items() if text and name != "name"}


def design_of(lesson: Lesson, case: str) -> Design:
    """The design of a case. Raises InvalidParameter, which names the field that a link would ignore."""
    if case != BASE and case not in lesson.cases:
        raise InvalidParameter(said("there is no case {case}", case=case[:20]))
    design, ignored = links.decode(fields_of(lesson, case))
    if ignored:
        where = "design" if case == BASE else f"cases.{case}"
        raise InvalidParameter(
            said("{place}: {name}: {why}", place=where, name=ignored[0].name[:30], why=ignored[0].why)
        )
    return design


def check_designs(lesson: Lesson) -> None:
    """Whether every case opens. Raises InvalidParameter, which names the field."""
    for case in (BASE, *lesson.cases):
        design_of(lesson, case)


class Opened:
    """A design and what comes of it. Each property raises SimcError, in words, where there is no such thing."""

    def __init__(self, design: Design):
        self.design = design

    @cached_property
    def study(self) -> Study:
        """Controller, loop, margins."""
        return present_study(self.design)

    @cached_property
    def stable(self) -> Study:
        """The same, where the loop is stable."""
        if not self.study.stable:
            raise NotStable(said("the loop is not stable"))
        return self.study

    @cached_property
    def reduction(self) -> Reduction:
        """The model."""
        asked = self.design.tuning
        return half_rule(self.design.plant, asked.order, asked.h, rules=asked.rules, tau_F=asked.tau_F)

    @cached_property
    def rest(self) -> StaticErrors:
        """In the long run."""
        return static_errors(self.stable.loop)

    @cached_property
    def ultimate(self) -> Ultimate:
        """Of the plant."""
        return ultimate(self.design.plant)

    @cached_property
    def relay(self) -> Relay:
        """A relay of amplitude 1 on the plant."""
        return relay_test(self.design.plant, 1.0)

    @cached_property
    def built(self) -> AsBuilt:
        """The loop with its actuator."""
        return as_built(self.stable.loop, self.design.actuator.scenario(self.design.excitation))

    @cached_property
    def sampled(self) -> Margins:
        """Of the loop with its sampled controller."""
        actuator = self.design.actuator
        return sampled_margins(self.stable.loop, actuator.h, actuator.law)

    @cached_property
    def cascade(self) -> CascadeStudy:
        """Both loops."""
        return cascade_study(self.design.cascade)

    @cached_property
    def work(self) -> Work:
        """The record of the example."""
        return work_on_example(self.design.record.example)

    @cached_property
    def fits(self) -> Mapping[str, Identified]:
        """All usual structures, the best first."""
        part, why = self.work.part(self.design.record)
        if part is None:
            raise InvalidParameter(why)
        found = self.work.fitted(part, self.design.record, USUAL)
        if not found.found:
            raise InvalidParameter(found.why)
        return {each.structure: each for each in found.found}

    @cached_property
    def fit(self) -> Identified:
        """The structure that is chosen, else the best."""
        structure = self.design.record.structure
        if structure and structure not in self.fits:
            raise InvalidParameter(
                said(
                    "structure {structure} is none of those fitted here, {fitted}",
                    structure=structure,
                    fitted=", ".join(self.fits),
                )
            )
        return self.fits[structure] if structure else next(iter(self.fits.values()))

    @cached_property
    def row(self) -> Row:
        """The rule that is chosen on the page of rules."""
        asked = self.design.compared
        question = question_of(self.design)
        key, _, kind = asked.rule.partition("-")
        if not key:
            raise InvalidParameter(said("compared_rule must name a rule, such as simc-PI"))
        rows = comparison(question.plant, (kind,), question.Ms, question.tau_F, (key,), question.criterion)
        found = next(each for each in rows if key_of(each) == asked.rule)
        if not math.isfinite(found.Mst):
            raise NotStable(found.refusal or said("the loop is not stable"))
        return found


@lru_cache(maxsize=KEPT)
def opened(design: Design) -> Opened:
    """The design, opened once for all sessions."""
    return Opened(design)


class Cases:
    """The cases of a lesson by name, each opened when it is asked for."""

    def __init__(self, lesson: Lesson):
        self.lesson = lesson

    def __getitem__(self, case: str) -> Opened:
        return opened(design_of(self.lesson, case))
