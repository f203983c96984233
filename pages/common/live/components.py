"""What runs in the browser, registered once: the instruments, and the messages that reach them on the same page."""

import re
from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from uuid import uuid4

import streamlit as st

from pages.common.live.kit.packing import pack
from pages.common.live.modules import bundled
from pages.common.live.spoken import spoken
from pages.common.parts.qr import qr_svg
from pages.common.session import state
from pages.common.session.lecture import asked_lecture
from pages.common.words import language
from pages.common.words.catalogues import ENGLISH
from simc_core.figures import palette

HERE = Path(__file__).parent
WORD = re.compile("[a-z0-9_]{1,20}")
UPLOT = HERE / "vendor" / "uplot.min.js"


@cache
def _instrument(name: str, language: str):
    """One for each language."""
    html = _text(HERE / "kit" / "live.html")
    css = palette.css_variables(".live") + _text(
        UPLOT.with_suffix(".css"), HERE / "kit" / "live.css", HERE / "kit" / "lecture.css"
    )
    js = _text(UPLOT) + spoken(language) + bundled(HERE / name / "main.js")
    return st.components.v2.component(_in_language(f"simc_live_{name}", language), html=html, css=css, js=js)


def _text(*files: Path) -> str:
    return "\n".join(file.read_text(encoding="utf-8") for file in files)


@cache
def _message(language: str):
    js = spoken(language) + bundled(HERE / "kit" / "message.js")
    return st.components.v2.component(_in_language("simc_live_message", language), html="<span></span>", js=js)


def _in_language(name: str, language: str) -> str:
    """Another language is another instrument, which is told everything anew."""
    return name if language == ENGLISH else f"{name}_{language}"


for each in ("tuning", "cascade", "hand", "plane"):
    _instrument(each, ENGLISH)
_message(ENGLISH)


def message(key: str, data: bytes) -> None:
    """Numbers for an instrument of this page."""
    _message(language())(key=_in_language(key, language()), data=data)


def staged(name: str, panels: Sequence[str], figures: Sequence[str], view: str) -> None:
    """Leave of the instrument `name`, which is on this page, these panels (none: all) and these numbers."""
    told = {"kind": "stage", "to": name, "panels": list(panels), "figures": list(figures), "view": view}
    message(key=f"stage_{name}", data=pack(told, {}))


def show(name: str, key: str, data: bytes, take: Callable[[Mapping], None]) -> int:
    """The instrument of that name, and the release it answers next.

    take: does what a release asks for. It hears of it in a callback, or, where no callback heard it, here, and the
    script runs again: so it is with the first thing a page does after its server was started anew, when the new
    session does not know the component yet.
    """

    def heard(release: Mapping) -> None:
        state.remember(f"{key}_answers", int(release["n"]))
        if "link" in release:
            state.remember(f"{key}_place", place_of(release["link"]))
        else:
            take(release)

    own = _in_language(key, language())
    asked = _instrument(name, language())(
        key=own, data=data, on_release_change=lambda: heard(state.widget(own)["release"])
    )
    if asked.release and int(asked.release["n"]) != state.memory(f"{key}_answers", int):
        heard(asked.release)
        st.rerun()
    _lecture(name, key)
    return state.memory(f"{key}_answers", int)


def _lecture(name: str, key: str) -> None:
    """What the lecture view is told: that a link asks for it, and its own link where it asked for that.

    What is asked for stands in every run from then on, with a number by which the browser hears it once: a run that
    follows at once may take away what the one before it has said.
    """
    if place := asked_lecture():
        state.make_last(f"{key}_asked", place_of(place) | {"once": uuid4().hex})
    if asked := state.lasting(f"{key}_asked", dict):
        message(key=f"{key}_lecture", data=pack({"kind": "lecture", "to": name} | asked, {}))
    if place := state.memory(f"{key}_place", dict):
        link = state.address(**place, lecture="1")
        header = {"kind": "link", "to": name, "link": link, "qr": picture_of(qr_svg(link))}
        message(key=f"{key}_link", data=pack(header, {}))


def place_of(given: Mapping) -> dict[str, str]:
    """View and panel of an instrument as a browser or a link names them; what is no short word is left out."""
    found = {name: str(given.get(name, "")) for name in ("view", "panel")}
    return {name: word for name, word in found.items() if WORD.fullmatch(word)}


def picture_of(svg: str) -> str:
    """An SVG as the address of an image."""
    return f"data:image/svg+xml;base64,{b64encode(svg.encode()).decode()}" if svg else ""
