"""What runs in the browser, registered once: the instruments, and the messages that reach them on the same page."""

from collections.abc import Callable, Mapping
from pathlib import Path

import streamlit as st

from pages.common.live.modules import bundled

HERE = Path(__file__).parent
UPLOT = HERE / "vendor" / "uplot.min.js"


def _instrument(name: str):
    html, css = _text(HERE / "kit" / "live.html"), _text(UPLOT.with_suffix(".css"), HERE / "kit" / "live.css")
    js = _text(UPLOT) + bundled(HERE / name / "main.js")
    return st.components.v2.component(f"simc_live_{name}", html=html, css=css, js=js)


def _text(*files: Path) -> str:
    return "\n".join(file.read_text(encoding="utf-8") for file in files)


tuning = _instrument("tuning")
cascade = _instrument("cascade")
hand = _instrument("hand")
message = st.components.v2.component("simc_live_message", html="<span></span>", js=bundled(HERE / "kit" / "message.js"))


def answer_if_unheard(asked, answers: int, take: Callable[[Mapping], None]) -> None:
    """Take a release that no callback heard, and run again.

    So it is with the first thing a page does after its server was started anew: the new session does not know the
    component yet. answers: the last release that was taken.
    """
    release = asked.release
    if release and int(release["n"]) != answers:
        take(release)
        st.rerun()
