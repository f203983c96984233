"""What runs in the browser, registered once: the instruments, and the messages that reach them on the same page."""

from collections.abc import Callable, Mapping
from pathlib import Path

import streamlit as st

HERE = Path(__file__).parent
SHARED = ("uplot.min.js", "format.js", "table.js", "panel.js", "curves.js", "slider.js", "strip.js", "svg.js")
SHARED = (*SHARED, "picture.js", "instrument.js", "letters.js", "mount.js")


def _text(*names: str) -> str:
    return "\n".join((HERE / name).read_text(encoding="utf-8") for name in names)


def _instrument(name: str, *own: str):
    html, css = _text("live.html"), _text("uplot.min.css", "live.css")
    return st.components.v2.component(f"simc_live_{name}", html=html, css=css, js=_text(*SHARED, *own))


tuning = _instrument("tuning", "tuning_panels.js", "tradeoff.js", "tuning.js", "tuning_main.js")
cascade = _instrument("cascade", "loops.js", "cascade_panels.js", "cascade.js", "cascade_main.js")
message = st.components.v2.component(
    "simc_live_message", html="<span></span>", js=_text("table.js", "letters.js", "message.js")
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
