"""A file as columns of numbers, before it is told what they are."""

from dataclasses import dataclass

from simc_core.identification.reading.columns import Column
from simc_core.identification.reading.questions import Question


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """A file as columns of numbers, before it is told what they are.

    understood: one sentence for each step.   questions: what is not clear.   sheets: of a spreadsheet file.
    """

    columns: tuple[Column, ...]
    understood: tuple[str, ...] = ()
    questions: tuple[Question, ...] = ()
    sheets: tuple[str, ...] = ()
