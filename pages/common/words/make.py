"""make catalogue: all templates into pages/locale/simc.pot, and what is new into the catalogue of each language.

python -m pages.common.words.make cs begins the catalogue of a language that has none.
"""

import sys
from io import BytesIO

from babel.messages.catalog import Catalog
from babel.messages.pofile import read_po, write_po

from pages.common.words.catalogues import LOCALE, place_of
from pages.common.words.extraction import template

POT = LOCALE / "simc.pot"


def main(*begun: str) -> None:
    """Write the template; begin the catalogues of these languages; merge it into those there are."""
    found = template()
    POT.write_text(pot(found), encoding="utf-8")
    for language in sorted({*begun, *(path.parts[-3] for path in LOCALE.glob("*/LC_MESSAGES/simc.po"))}):
        merge(language, found)


def pot(found: Catalog) -> str:
    """The text of the template."""
    return _text(found, omit_header=True)


def merge(language: str, found: Catalog) -> None:
    """New templates go into the catalogue of the language, those that are gone out of it."""
    place = place_of(language)
    if place.exists():
        with place.open("rb") as file:
            own = read_po(file, locale=language)
    else:
        place.parent.mkdir(parents=True)
        own = Catalog(locale=language, charset="utf-8", fuzzy=False)
    own.update(found, no_fuzzy_matching=True, update_creation_date=False)
    place.write_text(_text(own, ignore_obsolete=True), encoding="utf-8")


def _text(catalogue: Catalog, **options: bool) -> str:
    file = BytesIO()
    write_po(file, catalogue, width=120, include_lineno=False, **options)
    return file.getvalue().decode()


if __name__ == "__main__":
    main(*sys.argv[1:])
