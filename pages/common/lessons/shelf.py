"""The lessons of the program, by subject and by paper. Pure: no streamlit."""

from functools import cache
from pathlib import Path

from pages.common.lessons.lesson import SUBJECTS, Lesson
from pages.common.lessons.read import read_lesson
from simc_core.published.sources import SOURCES
from simc_core.wording import joined, said

DATA = Path(__file__).with_name("data")
NO_PAPER = said("Beyond the papers")


@cache
def lessons() -> dict[str, Lesson]:
    """All of them by id, in the order of the files."""
    found = [read_lesson(file.read_bytes(), own=True) for file in sorted(DATA.glob("*.toml"))]
    return {each.id: each for each in found}


def by_subject() -> dict[str, list[Lesson]]:
    """Title of each subject, and its lessons."""
    return {title: [each for each in lessons().values() if each.subject == key] for key, title in SUBJECTS.items()}


def after(lesson: Lesson) -> Lesson | None:
    """The next one by subject; None after the last one, and after one that is not of the program."""
    order = [each for group in by_subject().values() for each in group]
    at = order.index(lesson) + 1 if lesson in order else len(order)
    return order[at] if at < len(order) else None


def by_source() -> dict[str, list[Lesson]]:
    """Key of each paper, those with most lessons first, and its lessons; last "" for those of none."""
    keys = {each.source for each in lessons().values()}
    found = {key: [each for each in lessons().values() if each.source == key] for key in keys}
    return dict(sorted(found.items(), key=lambda item: (item[0] == "", -len(item[1]), item[0])))


def by_paper() -> dict[str, list[Lesson]]:
    """The same by the full name of the paper."""
    return {joined([f"[{key}]", SOURCES[key]], " ") if key else NO_PAPER: found for key, found in by_source().items()}
