"""Texts of lessons on the page: Greek letters for plain names; of a file that was opened, nothing becomes markup.

Those of the program's own lessons are in the catalogue, as pages.common.words.extraction finds them in their files.
"""

from pages.common.lessons.lesson import Lesson
from pages.common.parts.foreign_text import told
from pages.common.parts.symbols import spoken, symbols
from pages.common.words.extraction import is_number
from simc_core.wording import Numeral, Text


def shown(lesson: Lesson, text: str) -> str:
    """A sentence of the lesson as Markdown."""
    return symbols(in_catalogue(text)) if lesson.own else told(text)


def named(lesson: Lesson, text: str) -> str:
    """The same without formulas, for headings and buttons, which are also heard."""
    return spoken(in_catalogue(text)) if lesson.own else told(text)


def label(lesson: Lesson, case: str) -> str:
    """Of a case in legends; a figure tells it in the language in use."""
    text = lesson.label(case)
    return in_catalogue(text) if lesson.own and "name" in lesson.cases.get(case, {}) else text


def in_catalogue(text: str) -> Numeral | Text:
    """A text of a file of the program as the sentence of the catalogue that it is, or as a number."""
    return Numeral(text) if is_number(text) else Text(text, text, {})
