"""A publication by its key: a link to the page of sources, with its full name."""

import re

from pages.common.words import translated
from simc_core.published.sources import SOURCES

KEY = r"[A-Z]{1,4}\d{2}|PSB"
ALONE = re.compile(rf"\b(?:{KEY})\b")
BRACKETS = re.compile(rf"\[((?:{KEY})\b[^\]\n]*)\]")


def address(key: str) -> str:
    """Of the page of sources with this one on top."""
    return f"sources?source={key}"


def cited(key: str) -> str:
    """Markdown of the key in brackets, which leads to the page of sources and tells its full name on hover."""
    return linked(f"[{key}]")


def linked(text: str) -> str:
    """The text with a link in place of every key in square brackets, [SK03 eq. 10; V06]."""

    def link(found: re.Match) -> str:
        return rf"\[{ALONE.sub(_link, found[1])}\]"

    return BRACKETS.sub(link, text)


def _link(found: re.Match) -> str:
    full = translated(SOURCES.get(found[0], "")).replace('"', "'")
    return f'[{found[0]}]({address(found[0])} "{full}")' if full else found[0]
