"""What a file does not tell: a question with its answers, one of them assumed where there is one to assume."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Question:
    """Something that is not clear.

    name: of the argument of `read_trend` that answers it.   text: in words.   choices: the answers there are, () for a
    number.   assumed: the answer that is taken meanwhile, "" where nothing can be.
    """

    name: str
    text: str
    choices: tuple[str, ...] = ()
    assumed: str = ""
