"""Number fields that together make a plant: one kind of them is shown, and the plant follows when none is missing."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

import streamlit as st

from pages.common.parts.number_field import number_field
from pages.common.parts.symbols import symbols
from pages.common.parts.units import unit_of
from pages.common.session import state
from pages.common.session.sheet import Sheet
from pages.common.words import numeral, translated, words
from simc_core import Plant, read_back
from simc_core.errors import SimcError


@dataclass(frozen=True, slots=True)
class Field:
    """empty: what no number means, None where there must be one.   unit: in terms of unit_of.   help: below a mark."""

    label: str
    check: Callable[[str, float], float]
    empty: float | None = None
    unit: str = "time"
    help: str | None = None


@dataclass(frozen=True, slots=True)
class NumberForm:
    """One way of entering a plant.

    way: its name in keys.   label: of the choice of kind.   fields: by name.   kinds: names of the fields of each kind.
    begun: kind and numbers of the plant called so in design.py, kind None where it is none of these.
    change: what the numbers of one kind change in the design. Raises SimcError.
    """

    way: str
    label: str
    fields: dict[str, Field]
    kinds: dict[str, tuple[str, ...]]
    begun: Callable[[str], tuple[str | None, dict[str, float]]]
    change: Callable[[str, str, dict[str, float]], dict]

    def missing(self, kind: str, given: dict[str, float]) -> list[str]:
        """Labels of what must be a number and is none yet."""
        return [
            self.fields[name].label
            for name in self.kinds[kind]
            if name not in given and self.fields[name].empty is None
        ]

    def in_words(self, error: SimcError) -> str:
        """What the core refuses, with the fields called as on the page."""
        names = {name: translated(field.label) for name, field in self.fields.items()}
        found = re.compile("|".join(rf"\b{name}\b" for name in names))
        return found.sub(lambda name: names[name[0]], translated(str(error)))

    def numbers(self, kind: str, given: dict[str, float]) -> dict[str, float]:
        """Those given, and what an empty field means."""
        return {name: given.get(name, self.fields[name].empty) for name in self.kinds[kind]}


@dataclass(slots=True)
class _Typed:
    """The numbers typed so far, the plant they were begun from or have made, and why they make none."""

    plant: Plant
    kind: str | None
    given: dict[str, float] = field(default_factory=dict)
    why: str = ""


def show(form: NumberForm, name: str) -> None:
    """The fields of one kind for the plant called `name` in design.py."""
    plant = state.value(name)
    typed = state.memory(f"{name}_{form.way}", lambda: _Typed(plant, *form.begun(name)))
    if typed.plant != plant:
        kind, given = form.begun(name)
        typed.plant, typed.kind, typed.given, typed.why = plant, kind or typed.kind, given, ""
    key = f"{name}_{form.way}_kind"
    state.set_widget(key, typed.kind or next(iter(form.kinds)))
    kind = st.segmented_control(
        translated(form.label),
        list(form.kinds),
        format_func=translated,
        key=key,
        required=True,
        on_change=_take_kind,
        args=(form, name, typed, key),
    )
    for part in form.kinds[kind]:
        _field(form, name, kind, part, typed)
    if missing := form.missing(kind, typed.given):
        st.caption(
            words(
                "Still to fill in: {missing}. Until then the plant stays as it is.",
                missing=", ".join(map(translated, missing)),
            )
        )
    elif typed.why:
        st.error(words("{why}. The plant stays as it is.", why=symbols(typed.why)))
    else:
        st.caption(words("Read: {plant}.", plant=symbols(read_back(plant))))


def _field(form: NumberForm, name: str, kind: str, part: str, typed: _Typed) -> None:
    about = form.fields[part]
    number_field(
        translated(about.label),
        typed.given.get(part),
        lambda value: value is None or about.check(translated(about.label), value),
        partial(_take, form, name, kind, part, typed),
        f"{name}_{form.way}_{part}",
        unit=unit_of(about.unit, _sheet(name)),
        optional=True,
        placeholder=words("needed") if about.empty is None else numeral(f"{about.empty:g}"),
        help=translated(about.help) if about.help else None,
    )


def _sheet(name: str) -> Sheet:
    """Units of this plant: the signals of the sheet are those of the single loop."""
    sheet = state.design_now().sheet
    return sheet if name == "plant" else Sheet(time_unit=sheet.time_unit)


def _take(form: NumberForm, name: str, kind: str, part: str, typed: _Typed, value: float | None) -> None:
    typed.given.pop(part, None)
    if value is not None:
        typed.given[part] = value
    _settle(form, name, kind, typed)


def _take_kind(form: NumberForm, name: str, typed: _Typed, key: str) -> None:
    if state.overtaken(key):
        return
    _settle(form, name, state.widget(key), typed)


def _settle(form: NumberForm, name: str, kind: str, typed: _Typed) -> None:
    """The plant of this kind, once nothing is missing; numbers that only another kind needs are kept for it."""
    typed.kind, typed.why = kind, ""
    if form.missing(kind, typed.given):
        return
    try:
        change = form.change(name, kind, form.numbers(kind, typed.given))
    except SimcError as error:
        typed.why = form.in_words(error)
        return
    typed.plant = change[name]
    state.change(**change)
