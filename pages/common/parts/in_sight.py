"""Work of many parts with a bar that says how far it is, for those who wait longer than a moment."""

from collections.abc import Iterator, Sequence
from time import monotonic
from typing import TypeVar

import streamlit as st

Part = TypeVar("Part")
MOMENT = 0.5  # seconds; a bar that comes and goes at once only disturbs


def in_sight(parts: Sequence[Part], words: str) -> Iterator[Part]:
    """The parts one after the other. words: what is done, "Simulating changed plants"."""
    bar, begun = st.empty(), monotonic()
    for done, part in enumerate(parts):
        if monotonic() - begun > MOMENT:
            bar.progress(done / len(parts), f"{words}: {done} of {len(parts)}")
        yield part
    bar.empty()
