"""What the core refuses, told in words in place of a traceback; the look of all warnings."""

from collections.abc import Iterator
from contextlib import contextmanager

import streamlit as st

from pages.common.parts.foreign_text import block, told
from pages.common.parts.symbols import sentence
from pages.common.session import state
from pages.common.words import words
from simc_core.errors import NotReducible, ParseError, RuleEnds, SimcError

AROUND = 70  # characters of a long text that are shown on either side of the fault


@contextmanager
def explain_refusal() -> Iterator[None]:
    """A SimcError raised inside is told in words, in place of the rest of the page."""
    try:
        yield
    except ParseError as error:
        unread(error)
    except NotReducible as error:
        st.error(words("**The half rule does not cover this plant.** {error}", error=sentence(str(error))))
    except SimcError as error:
        st.error(words("**This design is not possible.** {error}", error=sentence(str(error))))
        if isinstance(error, RuleEnds) and error.change:
            st.button(words("Do this"), key="remedy_refusal", on_click=state.change, kwargs=error.change)


def unread(error: SimcError) -> None:
    """What was typed is no plant: why, and the text with a mark below the fault. It quotes what was typed."""
    shown = _place_of(error) if isinstance(error, ParseError) else ""
    st.error(words("**This cannot be read.** {error}{text}", error=told(str(error)), text=shown))


def _place_of(error: ParseError) -> str:
    """The text, or the part of it that matters, with a mark below the fault."""
    begin, end = max(error.position - AROUND, 0), error.position + AROUND
    return block(error.text[begin:end], f"{' ' * (error.position - begin)}^") if error.text.strip() else ""
