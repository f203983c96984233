"""A lesson as a record, with its bounds. Pure: no streamlit.

A lesson has steps: free play, the question, one or more moves, the answer, the numbers. `data/` holds those of the
program, one file each; read.py reads a file, and says what is wrong with it.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from pages.common.parts.quantities import QUANTITIES
from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.wording import said

SUBJECTS = {  # in the order in which they are taught
    "reduction": said("From many lags to a model"),
    "speed": said("Speed against robustness"),
    "integral": said("Slow, fast and integrating plants"),
    "derivative": said("Derivative action"),
    "delay": said("Dead time"),
    "unstable": said("Unstable plants"),
    "response": said("What a good response is"),
    "rules": said("Tuning rules compared"),
    "identification": said("From a record to a model"),
    "built": said("The loop as it is built"),
    "cascade": said("Cascades"),
}
SHOWS = ("tau_c", "settings", "plant", "cascade", "single", "half_rule", "bode", "built", "trend", "rules", "relay")
MOVING = ("tau_c", "settings", "plant", "cascade")  # with something to move, and numbers
PANELS = ("y", "u", "nyquist", "sensitivity")
VIEWS = ("responses", "tradeoff")
BASE = "base"  # the case of the design alone
ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9_]{0,11}")
CASE = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,15}")
LABEL = re.compile(r"[\w =.,]{1,16}")  # of a case in legends, which read more than that as markup
MOST_NUMBERS = 4  # in sight at once
MOST = {"choices": 5, "cases": 8, "moves": 6, "claims": 12, "printed": 12, "behind": 3, "checks": 8, "design": 40}
LONGEST = {"title": 60, "where": 80, "text": 700, "name": 60, "check": 200, "value": 20}


@dataclass(frozen=True, slots=True)
class Move:
    """What is done and looked at in one step.

    text: what to do.   case: whose design stands there at first.   shows: what moves, or what is drawn, of SHOWS.
    view: of the figures that move.   panels: which of them, all where none is named.
    behind: cases that are drawn behind.
    """

    text: str
    case: str = BASE
    shows: str = "tau_c"
    view: str = "responses"
    panels: tuple[str, ...] = ()
    behind: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        _text("text", self.text)
        checks.one_of("shows", self.shows, SHOWS)
        checks.one_of("view", self.view, VIEWS)
        for panel in self.panels:
            checks.one_of("panels", panel, PANELS)
        _few("behind", self.behind)


@dataclass(frozen=True, slots=True)
class Claim:
    """A sentence of the answer, and what must hold for it to be true (claims.py)."""

    says: str
    checks: tuple[str, ...]

    def __post_init__(self) -> None:
        _text("says", self.says)
        _few("checks", self.checks, least=1)
        for each in self.checks:
            _text("checks", each, "check")


@dataclass(frozen=True, slots=True)
class Printed:
    """A number of the source.

    name: what it is.   of: an expression for ours.   value: as printed.   where: page, table or equation.
    differs: why ours is another one, where it is.
    """

    name: str
    of: str
    value: str
    where: str
    differs: str = ""

    def __post_init__(self) -> None:
        _text("name", self.name, "name")
        _text("of", self.of, "check")
        _text("value", self.value, "value")
        _text("where", self.where, "where")
        if self.differs:
            _text("differs", self.differs)
        try:
            float(self.value)
        except ValueError:
            raise InvalidParameter(
                said("value must be a number in quotes, found {found}", found=self.value[:20])
            ) from None


@dataclass(frozen=True, slots=True)
class Lesson:
    """id, title, subject.   source: key in square brackets elsewhere, "" for none; where: in it.

    question, choices, and the right one, counted from 1.   design: fields of a link.
    cases: further fields by name of the case, and its `name` in legends.
    play: the free beginning.   moves: after the prediction.   numbers: cells that are shown at the end.
    answer: in one or two sentences.   misprint: of the source.   own: of the program, not opened from a file.
    """

    id: str
    title: str
    subject: str
    question: str
    choices: tuple[str, ...]
    right: int
    answer: str
    design: Mapping[str, str]
    play: Move
    moves: tuple[Move, ...]
    source: str = ""
    where: str = ""
    cases: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    numbers: tuple[str, ...] = ()
    claims: tuple[Claim, ...] = ()
    printed: tuple[Printed, ...] = ()
    misprint: str = ""
    own: bool = False

    def __post_init__(self) -> None:
        if not ID.fullmatch(self.id):
            raise InvalidParameter(said("id must be 1 to 12 letters and digits, found {found}", found=self.id[:20]))
        _text("title", self.title, "title")
        checks.one_of("subject", self.subject, SUBJECTS)
        for name in ("question", "answer"):
            _text(name, getattr(self, name))
        if self.where:
            _text("where", self.where, "where")
        if self.misprint:
            _text("misprint", self.misprint)
        _few("choices", self.choices, least=2)
        for each in self.choices:
            _text("choices", each)
        if len(set(self.choices)) < len(self.choices):
            raise InvalidParameter(said("choices must differ from one another"))
        if not 1 <= self.right <= len(self.choices):
            raise InvalidParameter(
                said("right must be one of 1 to {n}, found {found}", n=len(self.choices), found=self.right)
            )
        for name in ("moves", "claims", "printed"):
            _few(name, getattr(self, name), least=int(name == "moves"))
        _few("cases", tuple(self.cases))
        for case in self.cases:
            if not CASE.fullmatch(case) or case == BASE:
                raise InvalidParameter(
                    said(
                        "a case is named by 1 to 16 letters and digits, not {base}, found {found}",
                        base=BASE,
                        found=case[:20],
                    )
                )
            label = self.label(case)
            if not LABEL.fullmatch(label):
                raise InvalidParameter(
                    said(
                        "cases.{case}: name must be 1 to 16 letters, digits and = . , found {found}",
                        case=case,
                        found=label[:20],
                    )
                )
        if len(self.numbers) > MOST_NUMBERS:
            raise InvalidParameter(
                said("numbers must be at most {most}, found {found}", most=MOST_NUMBERS, found=len(self.numbers))
            )
        for name in self.numbers:
            checks.one_of("numbers", name, QUANTITIES)
        for move in (self.play, *self.moves):
            for case in (move.case, *move.behind):
                checks.one_of("case", case, (BASE, *self.cases))

    def label(self, case: str) -> str:
        """Of a case in legends: its `name`, or what it is called in checks."""
        return self.cases.get(case, {}).get("name", case).replace("_", " ")

    @property
    def steps(self) -> int:
        """How many there are: play, question, moves, answer, and numbers where there are any."""
        moving = self.moves[-1].shows in MOVING
        return self.answer_at + bool(self.printed or self.misprint or (self.numbers and moving))

    @property
    def answer_at(self) -> int:
        """The step of the answer."""
        return len(self.moves) + 3

    def move_at(self, step: int) -> Move | None:
        """What is shown at a step, counted from 1; None where the question stands alone."""
        if step <= 1:
            return self.play
        return None if step == 2 else self.moves[min(step - 3, len(self.moves) - 1)]


def _text(field_name: str, value: str, kind: str = "text") -> None:
    if not value.strip() or len(value) > LONGEST[kind]:
        raise InvalidParameter(
            said(
                "{name} must have 1 to {most} characters, found {found}",
                name=field_name,
                most=LONGEST[kind],
                found=len(value),
            )
        )


def _few(name: str, items: tuple, least: int = 0) -> None:
    if not least <= len(items) <= MOST[name]:
        raise InvalidParameter(
            said(
                "{name} must be {least} to {most}, found {found}",
                name=name,
                least=least,
                most=MOST[name],
                found=len(items),
            )
        )
