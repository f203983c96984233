"""The number field of the whole app: decimal comma or point, 11/5, any minus sign; what was typed stays as typed.

Streamlit's own number field drops a comma, so that 0,5 becomes 5. This one is a text field read by the core. A text
that cannot be read, or a number that cannot be used, stays in the field with the reason below it, while the last good
value stays in use.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.parts.foreign_text import told
from pages.common.parts.symbols import symbols
from pages.common.parts.units import unit_of, with_unit
from pages.common.session import links, state
from pages.common.session.fields import PLACES
from pages.common.words import language, numeral, words
from simc_core.errors import SimcError
from simc_core.numbers import read_number
from simc_core.wording import Text


def number_text(value: float | None) -> str:
    """All digits of a number, with the decimal sign of the language."""
    return numeral(links.number_text(value))


@dataclass(slots=True)
class _Typed:
    """What stands in a field, the value in use that it was last seen with, and why it cannot be used itself."""

    text: str
    value: float | None
    why: str = ""
    language: str = field(default_factory=language)

    def retell(self, why: str) -> None:
        """In another language: the reason anew, and a plain number with its decimal sign."""
        if self.language == language():
            return
        self.language, self.why = language(), why
        if self.text.replace(",", ".") == links.number_text(self.value):
            self.text = number_text(self.value)


def number_field(
    label: str,
    value: float | None,
    check: Callable[[float | None], object],
    take: Callable[[float | None], object],
    key: str,
    *,
    unit: str = "",
    optional: bool = False,
    place: DeltaGenerator | None = None,
    under: DeltaGenerator | None = None,
    **options,
) -> None:
    """A field for one number.

    Parameters
    ----------
    label
        Name of the field, in plain words or Unicode; messages use it too.
    value
        The number in use, None for none.
    check
        Raises SimcError where a number cannot be used, and changes nothing.
    take
        Puts a number that passed `check` to use.
    key
        Of the widget.
    unit
        The user's name of its unit, which the label shows.
    optional
        Whether the field may be empty, which gives None.
    place, under
        Where the field stands, and where a refusal is told; below the field unless given.
    **options
        Of st.text_input: help, placeholder, width, label_visibility.
    """
    typed = state.memory(f"number_{key}", lambda: _Typed(number_text(value), value))
    refusal = typed.why and _refusal(label, typed.text, check, optional)
    if typed.value != value or (typed.why and not refusal):
        typed.text, typed.value, typed.why = number_text(value), value, ""
    typed.retell(refusal)
    state.set_widget(key, typed.text)
    place = place or st.container(width=options.get("width", "stretch"))
    shown = with_unit(label, unit)
    place.text_input(shown, key=key, on_change=_read, args=(label, typed, check, take, key, optional), **options)
    if typed.why:
        in_use = (
            words("{value} stays in use.", value=number_text(value)) if number_text(value) else words("It stays empty.")
        )
        with (under or place).container(key=f"refused_{key}"):
            st.error(f"{typed.why}. {in_use}")


def design_number(
    name: str,
    label: str,
    *,
    show: Callable = lambda value: value,
    read: Callable = lambda value: value,
    quantity: str = "",
    key: str = "",
    **options,
) -> None:
    """A number field for the field of the design with this name in design.py.

    show: the number in use, from the design's own, which may be None for a default.   read: and back.
    quantity: whose unit the label shows, see unit_of.   **options: of `number_field`.
    """

    def check(value: float | None) -> None:
        try:
            state.with_changes(**{name: read(value)})
        except SimcError as error:
            raise _named(error, PLACES[name][1], label) from None

    number_field(
        label,
        show(state.value(name)),
        check,
        lambda value: _change(name, read(value)),
        key or f"widget_{name}",
        unit=unit_of(quantity, state.design_now().sheet),
        **options,
    )


def _read(label: str, typed: _Typed, check: Callable, take: Callable, key: str, optional: bool) -> None:
    """Callback: use what was typed, or say why not."""
    if state.overtaken(key):
        return
    typed.text = (state.widget(key) or "").strip()
    typed.why = _refusal(label, typed.text, check, optional)
    if not typed.why:
        typed.value = _number(label, typed.text, optional)
        take(typed.value)


def _refusal(label: str, text: str, check: Callable, optional: bool) -> str:
    """Why this cannot be used, as Markdown; empty where it can."""
    try:
        number = _number(label, text, optional)
    except SimcError as error:
        return told(str(error))
    try:
        check(number)
    except SimcError as error:
        return symbols(str(error))  # of a number: nothing foreign in it
    return ""


def _number(label: str, text: str, optional: bool) -> float | None:
    return None if optional and not text else read_number(label, text)


def _named(error: SimcError, name: str, label: str) -> SimcError:
    """The error with the field called as it is on the page."""
    text = str(error)
    if isinstance(text, Text) and text.values.get("name") == name:
        return SimcError(text.put(name=label))
    rest = text.removeprefix(name)
    return error if rest == text else SimcError(label + rest)


def _change(name: str, value: float | None) -> None:
    state.change(**{name: value})
