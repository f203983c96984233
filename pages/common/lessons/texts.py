"""Texts of lessons on the page: Greek letters for plain names; of a file that was opened, nothing becomes markup."""

from pages.common.lessons.lesson import Lesson
from pages.common.parts.foreign_text import told
from pages.common.parts.symbols import symbols


def shown(lesson: Lesson, text: str) -> str:
    """A sentence of the lesson as Markdown."""
    return symbols(text) if lesson.own else told(text)
