"""Catalogues of translations, read once a process from pages/locale/<language>/LC_MESSAGES/simc.po."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from gettext import c2py
from pathlib import Path

from babel.messages.pofile import read_po

from simc_core.wording import Text

ENGLISH = "en"
LOCALE = Path(__file__).parents[2] / "locale"
# Offered when every sentence of the program is in its catalogue; tests/pages/test_catalogue.py sees to it. Each by the
# name that it has in itself: čeština, norsk, srpski, русский, Deutsch.
OFFERED = {
    ENGLISH: "English",
    "cs": "čeština",
    "no": "norsk",
    "sr": "srpski",
    "ru": "русский",
    "de": "Deutsch",
}


@dataclass(frozen=True, slots=True)
class Catalogue:
    """sentences: by context and template, one form for each number that the language tells apart.

    plural: which of them is for n.
    """

    sentences: Mapping[tuple[str, str], tuple[str, ...]]
    plural: Callable[[int], int]

    def template(self, text: Text) -> str:
        """The template of a text in this language; its own where there is none."""
        found = self.sentences.get((text.context, text.template))
        if not found:
            return text.several if text.several and text.n != 1 else text.template
        return found[self.plural(text.n)] if text.several else found[0]


def catalogue(language: str) -> Catalogue | None:
    """The catalogue of an offered language; None for English, which needs none."""
    return None if language == ENGLISH else _read(language)


def place_of(language: str) -> Path:
    """The file of a language."""
    return LOCALE / language / "LC_MESSAGES" / "simc.po"


@cache
def _read(language: str) -> Catalogue:
    with place_of(language).open("rb") as file:
        read = read_po(file, locale=language)
    sentences = {}
    for message in read:
        one = isinstance(message.id, str)
        forms = (message.string,) if one else tuple(message.string)
        if message.id and all(forms) and not message.fuzzy:
            sentences[message.context or "", message.id if one else message.id[0]] = forms
    return Catalogue(sentences, c2py(read.plural_expr))
