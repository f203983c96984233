"""Texts of lessons on the page: Greek letters for plain names; of a file that was opened, nothing becomes markup."""

from pages.common.lessons.lesson import Lesson
from pages.common.parts.foreign_text import told
from pages.common.parts.symbols import spoken, symbols


def shown(lesson: Lesson, text: str) -> str:
    """A sentence of the lesson as Markdown."""
    return symbols(text) if lesson.own else told(text)


def named(lesson: Lesson, text: str) -> str:
    """The same without formulas, for headings and buttons, which are also heard."""
    return spoken(text) if lesson.own else told(text)
