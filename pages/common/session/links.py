"""A Design as query parameters and back. Pure: no streamlit, so that it can be tested alone.

    plant, order, h, tau_c, b, filter, rules, speed, tau_F, rule, form
                                                     the design itself; from h on only where not the default
    facts                                            of the step test that the plant was made from
    own, now, controller                             my settings, those in the plant now, which of them is judged
    pins                                             order~h~tau_c~b~filter~rules~speed~tau_F~rule, or settings;
                                                     separated by !
    example, structure, begin, end, bad              what is chosen of a record on the page From data
    origin, uncertainty                              of a plant that was identified there
    box, rounding, language, exported                what the settings are typed into, or written as
    points, between                                  value~k~theta~tau1~tau2 of a gain schedule, separated by !
    tag, note, unit, PV, PV_unit, PV_low, ...        the loop sheet
    Ga, Gb, Ga_facts, method, ...                     the cascade, only where it is not the default
    u_min, u_max, T_t, noise, seed, sampling, law, scans,
    resolution, dead_band, backlash, rate_limit      the loop as built, only where it is not the default
    r, d, d_time, r_ramp, d_ramp                     set point and load in the figures
    r_low, r_high, r_rate                            limits of the set point in the controller
    compared_plant, compared_kind, compared_Ms, ...  what the page of rules compares

Numbers are written with all their digits, so that a link opens the very same design.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from urllib.parse import quote, urlencode

from pages.common.session.design import Design
from pages.common.session.fields import PLACES, get, put
from pages.common.session.record import (
    bad_of,
    bad_text,
    origin_of,
    origin_text,
    uncertainty_from,
    uncertainty_text,
)
from pages.common.session.tuning import Tuning
from simc_core import Plant, checks, parse_plant
from simc_core.controllers.forms import Controller, IController, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import SimcError
from simc_core.notation import plain
from simc_core.plants.step_facts import SettlingFacts, SlopeFacts, StepFacts
from simc_core.wording import said

LOST_PLUS = re.compile(r"((?<![A-Za-z])[sp](?:(?:\^|\*\*)\d+)?) (?=[\d.])")
# What course systems, mails and shops hang on every link to follow its reader: none of our business.
TRACKER = re.compile(r"(utm|mtm|pk)_\w+|(fb|g|dc|y|tw)clid|msclkid|[gw]braid|igshid|mc_[ce]id|_g[al]", re.IGNORECASE)
LONGEST_VALUE = 2000  # characters of one parameter; a plant of 40 poles needs fewer
TUNING_FIELDS = tuple(name for name, (record, _) in PLACES.items() if record == "tuning")
SETTINGS = ("own", "now")
FORM_NAMES = {"series": SeriesPid, "ideal": IdealPid, "parallel": ParallelPid, "I": IController}
TEXTS = (
    *("rules", "rule", "form", "speed", "controller", "box"),
    *("tag", "note", "unit", "PV", "PV_unit", "OP", "OP_unit"),
    *("method", "inner", "outer", "filter_outer", "law", "example", "structure"),
    *("rounding", "language", "exported", "between"),
    *("compared_plant", "compared_kind", "compared_criterion", "compared_rule"),
)
PLANTS = ("plant", "Ga", "Gb")
FACTS = ("facts", "Ga_facts", "Gb_facts")
FIRST_READ = (*SETTINGS, *PLANTS, "origin")  # what others refer to, in this order
ALWAYS = ("plant", "order")
FIRST = ("plant", *TUNING_FIELDS, "form", "pins")  # in an address; the others in the order of PLACES
ORDER = (*FIRST, *(name for name in PLACES if name not in FIRST))


@dataclass(frozen=True, slots=True)
class Ignored:
    """A parameter of an address that could not be used, and why."""

    name: str
    value: str
    why: str

    def __str__(self) -> str:
        return said("{given} was ignored: {why}", given=self.given, why=self.why)

    @property
    def given(self) -> str:
        """What stood there, shortened."""
        return f"{_short(self.name)} = {_short(self.value)}"


def encode(design: Design) -> dict[str, str]:
    """The query parameters of a design."""
    usual = _usual()
    return {name: text for name, text in _flat(design).items() if text and (name in ALWAYS or text != usual[name])}


def query(design: Design) -> str:
    """The query part of an address, escaped."""
    return urlencode(encode(design), quote_via=quote, safe="()*^/,~!")


def decode(parameters: Mapping[str, str]) -> tuple[Design, list[Ignored]]:
    """The design that the parameters say, and what of them could not be used.

    What they do not mention has its default, whatever was there before: a link always opens the same design.
    Parameters are taken one by one: a bad one leaves the default and does not spoil the others.
    """
    design, ignored = Design(), []
    for name, value in sorted(parameters.items(), key=lambda item: _turn(item[0])):
        try:
            design = _changed(design, name, value)
        except SimcError as error:
            ignored.append(Ignored(name, value, str(error)))
    return design, ignored


def _turn(name: str) -> int:
    return FIRST_READ.index(name) if name in FIRST_READ else len(FIRST_READ)


def without_trackers(parameters: Mapping[str, str]) -> dict[str, str]:
    """The parameters but for those that follow readers."""
    return {name: value for name, value in parameters.items() if not TRACKER.fullmatch(name)}


def number_text(value: float | None) -> str:
    """The shortest text that reads back as the same number; empty for None."""
    if value is None:
        return ""
    return repr(value).removesuffix(".0")


def _short(text: str) -> str:
    return text if len(text) <= 60 else text[:57] + "..."


@cache
def _usual() -> dict[str, str]:
    """The default design, which nothing changes."""
    return _flat(Design())


def _flat(design: Design) -> dict[str, str]:
    return {name: _text(name, get(design, name)) for name in ORDER}


def _changed(design: Design, name: str, text: str) -> Design:
    if len(text) > LONGEST_VALUE:
        raise SimcError(
            said("at most {longest_value} characters are read, found {n}", longest_value=LONGEST_VALUE, n=len(text))
        )
    if name not in PLACES:
        raise SimcError(said("no parameter has this name"))
    return put(design, name, origin_of(text, design.plant) if name == "origin" else _read(name, text))


def _text(name: str, value) -> str:
    if name in TEXTS:
        return value
    if name == "pins":
        return "!".join(map(_pin_text, value))
    if name == "points":
        return "!".join("~".join(map(number_text, point)) for point in value)
    if name in SETTINGS:
        return settings_text(value)
    if name in FACTS:
        return facts_text(value)
    if name == "origin":
        return origin_text(value)
    if name == "uncertainty":
        return uncertainty_text(value)
    if name == "bad":
        return bad_text(value)
    return plain(value) if name in PLANTS else number_text(value)


def _read(name: str, text: str):
    if name in TEXTS:
        return text
    if name in PLANTS:
        return _plant(text)
    if name == "pins":
        return tuple(map(_pin, text.split("!")))
    if name == "points":
        return tuple(tuple(_read(said("a number"), number) for number in point.split("~")) for point in text.split("!"))
    if name in SETTINGS:
        return settings_of(text)
    if name in FACTS:
        return facts_of(text)
    if name == "uncertainty":
        return uncertainty_from(text)
    if name == "bad":
        return bad_of(text)
    try:
        return float(text)
    except ValueError:
        raise SimcError(said("a number was expected")) from None


def _plant(text: str) -> Plant:
    """A plant of an address. One typed by hand has lost its + signs: an address says + for a space.

    A space after s or a power of s and before a digit can have been nothing else, 6s 1; other spaces stay refused.
    """
    try:
        return parse_plant(text)
    except SimcError as error:
        mended = LOST_PLUS.sub(r"\1+", text)
        if mended == text:
            raise
        try:
            return parse_plant(mended)
        except SimcError:
            raise SimcError(said("{error}; a + in an address is written %2B", error=error)) from None


def settings_text(controller: Controller | None) -> str:
    """form~settings~tau_F~b~c; empty for None."""
    if controller is None:
        return ""
    form = next(name for name, kind in FORM_NAMES.items() if isinstance(controller, kind))
    values = [getattr(controller, name) for name in (*controller.SETTINGS, *controller.OPTIONAL)]
    return "~".join([form, *map(number_text, values)])


def settings_of(text: str) -> Controller:
    """The controller of a text. Raises SimcError."""
    form, *values = text.split("~")
    kind = FORM_NAMES[checks.one_of("form", form, FORM_NAMES)]
    wanted = len(kind.SETTINGS) + len(kind.OPTIONAL)
    if len(values) != wanted:
        raise SimcError(
            said(
                "settings in {form} form have {wanted} values separated by ~, found {n}",
                form=form,
                wanted=wanted,
                n=len(values),
            )
        )
    return kind(*(_read("settings", value) for value in values))


def facts_text(facts: StepFacts | None) -> str:
    """step~dOP~dPV~theta~t63, movement~ the same, or slope~dOP~dPV~theta~duration; empty for None."""
    match facts:
        case None:
            return ""
        case SlopeFacts(dOP, dPV, theta, time):
            word = "slope"
        case SettlingFacts(dOP, dPV, theta, time, from_movement):
            word = "movement" if from_movement else "step"
    return "~".join([word, *map(number_text, (dOP, dPV, theta, time))])


def facts_of(text: str) -> StepFacts:
    """The facts of a text. Raises SimcError."""
    word, *values = text.split("~")
    if word not in ("step", "movement", "slope"):
        raise SimcError(said("facts begin with one of step, movement, slope, found {word}", word=word[:20]))
    if len(values) != 4:
        raise SimcError(said("facts of a step test have 4 values separated by ~, found {n}", n=len(values)))
    numbers = [_read("facts of a step test", value) for value in values]
    return SlopeFacts(*numbers) if word == "slope" else SettlingFacts(*numbers, word == "movement")


def _pin_text(pin: Tuning | Controller) -> str:
    if not isinstance(pin, Tuning):
        return settings_text(pin)
    return "~".join(_text(name, getattr(pin, name)) for name in TUNING_FIELDS)


def _pin(text: str) -> Tuning | Controller:
    values = text.split("~")
    if values[0] in FORM_NAMES:
        return settings_of(text)
    if not 0 <= len(TUNING_FIELDS) - len(values) <= 3:  # links of before have no speed, tau_F or rule
        raise SimcError(
            said(
                "a pinned tuning has {n} values separated by ~, found {given}", n=len(TUNING_FIELDS), given=len(values)
            )
        )
    given = dict(zip(TUNING_FIELDS, values, strict=False))
    return Tuning(**{name: _read(name, value) for name, value in given.items() if value})
