"""Work of many parts with a bar that says how far it is, for those who wait longer than a moment."""

import math
from collections.abc import Iterator, Sequence
from time import monotonic, thread_time
from typing import TypeVar

import streamlit as st

from pages.common.words import words

Part = TypeVar("Part")
MOMENT = 0.5  # seconds; a bar that comes and goes at once only disturbs


def in_sight(parts: Sequence[Part], what: str, most: float = math.inf) -> Iterator[Part]:
    """The parts one after the other.

    Parameters
    ----------
    parts : sequence
        What there is to do.
    what : str
        What is done, "Simulating changed plants".
    most : float
        Seconds of processor after which no further part is begun.
    """
    bar, begun, used = st.empty(), monotonic(), thread_time()
    for done, part in enumerate(parts):
        if thread_time() - used > most:
            break
        if monotonic() - begun > MOMENT:
            bar.progress(done / len(parts), words("{what}: {done} of {n}", what=what, done=done, n=len(parts)))
        yield part
    bar.empty()
