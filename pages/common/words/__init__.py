"""The language of a page: its own sentences, those of the core, numbers and formulas in it. Pure: no streamlit.

    words("{n} of {most} used", n=2, most=4)     a sentence of a page, in the language of the session
    translated(text)                             a Text of the core; what is no Text stays what it is
    LABEL = said("Gain margin")                  a constant, which no language is known for yet: translated where shown
    number(0.5), typeset(latex)                  with the decimal sign of the language

English has a decimal point, all other languages of the program a comma. What is copied, exported, or stands in a link
has no language and does not come here.
"""

import re
from collections.abc import Callable, Mapping
from typing import Any

from pages.common.words.catalogues import ENGLISH, Catalogue, catalogue
from simc_core import notation
from simc_core.wording import Numeral, Text, said

DECIMAL = re.compile(r"(?<=\d)\.(?=\d)")
_told_by: list[Callable[[], str]] = [lambda: ENGLISH]


def language_is_told_by(tell: Callable[[], str]) -> None:
    """Whom to ask for the language in use; English unless somebody is named."""
    _told_by[:] = [tell]


def language() -> str:
    """The language in use."""
    return _told_by[0]()


def words(template: str, /, *, context: str = "", **values: Any) -> str:
    """A sentence of a page in the language in use.   template, context, **values: as of `said`."""
    known = catalogue(language())
    if known is None:
        return template.format(**values) if values else template
    return _in(known, said(template, context=context, **values))


def translated(text: str) -> str:
    """A text in the language in use, where it is a Text or a Numeral; any other str as it is."""
    known = catalogue(language())
    return text if known is None else _in(known, text)


def number(value: float, digits: int = notation.DIGITS) -> str:
    """As notation.number, with the decimal sign of the language."""
    return translated(notation.number(value, digits))


def numeral(text: str) -> str:
    """A number that is written already, with the decimal sign of the language."""
    return translated(Numeral(text))


def capitalised(text: str) -> str:
    """With a capital at its beginning, and the rest as it is."""
    return text[:1].upper() + text[1:]


def typeset(latex: str) -> str:
    """A formula with the decimal sign of the language: a comma in braces, which LaTeX sets without a blank."""
    return latex if language() == ENGLISH else DECIMAL.sub("{,}", latex)


def _in(known: Catalogue, text: str) -> str:
    if isinstance(text, Numeral):
        return text.replace(".", ",")
    if not isinstance(text, Text):
        return text
    if not text.template:
        return _in(known, text.values["between"]).join(_in(known, part) for part in text.values["parts"])
    template = known.template(text)
    return template.format(**_values(known, text.values)) if text.values else template


def _values(known: Catalogue, values: Mapping[str, Any]) -> dict[str, Any]:
    told = {}
    for name, value in values.items():
        if isinstance(value, str):
            told[name] = _in(known, value)
        elif isinstance(value, float):
            told[name] = _WithComma(value)
        else:
            told[name] = value
    return told


class _WithComma(float):
    """A number that a template formats as it likes, with a comma for the point."""

    def __format__(self, how: str) -> str:
        return super().__format__(how).replace(".", ",")
