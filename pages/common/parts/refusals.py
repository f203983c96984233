"""What the core refuses, told in words in place of a traceback; the look of all warnings."""

from collections.abc import Iterator
from contextlib import contextmanager

import streamlit as st

from pages.common.parts.foreign_text import told
from pages.common.parts.symbols import sentence
from pages.common.session import state
from simc_core.errors import NotReducible, ParseError, RuleEnds, SimcError


@contextmanager
def explain_refusal() -> Iterator[None]:
    """A SimcError raised inside is told in words, in place of the rest of the page."""
    try:
        yield
    except ParseError as error:  # it quotes what was typed
        st.error(f"**This cannot be read.** {told(str(error))}")
    except NotReducible as error:
        st.error(f"**The half rule does not cover this plant.** {sentence(str(error))}")
    except SimcError as error:
        st.error(f"**This design is not possible.** {sentence(str(error))}")
        if isinstance(error, RuleEnds) and error.change:
            st.button("Do this", key="remedy_refusal", on_click=state.change, kwargs=error.change)
