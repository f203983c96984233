"""What is to be translated is found, and every language that is offered has all of it."""

import re
from io import BytesIO
from string import Formatter

import pytest
from babel.messages.catalog import Catalog
from babel.messages.pofile import read_po

from pages.common.words import catalogues, extraction, make
from pages.common.words.catalogues import ENGLISH, OFFERED
from simc_core.wording import said
from tests.pages.tools import address, run_page

CZECH = r"""
msgid ""
msgstr ""
"Content-Type: text/plain; charset=utf-8\n"
"Plural-Forms: nplurals=3; plural=(n == 1 ? 0 : n >= 2 && n <= 4 ? 1 : 2);\n"

msgid "gain {k:g}"
msgstr "zesílení {k:g}"

msgid "{n} pole"
msgid_plural "{n} poles"
msgstr[0] "{n} pól"
msgstr[1] "{n} póly"
msgstr[2] "{n} pólů"

msgctxt "poles"
msgid "none"
msgstr "žádné"

msgctxt "zero"
msgid "none"
msgstr "žádná"

#, fuzzy
msgid "guessed"
msgstr "hádáno"
"""


def test_the_template_is_todays():  # else: make catalogue
    assert make.POT.read_text(encoding="utf-8") == make.pot(extraction.template())


def test_an_offered_language_is_complete():
    template = extraction.template()
    for language in set(OFFERED) - {ENGLISH}:
        with catalogues.place_of(language).open("rb") as file:
            assert incomplete(read_po(file, locale=language), template) == [], language


def incomplete(own: Catalog, template: Catalog) -> list[str]:
    """What a catalogue lacks, has without being sure, or has with other places for values."""
    found = []
    for message in filter(lambda each: each.id, template):  # all but the header
        mine = own.get(message.id, message.context)
        one = isinstance(message.id, str)
        ids = {message.id} if one else set(message.id)
        forms = () if mine is None else (mine.string,) if one else tuple(mine.string)
        if not forms or not all(forms):
            found.append(f"not translated: {message.id}")
        elif mine.fuzzy:
            found.append(f"not sure: {message.id}")
        elif not all(any(places(form) == places(each) for each in ids) for form in forms):
            found.append(f"other places: {message.id}: {forms}")
        elif not all(any(markup(form) == markup(each) for each in ids) for form in forms):
            found.append(f"other markup: {message.id}: {forms}")
    return found


def places(text: str) -> list[str]:
    """Everything in braces, in any order."""
    return sorted(re.findall(r"\{[^{}]*\}", text))


def markup(text: str) -> list[object]:
    """What makes a formula, bold letters, code, a link, an element of HTML, a line."""
    counted = [text.count(each) for each in ("$", "**", "`", "](", "\n")]
    return [counted, sorted(re.findall(r"</?\w+|\\[A-Za-z]+", text))]


@pytest.mark.parametrize("language", sorted(set(OFFERED) - {ENGLISH}))
def test_a_language_is_written_in_its_own_letters(language):
    text = catalogues.place_of(language).read_text(encoding="utf-8")
    cyrillic = len(re.findall("[а-яА-ЯёЁђјљњћџЂЈЉЊЋЏ]", text))
    assert cyrillic > 50_000 if language == "ru" else cyrillic == 0


@pytest.mark.parametrize("language", sorted(set(OFFERED) - {ENGLISH}))
@pytest.mark.parametrize("name", ["tuning", "cascade", "from_data"])
def test_pages_open_in_every_language(name, language):
    app = run_page(name, lang=language)
    assert address(app)["lang"] == language
    if name == "tuning":
        assert any(button.label.startswith("1,5 θ: 10,5") for button in app.button)


def test_what_a_catalogue_lacks_is_found():
    template = Catalog()
    for each in ("gain {k:g}", ("{n} pole", "{n} poles"), "guessed", "lag"):
        template.add(each)
    own = read_po(BytesIO(CZECH.encode()), locale="cs")
    assert incomplete(own, template) == ["not sure: guessed", "not translated: lag"]
    own["gain {k:g}"].string = "zesílení {K:g}"
    assert incomplete(own, template)[0].startswith("other places: gain {k:g}")
    own["gain {k:g}"].string = "zesílení ${k:g}$"
    assert incomplete(own, template)[0].startswith("other markup: gain {k:g}")


@pytest.fixture
def czech(tmp_path, monkeypatch):
    """A small catalogue of Czech, read as those of the program are."""
    place = tmp_path / "cs" / "LC_MESSAGES" / "simc.po"
    place.parent.mkdir(parents=True)
    place.write_text(CZECH, encoding="utf-8")
    monkeypatch.setattr(catalogues, "LOCALE", tmp_path)
    catalogues._read.cache_clear()
    yield catalogues.catalogue("cs")
    catalogues._read.cache_clear()


def test_a_catalogue_is_read(czech):
    assert czech.template(said("gain {k:g}", k=2.0)) == "zesílení {k:g}"
    assert czech.template(said("none", context="poles")) == "žádné"
    assert czech.template(said("none", context="zero")) == "žádná"
    assert czech.template(said("none")) == "none"
    assert czech.template(said("guessed")) == "guessed"


def test_python_is_read():
    text = """
from simc_core.wording import counted, said as told
a = told("one {k}", k=1, context="c"), counted("{n} lag", "{n} " "lags", 3)
b = told("x" if a else "y"), words("another's")
"""
    found = [(each.id, each.context) for each in extraction.in_python(text, "a.py")]
    assert sorted(found, key=str) == sorted(
        [("one {k}", "c"), (("{n} lag", "{n} lags"), ""), ("x", ""), ("y", "")], key=str
    )


@pytest.mark.parametrize("call", ['said(f"gain {k}")', 'said("gain " + k)', "said(text)"])
def test_a_template_that_is_put_together_is_refused(call):
    with pytest.raises(extraction.NotPlain, match=r"a.py, line 2"):
        list(extraction.in_python(f"from simc_core.wording import said\n{call}", "a.py"))


def test_javascript_is_read():
    head = 'import { numeral, said } from "../kit/words.js";\n'
    found = extraction.in_script(f'{head}said("Skip");\nsaid("{{a}} \\"of\\" {{b}}", {{ a, b }});', "a.js")
    assert [each.id for each in found] == ["Skip", '{a} "of" {b}']
    assert [each.id for each in extraction.in_script(f'{head}said(\n"a " +\n"b",\n);', "a.js")] == ["a b"]
    assert list(extraction.in_script('said("Skip")', "a.js")) == []
    with pytest.raises(extraction.NotPlain, match=r"a.js, line 2"):
        list(extraction.in_script(f"{head}said(`of ${{a}}`)", "a.js"))


def test_every_template_can_be_filled():
    for message in extraction.everything():
        for text in (message.one, message.several):
            if re.search(r"\{\w*(:[^{}]*)?\}", text) and "\\" not in text:
                assert list(Formatter().parse(text))


def test_new_templates_go_into_a_catalogue_and_old_ones_out_of_it(czech):
    template = Catalog()
    template.add("gain {k:g}")
    template.add("lag")
    make.merge("cs", template)
    merged = catalogues.place_of("cs").read_text(encoding="utf-8")
    assert 'msgid "gain {k:g}"\nmsgstr "zesílení {k:g}"' in merged
    assert 'msgid "lag"\nmsgstr ""' in merged
    assert "guessed" not in merged
