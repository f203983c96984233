"""Every key in square brackets has its publication in simc_core.published.sources, and every publication is used."""

import re

from simc_core.published.sources import SOURCES, as_markdown
from tests.browser.tools import ROOT

KEY = re.compile(r"[A-Z]{1,4}\d{2}|PSB")
BRACKETS = re.compile(rf"\[((?:{KEY.pattern})\b[^\]\n]*)\]")  # [SK03], [SK03 eq. 10; V06]
OWNERS = {ROOT / "simc_core" / "published" / "sources.py", ROOT / "docs" / "sources.md"}


def keys_used() -> set[str]:
    files = [ROOT / "README.md"]
    for folder in ("simc_core", "pages", "tests", "docs"):
        files += [path for path in (ROOT / folder).rglob("*") if path.suffix in {".py", ".js", ".md", ".rst"}]
    lessons = [path.read_text() for path in (ROOT / "pages" / "common" / "lessons" / "data").glob("*.toml")]
    in_lessons = {key for text in lessons for key in re.findall(r'^source = "(\w+)"', text, re.MULTILINE)}
    texts = [path.read_text() for path in files if path not in OWNERS and "_build" not in path.parts]
    return in_lessons | {
        key
        for text in texts
        for inside in BRACKETS.findall(text)
        for key in re.findall(rf"\b(?:{KEY.pattern})\b", inside)
    }


def test_keys_and_entries_agree():
    assert keys_used() == set(SOURCES)


def test_the_page_of_sources_is_made_from_the_entries():
    assert (ROOT / "docs" / "sources.md").read_text() == as_markdown()
