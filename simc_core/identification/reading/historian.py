"""One row for each value of a tag, as historians export: to one column of time and one of values for each tag."""

from collections.abc import Sequence

import numpy as np

from simc_core.identification.reading.columns import INSTANTS, NUMBERS, WORDS, Column
from simc_core.identification.reading.time_axis import TimeAxis
from simc_core.wording import counted, said

MOST_TAGS = 20
LEAST_VALUES = 2


def is_long(columns: Sequence[Column]) -> bool:
    """Whether there is a column of few words, one of dates and one of values, and nothing else that counts."""
    words = [each for each in columns if each.kind == WORDS and 2 <= len(each.words) <= MOST_TAGS]
    values = [each for each in columns if each.kind == NUMBERS and each.finite.any()]
    dates = any(each.kind == INSTANTS for each in columns)
    return len(words) == 1 and (len(values) == 1 if dates else len(values) == 2) and bool(words[0].values.size > 4)


def by_tags(columns: Sequence[Column], axis: TimeAxis) -> tuple[list[Column], TimeAxis, str]:
    """The same with a column for each tag; each keeps its own instants."""
    tag = next(each for each in columns if each.kind == WORDS and 2 <= len(each.words) <= MOST_TAGS)
    at = next(i for i, each in enumerate(columns) if each.kind == NUMBERS and i not in axis.columns)
    t = axis.of(at)
    found = []
    for code, word in enumerate(tag.words):
        values = np.where(tag.values == code, columns[at].values, np.nan)
        if np.isfinite(values).sum() >= LEAST_VALUES:
            found.append(Column(word[:60] or said("no tag"), "", values))
    in_words = counted(
        "One row for each value of a tag ({name}): {n} tag, each with its own instants.",
        "One row for each value of a tag ({name}): {n} tags, each with its own instants.",
        len(found),
        name=tag.name,
    )
    return found, TimeAxis({-1: t}, axis.unit, set(), axis.said, axis.questions), in_words
