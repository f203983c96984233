"""The record that is being worked on: read once, then cut, cleaned and fitted. Pure: no streamlit."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from pages.common.from_data.examples import EXAMPLES, text_of
from pages.common.session.record import Chosen
from simc_core import Identified, SimcError, Trend, checks, find_moves, identify_all
from simc_core.identification.moves import Move
from simc_core.identification.reading.meaning import Reading, understand
from simc_core.identification.reading.reader import load
from simc_core.identification.reading.table import Table
from simc_core.identification.uncertainty import NEAR
from simc_core.wording import Text, said

OF_A_FILE = ("decimal", "day_first", "sheet")  # what a file must be read anew for
NO_UNIT = said("no unit")
MORE = ("inverse", "oscillating", "DIPDT", "unstable")


@dataclass(slots=True)
class Fits:
    """What came of the fitting of one part of a record. why: the refusal, where there is one.

    known: what was computed from them, by name.
    """

    of: tuple[Any, ...]
    found: tuple[Identified, ...] = ()
    why: str = ""
    known: dict[tuple[Any, ...], tuple[Any, str]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Along:
    """A record beside another.

    part: of it that is fitted along.   number: its place among the records that are fitted, from 2; 0 where it is not.
    why: there is no part.
    """

    name: str
    part: Trend | None
    number: int
    why: str


@dataclass(slots=True)
class Work:
    """A record.

    name: of the file or example.   example: its key, "" for a file.   content: of the file, kept while a question about
    it is open only.   how: answers that were given, by names of arguments of `read_trend`.
    reading: what it was understood to be.   fits: of the part that is fitted at present.
    beside: other records of the same process, fitted together with this one.   chosen: what was chosen of it while it
    was the one that is shown; of the shown one the design knows it.
    """

    name: str
    example: str
    content: bytes | str | None
    table: Table
    reading: Reading
    how: dict[str, Any] = field(default_factory=dict)
    fits: Fits | None = None
    beside: list["Work"] = field(default_factory=list)
    chosen: Chosen = field(default_factory=Chosen)

    @property
    def trend(self) -> Trend | None:
        """The whole record."""
        return self.reading.trend

    @property
    def refusal(self) -> str:
        """Why there is no trend; what the library calls the argument that helps is a field of the page."""
        why = self.reading.refusal
        return why.put(argument="") if isinstance(why, Text) and "argument" in why.values else why

    def answer(self, name: str, value: Any) -> None:
        """Take an answer and understand the record anew. Raises SimcError, and then nothing has changed."""
        how = self.how | {name: value}
        table = self.table
        if name in OF_A_FILE and self.content is not None:
            table = load(self.content, **{key: how[key] for key in OF_A_FILE if key in how})
        reading = _understood(table, how)
        self.how, self.table, self.reading, self.fits = how, table, reading, None

    def part(self, chosen: Chosen) -> tuple[Trend | None, str]:
        """The part that is fitted; None, and why, where there is none."""
        if self.trend is None:
            return None, self.refusal
        try:
            return _cut(self.trend, chosen), ""
        except SimcError as error:
            return None, str(error)

    def along(self) -> list["Along"]:
        """The records beside this one, in order, with the part of each that is fitted along, or why there is none."""
        found: list[Along] = []
        unit = self.trend.units.get("t", "") if self.trend is not None else ""
        for other in self.beside:
            part, why = other.part(other.chosen)
            if part is not None and part.units.get("t", "") != unit:
                own = part.units.get("t") or NO_UNIT
                part, why = None, said("its time is in {own}, here in {unit}", own=own, unit=unit or NO_UNIT)
            fitted = sum(each.part is not None for each in found)
            found.append(Along(other.name, part, 2 + fitted if part is not None else 0, why))
        return found

    def parts(self, own: Trend) -> list[Trend]:
        """All that is fitted together, `own` of this record the first."""
        return [own, *(each.part for each in self.along() if each.part is not None)]

    def names(self) -> list[str]:
        """Names of the records that are fitted together, in the same order."""
        return [self.name, *(each.name for each in self.along() if each.part is not None)]

    def shown_instead(self, i: int, chosen: Chosen) -> "Work":
        """The record beside this one that is to be shown; this one, of which `chosen` was chosen, is beside it then."""
        other = self.beside[i]
        rest = [each for each in self.beside if each is not other]
        self.chosen, self.beside, self.fits = chosen, [], None
        other.beside, other.fits = [self, *rest], None
        return other

    def fitted(
        self,
        trend: Trend,
        chosen: Chosen,
        structures: tuple[str, ...],
        progress: Callable[[int, int], None] | None = None,
    ) -> Fits:
        """All structures fitted to this part and the records beside, kept until another part is asked for."""
        if self.fits is None or not self.is_fitted(chosen, structures):
            of = self._asked(chosen, structures)
            try:
                self.fits = Fits(of, identify_all(self.parts(trend), structures, progress=progress))
            except SimcError as error:
                self.fits = Fits(of, why=str(error))
        return self.fits

    def is_fitted(self, chosen: Chosen, structures: tuple[str, ...]) -> bool:
        """Whether this part has been fitted."""
        return self.fits is not None and self.fits.of == self._asked(chosen, structures)

    def _asked(self, chosen: Chosen, structures: tuple[str, ...]) -> tuple[Any, ...]:
        others = tuple((id(each.reading), each.chosen) for each in self.beside)
        return (chosen.begin, chosen.end, chosen.bad, structures, others)


def nearly(fits: Fits, model: Identified) -> tuple[Identified, ...]:
    """The model, and the others that fit nearly as well: all that the record leaves open."""
    others = (each for each in fits.found if each is not model and each.criterion <= NEAR)
    return (replace(model, criterion=0.0), *others)


def kept(fits: Fits, key: tuple[Any, ...], make: Callable[[], Any]) -> tuple[Any, str]:
    """What was computed for these fits already, else now; and why there is nothing."""
    if key not in fits.known:
        try:
            fits.known[key] = (make(), "")
        except SimcError as error:
            fits.known[key] = (None, str(error))
    return fits.known[key]


def _cut(trend: Trend, chosen: Chosen) -> Trend:
    """The part without what is left out. Raises SimcError where nothing is left."""
    if chosen.begin is not None or chosen.end is not None:
        ends = (chosen.begin, chosen.end)
        begin, end = (usual if given is None else given for given, usual in zip(ends, ends_of(trend), strict=True))
        trend = trend.between(begin, end)
    for low, high in chosen.bad:
        trend = trend.without(low, high)
    return trend


def work_on(name: str, content: bytes | str, example: str = "") -> Work:
    """A record from the content of a file, or a paste. Raises SimcError."""
    table = load(content)
    reading = _understood(table, {})
    asked = any(question.name in OF_A_FILE for question in reading.questions) or len(table.sheets) > 1
    return Work(name, example, content if asked else None, table, reading)


def work_on_example(key: str) -> Work:
    """A record that the program makes. Raises SimcError."""
    checks.one_of("example", key, EXAMPLES)
    return work_on(EXAMPLES[key].title, text_of(key), key)


def _understood(table: Table, how: dict[str, Any]) -> Reading:
    return understand(table, **{key: value for key, value in how.items() if key not in ("decimal", "sheet")})


def ends_of(trend: Trend) -> tuple[float, float]:
    """First and last instant."""
    return float(trend.t[0]), float(trend.t[-1])


def moves_of(trend: Trend) -> tuple[Move, ...]:
    """Moves of OP that are few enough to be meant one by one."""
    found = find_moves(trend)
    return found if len(found) <= 40 else ()
