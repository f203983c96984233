"""What a report tells of a loop: plant, design, what is typed, margins, responses, what to watch. Pure."""

import math
import re
from dataclasses import dataclass, replace
from datetime import date
from typing import NamedTuple

from pages.common.parts.settings_text import as_text
from pages.common.parts.units import measured
from pages.common.session.design import Design
from pages.common.session.sheet import Sheet
from pages.common.studies.single import Study, attempt, judged_settings
from pages.common.take_home.proof import (
    AS_TYPED,
    DESIGN,
    longest_period,
    not_drawn,
    responses,
    sampled,
    sampled_response,
)
from pages.common.take_home.typed import SPAN, assumed, name_of, rows, typed_into
from simc_core import BOXES, Typed
from simc_core.errors import SimcError
from simc_core.implementation.boxes.box import DIRECT, REVERSE
from simc_core.implementation.single_precision import dead_error
from simc_core.notation import number, plain
from simc_core.plants.step_facts import SlopeFacts, StepFacts
from simc_core.published.sources import SOURCES
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.simulation import TimeResponse
from simc_core.studies.advice import advice
from simc_core.studies.own_settings import advice_on_settings
from simc_core.wording import Numeral, Text, joined, said

NOW = said("now")  # column and curve
FORMS = {"series": said("series"), "ideal": said("ideal"), "parallel": said("parallel")}
WORDS = {word: word for word in (said("action"), said("no integral"), REVERSE, DIRECT)}  # of settings as text
FIRST_WORD = re.compile(r"[^\W\d_]{3,}(?![\w/])")
BLIND = 1e-3  # of the range of PV: an error that REAL no longer sees and that is larger is told


class Row(NamedTuple):
    """A number with its name and unit, as text, of which what is to be translated still can."""

    name: str
    value: str
    unit: str


@dataclass(frozen=True, slots=True, eq=False)
class Report:
    """One loop on one page.

    tag, note, made: what it is called, a remark, the day.   plant, kind, came_from: transfer function, what sort, and
    where it came from.   signals: names, units and ranges.   how: the controller came about.   settings: of the design.
    box, typed: what they are typed into, and the numbers there; empty without one.   margins: by title.
    curves: responses by name, in the order in which they are drawn.   asked: of the loop in them, in words.
    time, y, u: units, empty where they have no name.
    """

    tag: str
    note: str
    made: str
    plant: str
    kind: str
    came_from: str
    signals: tuple[Row, ...]
    how: str
    settings: tuple[Row, ...]
    box: str
    typed: tuple[Row, ...]
    margins: dict[str, Margins]
    curves: dict[str, TimeResponse]
    asked: str
    watch: tuple[str, ...]
    sources: tuple[str, ...]
    link: str
    time: str
    y: str
    u: str


def report(design: Design, present: Study, link: str) -> Report:
    """The report of a design; `present` is its study. What cannot be told of it is under "What to watch"."""
    sheet, typed, watch = design.sheet, None, []
    if design.box:
        try:
            typed = typed_into(design.box, present.controller, sheet, design.home.rounding == "safe")
        except SimcError as error:
            watch.append(
                said("{box} does not take this design: {error}.", box=BOXES[design.box].title, error=str(error))
            )
    final = judged_settings(design.plant, typed.effective) if typed else present
    margins: dict[str, Margins] = {DESIGN: present.margins}
    if typed:
        margins[AS_TYPED] = final.margins
    if design.actuator.h:
        try:
            margins |= dict([sampled(final.loop, design)])
            watch += _on_sampling(final, design)
        except SimcError as error:
            watch.append(str(error))
    before = attempt(lambda: judged_settings(design.plant, design.now))[0] if design.now else None
    curves, why = _responses(design, present, final, before)
    return Report(
        tag=sheet.tag,
        note=sheet.note,
        made=date.today().isoformat(),
        plant=f"G(s) = {plain(design.plant)}",
        kind=design.plant.kind,
        came_from=_came_from(design.facts, sheet),
        signals=tuple(_signals(sheet)),
        how=_how(design, present),
        settings=_settings(design, present),
        box=name_of(design.box) if typed else "",
        typed=tuple(Row(row["field"], row["value"], row["unit"]) for row in rows(design.box, typed, sheet))
        if typed
        else (),
        margins=({NOW: before.margins} if before else {}) | margins,
        curves=curves,
        asked=_asked(design),
        watch=(*watch, *why, *_watch(design, present, typed)),
        sources=tuple(_sources(design)),
        link=link,
        time=sheet.time_unit,
        y=sheet.PV_unit,
        u=sheet.OP_unit,
    )


def _responses(
    design: Design, present: Study, final: Study, before: Study | None
) -> tuple[dict[str, TimeResponse], list[str]]:
    """The new loop, as it is built where that can be simulated, the design, and the loop now; what could not be."""
    built = replace(design.actuator.scenario(design.excitation).actuation, noise=0.0)
    found: dict[str, TimeResponse] = {}
    why: list[str] = []
    if final is not present or not built.linear:
        name = said("as built") if not built.linear else AS_TYPED
        try:
            found[name] = sampled_response(present.loop, final.loop, design, built)
        except SimcError as error:
            why.append(not_drawn(name, final.loop, error))
    loops = {DESIGN: present.loop} | ({NOW: before.loop} if before else {})
    others, why_not = responses(present.loop, loops, design)
    return found | others, why + why_not


def _how(design: Design, present: Study) -> str:
    if present.tuned is None:
        return said("my settings")
    tau_c = measured(present.tau_c, design.sheet.time_unit)
    return said(
        "SIMC {kind}, tau_c = {tau_c}, model {model}", kind=design.tuning.kind, tau_c=tau_c, model=plain(present.model)
    )


def _settings(design: Design, present: Study) -> tuple[Row, ...]:
    controller, form = present.controller, design.form
    form = form if controller.has_form(form) else "parallel"
    lines = [line.partition(" = ") for line in as_text(controller, form, design.sheet).splitlines()]
    found = []
    for name, _, rest in lines:
        value, _, unit = rest.partition(" ") if rest[0].isdigit() else (rest, "", "")
        found.append(Row(WORDS.get(name, name), WORDS.get(value) or Numeral(value), unit))
    return (Row(said("form"), FORMS[form], ""), *found)


def _came_from(facts: StepFacts | None, sheet: Sheet) -> str:
    match facts:
        case None:
            return said("typed as a transfer function")
        case SlopeFacts():
            last = said("slope over {time}", time=measured(facts.duration, sheet.time_unit))
        case StepFacts(from_movement=True):
            last = said("63 % from the movement after {time}", time=measured(facts.t63, sheet.time_unit))
        case _:
            last = said("63 % after {time}", time=measured(facts.t63, sheet.time_unit))
    parts = [
        said("OP by {change}", change=measured(facts.dOP, sheet.OP_unit)),
        said("PV by {change}", change=measured(facts.dPV, sheet.PV_unit)),
        said("dead time {time}", time=measured(facts.theta, sheet.time_unit)),
        last,
    ]
    return said("step test: {facts}", facts=joined(parts))


def _signals(sheet: Sheet) -> list[Row]:
    found = []
    for signal in ("PV", "OP"):
        name, unit, low, high, now = (
            getattr(sheet, f"{signal}{end}") for end in ("", "_unit", "_low", "_high", "_now")
        )
        if name:
            found.append(Row(signal, name, unit))
        if low is not None and high is not None:
            found.append(
                Row(
                    said("range of {signal}", signal=signal),
                    said("{low} to {high}", low=number(low), high=number(high)),
                    unit,
                )
            )
        if now is not None:
            found.append(Row(said("{signal} now", signal=signal), number(now), unit))
    return found


def _asked(design: Design) -> str:
    asked, sheet = design.excitation, design.sheet
    told = [
        said("set point {size}", size=measured(asked.reached, sheet.PV_unit)),
        said("then load {size}", size=measured(asked.disturbance, sheet.OP_unit)),
    ]
    match design.actuator.u_min, design.actuator.u_max:
        case None, None:
            pass
        case low, None:
            told.append(said("{u} from {low}", u=sheet.u_name, low=measured(sheet.on_scale(low), sheet.OP_unit)))
        case None, high:
            told.append(said("{u} to {high}", u=sheet.u_name, high=measured(sheet.on_scale(high), sheet.OP_unit)))
        case low, high:
            told.append(
                said(
                    "{u} from {low} to {high}",
                    u=sheet.u_name,
                    low=number(sheet.on_scale(low)),
                    high=measured(sheet.on_scale(high), sheet.OP_unit),
                )
            )
    return joined(told)


def _on_sampling(final: Study, design: Design) -> list[Text]:
    """Where h is too long, and what an integral in 32 bits does not see."""
    found, h = [], design.actuator.h
    longest, sheet = longest_period(final.loop, design.actuator.law, design.actuator.delay_scans), design.sheet
    if h > longest:
        period = measured(longest, sheet.time_unit)
        found.append(
            said("Sampling is slow for this loop: with {period} or less Ms rises by 5 % at most.", period=period)
        )
    spans = [(sheet.PV_low, sheet.PV_high), (sheet.OP_low, sheet.OP_high)]
    PV, OP = ((0.0, SPAN) if None in ends else ends for ends in spans)
    blind = dead_error(max(map(abs, OP)), final.controller.to_parallel().Ki, h)
    if BLIND * (PV[1] - PV[0]) < blind < math.inf:
        found.append(
            said(
                "Where the box integrates in REAL (32 bits), an error below {size} does not move its integral: "
                "take LREAL or a slower task.",
                size=measured(blind, sheet.PV_unit, 2),
            )
        )
    return found


def _watch(design: Design, present: Study, typed: Typed | None) -> list[str]:
    advised = advice(present.tuned) if present.tuned else advice_on_settings(present.loop, present.margins)
    found: list[str] = [
        joined(filter(None, (joined((item.headline, "."), ""), item.text, item.remedy)), " ")
        for item in advised
        if item.level != "note"
    ]
    if typed:
        found += typed.warnings
        found += [said("The loop sheet does not tell it: {assumed}.", assumed=what) for what in assumed(design.sheet)]
    return found


def _sources(design: Design) -> list[str]:
    found = [joined(("[SK03]", SOURCES["SK03"]), " ")] if design.source == "simc" else []
    if design.box:
        box = BOXES[design.box]
        found.append(
            said("Law of the box as read in: {source}, a text of its maker.", source=box.source)
            if box.verified == "maker"
            else said("Law of the box as read in: {source}, a text of a third party.", source=box.source)
        )
    return found


def beginning(text: str) -> str:
    """With a capital at its beginning, unless that is a symbol."""
    return text[0].upper() + text[1:] if FIRST_WORD.match(text) else text


def plant_rows(report: Report) -> list[Row]:
    """What is told of the plant."""
    rows = [
        Row(said("plant"), report.plant, ""),
        Row(said("kind"), report.kind, ""),
        Row(said("from"), report.came_from, ""),
    ]
    return [*rows, Row(said("note"), report.note, "")] if report.note else rows
