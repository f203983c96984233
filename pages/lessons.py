"""Examples of the papers as lessons: play, predict, move, see."""

from pages.common.lessons import progress
from pages.common.lessons.in_use import lesson_now
from pages.common.lessons.list_view import list_view
from pages.common.lessons.view import lesson_view
from pages.common.shell import header

header.show("lessons")
lesson = lesson_now()
if lesson is None:
    list_view()
else:
    lesson_view(lesson)
progress.keep()
