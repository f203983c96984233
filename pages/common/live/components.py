"""What runs in the browser, registered once: the instruments, and the messages that reach them on the same page."""

from collections.abc import Callable, Mapping
from pathlib import Path

import streamlit as st

HERE = Path(__file__).parent
KIT = ("format", "table", "panel", "curves", "slider", "strip", "svg", "picture", "instrument", "letters", "mount")
SHARED = ("vendor/uplot.min.js", *(f"kit/{name}.js" for name in KIT))


def _text(*names: str) -> str:
    return "\n".join((HERE / name).read_text(encoding="utf-8") for name in names)


def _instrument(name: str, *own: str):
    html, css = _text("kit/live.html"), _text("vendor/uplot.min.css", "kit/live.css")
    js = _text(*SHARED, *(f"{name}/{part}.js" for part in own))
    return st.components.v2.component(f"simc_live_{name}", html=html, css=css, js=js)


tuning = _instrument("tuning", "panels", "tradeoff", "tuning", "main")
cascade = _instrument("cascade", "loops", "panels", "cascade", "main")
message = st.components.v2.component(
    "simc_live_message", html="<span></span>", js=_text("kit/table.js", "kit/letters.js", "kit/message.js")
)


def answer_if_unheard(asked, answers: int, take: Callable[[Mapping], None]) -> None:
    """Take a release that no callback heard, and run again.

    So it is with the first thing a page does after its server was started anew: the new session does not know the
    component yet. answers: the last release that was taken.
    """
    release = asked.release
    if release and int(release["n"]) != answers:
        take(release)
        st.rerun()
