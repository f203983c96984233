"""What a step shows beside its text: an instrument that moves, or figures."""

from pages.common import live
from pages.common.from_data.record_view import figure as record_figure
from pages.common.half_rule import view as half_rule_view
from pages.common.lessons.lesson import BASE, Lesson, Move
from pages.common.lessons.opened import design_of, opened
from pages.common.lessons.texts import label
from pages.common.parts.panel import show
from pages.common.session.design import Design
from pages.common.studies import cascade
from pages.common.studies.single import Study, present_study, study_of_settings, time_responses
from pages.common.tuning.panels import open_loop
from pages.common.words import words
from simc_core import Trend
from simc_core.figures import built_input_figure, built_output_figure, input_figure, output_figure
from simc_core.figures.trend import trend_figure
from simc_core.wording import said

HEIGHT = 260  # px


def stage(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    """The figure of a move for the design as it stands now. figures: names of numbers that are shown with it."""
    SHOWN[move.shows](lesson, move, design, figures)


def _behind(lesson: Lesson, move: Move) -> list[tuple[str, Study]]:
    return [(label(lesson, case), present_study(design_of(lesson, case))) for case in move.behind]


def _tau_c(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    live.tuning_instrument(design.plant, [(said("now"), present_study(design)), *_behind(lesson, move)])
    live.staged("tuning", move.panels, figures, move.view)


def _settings(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    live.hand_instrument(present_study(design), _behind(lesson, move), settings=True)
    live.staged("hand", move.panels, figures, move.view)


def _plant(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    present = present_study(design)
    live.hand_instrument(present, [(said("before"), present), *_behind(lesson, move)], settings=False)
    live.staged("hand", move.panels, figures, move.view)


def _cascade(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    live.cascade_instrument(design.cascade)
    live.staged("cascade", move.panels, figures, move.view)


def _single(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    courses = cascade.time_responses(cascade.study(design.cascade))
    show(output_figure(courses, HEIGHT), "single_y", words("Output y1 of the cascade and of a single loop: r, d1, d2"))
    show(input_figure(courses, HEIGHT), "single_u", words("Input u of the cascade and of a single loop"))


def _half_rule(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    reduction = opened(design).reduction
    half_rule_view.budget(reduction)
    half_rule_view.steps(reduction)


def _bode(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    open_loop([(said("now"), present_study(design)), *_behind(lesson, move)])


def _built(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    found = opened(design).built
    show(built_output_figure(found, HEIGHT), "built_y", words("Output y of the loop as built and of the linear loop"))
    show(built_input_figure(found, HEIGHT), "built_u", words("Input u of the loop as built and of the linear loop"))


def _trend(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    case = opened(design)
    trend = case.work.trend
    part, _ = case.work.part(design.record)
    chosen = case.fit if design.record.structure else None
    record_figure(trend, design, part, chosen)


def _relay(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    found = opened(design).relay
    figure = trend_figure(Trend(found.t, found.y, found.u), height=2 * HEIGHT)
    show(figure, "relay", words("Output and input of a plant under a relay"))


def _rules(lesson: Lesson, move: Move, design: Design, figures: tuple[str, ...]) -> None:
    first = said("now") if move.case == BASE else label(lesson, move.case)
    designs = [(first, design), *((label(lesson, case), design_of(lesson, case)) for case in move.behind)]
    studies = [study_of_settings(each.plant, opened(each).row.controller) for _, each in designs]
    courses = list(zip([name for name, _ in designs], time_responses(studies, design.excitation), strict=True))
    show(output_figure(courses, HEIGHT), "rules_y", words("Output y after a set-point step and a load step"))
    show(input_figure(courses, HEIGHT), "rules_u", words("Controller output u after a set-point step and a load step"))


SHOWN = {
    "tau_c": _tau_c,
    "settings": _settings,
    "plant": _plant,
    "cascade": _cascade,
    "single": _single,
    "half_rule": _half_rule,
    "bode": _bode,
    "built": _built,
    "trend": _trend,
    "relay": _relay,
    "rules": _rules,
}
