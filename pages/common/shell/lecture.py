"""The lecture view of a page without an instrument: large type, no navigation, a figure alone, H hides, steps by steps.

The instruments have one of their own, see live/kit/lecture.js.
"""

from pathlib import Path

import streamlit as st

from pages.common.parts.qr import qr_svg
from pages.common.session import state
from pages.common.session.lecture import ask_lecture, asked_lecture, lecture_is, lecturing
from pages.common.words import words

HERE = Path(__file__).parent
INSTRUMENTS = ("tuning", "cascade")
THEIR_VIEWS = ("", "live", "responses", "tradeoff")

_keys = st.components.v2.component(
    "simc_lecture_keys", html="<span></span>", js=(HERE / "lecture.js").read_text(encoding="utf-8")
)


def offer() -> None:
    """The button in the sidebar."""
    st.button(
        words("Large type"),
        key="lecture_begin",
        width="stretch",
        on_click=_begin,
        help=words("For a lecture; Esc leaves it."),
    )


def lecture(place: str, instrument: bool | None = None) -> None:
    """The page for the last row, where a link or the button asked for it.

    instrument: whether there is one, to which its own views are left; None where the place tells.
    """
    there = place in INSTRUMENTS if instrument is None else instrument
    asked = asked_lecture(leave=lambda view: there and view in THEIR_VIEWS)
    if asked:
        lecture_is({"place": place} | asked)
    on = lecturing()
    if on and on["place"] != place:
        lecture_is({})  # another page: it ends
    if on.get("place") != place:
        return
    panel = on.get("panel", "")
    st.html(f"<style>{(HERE / 'lecture.css').read_text(encoding='utf-8')}{_alone(panel)}</style>")
    with st.container(key="lecture_bar", horizontal=True, vertical_alignment="center", gap="small"):
        st.button(words("Leave"), key="lecture_leave", on_click=_leave)
        with st.popover("QR"):
            link = state.address(
                **{name: word for name, word in on.items() if name in ("view", "panel") and word}, lecture="1"
            )
            st.html(f'<div class="lecture_code">{qr_svg(link)}</div>')
            st.text(link)
        st.caption(
            words("H hides and shows numbers and curves. Right and left arrow: step by step, where there are steps.")
        )
        _keys(key="lecture_keys", data={})


def _alone(panel: str) -> str:
    """One figure and what is being worked on, nothing else."""
    if not (panel and panel.isidentifier()):
        return ""
    kept = ", ".join(
        [f".st-key-figure_{panel}", f":has(.st-key-figure_{panel})", ".st-key-line *", ".st-key-lecture_bar *"]
    )
    return (
        f"[data-testid=stMain] [data-testid=stElementContainer]:not({kept}) {{ display: none }}"
        "[data-testid=stVerticalBlock], [data-testid=stHorizontalBlock] { gap: 0 }"
    )


def _begin() -> None:
    ask_lecture()


def _leave() -> None:
    lecture_is({})
