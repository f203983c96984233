"""What runs in the browser, registered once: the instruments, and the messages that reach them on the same page."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import streamlit as st

from pages.common.live.kit.packing import pack
from pages.common.live.modules import bundled
from pages.common.session import state
from simc_core.figures import palette

HERE = Path(__file__).parent
UPLOT = HERE / "vendor" / "uplot.min.js"


def _instrument(name: str):
    html = _text(HERE / "kit" / "live.html")
    css = palette.css_variables(".live") + _text(UPLOT.with_suffix(".css"), HERE / "kit" / "live.css")
    js = _text(UPLOT) + bundled(HERE / name / "main.js")
    return st.components.v2.component(f"simc_live_{name}", html=html, css=css, js=js)


def _text(*files: Path) -> str:
    return "\n".join(file.read_text(encoding="utf-8") for file in files)


tuning = _instrument("tuning")
cascade = _instrument("cascade")
hand = _instrument("hand")
plane = _instrument("plane")
message = st.components.v2.component("simc_live_message", html="<span></span>", js=bundled(HERE / "kit" / "message.js"))


def staged(name: str, panels: Sequence[str], figures: Sequence[str], view: str) -> None:
    """Leave of the instrument `name`, which is on this page, these panels (none: all) and these numbers."""
    told = {"kind": "stage", "to": name, "panels": list(panels), "figures": list(figures), "view": view}
    message(key=f"stage_{name}", data=pack(told, {}))


def show(component: Callable, key: str, data: bytes, take: Callable[[Mapping], None]) -> int:
    """The instrument, and the release it answers next.

    take: does what a release asks for. It hears of it in a callback, or, where no callback heard it, here, and the
    script runs again: so it is with the first thing a page does after its server was started anew, when the new
    session does not know the component yet.
    """

    def heard(release: Mapping) -> None:
        state.remember(f"{key}_answers", int(release["n"]))
        take(release)

    asked = component(key=key, data=data, on_release_change=lambda: heard(state.widget(key)["release"]))
    if asked.release and int(asked.release["n"]) != state.memory(f"{key}_answers", int):
        heard(asked.release)
        st.rerun()
    return state.memory(f"{key}_answers", int)
