"""A publication by its key: a link to the page of sources, with its full name."""

import re

from simc_core.published.sources import SOURCES

KEY = re.compile(r"\[([A-Z]{1,4}\d{2}|PSB)\b([^\]\n]*)\]")


def cited(key: str) -> str:
    """Markdown of the key in brackets, which leads to the page of sources and tells its full name on hover."""
    full = SOURCES[key].replace('"', "'")
    return f'[\\[{key}\\]](sources?source={key} "{full}")'


def linked(text: str) -> str:
    """The text with a link in place of every first key in square brackets, [SK03 eq. 10]."""

    def link(found: re.Match) -> str:
        return f"{cited(found[1])}{found[2]}" if found[1] in SOURCES else found[0]

    return KEY.sub(link, text)
